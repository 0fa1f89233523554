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

__all__ = ["intervals"]

Array = NDArray[np.float64]
Integers = NDArray[np.intp]
Flags = NDArray[np.bool_]


def intervals(course: Course, near: Neighbours, reach: float) -> tuple[Array, Array]:
    """Where spans are nearer their runs than the radii and a reach.

    Args:
        course: The rods.
        near: Runs of spans near spans.
        reach: Between the surfaces [m].

    Returns:
        Where the intervals begin and end, two on the first and two on the second halves of the spans, equal where there
        are none, each of shape (4, n_runs).
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
    curves, begins, ends = Curves(c, chord, onward, back), np.zeros((4, len(on))), np.zeros((4, len(on)))
    for k in range(len(on)):
        a, ρ = on[k], radius[on[k]] + radius[first[k]] + reach
        u, b, v = _closest_chords(curves, sag, a, first[k], last[k], ρ)
        if b >= 0:
            # Its distance from a rod, a bent curve itself where both run side by side, is looked at in three places,
            # and where it is least or greatest between these. One interval over both halves, or over what is out of
            # reach between two places of touch, would move all its points at once where one of them is left or reached.
            ρ_2 = ρ * ρ
            left = sampled(curves, a, 0.0, first[k], last[k], ρ_2)
            for half in range(2):
                right = sampled(curves, a, 0.5 * (half + 1), first[k], last[k], ρ_2)
                top = farthest(curves, a, left, right, ρ_2)
                begins[2 * half, k], ends[2 * half, k] = _part(curves, a, left, top, ρ_2, u, b, v)
                if top.u < right.u:
                    begins[2 * half + 1, k], ends[2 * half + 1, k] = _part(curves, a, top, right, ρ_2, u, b, v)
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
def _part(
    curves: Curves, a: int, left: Seen, right: Seen, ρ_2: float, u: float, b: int, v: float
) -> tuple[float, float]:
    """Where a part of a span with one place of touch at most is within reach; from u to v on b chords are closest."""
    deep = left if left.inside else right if right.inside else deepest(curves, a, left, right, ρ_2, u, b, v)
    if not deep.inside:
        return left.u, left.u
    begins = left.u if left.inside else edge(curves, a, deep, left.u, ρ_2)
    return begins, right.u if right.inside else edge(curves, a, deep, right.u, ρ_2)
