"""Where along its spans a rod is near others.

Fibres that cross touch over some 10 µm of a span that is fifty times as long; so the interval is found first.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.meeting.curves import Course
from dolfinrod.scene.meeting.facing import oppose
from dolfinrod.scene.meeting.neighbours import Neighbours
from dolfinrod.scene.meeting.projection import between_chords, to_chord

__all__ = ["begin_at", "intervals"]

Array = NDArray[np.float64]
Integers = NDArray[np.intp]
Flags = NDArray[np.bool_]

# Corrections of an interval on the true curves, and when one is small against its distance from the deepest point.
CORRECTIONS, SETTLED = 12, 1e-6
# Places of a span at which its distance from a rod, a bent curve itself where both run side by side, is looked at.
SAMPLES = (0.0, 0.5, 1.0)


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
    places = [_sampled(course, near, runs, at, ρ_2) for at in SAMPLES]
    for k in range(len(SAMPLES) - 1, 0, -1):
        f, slope, bend = np.zeros((3, len(a)))
        chord = _Seen(a, u.copy(), b.copy(), v.copy(), f, slope, bend, np.zeros(len(a), dtype=bool))
        places.insert(k, _deepest(course, places[k - 1], places[k], ρ_2, chord))
    inside = np.array([place.inside for place in places])
    found = inside.any(axis=0)
    last = len(places) - 1
    for k, deepest in enumerate((inside.argmax(axis=0), last - inside[::-1].argmax(axis=0))):
        # Samples are at even places, what lies between them at odd ones: the next sample beyond is out of reach.
        beyond = np.clip((deepest - 1) // 2 * 2 if k == 0 else deepest // 2 * 2 + 2, 0, last)
        seen = _chosen(places, deepest)
        look = np.flatnonzero(found & (deepest != k * last))
        at = seen.u.copy()
        at[look] = _edge(course, seen.only(look), _chosen(places, beyond).u[look], ρ_2[look])
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
class _Seen:
    """A point of each span, what lies opposite it, distance² − ρ² and two derivatives by u, and whether that is < 0."""

    a: Integers
    u: Array
    b: Integers
    v: Array
    f: Array
    slope: Array
    bend: Array
    inside: Flags

    def look(self, course: Course, live: Integers, ρ_2: Array) -> None:
        """Look at some of the points anew."""
        seen = oppose(course, self.a[live], self.u[live], self.b[live], self.v[live])
        self.b[live], self.v[live], self.f[live] = seen.b, seen.v, seen.square - ρ_2[live]
        self.slope[live], self.bend[live], self.inside[live] = seen.slope, seen.bend, self.f[live] < 0.0

    def only(self, on: Integers) -> _Seen:
        """Some of the points."""
        derivatives = self.f[on], self.slope[on], self.bend[on]
        return _Seen(self.a[on], self.u[on], self.b[on], self.v[on], *derivatives, self.inside[on])


def _sampled(course: Course, near: Neighbours, runs: Integers, at: float, ρ_2: Array) -> _Seen:
    """The same place of all spans."""
    a, u = near.on[runs], np.full(len(runs), at)
    seen = oppose(course, a, u, *begin_at(course, near, runs, course.place(a, u)))
    # Far ends of a span may face another part of the rod, or themselves.
    within = (near.first[runs] <= seen.b) & (seen.b <= near.last[runs])
    return _Seen(a, u, seen.b, seen.v, seen.square - ρ_2, seen.slope, seen.bend, within & (seen.square < ρ_2))


def _chosen(places: list[_Seen], which: Integers) -> _Seen:
    """One of several places for each span."""
    every = np.arange(len(which))

    def pick(name: str) -> NDArray[Any]:
        return np.asarray(np.array([getattr(place, name) for place in places])[which, every])

    return _Seen(*(pick(field.name) for field in fields(_Seen)))


def _deepest(course: Course, left: _Seen, right: _Seen, ρ_2: Array, chord: _Seen) -> _Seen:
    """Where between two samples beyond reach the distance is least, or a point within reach on the way there.

    Args:
        course: The rods.
        left: The one sample.
        right: The other.
        ρ_2: Square of the reach, shape (n,) [m²].
        chord: Closest points of the chords, where to look if the slopes of the samples do not tell.

    Returns:
        The points.
    """
    low, high, outside = left.u.copy(), right.u.copy(), ~left.inside & ~right.inside
    between = outside & (left.slope < 0.0) & (right.slope > 0.0)
    live = np.flatnonzero(between | (outside & (chord.u > low) & (chord.u < high)))
    turns = np.where(between, -left.slope / np.where(between, right.slope - left.slope, 1.0), 0.0)
    chord.u[between] = (low + turns * (high - low))[between]
    for _ in range(CORRECTIONS):
        if not len(live):
            break
        chord.look(course, live, ρ_2)
        u, slope, bend = chord.u[live], chord.slope[live], chord.bend[live]
        low[live], high[live] = np.where(slope < 0.0, u, low[live]), np.where(slope < 0.0, high[live], u)
        to = np.where(bend > 0.0, u - slope / np.where(bend > 0.0, bend, 1.0), np.nan)
        to = np.where((to > low[live]) & (to < high[live]), to, 0.5 * (low[live] + high[live]))
        on = ~chord.inside[live] & between[live] & (np.abs(to - u) > SETTLED)
        live = live[on]
        chord.u[live] = to[on]
    return chord


def _edge(course: Course, seen: _Seen, beyond: Array, ρ_2: Array) -> Array:
    """Where, between points within reach and others beyond, reach ends.

    Args:
        course: The rods.
        seen: Points within reach.
        beyond: Places beyond, shape (n,).
        ρ_2: Square of the reach [m²].

    Returns:
        Places on the spans, shape (n,).
    """
    inner, outer, deepest = seen.u.copy(), beyond.copy(), seen.u.copy()
    bend = seen.bend
    root = np.sqrt(np.maximum(seen.slope**2 - 2.0 * bend * seen.f, 0.0))
    way = (-seen.slope + np.copysign(root, outer - inner)) / np.where(bend > 0.0, bend, 1.0)
    least, most = np.minimum(inner, outer), np.maximum(inner, outer)
    seen.u[:] = np.clip(np.where(bend > 0.0, inner + way, outer), least, most)
    live = np.arange(len(inner))
    for _ in range(CORRECTIONS):
        if not len(live):
            break
        seen.look(course, live, ρ_2)
        u, f, slope, within = seen.u[live], seen.f[live], seen.slope[live], seen.inside[live]
        inner[live], outer[live] = np.where(within, u, inner[live]), np.where(within, outer[live], u)
        steep = slope * np.sign(beyond - deepest)[live] > 0.0
        to = np.where(steep, u - f / np.where(steep, slope, 1.0), np.nan)
        kept = (to - inner[live]) * (to - outer[live]) <= 0.0
        to = np.where(kept, to, 0.5 * (inner[live] + outer[live]))
        seen.u[live] = to
        live = live[np.abs(to - u) > SETTLED * np.abs(to - deepest[live])]
    return seen.u
