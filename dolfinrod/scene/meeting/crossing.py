"""Whether straight pieces of rods meet while their ends move straight on: compiled loops."""

from __future__ import annotations

from math import copysign, sqrt

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.compiled import compiled
from dolfinrod.scene.meeting.curves import spot
from dolfinrod.scene.meeting.projection import chords_apart
from dolfinrod.scene.meeting.vectors import Point, added, crossed, dotted, scaled

__all__ = ["meet"]

Array = NDArray[np.float64]
Integers = NDArray[np.intp]
# Both ends of a piece at the start of the step, and at its end.
Piece = tuple[Point, Point, Point, Point]
Cubic = tuple[float, float, float, float]

# Halvings of a time between 0 and 1, to the last bit.
HALVINGS = 52


@compiled
def meet(start: Array, end: Array, a: Integers, b: Integers, pieces: Integers, reach: Array) -> bool:
    """Whether spans meet others on the way, both cut into pieces that are taken as straight.

    Args:
        start: Coefficients of the curves where a step began.
        end: Where it has led.
        a: Spans, shape (n,).
        b: As many others.
        pieces: Of each of the two, shape (n,).
        reach: Distance that is none, shape (n,) [m].

    Returns:
        Whether any does.
    """
    for n in range(len(a)):
        k = pieces[n]
        for i in range(k):
            one = _piece(start, end, a[n], i / k, (i + 1) / k)
            for j in range(k):
                if _meets(one, _piece(start, end, b[n], j / k, (j + 1) / k), reach[n]):
                    return True
    return False


@compiled
def _piece(start: Array, end: Array, span: int, begins: float, ends: float) -> Piece:
    """Of a span."""
    return spot(start, span, begins), spot(start, span, ends), spot(end, span, begins), spot(end, span, ends)


@compiled
def _meets(one: Piece, other: Piece, reach: float) -> bool:
    """Whether two pieces do: where they come to lie in a plane, which is a cubic in time."""
    A, B, C = added(one[1], -1.0, one[0]), added(other[1], -1.0, other[0]), added(other[0], -1.0, one[0])
    A_1 = added(added(one[3], -1.0, one[2]), -1.0, A)
    B_1 = added(added(other[3], -1.0, other[2]), -1.0, B)
    C_1 = added(added(other[2], -1.0, one[2]), -1.0, C)
    AB, AB_1 = crossed(A, B), added(crossed(A_1, B), 1.0, crossed(A, B_1))
    AB_2 = crossed(A_1, B_1)
    cubic = (
        dotted(AB, C),
        dotted(AB_1, C) + dotted(AB, C_1),
        dotted(AB_2, C) + dotted(AB_1, C_1),
        dotted(AB_2, C_1),
    )
    first, second = _turns(cubic)
    for low, high in ((0.0, first), (first, second), (second, 1.0)):
        rises = _value(cubic, low) < 0.0 < _value(cubic, high)
        if rises or _value(cubic, high) < 0.0 < _value(cubic, low):
            τ = _root(cubic, low, high, 1.0 if rises else -1.0)
            apart = scaled(-1.0, added(C, τ, C_1))
            _, _, square = chords_apart(apart, added(A, τ, A_1), added(B, τ, B_1))
            if square <= reach * reach:
                return True
    return False


@compiled
def _turns(cubic: Cubic) -> tuple[float, float]:
    """Where between 0 and 1 a cubic may turn, ascending; 0 where it does not."""
    c_1, c_2, c_3 = cubic[1], 2.0 * cubic[2], 3.0 * cubic[3]
    q = -0.5 * (c_2 + copysign(sqrt(max(c_2 * c_2 - 4.0 * c_1 * c_3, 0.0)), c_2))
    one = max(q / c_3, 0.0) if abs(c_3) > abs(q) else 0.0
    other = max(c_1 / q, 0.0) if abs(q) > abs(c_1) else 0.0
    return min(one, other), max(one, other)


@compiled
def _root(cubic: Cubic, low: float, high: float, sign: float) -> float:
    """Where it changes sign from below zero, or to below zero for a sign of −1."""
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if sign * _value(cubic, middle) < 0.0:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


@compiled
def _value(cubic: Cubic, τ: float) -> float:
    return cubic[0] + τ * (cubic[1] + τ * (cubic[2] + τ * cubic[3]))
