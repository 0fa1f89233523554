"""Steps so long that a rod has gone through another."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.meeting.curves import Course, between, dot, travel
from dolfinrod.scene.meeting.facing import look
from dolfinrod.scene.meeting.projection import between_chords
from dolfinrod.scene.rubbing import cross

__all__ = ["passes"]

Array = NDArray[np.float64]
Integers = NDArray[np.intp]

# Places on a span at which it is looked for on the other side of another.
LOOKS = 3
# A span is cut until its pieces are straight to this part of a radius; round-off of a distance against a radius.
STRAIGHT, GRAZING = 0.1, 1e-6
# Halvings of a time between 0 and 1, to the last bit.
HALVINGS = 52


def passes(start: Course, end: Course, a: Integers, b: Integers) -> bool:
    """Whether spans have gone through others, all points on straight lines from where they were to where they are.

    Either the centrelines of two meet on the way; or, which they do not where the rods run side by side, a point of
    one comes to the other side of the other and has been nearer than half the distance at which their surfaces touch.

    Args:
        start: The rods where a step began.
        end: Where it has led.
        a: Spans, shape (n,).
        b: As many that may be on their way.

    Returns:
        Whether any has.
    """
    spans, middle, half = start.spans, between(start, end, 0.5), travel(start, end)
    sag = np.maximum(middle.sag, np.maximum(start.sag, end.sag))
    _, _, square = between_chords(middle.starts[a], middle.chords[a], middle.starts[b], middle.chords[b])
    within = 0.5 * (spans.radius[a] + spans.radius[b]) + half[a] + half[b] + sag[a] + sag[b]
    near = square <= within**2
    a, b = a[near], b[near]
    return bool(len(a)) and (_beside(start, end, a, b) or _across(start, end, a, b, sag))


def _beside(start: Course, end: Course, a: Integers, b: Integers) -> bool:
    """Whether points of the first come out on the other side of the second.

    Between the closest points at the start and at the end both rods go straight; of a straight rod no other point is
    further away on the way, so this is no false alarm.
    """
    spans, u = start.spans, np.tile(np.linspace(0.0, 1.0, LOOKS), len(a))
    a, b = np.repeat(a, LOOKS), np.repeat(b, LOOKS)

    first, last = (look(course, a, u, b, b) for course in (start, end))
    turned = dot(first.d, last.d) < 0.0
    # The closest point of one's own rod is oneself.
    turned &= ~(spans.neighbouring(a, u, first.b, first.v) | spans.neighbouring(a, u, last.b, last.v))
    d, way = first.d[turned], (last.d - first.d)[turned]
    least = dot(d, d) - dot(d, way) ** 2 / dot(way, way)
    return bool((least < 0.25 * (spans.radius[a] + spans.radius[b])[turned] ** 2).any())


def _across(start: Course, end: Course, a: Integers, b: Integers, sag: Array) -> bool:
    """Whether centrelines meet on the way, their pieces taken as straight."""
    radius = start.spans.radius
    k = int(np.ceil(np.sqrt((np.maximum(sag[a], sag[b]) / (STRAIGHT * np.minimum(radius[a], radius[b]))).max())))
    k = max(k, 1)
    part = np.arange(k) / k
    i, j = (np.tile(np.repeat(np.arange(k), k), len(a)), np.tile(np.arange(k), k * len(a)))
    a, b = np.repeat(a, k * k), np.repeat(b, k * k)
    ends = [
        np.stack([course.place(span, part[at] + step) for course in (start, end)])
        for span, at in ((a, i), (b, j))
        for step in (0.0, 1.0 / k)
    ]
    (A, A_1), (B, B_1), (C, C_1) = (
        (p[0], p[1] - p[0]) for p in (ends[1] - ends[0], ends[3] - ends[2], ends[2] - ends[0])
    )
    reach = GRAZING * (radius[a] + radius[b])

    def volume(P: Array, Q: Array, R: Array) -> Array:
        return dot(P, cross(Q, R))

    cubic = np.stack(
        [
            volume(A, B, C),
            volume(A_1, B, C) + volume(A, B_1, C) + volume(A, B, C_1),
            volume(A_1, B_1, C) + volume(A_1, B, C_1) + volume(A, B_1, C_1),
            volume(A_1, B_1, C_1),
        ]
    )
    of, τ = _roots(cubic)
    here = [(1.0 - τ)[:, None] * p[0, of] + τ[:, None] * p[1, of] for p in ends]
    _, _, square = between_chords(here[0], here[1] - here[0], here[2], here[3] - here[2])
    return bool((square <= reach[of] ** 2).any())


def _roots(cubic: Array) -> tuple[Integers, Array]:
    """Where cubics, coefficients of shape (4, n), change sign between 0 and 1: their numbers and the places."""
    c_1, c_2, c_3 = cubic[1], 2.0 * cubic[2], 3.0 * cubic[3]
    q = -0.5 * (c_2 + np.copysign(np.sqrt(np.maximum(c_2**2 - 4.0 * c_1 * c_3, 0.0)), c_2))
    turns = [np.divide(x, y, out=np.zeros_like(q), where=np.abs(y) > np.abs(x)) for x, y in ((q, c_3), (c_1, q))]
    marks = np.sort(np.clip(np.stack([np.zeros_like(q), *turns, np.ones_like(q)]), 0.0, 1.0), axis=0)
    values = _value(cubic, marks)
    piece, of = np.nonzero(np.sign(values[:-1]) * np.sign(values[1:]) < 0.0)
    low, high, falls = marks[piece, of], marks[piece + 1, of], values[piece, of] > 0.0
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        before = (_value(cubic[:, of], middle) > 0.0) == falls
        low, high = np.where(before, middle, low), np.where(before, high, middle)
    return of, 0.5 * (low + high)


def _value(cubic: Array, τ: Array) -> Array:
    return np.asarray(cubic[0] + τ * (cubic[1] + τ * (cubic[2] + τ * cubic[3])))
