"""The point of a rod that is closest to a given one."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.meeting.curves import Course, dot

__all__ = ["between_chords", "project", "to_chord"]

Array = NDArray[np.float64]
Integers = NDArray[np.intp]
Flags = NDArray[np.bool_]

# Of a span; Newton's method squares it with the next step, which is not taken.
SETTLED = 1e-10
# Steps; a few for a point near a smooth rod, two more for every span that is passed on the way.
MOST = 60


def project(course: Course, x: Array, span: Integers, ξ: Array) -> tuple[Integers, Array, Flags]:
    """Closest points of rods, from span to span as far as the way there leads down.

    (x − x_B)·x_B′ = 0 by Newton's method; at ends of rods, and at kinks that face x, the point there is the closest.

    Args:
        course: The rods.
        x: Points, shape (n, 3) [m].
        span: Where the search for each begins, shape (n,).
        ξ: Likewise.

    Returns:
        Spans, coordinates on them, and whether it is a point of no smooth part, each of shape (n,).
    """
    span, ξ, held = span.copy(), ξ.copy(), np.zeros(len(span), dtype=bool)
    hopped, live = np.zeros(len(span), dtype=np.int8), np.arange(len(span))
    for _ in range(MOST):
        if not len(live):
            break
        at, here = span[live], ξ[live]
        x_B, t, bend = course.at(at, here)
        d, speed = x[live] - x_B, dot(t, t)
        κ = speed - dot(d, bend)
        to = here + dot(d, t) / np.where(κ > 0.0, κ, speed)
        still = np.abs(to - here) <= SETTLED
        out = (to > 1.0).astype(np.int8) - (to < 0.0)
        edge = (out != 0) & (here == 0.5 * (out + 1)) & ~still
        goes_on = np.where(out > 0, course.spans.onward[at], course.spans.back[at])
        stuck = edge & (~goes_on | (hopped[live] == -out))
        hop = edge & ~stuck
        span[live], hopped[live] = at + np.where(hop, out, 0), np.where(hop, out, 0)
        ξ[live] = np.where(hop, 0.5 * (1 - out), np.clip(to, 0.0, 1.0))
        held[live] = stuck
        live = live[~(still | stuck)]
    return span, ξ, held


def to_chord(x: Array, start: Array, chord: Array) -> tuple[Array, Array]:
    """Closest points of chords.

    Args:
        x: Points, shape (n, 3) [m].
        start: Where the chords begin, shape (n, 3) [m].
        chord: From there to their ends.

    Returns:
        Their places on the chords, from 0 to 1, and their distances squared, shape (n,) [–, m²].
    """
    v = np.clip(dot(x - start, chord) / dot(chord, chord), 0.0, 1.0)
    d = x - start - v[:, None] * chord
    return v, dot(d, d)


def between_chords(a: Array, A: Array, b: Array, B: Array) -> tuple[Array, Array, Array]:
    """Closest points of pairs of chords; of parallel ones, in the middle of where they run beside each other.

    Args:
        a: Where the first begin, shape (n, 3) [m].
        A: From there to their ends.
        b: Where the second begin.
        B: From there to their ends.

    Returns:
        Their places on both, from 0 to 1, and their distances squared, each of shape (n,) [–, –, m²].
    """
    r, AA, AB, BB = a - b, dot(A, A), dot(A, B), dot(B, B)
    Ar, Br = dot(A, r), dot(B, r)
    ends = np.sort(np.clip(np.stack([-Ar, AB - Ar]) / AA, 0.0, 1.0), axis=0)
    across = AA * BB - AB**2
    askew = across > np.finfo(float).eps * AA * BB
    u = np.where(askew, (AB * Br - BB * Ar) / np.where(askew, across, 1.0), ends.mean(axis=0))
    u = np.clip(u, 0.0, 1.0)
    v = np.clip((AB * u + Br) / BB, 0.0, 1.0)
    u = np.clip((AB * v - Ar) / AA, 0.0, 1.0)
    d = r + u[:, None] * A - v[:, None] * B
    return u, v, dot(d, d)
