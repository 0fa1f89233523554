"""How often two curves are linked."""

from __future__ import annotations

from typing import TYPE_CHECKING

from dolfinrod.twist import gauss
from dolfinrod.twist.polygon import corners

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

__all__ = ["link"]


def link(r_k: ArrayLike, r_l: ArrayLike, *, closed: bool = True) -> float:
    """Linking number of two closed polygons, by their Gauss integral; that integral as it is of open ones.

    Lk = (1/4π) ∮∮ (r_k − r_l)·(dr_k × dr_l)/|r_k − r_l|³. Of a thin closed ribbon r, r + ε u it is Tw + Wr, `twist(r,
    u)` and `writhe(r)` (Călugăreanu, White, Fuller). Right-handed links are positive whichever way both are run through
    together; running through one the other way changes the sign.

    Args:
        r_k: Points of one curve in order, shape (n, 3) [m].
        r_l: Of the other, shape (m, 3) [m].
        closed: Whether a last segment leads back to the first point, of either.

    Returns:
        Turns; a whole number but for round-off where the curves are closed.
    """
    return gauss.integral(corners(r_k, closed=closed), corners(r_l, closed=closed))
