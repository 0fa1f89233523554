"""Straight pieces between numbered points, put in the order in which one leads on to the next."""

from __future__ import annotations

from collections import Counter, defaultdict

import numpy as np
from numpy.typing import NDArray

__all__ = ["ChainError", "chained"]

Array = NDArray[np.float64]
Links = NDArray[np.int64]
Neighbours = dict[int, list[int]]


class ChainError(ValueError):
    """Pieces that are not one open polyline; the message completes "field …"."""


def chained(links: Links, points: Array) -> list[int]:
    """Numbers of the points from one end of a polyline to the other, the way its first piece leads.

    Args:
        links: Points at either end of each piece, in any order and orientation, shape (n, 2).
        points: Shape (n_p, 3).

    Returns:
        Each point of the polyline once.

    Raises:
        ChainError: A piece without length, twice there, or between points that are not; a branch, a loop, a gap.
    """
    _check(links, points)
    neighbours = _neighbours(links)
    for i, around in neighbours.items():
        if len(around) > 2:
            raise ChainError(f"must not branch, got {len(around)} line cells that meet in {_spoken(i, points)}")
    ends = [i for i, around in neighbours.items() if len(around) == 1]
    if not ends:
        loop = _spoken(int(links[0][0]), points)
        raise ChainError(f"must lead from one end to another, got a closed loop through {loop}")
    order = _walked(ends[0], neighbours)
    missed = neighbours.keys() - set(order)
    if missed:
        pieces = f"one through {_spoken(order[0], points)}, another through {_spoken(min(missed), points)}"
        raise ChainError(f"must be one polyline, got pieces that share no point: {pieces}")
    a, b = links[0]
    return order if order.index(a) < order.index(b) else order[::-1]


def _check(links: Links, points: Array) -> None:
    """Each piece by itself can be."""
    if links.min() < 0 or links.max() >= len(points):
        stray = next(int(i) for i in links.flat if not 0 <= i < len(points))
        raise ChainError(f"must hold the points of its cells, got a cell with point {stray} of {len(points)}")
    for i in np.unique(links).tolist():
        if not np.isfinite(points[i]).all():
            raise ChainError(f"must have finite coordinates, got {_spoken(i, points)}")
    for a, b in links.tolist():
        if (points[a] == points[b]).all():
            raise ChainError(f"must have cells of some length, got one of none at {_spoken(a, points)}")
    (a, b), times = Counter((min(link), max(link)) for link in links.tolist()).most_common(1)[0]
    if times > 1:
        between = f"{_spoken(a, points)} and {_spoken(b, points)}"
        raise ChainError(f"must have each cell once, got {times} cells between {between}")


def _neighbours(links: Links) -> Neighbours:
    """The points next to each point."""
    neighbours = defaultdict(list)
    for a, b in links.tolist():
        neighbours[a].append(b)
        neighbours[b].append(a)
    return neighbours


def _walked(end: int, neighbours: Neighbours) -> list[int]:
    """Points from an end onward, as far as they lead."""
    order, onward = [end], neighbours[end]
    while onward:
        order.append(onward[0])
        onward = [i for i in neighbours[order[-1]] if i != order[-2]]
    return order


def _spoken(i: int, points: Array) -> str:
    """A point as it is found again: its number, counted from 0, and where it lies."""
    return f"point {i} at ({', '.join(f'{x:.6g}' for x in points[i])})"
