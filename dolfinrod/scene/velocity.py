"""How rods move at the start."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.errors import SceneError, quoted
from dolfinrod.scene.quantity import VectorLike, assign, rod_index, vector

__all__ = ["Velocity"]

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Velocity:
    """Velocity of a rod at t = 0, ṙ(s) = v + ω × (r₀(s) − about), its sections turning with ω.

    Several of one rod add up; a rod without any is at rest.

    Args:
        v: Velocity of the point `about`, or a function of points in space, (n, 3) [m] → (n, 3) [m/s].
        omega: Angular velocity ω of the rod and of its sections [rad/s].
        about: Point about which the rod turns [m].
        rod: Number of the rod; None: every rod.

    Raises:
        SceneError: No vectors of finite numbers.
    """

    v: VectorLike | Callable[[Array], Array] = (0.0, 0.0, 0.0)
    omega: VectorLike = (0.0, 0.0, 0.0)
    about: VectorLike = (0.0, 0.0, 0.0)
    rod: int | None = None

    def __post_init__(self) -> None:
        v = self.v if callable(self.v) else vector(self.v, "Velocity.v", "m/s")
        omega = vector(self.omega, "Velocity.omega", "rad/s")
        about = vector(self.about, "Velocity.about", "m")
        assign(self, v=v, omega=omega, about=about, rod=rod_index(self.rod, "Velocity.rod"))

    def at(self, r: Array) -> Array:
        """Velocity of points.

        Args:
            r: Points in space, shape (n, 3) [m].

        Returns:
            Velocities, shape (n, 3) [m/s].

        Raises:
            SceneError: A function gave something else.
        """
        turning = np.cross(np.asarray(self.omega), r - np.asarray(self.about))
        return turning + (_values(self.v, r) if callable(self.v) else np.asarray(self.v))


def _values(function: Callable[[Array], Array], r: Array) -> Array:
    v = np.asarray(function(r), dtype=float)
    if v.shape != r.shape or not np.isfinite(v).all():
        raise SceneError(f"must give finite velocities of shape {r.shape}, got {quoted(v)}", field="Velocity.v")
    return v
