"""The point of a rod that is closest to a given one."""

from __future__ import annotations

from math import nan

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.compiled import compiled
from dolfinrod.scene.meeting.curves import Curves, along, spot
from dolfinrod.scene.meeting.vectors import Point, row

__all__ = ["begin", "begin_at", "between_chords", "chords_apart", "closest", "faced", "opposite"]

Array = NDArray[np.float64]
Integers = NDArray[np.intp]
Flags = NDArray[np.bool_]

# Of a span; Newton's method squares it with the next step, which is not taken.
SETTLED = 1e-10
# Steps; a few for a point near a smooth rod, two more for every span that is passed on the way.
MOST = 60
EPS = float(np.finfo(float).eps)


@compiled
def clipped(ξ: float) -> float:
    """From 0 to 1."""
    return 0.0 if ξ < 0.0 else (1.0 if ξ > 1.0 else ξ)


@compiled
def closest(curves: Curves, x: Point, span: int, ξ: float) -> tuple[int, float, bool]:
    """Closest point of a rod, from span to span as far as the way there leads down.

    (x − x_B)·x_B′ = 0 by Newton's method; at ends of rods, and at kinks that face x, the point there is the closest.

    Args:
        curves: The rods.
        x: A point [m].
        span: Where the search begins.
        ξ: Likewise.

    Returns:
        Span, coordinate on it, and whether it is a point of no smooth part.
    """
    hopped = 0
    for _ in range(MOST):
        dt = speed = bend = 0.0
        for i in range(3):
            x_B, t, t_v = along(curves.c, span, i, ξ)
            dt += (x[i] - x_B) * t
            speed += t * t
            bend += (x[i] - x_B) * t_v
        to = ξ + dt / (speed - bend if speed > bend else speed)
        still = abs(to - ξ) <= SETTLED
        out = 1 if to > 1.0 else (-1 if to < 0.0 else 0)
        if out != 0 and not still and ξ == 0.5 * (out + 1):
            if not (curves.onward[span] if out > 0 else curves.back[span]) or hopped == -out:
                return span, ξ, True
            span, ξ, hopped = span + out, 0.5 * (1 - out), out
            continue
        ξ, hopped = clipped(to), 0
        if still:
            break
    return span, ξ, False


@compiled
def opposite(
    curves: Curves, a: Integers, u: Array, span: Integers, ξ: Array
) -> tuple[Integers, Array, Array, Array, Array]:
    """What lies opposite points.

    Args:
        curves: The rods.
        a: Spans of the points, shape (n,).
        u: Places on them.
        span: From where on it is looked for, shape (n,).
        ξ: Likewise.

    Returns:
        Spans where it lies, coordinates v there, the way from there to the points, shape (n, 3) [m], dx_B/dv,
        shape (n, 3) [m], and 1/(|t|² − d·x_B″), zero where it is held, shape (n,) [1/m²].
    """
    n = len(a)
    b, v, d, t, follow = np.empty(n, np.intp), np.empty(n), np.empty((n, 3)), np.empty((n, 3)), np.empty(n)
    for i in range(n):
        x, κ = spot(curves.c, a[i], u[i]), 0.0
        b[i], v[i], held = closest(curves, x, span[i], ξ[i])
        for j in range(3):
            x_B, t[i, j], t_v = along(curves.c, b[i], j, v[i])
            d[i, j] = x[j] - x_B
            κ += t[i, j] * t[i, j] - d[i, j] * t_v
        follow[i] = 0.0 if held or not κ > 0.0 else 1.0 / κ
    return b, v, d, t, follow


@compiled
def begin(curves: Curves, x: Point, first: int, last: int) -> tuple[int, float]:
    """Closest point of the chords of a run, from which that of the curves is looked for: a span and a place on it."""
    best, place, least = first, nan, nan
    for span in range(first, last + 1):
        dt = speed = 0.0
        for i in range(3):
            chord = curves.chord[span, i]
            dt += (x[i] - curves.c[span, 0, i]) * chord
            speed += chord * chord
        v, square = clipped(dt / speed), 0.0
        for i in range(3):
            square += (x[i] - curves.c[span, 0, i] - v * curves.chord[span, i]) ** 2
        if span == first or square < least:
            best, place, least = span, v, square
    return best, place


@compiled
def begin_at(curves: Curves, a: Integers, u: Array, first: Integers, last: Integers) -> tuple[Integers, Array]:
    """The same for points of spans a at u, each of which has its run, shape (n,) all."""
    b, v = np.empty(len(a), np.intp), np.empty(len(a))
    for i in range(len(a)):
        b[i], v[i] = begin(curves, spot(curves.c, a[i], u[i]), first[i], last[i])
    return b, v


@compiled
def faced(
    c: Array, chord: Array, onward: Flags, back: Flags, a: Integers, u: Array, first: Integers, last: Integers
) -> tuple[Integers, Array, Array, Array, Array]:
    """`opposite` from `begin_at` on; of curves the arrays, as Numba takes longer to see what a record is."""
    curves = Curves(c, chord, onward, back)
    b, v = begin_at(curves, a, u, first, last)
    return opposite(curves, a, u, b, v)


@compiled
def chords_apart(r: Point, A: Point, B: Point) -> tuple[float, float, float]:
    """Closest points of two chords; of parallel ones, in the middle of where they run beside each other.

    Args:
        r: From where the second begins to where the first does [m].
        A: From there to its end.
        B: Likewise.

    Returns:
        Their places on both, from 0 to 1, and their distance squared [m²].
    """
    AA = AB = BB = Ar = Br = square = 0.0
    for i in range(3):
        AA += A[i] * A[i]
        AB += A[i] * B[i]
        BB += B[i] * B[i]
        Ar += A[i] * r[i]
        Br += B[i] * r[i]
    across = AA * BB - AB * AB
    if across > EPS * AA * BB:
        u = clipped((AB * Br - BB * Ar) / across)
    else:
        u = 0.5 * (clipped(-Ar / AA) + clipped((AB - Ar) / AA))
    v = clipped((AB * u + Br) / BB)
    u = clipped((AB * v - Ar) / AA)
    for i in range(3):
        square += (r[i] + u * A[i] - v * B[i]) ** 2
    return u, v, square


@compiled
def between_chords(a: Array, A: Array, b: Array, B: Array) -> tuple[Array, Array, Array]:
    """The same for pairs of chords.

    Args:
        a: Where the first begin, shape (n, 3) [m].
        A: From there to their ends.
        b: Where the second begin.
        B: From there to their ends.

    Returns:
        Each of shape (n,) [–, –, m²].
    """
    n = len(a)
    u, v, square = np.empty(n), np.empty(n), np.empty(n)
    for i in range(n):
        r = a[i, 0] - b[i, 0], a[i, 1] - b[i, 1], a[i, 2] - b[i, 2]
        u[i], v[i], square[i] = chords_apart(r, row(A, i), row(B, i))
    return u, v, square
