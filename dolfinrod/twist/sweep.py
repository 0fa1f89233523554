"""How all pairs of fibres turn about one another from knot to knot: the one sweep that windings are read off."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.twist.angle import swept
from dolfinrod.twist.coarse import resolved
from dolfinrod.twist.fibres import Fibres, between

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]
    Indices = NDArray[np.intp]

__all__ = ["Sweep", "sweeps"]

# Places at a time: what they need stays in memory, and mostly in the processor's cache.
AT_ONCE = 32768


@dataclass(frozen=True, eq=False)
class Sweep:
    """Some pairs of fibres between the knots of both, ascending.

    Args:
        k: First fibre of each pair, shape (P,).
        l: Second, shape (P,).
        X: Knots, shape (P, m) [m].
        d: From first to second in the plane across, shape (2, P, m) [m].
        angle: Turned from knot to knot; zero off the stretch of X that both share, shape (P, m − 1) [rad].
        shared: Which intervals lie on that stretch, shape (P, m − 1).
        within: The part of each interval on which they were near enough, from 0 to 1, shape (P, m − 1).
    """

    k: Indices
    l: Indices
    X: Array
    d: Array
    angle: Array
    shared: NDArray[np.bool_]
    within: Array

    @property
    def length(self) -> Array:
        """Of the shared stretch of each pair, shape (P,) [m]."""
        return np.asarray(np.where(self.shared, np.diff(self.X, axis=1), 0.0).sum(axis=1))

    @property
    def left_out(self) -> Array:
        """Length on which they were too far apart to count, shape (P,) [m]."""
        return np.asarray(np.where(self.shared, np.diff(self.X, axis=1) * (1.0 - self.within), 0.0).sum(axis=1))


def sweeps(
    fibres: Fibres, k: Indices, l: Indices, *, within: float | None = None, stations: Array | None = None
) -> Iterator[Sweep]:
    """Sweep pairs of fibres, some at a time.

    Args:
        fibres: All of them; those of the pairs never turn back.
        k: First fibre of each pair, shape (P,).
        l: Second, shape (P,).
        within: Distance in the plane across beyond which they do not count; None: they always do [m].
        stations: Further knots, shape (s,) [m].

    Yields:
        Pairs in the order given.

    Raises:
        ValueError: Two fibres meet, share no stretch of X, or are given by too few points.
    """
    if within is not None and not within > 0.0:
        raise ValueError(f"within must be a positive distance, got {within} m")
    extra = np.empty(0) if stations is None else stations
    step = max(1, AT_ONCE // (2 * fibres.X.shape[1] + len(extra)))
    for first in range(0, len(k), step):
        yield _swept(fibres, k[first : first + step], l[first : first + step], extra, within)


def _swept(fibres: Fibres, k: Indices, l: Indices, stations: Array, within: float | None) -> Sweep:
    """Both fibres at every knot of either."""
    n = fibres.X.shape[1]
    A, B = fibres.X[k], fibres.X[l]
    knots = np.concatenate([A, B, np.broadcast_to(stations, (len(k), len(stations)))], axis=1)
    order = np.argsort(knots, axis=1, kind="stable")
    X = np.take_along_axis(knots, order, axis=1)
    # As many nodes of a fibre as have gone before tell the segment it is on.
    i = np.cumsum(order < n, axis=1, dtype=np.int32) - 1
    j = np.cumsum((order >= n) & (order < 2 * n), axis=1, dtype=np.int32) - 1
    i, j = (np.clip(index, 0, n - 2) for index in (i, j))
    d = between(fibres.X, fibres.yz, l, X, j) - between(fibres.X, fibres.yz, k, X, i)
    low, high = np.maximum(A[:, 0], B[:, 0]), np.minimum(A[:, -1], B[:, -1])
    for p in np.flatnonzero(low >= high):
        fibres.shared(int(k[p]), int(l[p]))
    shared = (X[:, :-1] >= low[:, None]) & (X[:, 1:] <= high[:, None])
    angle = np.where(shared, swept(d[:, :, :-1], d[:, :, 1:]), 0.0)
    _apart(k, l, X, d, shared)
    for p in np.flatnonzero(np.abs(angle).max(axis=1) >= 0.5 * np.pi):
        on = np.flatnonzero(shared[p])
        resolved(X[p, on[0] : on[-1] + 2], d[:, p, on[0] : on[-1] + 2], (int(k[p]), int(l[p])))
    if within is None:
        return Sweep(k, l, X, d, angle, shared, np.ones_like(angle))
    start, way = d[:, :, :-1], np.diff(d)
    low_part, high_part = _near(start, way, within)
    near = np.where(shared, swept(start + low_part * way, start + high_part * way), 0.0)
    return Sweep(k, l, X, d, near, shared, high_part - low_part)


def _apart(k: Indices, l: Indices, X: Array, d: Array, shared: NDArray[np.bool_]) -> None:
    """Complain where two fibres go through the same point."""
    zero = (d[0] == 0.0) & (d[1] == 0.0)
    meets = shared & (zero[:, :-1] | zero[:, 1:])
    if np.any(meets):
        p, i = (int(index[0]) for index in np.nonzero(meets))
        raise ValueError(f"fibres {k[p]} and {l[p]} meet near X = {X[p, i]:.6g} m: no winding is defined there")


def _near(a: Array, way: Array, within: float) -> tuple[Array, Array]:
    """Where a straight way from a enters and leaves a disc about the origin, as parts of it; alike outside.

    |a + t way|² = within².
    """
    p, q, over = np.sum(way**2, axis=0), np.sum(a * way, axis=0), np.sum(a**2, axis=0) - within**2
    still, inside = p == 0.0, np.where(over <= 0.0, 1.0, 0.0)
    root = np.sqrt(np.maximum(q**2 - p * over, 0.0))
    size = np.where(still, 1.0, p)
    first = np.where(still, 0.0, np.clip((-q - root) / size, 0.0, 1.0))
    return first, np.where(still, inside, np.clip((-q + root) / size, 0.0, 1.0))
