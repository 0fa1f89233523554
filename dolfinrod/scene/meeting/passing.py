"""Steps so long that a rod has gone through another, or half-way into it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.meeting.crossing import meet
from dolfinrod.scene.meeting.curves import Course, between, dot, travel
from dolfinrod.scene.meeting.facing import look
from dolfinrod.scene.meeting.pressed import Pressed
from dolfinrod.scene.meeting.projection import between_chords
from dolfinrod.scene.meeting.record import least

__all__ = ["PASSED", "PLACED", "SQUEEZED", "passes", "squeezed"]

PASSED = "a rod went through or leapt past another in one step, which was too long"
PLACED = "rods begin half-way within one another: place them apart"
SQUEEZED = "rods are pressed half-way into one another, so RodContact.law needs a larger eps_N"

Array = NDArray[np.float64]
Integers = NDArray[np.intp]

# Depth over the distance at which surfaces touch, beyond which normals may point anywhere.
DEEPEST = 0.5
# Places on a span at which it is looked for on the other side of another.
LOOKS = 3
# A span is cut until its pieces are straight to this part of a radius; round-off of a distance against a radius.
STRAIGHT, GRAZING = 0.1, 1e-6


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


def squeezed(pressed: Pressed) -> bool:
    """Whether any point is half-way into what it touches."""
    depth = replace(pressed, gap=pressed.gap / (pressed.radius_a + pressed.radius_b))
    return bool(least(depth, np.zeros(len(pressed.p), dtype=np.intp), 1)[0] < -DEEPEST)


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
    bent = np.maximum(sag[a], sag[b]) / (STRAIGHT * np.minimum(radius[a], radius[b]))
    pieces = np.maximum(np.ceil(np.sqrt(bent)), 1.0).astype(np.intp)
    return meet(start.c, end.c, a, b, pieces, GRAZING * (radius[a] + radius[b]))
