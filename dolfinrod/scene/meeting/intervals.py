"""Where along its spans a rod is near others.

Fibres that cross touch over some 10 µm of a span that is fifty times as long; so the interval is found first.
"""

from __future__ import annotations

from math import copysign, nan, sqrt
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.compiled import compiled
from dolfinrod.scene.meeting.curves import Course, Curves, along, spot
from dolfinrod.scene.meeting.projection import begin, chords_apart, closest
from dolfinrod.scene.meeting.vectors import row

if TYPE_CHECKING:
    from dolfinrod.scene.meeting.neighbours import Neighbours

__all__ = ["intervals"]

Array = NDArray[np.float64]
Integers = NDArray[np.intp]
Flags = NDArray[np.bool_]

# Corrections of an interval on the true curves, and when one is small against its distance from the deepest point.
CORRECTIONS, SETTLED = 12, 1e-6


class Seen(NamedTuple):
    """A point of a span, what lies opposite it, distance² − ρ² and two derivatives by u, and whether it is in reach."""

    u: float
    b: int
    v: float
    f: float
    slope: float
    bend: float
    inside: bool


def intervals(course: Course, near: Neighbours, reach: float) -> tuple[Array, Array]:
    """Where spans are nearer their runs than the radii and a reach.

    Args:
        course: The rods.
        near: Runs of spans near spans.
        reach: Between the surfaces [m].

    Returns:
        Where the intervals begin and end on the first and the second halves of the spans, equal where there are none,
        each of shape (2, n_runs).
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
    curves, begins, ends = Curves(c, chord, onward, back), np.zeros((2, len(on))), np.zeros((2, len(on)))
    for k in range(len(on)):
        a, ρ = on[k], radius[on[k]] + radius[first[k]] + reach
        u, b, v = _closest_chords(curves, sag, a, first[k], last[k], ρ)
        if b >= 0:
            found = _interval(curves, a, first[k], last[k], ρ * ρ, u, b, v)
            begins[0, k], ends[0, k], begins[1, k], ends[1, k] = found
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
def _interval(
    curves: Curves, a: int, first: int, last: int, ρ_2: float, u: float, b: int, v: float
) -> tuple[float, float, float, float]:
    """Where a span comes within reach of a run and where it leaves it, twice; from u to v on b chords are closest."""
    # Its distance from a rod, a bent curve itself where both run side by side, is looked at in three places, and where
    # it is least between these.
    start, middle, end = (
        _sampled(curves, a, 0.0, first, last, ρ_2),
        _sampled(curves, a, 0.5, first, last, ρ_2),
        _sampled(curves, a, 1.0, first, last, ρ_2),
    )
    # One interval over both halves would move all its points at once where one of them is left or reached.
    if middle.inside:
        begins = 0.0 if start.inside else _edge(curves, a, middle, 0.0, ρ_2)
        return begins, 0.5, 0.5, 1.0 if end.inside else _edge(curves, a, middle, 1.0, ρ_2)
    early = start if start.inside else _deepest(curves, a, start, middle, ρ_2, u, b, v)
    late = end if end.inside else _deepest(curves, a, middle, end, ρ_2, u, b, v)
    one_begins = one_ends = other_begins = other_ends = 0.0
    if early.inside:
        one_begins = 0.0 if start.inside else _edge(curves, a, early, 0.0, ρ_2)
        one_ends = _edge(curves, a, early, 0.5, ρ_2)
    if late.inside:
        other_begins = _edge(curves, a, late, 0.5, ρ_2)
        other_ends = 1.0 if end.inside else _edge(curves, a, late, 1.0, ρ_2)
    return one_begins, one_ends, other_begins, other_ends


@compiled
def _look(curves: Curves, a: int, u: float, b: int, v: float, ρ_2: float) -> Seen:
    """What lies opposite span a at u, looked for from span b at v on."""
    b, v, held = closest(curves, spot(curves.c, a, u), b, v)
    dd = dx = dt = xx = xt = tt = 0.0
    for i in range(3):
        x, x_u, x_uu = along(curves.c, a, i, u)
        x_B, t, t_v = along(curves.c, b, i, v)
        d = x - x_B
        dd += d * d
        dx += d * x_u
        dt += d * t_v
        xx += x_u * x_u + d * x_uu
        xt += x_u * t
        tt += t * t
    κ = tt - dt
    follows = 0.0 if held or not κ > 0.0 else xt * xt / κ
    return Seen(u, b, v, dd - ρ_2, 2.0 * dx, 2.0 * (xx - follows), dd < ρ_2)


@compiled
def _sampled(curves: Curves, a: int, u: float, first: int, last: int, ρ_2: float) -> Seen:
    """A place of a span."""
    b, v = begin(curves, spot(curves.c, a, u), first, last)
    seen = _look(curves, a, u, b, v, ρ_2)
    # Far ends of a span may face another part of the rod, or themselves.
    within = seen.inside and first <= seen.b and seen.b <= last
    return Seen(u, seen.b, seen.v, seen.f, seen.slope, seen.bend, within)


@compiled
def _deepest(curves: Curves, a: int, left: Seen, right: Seen, ρ_2: float, u: float, b: int, v: float) -> Seen:
    """Where between two samples beyond reach the distance is least, or a point within reach on the way there.

    Args:
        curves: The rods.
        a: The span.
        left: The one sample.
        right: The other.
        ρ_2: Square of the reach [m²].
        u: Where chords are closest, to look there if the slopes of the samples do not tell.
        b: Likewise, on the span opposite.
        v: Likewise.

    Returns:
        The point.
    """
    low, high = left.u, right.u
    if left.inside or right.inside:
        return Seen(u, b, v, 0.0, 0.0, 0.0, False)
    # It may fall and rise between them, or only beside one of them, and then fall or rise on to the other.
    sought = False
    for place, beside in ((_hollow(left, right), left), (_least(left), left), (_least(right), right)):
        if not sought and low < place < high:
            u, b, v, sought = place, beside.b, beside.v, True
    if not sought and not low < u < high:
        return Seen(u, b, v, 0.0, 0.0, 0.0, False)
    seen = Seen(u, b, v, 0.0, 0.0, 0.0, False)
    for _ in range(CORRECTIONS):
        seen = _look(curves, a, u, seen.b, seen.v, ρ_2)
        low, high = (u, high) if seen.slope < 0.0 else (low, u)
        to = _least(seen)
        to = to if low < to < high else 0.5 * (low + high)
        if seen.inside or not sought or not abs(to - u) > SETTLED:
            break
        u = to
    return seen


@compiled
def _hollow(left: Seen, right: Seen) -> float:
    """Where the cubic with the values and slopes of two points is least between them; nowhere else."""
    h = right.u - left.u
    fall, rise, start = right.f - left.f, h * right.slope, h * left.slope
    bend, twist = 3.0 * fall - 2.0 * start - rise, start + rise - 2.0 * fall
    root = bend * bend - 3.0 * twist * start
    below = bend + sqrt(max(root, 0.0))
    return left.u - h * start / below if root > 0.0 and below != 0.0 else nan


@compiled
def _least(seen: Seen) -> float:
    """Where a distance that bends upwards is least, as far as a point tells; nowhere else."""
    return seen.u - seen.slope / seen.bend if seen.bend > 0.0 else nan


@compiled
def _edge(curves: Curves, a: int, seen: Seen, beyond: float, ρ_2: float) -> float:
    """Where, between a point of a span within reach and a place beyond, reach ends."""
    inner, outer, deepest = seen.u, beyond, seen.u
    root = sqrt(max(seen.slope**2 - 2.0 * seen.bend * seen.f, 0.0))
    to = outer
    if seen.bend > 0.0:
        to = inner + (-seen.slope + copysign(root, outer - inner)) / seen.bend
    u = min(max(to, min(inner, outer)), max(inner, outer))
    for _ in range(CORRECTIONS):
        seen = _look(curves, a, u, seen.b, seen.v, ρ_2)
        inner, outer = (u, outer) if seen.inside else (inner, u)
        steep = seen.slope * (1.0 if beyond > deepest else -1.0) > 0.0
        to = u - seen.f / seen.slope if steep else nan
        to = to if (to - inner) * (to - outer) <= 0.0 else 0.5 * (inner + outer)
        settled = abs(to - u) <= SETTLED * abs(to - deepest)
        u = to
        if settled:
            break
    return u
