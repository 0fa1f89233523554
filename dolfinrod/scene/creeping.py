"""Friction against the velocity in space, Eq. 28 to the letter: how it changes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from dolfinrod.scene.rubbing import Pressed

__all__ = ["against", "creeping_gradient"]

Array = NDArray[np.float64]


def against(way: Array, rate: float, v_0: float) -> tuple[Array, Array]:
    """Velocity of points on their way in a step, one over which is the rate, and √(|v|² + v_0²)."""
    v = way * rate
    return v, np.sqrt(np.einsum("ni,ni->n", v, v) + v_0**2)


def creeping_gradient(pressed: Pressed, v: Array, speed: Array, rate: float, μ: float, Q: Array, end: Array) -> Array:
    """∂t/∂X of t = −μ p v/√(|v|² + v_0²), in the axes of the wall.

    Args:
        pressed: The points.
        v: Their velocity in space, shape (n, 3) [m/s].
        speed: √(|v|² + v_0²), shape (n,) [m/s].
        rate: ∂v/∂x [1/s].
        μ: Coefficient of friction.
        Q: Axes of the wall where forces act.
        end: Axes of the wall at the end of the step, in which X is.

    Returns:
        The derivative, shape (n, 3, 3).
    """
    bent = np.eye(3) / speed[:, None, None] - v[:, :, None] * v[:, None, :] / (speed**3)[:, None, None]
    follows = (v @ Q / speed[:, None])[:, :, None] * pressed.p_X[:, None, :]
    return -μ * (follows + Q.T @ bent @ end * (pressed.p * rate)[:, None, None])
