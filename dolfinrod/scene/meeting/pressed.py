"""Points of rods that press on others: gaps, line loads and how these change."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.damped import elastic, in_step
from dolfinrod.scene.meeting.curves import Course, between
from dolfinrod.scene.meeting.facing import Facing, Opposite, face, look
from dolfinrod.scene.meeting.neighbours import Neighbours
from dolfinrod.scene.meeting.projection import opposite
from dolfinrod.scene.meeting.spots import Points
from dolfinrod.scene.normallaw import NormalLaw

__all__ = ["Pressed", "load"]

Array = NDArray[np.float64]
Integers = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class Pressed:
    """Points in contact.

    Args:
        a: Spans of the points, shape (n,).
        u: Places on them.
        b: Spans opposite at the end of the step.
        v: Places on them.
        index: Number of the point in its spot.
        length: For which it stands, half of it since each of two rods has its own points [m].
        radius_a: Of the rod [m].
        radius_b: Of the rod opposite [m].
        gap_0: Between the surfaces at the start of the step [m].
        gap: At its end [m].
        p: Line load [N/m].
        slope: dp/dg by the gap at the end [N/m²].
        damped: Work that damping takes in the step [J/m].
        facing: Where the load acts.
        end: At the end of the step.
        level: Part of the step at which the load acts.
    """

    a: Integers
    u: Array
    b: Integers
    v: Array
    index: Integers
    length: Array
    radius_a: Array
    radius_b: Array
    gap_0: Array
    gap: Array
    p: Array
    slope: Array
    damped: Array
    facing: Facing
    end: Facing
    level: float


def load(
    near: Neighbours,
    points: Points,
    law: NormalLaw,
    courses: tuple[Course, ...],
    *,
    mean: bool = False,
    rate: float = 0.0,
) -> Pressed:
    """Line loads at points.

    Args:
        near: The runs they face.
        points: Gauss points.
        law: Of the load.
        courses: Where a step leads and, where that is asked for, where it began.
        mean: Whether the mean load on the way acts, half-way; else the load at the end, there.
        rate: One over the length of the step, for what is damped [1/s].

    Returns:
        Those under load, and those that damping alone keeps from it.
    """
    end, spans, run, u = courses[0], courses[0].spans, points.run, points.u
    a, first, last = near.on[run], near.first[run], near.last[run]
    seen = look(end, a, u, first, last)
    radius_a, radius_b = spans.radius[a], spans.radius[first]
    gap = gap_0 = seen.distance - (radius_a + radius_b)
    if len(courses) > 1:
        gap_0 = look(courses[1], a, u, first, last).distance - (radius_a + radius_b)
    p, slope, damped, touching = _loads(gap_0, gap, law, rate, mean=mean)
    # Closest points beyond a run are those of another, or of the rod itself.
    some = touching & (first <= seen.b) & (seen.b <= last)
    on = slice(None) if some.all() else np.flatnonzero(some)
    a, u, seen = a[on], u[on], seen.only(on)
    facing = face(end, a, u, seen)
    acting, level = (_half_way(courses[1], end, a, u, seen), 0.5) if mean else (facing, 1.0)
    length = 0.5 * points.weight[on] * spans.length[a]
    radii, gaps = (radius_a[on], radius_b[on]), (gap_0[on], gap[on])
    loads = p[on], slope[on], damped[on]
    return Pressed(a, u, seen.b, seen.v, points.index[on], length, *radii, *gaps, *loads, acting, facing, level)


def _half_way(start: Course, end: Course, a: Integers, u: Array, seen: Opposite) -> Facing:
    """Where mean loads act on points that face others at the end of a step."""
    middle = between(start, end, 0.5)
    return face(middle, a, u, Opposite(*opposite(middle.curves, a, u, seen.b, seen.v)))


def _loads(
    gap_0: Array, gap: Array, law: NormalLaw, rate: float, *, mean: bool
) -> tuple[Array, Array, Array, NDArray[np.bool_]]:
    """Line loads of a step from gaps to others, their slopes, work of damping, and what of it touches."""
    acts, none = in_step(law, gap_0, rate), np.zeros_like(gap)
    p, slope = acts.mean(gap_0, gap, none) if mean else acts.pressure(gap, none)
    spring = elastic(acts, gap_0, gap, p, mean=mean)
    return p, slope, (p - spring) * (gap_0 - gap), np.maximum(p, spring) > 0.0
