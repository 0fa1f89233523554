"""Points of rods that press on others: gaps, line loads and how these change."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.meeting.curves import Course, between
from dolfinrod.scene.meeting.facing import Facing, face
from dolfinrod.scene.meeting.intervals import begin_at
from dolfinrod.scene.meeting.neighbours import Neighbours
from dolfinrod.scene.meeting.spots import Points
from dolfinrod.scene.pressure import NormalLaw

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
    facing: Facing
    end: Facing
    level: float


def load(
    near: Neighbours, points: Points, law: NormalLaw, courses: tuple[Course, ...], *, mean: bool = False
) -> Pressed:
    """Line loads at points.

    Args:
        near: The runs they face.
        points: Gauss points.
        law: Of the load.
        courses: Where a step leads and, where that is asked for, where it began.
        mean: Whether the mean load on the way acts, half-way; else the load at the end, there.

    Returns:
        Those under load.
    """
    end, spans, a, run = courses[0], courses[0].spans, near.on[points.run], points.run
    facing, b, v = _faced(near, points, end)
    radius_a, radius_b, none = spans.radius[a], spans.radius[near.first[run]], np.zeros(len(a))
    gap = facing.distance - radius_a - radius_b
    # Closest points beyond a run are those of another, or of the rod itself.
    within = (near.first[run] <= b) & (b <= near.last[run])
    gap_0 = _faced(near, points, courses[1])[0].distance - radius_a - radius_b if len(courses) > 1 else gap
    p, slope = law.mean(gap_0, gap, none) if mean else law.pressure(gap, none)
    on = np.flatnonzero((p > 0.0) & within)
    a, u, b, v, facing = a[on], points.u[on], b[on], v[on], facing.only(on)
    level, acting = 1.0, facing
    if mean:
        level = 0.5
        middle = between(courses[1], end, level)
        acting, *_ = face(middle, a, u, middle.place(a, u), b, v)
    length = 0.5 * points.weight[on] * spans.length[a]
    radii, gaps = (radius_a[on], radius_b[on]), (gap_0[on], gap[on])
    return Pressed(a, u, b, v, points.index[on], length, *radii, *gaps, p[on], slope[on], acting, facing, level)


def _faced(near: Neighbours, points: Points, course: Course) -> tuple[Facing, Integers, Array]:
    """What faces the points; as `face`."""
    a = near.on[points.run]
    x = course.place(a, points.u)
    return face(course, a, points.u, x, *begin_at(course, near, points.run, x))
