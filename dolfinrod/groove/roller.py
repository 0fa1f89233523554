"""The groove around its roller: how places on it and in the straight, unrolled groove belong together."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene import SceneError

if TYPE_CHECKING:
    from dolfinrod.groove.scenario import Scenario

__all__ = ["refuse_straight", "turned", "unrolled", "wrapped"]

Array = NDArray[np.float64]


def wrapped(X: Array, R: float) -> Array:
    """(X, Y, Z) ↦ ((R + Y) sin(X/R), (R + Y) cos(X/R) − R, Z), shape (n, 3) [m]; R is the radius of the roller [m]."""
    φ, ρ = X[:, 0] / R, R + X[:, 1]
    return np.stack([ρ * np.sin(φ), ρ * np.cos(φ) - R, X[:, 2]], axis=1)


def unrolled(x: Array, R: float) -> Array:
    """The reverse of `wrapped`, up to half a turn of the roller either way."""
    up = x[:, 1] + R
    return np.stack([R * np.arctan2(x[:, 0], up), np.hypot(x[:, 0], up) - R, x[:, 2]], axis=1)


def turned(v: Array, X: Array, R: float) -> Array:
    """Vectors at places of the unrolled groove, along, out of and across it there, in the axes of space, (n, 3)."""
    c, s = np.cos(X[:, 0] / R), np.sin(X[:, 0] / R)
    return np.stack([c * v[:, 0] + s * v[:, 1], c * v[:, 1] - s * v[:, 0], v[:, 2]], axis=1)


def refuse_straight(scenario: Scenario) -> None:
    """What lies around a roller is bent: straight cylinders, tails and ways along X are not.

    Raises:
        SceneError: The scenario has a roller and one of these.
    """
    straight = (
        (scenario.core is not None, "there is a core, which is straight"),
        (scenario.bundle.tail > 0.0, "fibres have a tail, which is straight"),
        (scenario.ends.speed > 0.0, "fibres go on along X"),
        (scenario.ends.exit == "held" or bool(scenario.ends.trailing), "B holds fibres along axes of space"),
    )
    for meant, why in straight:
        if scenario.roller is not None and meant:
            raise SceneError(f"must be None where {why}, got {scenario.roller} m", field="Scenario.roller")
