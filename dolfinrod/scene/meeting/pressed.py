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
    radius_a, radius_b, none = spans.radius[a], spans.radius[first], np.zeros(len(a))
    touching = radius_a + radius_b
    gap = gap_0 = seen.distance - touching
    if len(courses) > 1:
        gap_0 = look(courses[1], a, u, first, last).distance - touching
    acts = in_step(law, gap_0, rate)
    p, slope = acts.mean(gap_0, gap, none) if mean else acts.pressure(gap, none)
    spring = elastic(acts, gap_0, gap, p, mean=mean)
    # Closest points beyond a run are those of another, or of the rod itself.
    some = (np.maximum(p, spring) > 0.0) & (first <= seen.b) & (seen.b <= last)
    on = slice(None) if some.all() else np.flatnonzero(some)
    a, u, seen = a[on], u[on], seen.only(on)
    level, facing = 1.0, face(end, a, u, seen)
    acting = facing
    if mean:
        level = 0.5
        middle = between(courses[1], end, level)
        acting = face(middle, a, u, Opposite(*opposite(middle.curves, a, u, seen.b, seen.v)))
    length = 0.5 * points.weight[on] * spans.length[a]
    radii, gaps = (radius_a[on], radius_b[on]), (gap_0[on], gap[on])
    loads = p[on], slope[on], ((p - spring) * (gap_0 - gap))[on]
    return Pressed(a, u, seen.b, seen.v, points.index[on], length, *radii, *gaps, *loads, acting, facing, level)
