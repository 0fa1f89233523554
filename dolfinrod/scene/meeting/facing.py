"""Points of one rod and what lies opposite them on another."""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.compiled import compiled
from dolfinrod.scene.meeting.curves import Course, dot
from dolfinrod.scene.meeting.projection import faced

__all__ = ["Facing", "Opposite", "face", "look"]

Array = NDArray[np.float64]
Integers = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class Opposite:
    """What lies opposite points: the closest points of others.

    Args:
        b: Spans where it lies, shape (n,).
        v: Coordinates there.
        d: From there to the points, x_A − x_B, shape (n, 3) [m].
        t: dx_B/dv, shape (n, 3) [m].
        follow: 1/(|t|² − d·x_B″), the way of the point opposite; zero where it is held, shape (n,) [1/m²].
    """

    b: Integers
    v: Array
    d: Array
    t: Array
    follow: Array

    @property
    def distance(self) -> Array:
        """|d|, shape (n,) [m]."""
        return np.sqrt(dot(self.d, self.d))

    def only(self, on: Integers | slice) -> Opposite:
        """Some of the points."""
        return Opposite(self.b[on], self.v[on], self.d[on], self.t[on], self.follow[on])


def look(course: Course, a: Integers, u: Array, first: Integers, last: Integers) -> Opposite:
    """What lies opposite points on runs.

    Args:
        course: The rods.
        a: Spans of the points, shape (n,).
        u: Places on them.
        first: Spans with which the runs begin, shape (n,).
        last: With which they end.

    Returns:
        The closest places, which may be beyond the runs.
    """
    return Opposite(*faced(*course.curves, a, u, first, last))


@dataclass(frozen=True, eq=False)
class Facing:
    """Points opposite each other, as linear in nodes.

    Args:
        nodes: Of the first span, then of the second, shape (n, M).
        h: Weights of nodes in x_A − x_B, shape (n, M).
        h_v: Their derivatives by the coordinate v on the second, with the sign changed, shape (n, M).
        distance: |x_A − x_B|, shape (n,) [m].
        normal: From the second to the first, shape (n, 3).
        opposite: What lies there.
    """

    nodes: Integers
    h: Array
    h_v: Array
    distance: Array
    normal: Array
    opposite: Opposite


def face(course: Course, a: Integers, u: Array, found: Opposite) -> Facing:
    """What faces points of spans a at u, from what lies opposite."""
    spans = course.spans
    return Facing(*_faced(spans.nodes, spans.shape, a, u, found.b, found.v, found.d), found)


@compiled
def _faced(
    nodes: Integers, shape: Array, a: Integers, u: Array, b: Integers, v: Array, d: Array
) -> tuple[Integers, Array, Array, Array, Array]:
    n, m, last = len(a), shape.shape[1], shape.shape[2] - 1
    at, h, h_v = np.empty((n, 2 * m), np.intp), np.empty((n, 2 * m)), np.zeros((n, 2 * m))
    distance, normal = np.empty(n), np.zeros((n, 3))
    for i in range(n):
        for k in range(m):
            at[i, k], at[i, m + k] = nodes[a[i], k], nodes[b[i], k]
            w_a, w_b, w_v = shape[a[i], k, last], shape[b[i], k, last], 0.0
            for q in range(last - 1, -1, -1):
                w_a = w_a * u[i] + shape[a[i], k, q]
                w_v = w_v * v[i] + w_b
                w_b = w_b * v[i] + shape[b[i], k, q]
            h[i, k], h[i, m + k], h_v[i, m + k] = w_a, -w_b, w_v
        distance[i] = sqrt(d[i, 0] ** 2 + d[i, 1] ** 2 + d[i, 2] ** 2)
        for j in range(3):
            normal[i, j] = d[i, j] / distance[i] if distance[i] > 0.0 else 0.0
    return at, h, h_v, distance, normal
