"""Collocation of u′ = f(u) on a line of pieces whose lengths are unknown, to round-off.

Every piece has its own f, smooth on it, and ends where a function of u is zero; u is continuous. On each panel of a
piece u is a polynomial given at Chebyshev's points, both ends among them, and collocated at Gauss points. All panels
are solved at once by Newton's method; Jacobians are complex-step derivatives. Neither model knows of it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.polynomial import chebyshev, legendre
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import csc_array, lil_array
from scipy.sparse.linalg import splu

__all__ = ["Line", "Piece", "Pieces", "corrected", "line"]

Array = NDArray[np.float64]
Function = Callable[[Array], Array]

TINY = 1e-30


@dataclass(frozen=True)
class Piece:
    """A stretch on which f is smooth.

    Args:
        slope: f, shape (..., m) to (..., m), analytic.
        panels: Into how many it is cut, finer towards its ends.
    """

    slope: Function
    panels: int


@dataclass(frozen=True)
class Pieces:
    """A boundary-value problem.

    Args:
        pieces: One after the other.
        start: Zero at the start of the first.
        end: Zero at the end of the last; together as many conditions as u has components.
        edge: One number, zero where a piece passes into the next.
        length: Of all together.
    """

    pieces: Sequence[Piece]
    start: Function
    end: Function
    edge: Function
    length: float


@dataclass(frozen=True, eq=False)
class Line:
    """An iterate.

    Args:
        degree: Of the polynomials.
        u: At the points, those where panels meet listed once, shape (n, m).
        lengths: Of the pieces, shape (n_pieces,).
        edges: Ends of the panels of each piece, from 0 to 1.
    """

    degree: int
    u: Array
    lengths: Array
    edges: tuple[Array, ...]

    @property
    def panels(self) -> tuple[Array, Array, Array]:
        """Starts and lengths of the panels, and the piece of each."""
        offsets = np.concatenate([[0.0], np.cumsum(self.lengths)[:-1]])
        starts = [o + ℓ * e[:-1] for o, ℓ, e in zip(offsets, self.lengths, self.edges, strict=True)]
        spans = [ℓ * np.diff(e) for ℓ, e in zip(self.lengths, self.edges, strict=True)]
        numbers = [np.full(len(e) - 1, k) for k, e in enumerate(self.edges)]
        return np.concatenate(starts), np.concatenate(spans), np.concatenate(numbers)

    @property
    def points(self) -> Array:
        """Places of u, shape (n,)."""
        starts, spans, _ = self.panels
        inner = starts[:, None] + spans[:, None] * _places(self.degree)[:-1]
        return np.append(inner.ravel(), self.lengths.sum())

    def at(self, s: Array) -> Array:
        """u between the points, shape (len(s), m)."""
        starts, spans, _ = self.panels
        k = np.clip(np.searchsorted(starts, s, side="right") - 1, 0, len(starts) - 1)
        ξ = (s - starts[k]) / spans[k]
        weights = chebyshev.chebvander(2.0 * ξ - 1.0, self.degree) @ _series(self.degree)
        return np.einsum("sn,snm->sm", weights, self.u[k[:, None] * self.degree + np.arange(self.degree + 1)])

    def integral(self, f: Function) -> float:
        """∫ f(u) ds over all pieces, f smooth on each panel."""
        _, spans, _ = self.panels
        points, weights = legendre.leggauss(self.degree + 4)
        within = chebyshev.chebvander(points, self.degree) @ _series(self.degree)
        blocks = self.u[np.arange(len(spans))[:, None] * self.degree + np.arange(self.degree + 1)]
        return float(np.einsum("p,q,pq->", spans, 0.5 * weights, f(np.einsum("qn,pnm->pqm", within, blocks))))


def line(problem: Pieces, guess: Function, lengths: ArrayLike, degree: int) -> Line:
    """A first iterate.

    Args:
        problem: To which it belongs.
        guess: u at places, shape (n,) to (n, m).
        lengths: Of the pieces.
        degree: Of the polynomials.

    Returns:
        The iterate.
    """
    edges = tuple(0.5 * (1.0 - np.cos(np.linspace(0.0, np.pi, piece.panels + 1))) for piece in problem.pieces)
    empty = Line(degree, np.zeros((0, 0)), np.asarray(lengths, dtype=float), edges)
    return Line(degree, guess(empty.points), empty.lengths, edges)


def corrected(problem: Pieces, at: Line) -> tuple[Line, float]:
    """One step of Newton's method.

    Args:
        problem: To be solved.
        at: An iterate.

    Returns:
        The next one and the largest change of any of its numbers.

    Raises:
        RuntimeError: The linear system is singular.
    """
    n, (_, spans, numbers) = at.degree, at.panels
    m, points, pieces = at.u.shape[1], len(at.u), len(at.lengths)
    within, steepness = _collocation(n)
    J = lil_array((points * m + pieces, points * m + pieces))
    R = np.zeros(points * m + pieces)
    for k, (span, piece) in enumerate(zip(spans, numbers, strict=True)):
        rows, columns = slice(k * n * m, (k + 1) * n * m), slice(k * n * m, (k * n + n + 1) * m)
        block = at.u[k * n : k * n + n + 1]
        f, by = linearised(problem.pieces[piece].slope, within @ block)
        own = np.einsum("qn,qab->qanb", within, by).reshape(n * m, (n + 1) * m)
        R[rows] = (steepness @ block - span * f).ravel()
        J[rows, columns] = np.kron(steepness, np.eye(m)) - span * own
        J[rows, [points * m + piece]] = -(span / at.lengths[piece]) * f.reshape(-1, 1)
    row = (points - 1) * m
    meet = np.cumsum([(len(e) - 1) * n for e in at.edges])[:-1]
    for condition, place in ((problem.start, 0), *((problem.edge, p) for p in meet), (problem.end, points - 1)):
        value, by = linearised(condition, at.u[place])
        R[row : row + len(value)], J[row : row + len(value), place * m : (place + 1) * m] = value, by
        row += len(value)
    R[row], J[[row], points * m :] = at.lengths.sum() - problem.length, np.ones((1, pieces))
    step = splu(csc_array(J)).solve(-R)
    moved = Line(n, at.u + step[: points * m].reshape(points, m), at.lengths + step[points * m :], at.edges)
    return moved, float(np.abs(step).max())


@cache
def _collocation(degree: int) -> tuple[Array, Array]:
    """Values and derivatives at Gauss points from values at Chebyshev's."""
    gauss = 0.5 * (1.0 + legendre.leggauss(degree)[0])
    within = chebyshev.chebvander(2.0 * gauss - 1.0, degree) @ _series(degree)
    return within, _derivatives(gauss, degree) @ _series(degree)


def linearised(f: Function, x: Array) -> tuple[Array, Array]:
    """f(x), shape (..., k), and its derivative, shape (..., k, m), for x of shape (..., m)."""
    m = x.shape[-1]
    moved = f(x + 1j * TINY * np.eye(m).reshape(m, *(1,) * (x.ndim - 1), m))
    return moved[0].real, np.moveaxis(moved.imag, 0, -1) / TINY


def _places(degree: int) -> Array:
    """Chebyshev's points with both ends, from 0 to 1."""
    return np.asarray(0.5 * (1.0 - np.cos(np.linspace(0.0, np.pi, degree + 1))))


def _vander(degree: int) -> Array:
    return np.asarray(chebyshev.chebvander(2.0 * _places(degree) - 1.0, degree))


def _series(degree: int) -> Array:
    """Chebyshev coefficients from values at the points."""
    return np.asarray(np.linalg.inv(_vander(degree)))


def _derivatives(ξ: Array, degree: int) -> Array:
    """Of Chebyshev's polynomials by ξ, shape (len(ξ), degree + 1)."""
    return np.asarray(2.0 * chebyshev.chebval(2.0 * ξ - 1.0, chebyshev.chebder(np.eye(degree + 1), axis=0)).T)
