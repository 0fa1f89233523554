"""The Gauss integral of polygons, exact: solid angles under which segments are seen from one another."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["blocks", "integral", "lengthened"]

# Pairs of segments at a time: their arrays stay in the processor's cache.
AT_ONCE = 16384


def integral(r_k: Array, r_l: Array) -> float:
    """(1/4π) ∬ (r_k − r_l)·(dr_k × dr_l)/|r_k − r_l|³, the signed area of directions over that of the sphere.

    Args:
        r_k: Ends of segments, none of length zero, shape (n, 3) [m].
        r_l: Of another polygon that does not meet it, shape (m, 3) [m].

    Returns:
        The integral; of closed polygons a whole number, positive where they wind right-handed.
    """
    return sum(float(Ω.sum()) for _, Ω in blocks(r_k, r_l)) / (4.0 * np.pi)


def blocks(r_k: Array, r_l: Array) -> Iterator[tuple[int, Array]]:
    """Signed solid angles of all pairs of segments, some rows at a time.

    Differences r_k − r_l of points of two segments fill a parallelogram; seen from the origin, its two triangles span
    Ω with tan Ω/2 = V/(abc + (a·b) c + (b·c) a + (c·a) b) (Van Oosterom & Strackee 1983), V = (r_k − r_l)·(e_k × e_l)
    for either. That is the formula of Klenin & Langowski 2000 without arcsines, which lose digits near a right angle.

    Args:
        r_k: Ends of segments, shape (n, 3).
        r_l: Ends of segments, shape (m, 3).

    Yields:
        Index of the first row, and solid angles, shape (rows, m − 1).
    """
    rows = max(1, AT_ONCE // len(r_l))
    e_l = np.diff(r_l, axis=0)
    for first in range(0, len(r_k) - 1, rows):
        ends = r_k[first : first + rows + 1]
        yield first, _solid_angles(ends, r_l, np.diff(ends, axis=0), e_l)


def _solid_angles(r_k: Array, r_l: Array, e_k: Array, e_l: Array) -> Array:
    """Of the parallelograms between neighbouring differences, shape (n − 1, m − 1)."""
    D = [r_k[:, None, i] - r_l[None, :, i] for i in range(3)]
    size = np.sqrt(D[0] ** 2 + D[1] ** 2 + D[2] ** 2)
    along_l = sum(d[:, :-1] * d[:, 1:] for d in D)
    along_k = sum(d[:-1] * d[1:] for d in D)
    across = sum(d[:-1, :-1] * d[1:, 1:] for d in D)
    # a·(e_k × e_l) as e_l·(a × e_k), term by term.
    x, y, z = (d[:-1, :-1] for d in D)
    p, q, s = (e_k[:, None, i] for i in range(3))
    V = e_l[:, 0] * (y * s - z * q) + e_l[:, 1] * (z * p - x * s) + e_l[:, 2] * (x * q - y * p)
    a, b, c, d = size[:-1, :-1], size[:-1, 1:], size[1:, 1:], size[1:, :-1]
    first = a * b * c + along_l[:-1] * c + along_k[:, 1:] * a + across * b
    second = a * c * d + across * d + along_l[1:] * a + along_k[:, :-1] * c
    return np.asarray(2.0 * (np.arctan2(V, first) + np.arctan2(V, second)))


def lengthened(r_k: Array, r_l: Array) -> float:
    """The Gauss integral of two open curves that go on straight along X for ever, back from start and on from end.

    Of curves that run along X it is their winding from end to end: signed crossings, halved and averaged over all
    directions of view, depend on how these turn about X alone where ends are parallel to it (as in Berger & Prior
    2006). Where curves turn back it goes on to be the winding of what cannot be combed out.

    Args:
        r_k: Ends of segments, none of length zero, shape (n, 3) [m].
        r_l: Of another, shape (m, 3) [m].

    Returns:
        Turns, positive where they wind right-handed about each other.
    """
    rays = _rays(r_k, r_l) + _rays(r_l, r_k)
    return integral(r_k, r_l) + rays / (4.0 * np.pi)


def _rays(r_k: Array, r_l: Array) -> float:
    """Solid angles of both rays of one curve against the segments of another; rays side by side span none."""
    X = np.array([1.0, 0.0, 0.0])
    start, end = r_k[0] - r_l, r_k[-1] - r_l
    return float(_triangles(end[:-1], end[1:], X).sum() + _triangles(start[1:], start[:-1], -X).sum())


def _triangles(a: Array, b: Array, c: Array) -> Array:
    """Signed solid angles of triangles with unit vectors c as third corners, shape (n,)."""
    A, B = np.linalg.norm(a, axis=1), np.linalg.norm(b, axis=1)
    V = np.einsum("ni,ni->n", a, np.cross(b, c))
    return np.asarray(2.0 * np.arctan2(V, A * B + np.einsum("ni,ni->n", a, b) + (b @ c) * A + (a @ c) * B))
