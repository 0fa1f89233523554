"""Points of one rod and what lies opposite them on another."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.meeting.curves import Course, dot
from dolfinrod.scene.meeting.projection import project

__all__ = ["Facing", "Opposite", "face", "oppose"]

Array = NDArray[np.float64]
Integers = NDArray[np.intp]
Flags = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Opposite:
    """What lies opposite points of spans: the closest points of others.

    Args:
        b: Spans where it lies, shape (n,).
        v: Coordinates there.
        d: From there to the points, shape (n, 3) [m].
        square: Distance squared, shape (n,) [m²].
        slope: Its derivative by the coordinate u of the points on their spans.
        bend: Its second derivative by u.
    """

    b: Integers
    v: Array
    d: Array
    square: Array
    slope: Array
    bend: Array


def oppose(course: Course, a: Integers, u: Array, b: Integers, v: Array) -> Opposite:
    """What lies opposite points of spans a at u, looked for from spans b at v on."""
    x, x_u, x_uu = course.at(a, u)
    b, v, held = project(course, x, b, v)
    x_B, t, t_v = course.at(b, v)
    d = x - x_B
    κ = dot(t, t) - dot(d, t_v)
    follows = np.where(held | (κ <= 0.0), 0.0, dot(x_u, t) ** 2 / np.where(κ == 0.0, 1.0, κ))
    return Opposite(b, v, d, dot(d, d), 2.0 * dot(d, x_u), 2.0 * (dot(x_u, x_u) + dot(d, x_uu) - follows))


@dataclass(frozen=True, eq=False)
class Facing:
    """Points opposite each other, as linear in nodes.

    Args:
        nodes: Of the first span, then of the second, shape (n, M).
        h: Weights of nodes in x_A − x_B, shape (n, M).
        h_v: Their derivatives by the coordinate v on the second, shape (n, M).
        d: x_A − x_B, shape (n, 3) [m].
        t: dx_B/dv, shape (n, 3) [m].
        follow: 1/(|t|² − d·x_B″), the way of the point opposite; zero where it is held, shape (n,) [1/m²].
    """

    nodes: Integers
    h: Array
    h_v: Array
    d: Array
    t: Array
    follow: Array

    @property
    def distance(self) -> Array:
        """|d|, shape (n,) [m]."""
        return np.sqrt(dot(self.d, self.d))

    @property
    def normal(self) -> Array:
        """From the second to the first, shape (n, 3)."""
        D = self.distance
        return np.asarray(self.d / np.where(D > 0.0, D, 1.0)[:, None])

    def only(self, on: Integers | Flags) -> Facing:
        """Some of the points."""
        return Facing(self.nodes[on], self.h[on], self.h_v[on], self.d[on], self.t[on], self.follow[on])


def face(course: Course, a: Integers, u: Array, x: Array, b: Integers, v: Array) -> tuple[Facing, Integers, Array]:
    """What faces points.

    Args:
        course: The rods.
        a: Spans of the points, shape (n,).
        u: Their coordinates there.
        x: Where they are, shape (n, 3) [m].
        b: Spans from which on what faces them is looked for.
        v: Likewise, coordinates.

    Returns:
        What faces them, on which spans, and where on them.
    """
    spans = course.spans
    b, v, held = project(course, x, b, v)
    x_B, t, t_v = course.at(b, v)
    d = x - x_B
    κ = dot(t, t) - dot(d, t_v)
    free = ~held & (κ > 0.0)
    follow = np.where(free, 1.0 / np.where(free, κ, 1.0), 0.0)
    w, w_v = spans.weights(b, v), spans.slopes(b, v)
    h = np.concatenate([spans.weights(a, u), -w], axis=1)
    h_v = np.concatenate([np.zeros_like(w), w_v], axis=1)
    nodes = np.concatenate([spans.nodes[a], spans.nodes[b]], axis=1)
    return Facing(nodes, h, h_v, d, t, follow), b, v
