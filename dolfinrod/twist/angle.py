"""Angles about the machine direction X, from Y to Z, positive as a right-handed screw turns: Z twist."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["swept"]


def swept(before: Array, after: Array) -> Array:
    """Angle from one place across X to another, Δθ = atan2(y z′ − z y′, y y′ + z z′) with θ = atan2(z, y).

    It is the angle of the straight way from one to the other, which is less than half a turn: no unwrapping is needed.

    Args:
        before: y and z, shape (2, ...) [m].
        after: y′ and z′, shape (2, ...) [m].

    Returns:
        Shape (...) [rad].
    """
    (y, z), (y_after, z_after) = before, after
    return np.asarray(np.arctan2(y * z_after - z * y_after, y * y_after + z * z_after))
