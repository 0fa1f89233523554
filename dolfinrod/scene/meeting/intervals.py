"""Where along its spans a rod is near others.

Fibres that cross touch over some 10 µm of a span that is fifty times as long; so the interval is found first.
"""

from __future__ import annotations

from math import nan
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.compiled import compiled
from dolfinrod.scene.meeting.curves import Course, Curves
from dolfinrod.scene.meeting.depth import Seen, deepest, edge, farthest, sampled
from dolfinrod.scene.meeting.projection import chords_apart
from dolfinrod.scene.meeting.vectors import row

if TYPE_CHECKING:
    from dolfinrod.scene.meeting.neighbours import Neighbours

__all__ = ["MOST", "intervals"]

Array = NDArray[np.float64]
Integers = NDArray[np.intp]
Flags = NDArray[np.bool_]

# Intervals of half a span: in each half of it one on either side of what is out of reach.
MOST = 4


def intervals(course: Course, near: Neighbours, reach: float) -> tuple[Array, Array]:
    """Where spans are nearer their runs than the radii and a reach.

    Args:
        course: The rods.
        near: Runs of spans near spans.
        reach: Between the surfaces [m].

    Returns:
        Where the intervals begin and end, first those on the first halves of the spans, then those on the second,
        equal where there are none, each of shape (2 MOST, n_runs).
    """
    return _found(*course.curves, course.sag, course.spans.radius, near.on, near.first, near.last, reach)


@compiled
def _found(
    c: Array,
    chord: Array,
    onward: Flags,
    back: Flags,
    sag: Array,
    radius: Array,
    on: Integers,
    first: Integers,
    last: Integers,
    reach: float,
) -> tuple[Array, Array]:
    """As `intervals`; of curves the arrays, as Numba takes longer to see what a record is than the loop."""
    curves = Curves(c, chord, onward, back)
    begins, ends = np.zeros((2 * MOST, len(on))), np.zeros((2 * MOST, len(on)))
    for k in range(len(on)):
        a, ρ = on[k], radius[on[k]] + radius[first[k]] + reach
        u, b, v = _closest_chords(curves, sag, a, first[k], last[k], ρ)
        if b >= 0:
            near, ρ_2 = Seen(u, b, v, 0.0, 0.0, 0.0, False), ρ * ρ
            left = sampled(curves, a, 0.0, first[k], last[k], ρ_2)
            for half in range(2):
                middle = sampled(curves, a, 0.5 * half + 0.25, first[k], last[k], ρ_2)
                right = sampled(curves, a, 0.5 * half + 0.5, first[k], last[k], ρ_2)
                some = slice(MOST * half, MOST * (half + 1))
                _fill(curves, a, left, middle, right, ρ_2, near, begins[some, k], ends[some, k])
                left = right
    return begins, ends


@compiled
def _closest_chords(curves: Curves, sag: Array, a: int, first: int, last: int, ρ: float) -> tuple[float, int, float]:
    """Closest points of the chord of a span and of those of a run that are near enough, if any: u, span b or −1, v."""
    c, chord = curves.c, curves.chord
    best_u, best, best_v, least = 0.0, -1, 0.0, nan
    A = row(chord, a)
    for b in range(first, last + 1):
        r = c[a, 0, 0] - c[b, 0, 0], c[a, 0, 1] - c[b, 0, 1], c[a, 0, 2] - c[b, 0, 2]
        u, v, square = chords_apart(r, A, row(chord, b))
        if square <= (ρ + sag[a] + sag[b]) ** 2 and (best < 0 or square < least):
            best_u, best, best_v, least = u, b, v, square
    return best_u, best, best_v


@compiled
def _fill(
    curves: Curves,
    a: int,
    left: Seen,
    middle: Seen,
    right: Seen,
    ρ_2: float,
    near: Seen,
    begins: Array,
    ends: Array,
) -> None:
    """Intervals of half a span, as many as there are places of touch that lie apart.

    Its distance from a rod, a bent curve itself where both run side by side, is looked at in three places, and where it
    is least or greatest between these. One interval over both halves, or over what is out of reach between two places
    of touch, would move all its points at once where one of them is left or reached.
    """
    n = 0
    for one, other in ((left, middle), (middle, right)):
        top = farthest(curves, a, one, other, ρ_2)
        for p, q in ((one, top), (top, other)):
            first, last = _part(curves, a, p, q, ρ_2, near)
            if first < last:
                # What is within reach goes on where the part before has ended.
                if not (p.inside and n > 0 and ends[n - 1] == first):
                    begins[n], n = first, n + 1
                ends[n - 1] = last


@compiled
def _part(curves: Curves, a: int, left: Seen, right: Seen, ρ_2: float, near: Seen) -> tuple[float, float]:
    """Where a part of a span with one place of touch at most is within reach; near it the chords are closest."""
    deep = left if left.inside else right if right.inside else deepest(curves, a, left, right, ρ_2, near)
    if not deep.inside:
        return left.u, left.u
    begins = left.u if left.inside else edge(curves, a, deep, left.u, ρ_2)
    return begins, right.u if right.inside else edge(curves, a, deep, right.u, ρ_2)
