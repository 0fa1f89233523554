"""Rotations in whose spins moments do work within a step."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["working"]


def working(q: Array, before: Array, after: Array, level: float) -> tuple[Array, Array]:
    """Rotations in whose spins moments work in the balance, and their gradient by those after the step.

    Unit quaternions q between the ends of a step belong to shorter ones q̄, in which the balance is written: with the
    spins of q/|q̄| couples that add up to nothing leave the moment of momentum as it is.

    Args:
        q: Rotations at which forces act, shape (n, n_q).
        before: Those before the step.
        after: Those after it.
        level: Where in the step forces act.

    Returns:
        Shapes (n, n_q) and (n, n_q, n_q).
    """
    one = np.broadcast_to(np.eye(q.shape[1]), (*q.shape, q.shape[1]))
    if level == 1.0 or q.shape[1] == 1:
        return q, one
    between = (1.0 - level) * before + level * after
    length = np.linalg.norm(between, axis=1)[:, None]
    return q / length, level * (one - 2.0 * q[:, :, None] * q[:, None]) / length[:, :, None] ** 2
