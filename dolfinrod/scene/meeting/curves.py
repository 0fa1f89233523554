"""Centrelines cut into spans, and where they run in space."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import comb, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.compiled import compiled
from dolfinrod.scene.meeting.strands import Strands
from dolfinrod.scene.meeting.vectors import Point

__all__ = ["Course", "Curves", "Spans", "along", "between", "dot", "spot", "travel"]

Array = NDArray[np.float64]
Integers = NDArray[np.intp]
Flags = NDArray[np.bool_]


def dot(a: Array, b: Array) -> Array:
    """Inner products of rows, shape (n,)."""
    return np.asarray(np.einsum("ni,ni->n", a, b))


class Spans:
    """Pieces of the cells of all rods, each with its own coordinate ξ from 0 to 1.

    Args:
        strands: The centrelines.

    Attributes:
        cell: Of each span, shape (n,).
        rod: Likewise.
        radius: Likewise [m].
        nodes: Likewise, shape (n, m).
        s: Arc length where it begins, shape (n,) [m].
        length: Arc length of it, shape (n,) [m].
        shape: Coefficients of ξ^q in w, shape (n, m, p + 1).
        onward: Whether the next span goes on where it ends.
        back: Whether the one before ends where it begins.
        spread: How much further points may move than nodes.
    """

    def __init__(self, strands: Strands) -> None:
        long = np.ptp(strands.s, axis=1)
        # A cell as long as many others is cut to their measure, so that as many points look for contact on it.
        counts = strands.spans * np.maximum(1, np.rint(long / np.median(long))).astype(np.intp)
        self.cell = np.repeat(np.arange(len(long)), counts)
        piece = np.arange(len(self.cell)) - np.repeat(np.cumsum(counts) - counts, counts)
        part = 1.0 / counts[self.cell]
        self.rod, self.nodes = strands.rod[self.cell], strands.nodes[self.cell]
        self.radius = strands.radius[self.rod]
        self.length = long[self.cell] * part
        self.s = strands.s[self.cell, 0] + piece * self.length
        self.shape = _cut(strands.shape[self.cell], piece * part, part)
        self._powers = np.ascontiguousarray(self.shape.transpose(0, 2, 1))
        samples = [self.weights(np.arange(len(part)), np.full(len(part), ξ)) for ξ in np.linspace(0.0, 1.0, 5)]
        self.spread = float(np.abs(samples).sum(axis=2).max(initial=1.0))
        self.onward = np.append(self.rod[1:] == self.rod[:-1], False)
        self.back = np.insert(self.onward[:-1], 0, False)

    def course(self, x: Array) -> Course:
        """Where they run with nodes at x, shape (n_nodes, 3)."""
        return Course(self, x, _bent(self._powers, self.nodes, x))

    def along(self, span: Integers, ξ: Array) -> Array:
        """Arc lengths, shape (n,) [m]."""
        return np.asarray(self.s[span] + ξ * self.length[span])

    def neighbouring(self, a: Integers, u: Array, b: Integers, v: Array) -> Flags:
        """Whether points are of one rod, less than π (r_A + r_B) of arc apart, shape (n,)."""
        apart = np.abs(self.along(a, u) - self.along(b, v))
        return np.asarray((self.rod[a] == self.rod[b]) & (apart < 2.0 * np.pi * self.radius[a]))

    def weights(self, span: Integers, ξ: Array) -> Array:
        """w of the nodes of spans at ξ, shape (n, m)."""
        w = self.shape[span, :, -1]
        for q in range(self.shape.shape[2] - 2, -1, -1):
            w = w * ξ[:, None] + self.shape[span, :, q]
        return np.asarray(w)


def _cut(shape: Array, start: Array, part: Array) -> Array:
    """Coefficients of polynomials of start + part ξ, as polynomials of ξ."""
    n = shape.shape[2]
    to = np.zeros((len(shape), n, n))
    for q in range(n):
        for r in range(q + 1):
            to[:, q, r] = comb(q, r) * start ** (q - r) * part**r
    return np.asarray(shape @ to)


class Curves(NamedTuple):
    """What kernels are told of spans in space.

    Args:
        c: As `Course`.
        chord: From where spans begin to where they end, shape (n_spans, 3) [m].
        onward: As `Spans`.
        back: Likewise.
    """

    c: Array
    chord: Array
    onward: Flags
    back: Flags


@compiled
def along(c: Array, span: int, i: int, ξ: float) -> tuple[float, float, float]:
    """Coordinate i of a place and its first and second derivatives by ξ."""
    x, x_1, x_2 = c[span, c.shape[1] - 1, i], 0.0, 0.0
    for q in range(c.shape[1] - 2, -1, -1):
        x_2 = x_2 * ξ + x_1
        x_1 = x_1 * ξ + x
        x = x * ξ + c[span, q, i]
    return x, x_1, 2.0 * x_2


@compiled
def spot(c: Array, span: int, ξ: float) -> Point:
    """A place."""
    return along(c, span, 0, ξ)[0], along(c, span, 1, ξ)[0], along(c, span, 2, ξ)[0]


@compiled
def _places(c: Array, span: Integers, ξ: Array) -> Array:
    x = np.empty((len(span), 3))
    for i in range(len(span)):
        x[i, 0], x[i, 1], x[i, 2] = spot(c, span[i], ξ[i])
    return x


@dataclass(frozen=True, eq=False)
class Course:
    """Spans in space, x(ξ) = Σ c_q ξ^q.

    Args:
        spans: What runs there.
        x: Nodes, shape (n_nodes, 3) [m].
        c: Shape (n_spans, p + 1, 3) [m].
    """

    spans: Spans
    x: Array
    c: Array

    def place(self, span: Integers, ξ: Array) -> Array:
        """Places, shape (n, 3)."""
        return _places(self.c, span, ξ)

    @cached_property
    def _straight(self) -> tuple[Array, Array]:
        return _straightened(self.c)

    @cached_property
    def curves(self) -> Curves:
        """The same for kernels."""
        return Curves(self.c, self.chords, self.spans.onward, self.spans.back)

    @property
    def starts(self) -> Array:
        """Where spans begin, shape (n_spans, 3)."""
        return self.c[:, 0]

    @property
    def chords(self) -> Array:
        """From where spans begin to where they end, shape (n_spans, 3)."""
        return self._straight[0]

    @property
    def sag(self) -> Array:
        """How far spans may be from their chords at the same ξ, shape (n_spans,) [m]."""
        return self._straight[1]


@compiled
def _bent(powers: Array, nodes: Integers, x: Array) -> Array:
    """Coefficients of spans, shape (n, p + 1, 3)."""
    c = np.zeros((powers.shape[0], powers.shape[1], 3))
    for i in range(c.shape[0]):
        for q in range(c.shape[1]):
            for a in range(nodes.shape[1]):
                for j in range(3):
                    c[i, q, j] += powers[i, q, a] * x[nodes[i, a], j]
    return c


@compiled
def _straightened(c: Array) -> tuple[Array, Array]:
    """Chords of spans, and how far these may be from them: |ξ^q − ξ| is at most (q − 1) q^(−q/(q − 1))."""
    chord, sag = np.zeros((len(c), 3)), np.zeros(len(c))
    for i in range(len(c)):
        for q in range(1, c.shape[1]):
            x, y, z = c[i, q, 0], c[i, q, 1], c[i, q, 2]
            chord[i, 0] += x
            chord[i, 1] += y
            chord[i, 2] += z
            if q > 1:
                sag[i] += (q - 1.0) * float(q) ** (-q / (q - 1.0)) * sqrt(x * x + y * y + z * z)
    return chord, sag


def between(start: Course, end: Course, part: float) -> Course:
    """Part of the straight way of all nodes from one place to another."""
    one, other = 1.0 - part, part
    return Course(start.spans, one * start.x + other * end.x, one * start.c + other * end.c)


def travel(start: Course, end: Course) -> Array:
    """Half of how far points of spans move at most, shape (n_spans,) [m]."""
    moved = Course(start.spans, end.x - start.x, end.c - start.c)
    ends = np.linalg.norm(np.stack([moved.starts, moved.starts + moved.chords]), axis=2)
    return np.asarray(0.5 * (ends.max(axis=0) + moved.sag))
