"""Which spans of rods are so near each other that they may touch soon."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.meeting.curves import Course, Spans, between, travel
from dolfinrod.scene.meeting.projection import between_chords

__all__ = ["Neighbours", "near"]

Array = NDArray[np.float64]
Integers = NDArray[np.intp]
Flags = NDArray[np.bool_]


def near(course: Course, touching: Flags, reach: float) -> Integers:
    """Pairs of spans that come nearer each other than their radii and a reach, by balls in a tree.

    Neighbours along one rod, less than π (r_A + r_B) of arc apart, are none.

    Args:
        course: The rods.
        touching: Spans that may touch others, shape (n_spans,).
        reach: Between their surfaces [m].

    Returns:
        Pairs a < b, shape (n, 2).
    """
    from scipy.spatial import cKDTree

    spans, chords, sag = course.spans, course.chords, course.sag
    # An iteration that goes astray has places that are none.
    found = np.flatnonzero(touching & np.isfinite(course.c).all(axis=(1, 2)))
    if len(found) < 2:
        return np.zeros((0, 2), dtype=np.intp)
    long = np.linalg.norm(chords[found], axis=1)
    # One long span would make the balls of all others as large as itself; one that goes astray is cut to no more pieces
    # than there are spans.
    counts = np.maximum(1, np.ceil(long / max(np.median(long), long.mean()))).astype(np.intp)
    ball = np.repeat(np.arange(len(found)), counts)
    part = (np.arange(len(ball)) - np.repeat(np.cumsum(counts) - counts, counts) + 0.5) / counts[ball]
    of = found[ball]
    centres = course.starts[of] + part[:, None] * chords[of]
    around = 0.5 * long[ball] / counts[ball] + sag[of] + spans.radius[of] + 0.5 * reach
    i, j = cKDTree(centres).query_pairs(2.0 * around.max(), output_type="ndarray").T
    apart = centres[i] - centres[j]
    close = np.einsum("ni,ni->n", apart, apart) <= (around[i] + around[j]) ** 2
    a, b = np.sort(of[np.stack([i[close], j[close]])], axis=0)
    a, b = np.divmod(np.unique(a * len(spans.rod) + b), len(spans.rod))
    radii = spans.radius[a] + spans.radius[b]
    apart_along = spans.s[b] - spans.s[a] - spans.length[a]
    a, b = np.stack([a, b])[:, (spans.rod[a] != spans.rod[b]) | (apart_along >= np.pi * radii)]
    _, _, square = between_chords(course.starts[a], chords[a], course.starts[b], chords[b])
    within = spans.radius[a] + spans.radius[b] + reach + sag[a] + sag[b]
    return np.stack([a, b], axis=1)[square <= within**2]


class Neighbours:
    """Pairs of spans that may touch, until nodes have moved so far that others may.

    A run is a piece of a rod made of neighbouring spans, all near one span of a rod.

    Args:
        spans: The rods.
        g_0: Gap at which contact begins [m].
        touching: Spans that may touch others, shape (n_spans,).
        mine: Spans whose own points are looked at, shape (n_spans,).

    Attributes:
        a: First span of each pair, ascending; shape (n,).
        b: Second, ascending for each first.
        run: Number of the run to which the second belongs.
        on: First span, of each run.
        first: Of the spans of each run, the first.
        last: Likewise, the last.
    """

    def __init__(self, spans: Spans, g_0: float, touching: Flags, mine: Flags) -> None:
        self._spans, self._g_0, self._touching, self._mine = spans, g_0, touching, mine
        # Wide enough to serve many steps, and not so wide that pairs beyond the next rod are kept in mind.
        self.skin = float(spans.radius[touching].max(initial=0.0))
        self._around: tuple[Array, ...] = ()

    def holds(self, x: Array) -> bool:
        """Whether the pairs are all that may touch with nodes at x, shape (n_nodes, 3)."""
        moves = [np.einsum("ni,ni->n", x - place, x - place).max(initial=0.0) for place in self._around]
        return any(2.0 * self._spans.spread * np.sqrt(move) <= self.skin for move in moves)

    def swept(self, start: Course, end: Course) -> tuple[Integers, Integers]:
        """Pairs of spans that may touch on straight ways of their nodes from one place to another, each of shape (n,).

        Args:
            start: Where the rods were.
            end: Where they are.

        Returns:
            First and second spans.
        """
        # Pairs that hold at two places hold on the way between them if they were looked for in one.
        if len(self._around) == 1 and self.holds(start.x) and self.holds(end.x):
            return self.a, self.b
        middle = between(start, end, 0.5)
        pairs = near(middle, self._touching, 2.0 * float(travel(start, end)[self._touching].max(initial=0.0)))
        a, b = np.concatenate([pairs, pairs[:, ::-1]]).T
        return a[self._mine[a]], b[self._mine[a]]

    def renew(self, *places: Array) -> None:
        """Look for pairs anew, at each of some places of the nodes."""
        self._around, spans, n = tuple(x.copy() for x in places), self._spans, len(self._spans.rod)
        found = [near(spans.course(x), self._touching, self._g_0 + self.skin) for x in places]
        pairs = np.concatenate([*found, *(pairs[:, ::-1] for pairs in found)])
        self.a, self.b = np.divmod(np.unique(pairs[self._mine[pairs[:, 0]]] @ np.array([n, 1])), n)
        new = np.ones(len(self.a), dtype=bool)
        new[1:] = (np.diff(self.a) != 0) | (np.diff(self.b) != 1) | ~spans.onward[self.b[:-1]]
        self.run, begins = np.cumsum(new) - 1, np.flatnonzero(new)
        ends = np.append(begins[1:], len(new)) - 1 if len(new) else begins
        self.on, self.first, self.last = self.a[begins], self.b[begins], self.b[ends]
