"""Vectors in space, in kernels."""

from __future__ import annotations

from math import sin, sqrt

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.compiled import compiled

__all__ = ["Point", "across", "added", "crossed", "dotted", "rotated", "row", "scaled", "turned", "turned_by"]

Array = NDArray[np.float64]
Point = tuple[float, float, float]

SMALL = float(np.finfo(float).eps) ** 0.25


@compiled
def row(a: Array, i: int) -> Point:
    """Of an array."""
    return a[i, 0], a[i, 1], a[i, 2]


@compiled
def dotted(a: Point, b: Point) -> float:
    """a · b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@compiled
def crossed(a: Point, b: Point) -> Point:
    """a × b."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@compiled
def added(a: Point, x: float, b: Point) -> Point:
    """a + x b."""
    return a[0] + x * b[0], a[1] + x * b[1], a[2] + x * b[2]


@compiled
def scaled(x: float, a: Point) -> Point:
    """x a."""
    return x * a[0], x * a[1], x * a[2]


@compiled
def across(a: Point, n: Point) -> Point:
    """The part of a across a unit vector."""
    return added(a, -dotted(n, a), n)


@compiled
def _rests(ψ: Point) -> tuple[float, float, float]:
    """sin θ/θ, (1 − cos θ)/θ² and (1 − sin θ/θ)/θ² of the angle of a rotation vector."""
    θ = sqrt(dotted(ψ, ψ))
    if θ == 0.0:
        return 1.0, 0.5, 1.0 / 6.0
    sine, half = sin(θ) / θ, sin(0.5 * θ) / (0.5 * θ)
    return sine, 0.5 * half * half, 1.0 / 6.0 if θ < SMALL else (1.0 - sine) / (θ * θ)


@compiled
def turned(ψ: Point, u: Point) -> Point:
    """A vector turned by a rotation vector."""
    sine, rest, _ = _rests(ψ)
    once = crossed(ψ, u)
    return added(added(u, sine, once), rest, crossed(ψ, once))


@compiled
def turned_by(ψ: Point, u: Point, δψ: Point) -> Point:
    """Its change with that of the rotation vector."""
    _, first, second = _rests(ψ)
    once = crossed(ψ, δψ)
    return crossed(added(added(δψ, first, once), second, crossed(ψ, once)), turned(ψ, u))


@compiled
def rotated(ψ: Array, u: Array) -> Array:
    """Vectors turned by rotation vectors, shape (n, 3)."""
    to = np.empty((len(u), 3))
    for i in range(len(u)):
        to[i, 0], to[i, 1], to[i, 2] = turned(row(ψ, i), row(u, i))
    return to
