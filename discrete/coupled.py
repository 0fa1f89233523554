"""Systems of rods that touch one another, which couples unknowns far apart in the band.

Equilibria are solved for directly: band and coupling make one sparse matrix. In a motion the band, with the blocks of
single nodes of the coupling in it, differs little from the whole, as inertia resists where rods push: it is factorised
alone, and what else they do is found by iteration. Unknown are then the forces f = Δ(d) that it has not foreseen, with
increments d = d₀ + A⁻¹ f, where Δ is what rods answer now less what is in A: GMRES for f − Δ(A⁻¹ f) = Δ(d₀), whose
residual is what stays out of balance.

Source: Saad & Schultz, SIAM J. Sci. Stat. Comput. 7, 1986, DOI 10.1137/0907058.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot, sqrt
from typing import TYPE_CHECKING

import numpy as np

from discrete.assembly import SingularTangentError
from discrete.unknowns import N_ELEMENT, N_NODE, SPIN

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray
    from scipy.sparse import csc_matrix
    from scipy.sparse.linalg import SuperLU

    from discrete.nodes import Tangent

    Array = NDArray[np.float64]
    Entries = tuple[NDArray[np.int64], NDArray[np.int64], Array]

__all__ = ["CoupledInverse", "Hessenberg", "UncoupledError", "factorised", "joined", "solved"]

# Iterations in which forces are found or never.
MOST_ITERATIONS = 60
# Part of a vector below which what is left of it is not at right angles to what has been taken off, to round-off.
HALVED = 0.5


class UncoupledError(SingularTangentError):
    """Factors of rods by themselves are too far from those of all together."""


@dataclass(frozen=True, eq=False)
class CoupledInverse:
    """A factorised system of several rods together; lines of held unknowns impose what stands on the right.

    Args:
        factors: L and U.
        left: Scale of the right-hand side, shape (n_unknowns,).
        right: Scale of the solution, shape (n_unknowns,).
    """

    factors: SuperLU
    left: Array
    right: Array

    def times(self, right: Array) -> Array:
        """Solutions of several systems, shape (n_unknowns, m)."""
        return np.asarray(self.factors.solve(right * self.left[:, None]) * self.right[:, None])

    def single(self, right: Array) -> Array:
        """The same for one system, shape (n_unknowns,)."""
        return np.asarray(self.factors.solve(right * self.left) * self.right)


def factorised(tangent: Tangent) -> CoupledInverse:
    """Factors of a tangent with all that rods do to one another.

    Args:
        tangent: There.

    Raises:
        SingularTangentError: There are none.
    """
    # Half a tenth of a second to load, which scenes of rods that never touch need not wait for.
    from scipy.sparse.linalg import splu

    system, matrix = tangent.system, _matrix(tangent)
    try:
        factors = splu(matrix)
    except RuntimeError:
        raise SingularTangentError from None
    left = system.scale.copy()
    left[system.held] = 1.0 / left[system.held]
    return CoupledInverse(factors, left, system.scale)


def solved(tangent: Tangent, right: Array) -> Array:
    """Increments of all unknowns for one right-hand side, shape (n_unknowns,).

    Raises:
        SingularTangentError: There are none, or they are not finite.
    """
    found: Array = factorised(tangent).times(right[:, None])[:, 0]
    if not np.isfinite(found).all():
        raise SingularTangentError
    # What is held must not creep by the round-off of its factors.
    found[tangent.system.held] = right[tangent.system.held]
    return found


def _matrix(tangent: Tangent) -> csc_matrix:
    """The scaled matrix, a one on the diagonal for whatever is held."""
    from scipy.sparse import csc_matrix

    assert tangent.touched is not None
    assert tangent.touched.links is not None
    system, n = tangent.system, tangent.system.n_unknowns
    at = N_NODE * system.node_i[:, None] + np.arange(N_ELEMENT)
    linked = tangent.touched.links.entries()
    if len(tangent.guided):
        linked = _in_axes(tangent, linked)
    rows = np.concatenate([np.repeat(at, N_ELEMENT, axis=1).reshape(-1), linked[0]])
    columns = np.concatenate([np.tile(at, (1, N_ELEMENT)).reshape(-1), linked[1]])
    values = np.concatenate([tangent.elements.reshape(-1), linked[2]])
    free = np.ones(n, dtype=bool)
    free[system.held] = False
    kept, one = free[rows], np.ones(len(system.held))
    rows, columns, values = rows[kept], columns[kept], values[kept]
    values *= system.scale[rows] * system.scale[columns]
    places = np.concatenate([rows, system.held]), np.concatenate([columns, system.held])
    return csc_matrix((np.concatenate([values, one]), places), shape=(n, n))


def _in_axes(tangent: Tangent, entries: Entries) -> Entries:
    """Entries of a matrix for unknowns in space as such for those in the axes of the tangent."""
    from scipy.sparse import coo_matrix, csr_matrix

    n = tangent.system.n_unknowns
    plain = np.ones(n, dtype=bool)
    spins = N_NODE * tangent.guided[:, None] + np.arange(SPIN.start, SPIN.stop)
    plain[spins] = False
    same = np.flatnonzero(plain)
    rows = np.concatenate([same, np.repeat(spins, 3, axis=1).reshape(-1)])
    columns = np.concatenate([same, np.tile(spins, (1, 3)).reshape(-1)])
    axes = csr_matrix((np.concatenate([np.ones(len(same)), tangent.axes.reshape(-1)]), (rows, columns)), shape=(n, n))
    turned = coo_matrix(axes.T @ csr_matrix((entries[2], entries[:2]), shape=(n, n)) @ axes)
    return turned.row, turned.col, turned.data


def joined(
    start: Array, answer: Callable[[Array], Array], change: Callable[[Array], Array], fine: float
) -> Array | None:
    """Increments d = d₀ + A⁻¹ f with the forces f = Δ(d).

    Args:
        start: d₀, of any shape.
        answer: A⁻¹, increments that forces cause.
        change: Δ, forces that increments cause beyond those in A, where there are any, of any other shape.
        fine: Part of Δ(d₀) that may stay out of balance.

    Returns:
        d; None where it is not found.
    """
    first = change(start)
    size = float(np.linalg.norm(first))
    if size == 0.0:
        return start
    V = np.empty((MOST_ITERATIONS + 1, first.size))
    V[0] = first.reshape(-1) / size
    caused: list[Array] = []
    fit = Hessenberg(size)
    for k in range(MOST_ITERATIONS):
        v = V[k].reshape(first.shape)
        caused.append(answer(v))
        w = (v - change(caused[k])).reshape(-1)
        column = _beside(w, V[: k + 1])
        left = fit.grow(column)
        if left <= fine * size:
            return start + sum(y * d for y, d in zip(fit.solution(), caused, strict=True))
        if not np.isfinite(left) or column[-1] == 0.0:
            return None
        np.divide(w, column[-1], out=V[k + 1])
    return None


def _beside(w: Array, V: Array) -> Array:
    """Take the parts along the rows of V off w; these, and the size of what is left, shape (k + 2,)."""
    along, before = np.zeros(len(V)), sqrt(w @ w)
    while True:
        part = V @ w
        w -= part @ V
        along += part
        size = sqrt(w @ w)
        # Once more where round-off of the first time is as large as what is left.
        if not size < HALVED * before:
            return np.append(along, size)
        before = size


class Hessenberg:
    """Least squares H y ≈ (size, 0, 0, …) with a matrix H, zero below its first subdiagonal, that grows by columns.

    Args:
        size: Of the right-hand side.
    """

    def __init__(self, size: float) -> None:
        self._columns: list[Array] = []
        self._turns: list[tuple[float, float]] = []
        self._right = [size]

    def grow(self, column: Array) -> float:
        """Size of what is left with one more column, shape (k + 2,)."""
        h = column.tolist()
        for i, (c, s) in enumerate(self._turns):
            h[i], h[i + 1] = c * h[i] + s * h[i + 1], c * h[i + 1] - s * h[i]
        k = len(self._turns)
        r = hypot(h[k], h[k + 1])
        c, s = (h[k] / r, h[k + 1] / r) if r > 0.0 else (1.0, 0.0)
        h[k] = r
        self._turns.append((c, s))
        self._columns.append(np.array(h[: k + 1]))
        g = self._right.pop()
        self._right += [c * g, -s * g]
        return abs(self._right[-1])

    def solution(self) -> Array:
        """y, one a column."""
        y = np.array(self._right[:-1])
        for k in range(len(y) - 1, -1, -1):
            y[k] /= self._columns[k][k]
            y[:k] -= y[k] * self._columns[k][:k]
        return y
