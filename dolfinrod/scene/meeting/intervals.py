"""Where along its spans a rod is near others.

Fibres that cross touch over some 10 µm of a span that is fifty times as long; so the interval is found first.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.meeting.curves import Course
from dolfinrod.scene.meeting.facing import Opposite, oppose
from dolfinrod.scene.meeting.neighbours import Neighbours
from dolfinrod.scene.meeting.projection import between_chords, to_chord

__all__ = ["begin_at", "intervals"]

Array = NDArray[np.float64]
Integers = NDArray[np.intp]
Flags = NDArray[np.bool_]

# Corrections of an interval on the true curves, and when one is small against its distance from the deepest point.
CORRECTIONS, SETTLED = 12, 1e-6


def intervals(course: Course, near: Neighbours, reach: float) -> tuple[Array, Array]:
    """Where spans are nearer their runs than the radii and a reach.

    Args:
        course: The rods.
        near: Runs of spans near spans.
        reach: Between the surfaces [m].

    Returns:
        Where the intervals begin and end on the spans, equal where there are none, each of shape (n_runs,).
    """
    ends = np.zeros((2, len(near.on)))
    runs, u, b, v = _closest_chords(course, near, reach)
    if not len(runs):
        return ends[0], ends[1]
    a = near.on[runs]
    ρ_2 = (course.spans.radius[a] + course.spans.radius[b] + reach) ** 2
    outer = []
    for end in (0.0, 1.0):
        at = np.full(len(runs), end)
        outer.append(oppose(course, a, at, *begin_at(course, near, runs, course.place(a, at))))
    # Far ends of a span may face another part of the rod, or themselves.
    held = [(near.first[runs] <= side.b) & (side.b <= near.last[runs]) for side in outer]
    inside = [(side.square < ρ_2) & within for side, within in zip(outer, held, strict=True)]
    deep, found = _deepest(course, outer, inside, ρ_2, _Deep(a, u, b, v, *np.zeros((3, len(a)))))
    for k, end in enumerate((0.0, 1.0)):
        at = np.where(inside[k], end, deep.u)
        look = np.flatnonzero(found & ~inside[k])
        at[look] = _edge(course, deep, look, end, ρ_2)
        ends[k, runs] = np.where(found, at, 0.0)
    return ends[0], ends[1]


def _closest_chords(course: Course, near: Neighbours, reach: float) -> tuple[Integers, Array, Integers, Array]:
    """Runs whose chords are near enough, and the closest points of these: numbers, u, spans b, v."""
    a, b, chords, sag, radius = near.a, near.b, course.chords, course.sag, course.spans.radius
    u, v, square = between_chords(course.starts[a], chords[a], course.starts[b], chords[b])
    close = square <= (radius[a] + radius[b] + reach + sag[a] + sag[b]) ** 2
    some = np.flatnonzero(close)
    order = some[np.lexsort((square[some], near.run[some]))]
    runs, first = np.unique(near.run[order], return_index=True)
    best = order[first]
    return runs, u[best], b[best], v[best]


def begin_at(course: Course, near: Neighbours, runs: Integers, x: Array) -> tuple[Integers, Array]:
    """Closest points of the chords of runs, from which the closest ones of the curves are looked for.

    Args:
        course: The rods.
        near: The runs.
        runs: Numbers of them, one for each point, shape (n,).
        x: The points, shape (n, 3) [m].

    Returns:
        Spans and places on them, each of shape (n,).
    """
    counts = near.last[runs] - near.first[runs] + 1
    point = np.repeat(np.arange(len(runs)), counts)
    span = near.first[runs][point] + np.arange(len(point)) - np.repeat(np.cumsum(counts) - counts, counts)
    v, square = to_chord(x[point], course.starts[span], course.chords[span])
    least = np.minimum.reduceat(square, np.cumsum(counts) - counts) if len(runs) else square
    best = np.flatnonzero(square == least[point])[::-1]
    chosen = np.zeros(len(runs), dtype=np.intp)
    # Of equals the first, which is written last.
    chosen[point[best]] = best
    return span[chosen], v[chosen]


@dataclass(frozen=True, eq=False)
class _Deep:
    """A point of each span, what lies opposite it, and its distance² − ρ² with two derivatives by u."""

    a: Integers
    u: Array
    b: Integers
    v: Array
    f: Array
    slope: Array
    bend: Array

    def face(self, course: Course, live: Integers, ρ_2: Array) -> None:
        """Look at some of the points anew."""
        self.take(live, oppose(course, self.a[live], self.u[live], self.b[live], self.v[live]), ρ_2[live])

    def take(self, of: Integers, seen: Opposite, ρ_2: Array) -> None:
        """What was seen of some of the points."""
        self.b[of], self.v[of], self.f[of] = seen.b, seen.v, seen.square - ρ_2
        self.slope[of], self.bend[of] = seen.slope, seen.bend


def _deepest(
    course: Course, outer: list[Opposite], inside: list[Flags], ρ_2: Array, deep: _Deep
) -> tuple[_Deep, Flags]:
    """A point of each span within reach: an end, or one on the way to where the distance is least.

    Args:
        course: The rods.
        outer: What lies opposite the ends of the spans.
        inside: Whether it is within reach.
        ρ_2: Square of the reach, shape (n,) [m²].
        deep: Where to begin.

    Returns:
        The points, and whether they are within reach.
    """
    found, low, high = inside[0] | inside[1], np.zeros(len(ρ_2)), np.ones(len(ρ_2))
    for end, seen, within in ((0.0, outer[0], inside[0]), (1.0, outer[1], inside[1] & ~inside[0])):
        of = np.flatnonzero(within)
        deep.u[of] = end
        deep.take(of, seen.only(of), ρ_2[of])
    # A distance that grows from an end on, or falls to it, is least there.
    between, live = (outer[0].slope < 0.0) & (outer[1].slope > 0.0), np.flatnonzero(~found)
    for _ in range(CORRECTIONS):
        if not len(live):
            break
        deep.face(course, live, ρ_2)
        u, slope, bend = deep.u[live], deep.slope[live], deep.bend[live]
        found[live] = deep.f[live] < 0.0
        low[live], high[live] = np.where(slope < 0.0, u, low[live]), np.where(slope < 0.0, high[live], u)
        to = np.where(bend > 0.0, u - slope / np.where(bend > 0.0, bend, 1.0), np.nan)
        to = np.where((to > low[live]) & (to < high[live]), to, 0.5 * (low[live] + high[live]))
        on = ~found[live] & between[live] & (np.abs(to - u) > SETTLED)
        live = live[on]
        deep.u[live] = to[on]
    return deep, found


def _edge(course: Course, deep: _Deep, look: Integers, end: float, ρ_2: Array) -> Array:
    """Where, between a point within reach and an end beyond, reach ends.

    Args:
        course: The rods.
        deep: Points within reach.
        look: Numbers of those that are looked at, shape (n,).
        end: 0 or 1.
        ρ_2: Square of the reach of all [m²].

    Returns:
        Places on the spans, shape (n,).
    """
    ρ_2, inner, outer, deepest = ρ_2[look], deep.u[look], np.full(len(look), end), deep.u[look]
    at = _Deep(deep.a[look], deep.u[look], deep.b[look], deep.v[look], *np.zeros((3, len(look))))
    f, slope, bend = deep.f[look], deep.slope[look], deep.bend[look]
    root = np.sqrt(np.maximum(slope**2 - 2.0 * bend * f, 0.0))
    way = (-slope + np.copysign(root, outer - inner)) / np.where(bend > 0.0, bend, 1.0)
    at.u[:] = np.clip(np.where(bend > 0.0, inner + way, outer), np.minimum(inner, outer), np.maximum(inner, outer))
    live = np.arange(len(look))
    for _ in range(CORRECTIONS):
        if not len(live):
            break
        at.face(course, live, ρ_2)
        u, f, slope = at.u[live], at.f[live], at.slope[live]
        inner[live], outer[live] = np.where(f < 0.0, u, inner[live]), np.where(f < 0.0, outer[live], u)
        steep = slope * np.sign(end - deepest[live]) > 0.0
        to = np.where(steep, u - f / np.where(steep, slope, 1.0), np.nan)
        kept = (to - inner[live]) * (to - outer[live]) <= 0.0
        to = np.where(kept, to, 0.5 * (inner[live] + outer[live]))
        at.u[live] = to
        live = live[np.abs(to - u) > SETTLED * np.abs(to - deepest[live])]
    return at.u
