"""Curves as users give them: points joined by straight lines, checked at the door."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.float64]

__all__ = ["checked", "corners", "same"]

# Of the extent of a curve, below which two points are one but for round-off.
ROUND_OFF = 1e-12


def checked(r: ArrayLike, name: str = "a curve") -> Array:
    """Points of a polyline.

    Args:
        r: Points in order, shape (n, 3) [m].
        name: Of the curve, for complaints.

    Returns:
        The same as doubles.

    Raises:
        ValueError: They are fewer than two, not in space, or not finite.
    """
    points = np.asarray(r, dtype=float)
    if points.ndim != 2 or points.shape[1] != 3 or len(points) < 2:
        raise ValueError(f"{name} must be two or more points in space, shape (n, 3), got shape {points.shape}")
    if not np.isfinite(points).all():
        first = int(np.argmax(~np.isfinite(points).all(axis=1)))
        raise ValueError(f"{name} must be finite, but its point {first} is {points[first]} m")
    return points


def same(a: Array, b: Array, curve: Array) -> NDArray[np.bool_]:
    """Whether points of a curve are one but for round-off, shape (...)."""
    return np.asarray(np.linalg.norm(a - b, axis=-1) <= ROUND_OFF * float(np.ptp(curve, axis=0).max()))


def corners(r: ArrayLike, *, closed: bool) -> Array:
    """Ends of the segments of a polygon, none of which has length zero.

    Args:
        r: Points in order, shape (n, 3) [m].
        closed: Whether a last segment leads back to the first point, which may be listed again at the end or not.

    Returns:
        Shape (n_segments + 1, 3) [m]; of a closed polygon the last is the first.

    Raises:
        ValueError: A closed polygon has fewer than three points, or one of those `checked` names.
    """
    points = checked(r)
    points = points[np.r_[True, ~same(points[1:], points[:-1], points)]]
    if closed:
        once = points[:-1] if len(points) > 1 and same(points[-1], points[0], points) else points
        points = np.concatenate([once, once[:1]])
    if len(points) < (4 if closed else 2):
        raise ValueError(
            f"a {'closed' if closed else 'open'} curve has too few different points, {len(points) - closed}"
        )
    return points
