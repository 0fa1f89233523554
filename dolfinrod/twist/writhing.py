"""How a curve coils in space."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.twist import gauss
from dolfinrod.twist.polygon import corners

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

__all__ = ["writhe"]


def writhe(r: ArrayLike, *, closed: bool = False) -> float:
    """Writhe of a polygon, its own Gauss integral Wr = (1/4π) ∬ (r − r′)·(dr × dr′)/|r − r′|³, exact.

    Crossings with their signs, averaged over all directions of view; right-handed coils are positive. Zero in a plane.
    Of points on a smooth curve it is off by the square of their distance.

    Args:
        r: Points in order, shape (n, 3) [m].
        closed: Whether a last segment leads back to the first point.

    Returns:
        Turns.
    """
    ends = corners(r, closed=closed)
    n, total = len(ends) - 1, 0.0
    for first, Ω in gauss.blocks(ends, ends):
        i, j = first + np.arange(len(Ω))[:, None], np.arange(n)
        apart = np.abs(i - j)
        # A segment and those before and after it lie in planes with it.
        neighbours = (apart <= 1) | (closed & (apart == n - 1))
        total += float(np.where(neighbours, 0.0, Ω).sum())
    return total / (4.0 * np.pi)
