"""Assembly of all elements of all rods into one band, and its solution by LAPACK, Eq. 23–26."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.linalg.lapack import dgbsv, dgbtrf, dgbtrs

from discrete.rows import BLOCK
from discrete.singly import solved
from discrete.unknowns import AXIAL, N_ELEMENT, N_NODE, X

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]
    Indices = NDArray[np.int64]

__all__ = ["BandedSystem", "Inverse", "SingularTangentError", "gather", "scatter"]

# Sub- and superdiagonals: the unknowns of an element are contiguous.
_REACH = N_ELEMENT - 1
# Row of the main diagonal; LAPACK fills the rows above the band while it pivots.
_DIAGONAL = 2 * _REACH
_ROWS = 3 * _REACH + 1


class SingularTangentError(ArithmeticError):
    """The tangent has no inverse."""

    def __init__(self) -> None:
        super().__init__("the tangent is singular: something is free to move, or the load is critical")


class BandedSystem:
    """Linear system of all nodes, filled without a loop over elements and solved in place.

    Entry (r, c) of the matrix stands at row _DIAGONAL + r − c, column c of the band (LAPACK, Fortran order). The block
    of an element that begins at node a is a strided window of that array; windows of every other node are disjoint.

    Args:
        n_nodes: Number of nodes.
        node_i: First node of each element, ascending, shape (n,).
        l: Lengths of the elements, shape (n,).
        held: Unknowns whose equation is replaced by "increment = right-hand side".

    Attributes:
        node_i: As above.
        held: As above, and the empty places.
        scale: Unit of each unknown in the matrix that is factorised, shape (n_unknowns,).
        scale_elements: Products of these for the entries of each element, shape (n, 13, 13).
    """

    def __init__(self, n_nodes: int, node_i: Indices, l: Array, held: Indices) -> None:
        self.n_unknowns, self.node_i = N_NODE * n_nodes, node_i
        self._band = np.zeros((_ROWS, self.n_unknowns), order="F")
        item = self._band.itemsize
        self._blocks = np.lib.stride_tricks.as_strided(
            self._band[_DIAGONAL:],
            shape=(n_nodes - 1, N_ELEMENT, N_ELEMENT),
            strides=(N_NODE * _ROWS * item, item, (_ROWS - 1) * item),
        )
        self._disjoint = _alternating(n_nodes, node_i)
        # In units of the element length all its stiffnesses are alike, and pivoting does not mix 12EI/l³ with 4EI/l.
        scale = np.ones((n_nodes, N_NODE))
        scale[node_i + 1, X] = scale[node_i, X] = l[:, None]
        scale[node_i, AXIAL] = 1.0 / l
        own = gather(scale, node_i)
        self.scale, self.scale_elements = scale.reshape(-1), own[:, :, None] * own[:, None]
        last = np.setdiff1d(np.arange(n_nodes), node_i)
        self.held = np.union1d(held, last * N_NODE + AXIAL).astype(np.int64)
        row, column = np.meshgrid(self.held, np.arange(-_REACH, _REACH + 1), indexing="ij")
        column = row + column
        inside = (column >= 0) & (column < self.n_unknowns)
        self._lines = (_DIAGONAL + (row - column)[inside], column[inside])

    def solve(self, tangent: Array, right: Array) -> Array:
        """Increments of all unknowns.

        Args:
            tangent: Tangents of the elements, shape (n, 13, 13).
            right: Right-hand sides, overwritten, shape (n_nodes · 7,).

        Returns:
            Increments, shape (n_nodes · 7,).

        Raises:
            SingularTangentError: LAPACK met a pivot that is exactly zero, or the solution is not finite.
        """
        imposed = right[self.held]
        right *= self.scale
        right[self.held] = imposed / self.scale[self.held]
        self._fill(tangent)
        _, _, solution, info = dgbsv(_REACH, _REACH, self._band, right, overwrite_ab=True, overwrite_b=True)
        if info != 0 or not np.isfinite(solution).all():
            raise SingularTangentError
        solution *= self.scale
        # Pivoting mixes these lines with stiffer ones; a held section must not creep by that round-off.
        solution[self.held] = imposed
        return solution

    def inverse(self, tangent: Array) -> Inverse:
        """The system factorised once, for many right-hand sides; arguments and errors as for `solve`."""
        self._fill(tangent)
        band, pivots, info = dgbtrf(self._band, _REACH, _REACH)
        if info != 0 or not np.isfinite(band).all():
            raise SingularTangentError
        scale = self.scale.copy()
        scale[self.held] = 1.0 / scale[self.held]
        return Inverse(band, pivots, scale, self.scale)

    def _fill(self, tangent: Array) -> None:
        """Write the scaled matrix into the band."""
        self._band.fill(0.0)
        for window, elements in self._disjoint:
            self._blocks[window] += tangent[elements] * self.scale_elements[elements]
        self._band[self._lines] = 0.0
        self._band[_DIAGONAL, self.held] = 1.0


@dataclass(frozen=True, eq=False)
class Inverse:
    """A factorised system; lines of held unknowns impose what stands on the right.

    Args:
        band: L and U as LAPACK leaves them.
        pivots: Exchanged lines.
        left: Scale of the right-hand side, shape (n_unknowns,).
        right: Scale of the solution, shape (n_unknowns,).
    """

    band: Array
    pivots: Indices
    left: Array
    right: Array

    def times(self, right: Array) -> Array:
        """Solutions of several systems, shape (n_unknowns, m)."""
        solution, _ = dgbtrs(self.band, _REACH, _REACH, right * self.left[:, None], self.pivots, overwrite_b=True)
        return np.asarray(solution * self.right[:, None])

    def single(self, right: Array) -> Array:
        """The same for one system, shape (n_unknowns,): for those who ask often."""
        return solved(self.band.T, self.pivots, self.left, self.right, right)


def _alternating(n_nodes: int, node_i: Indices) -> tuple[tuple[slice | Indices, slice | Indices], ...]:
    """Elements in groups that share no node within a group, as (windows, elements), each few enough for a block.

    A single rod is addressed by slices, which NumPy adds in place.
    """
    if len(node_i) == n_nodes - 1:
        starts = range(0, len(node_i), 2 * BLOCK)
        every = [slice(first + k, first + 2 * BLOCK, 2) for first in starts for k in (0, 1)]
        return tuple((one, one) for one in every)
    groups = (np.flatnonzero(node_i % 2 == k) for k in (0, 1))
    parts = (group[first : first + BLOCK] for group in groups for first in range(0, len(group), BLOCK))
    return tuple((node_i[part], part) for part in parts)


def scatter(force: Array, node_i: Indices, n_nodes: int) -> Array:
    """Sum of what elements contribute to their unknowns, Eq. 25.

    Args:
        force: Contributions, shape (n, 13).
        node_i: First node of each element, shape (n,).
        n_nodes: Number of nodes.

    Returns:
        Sum, shape (n_nodes, 7).
    """
    total = np.zeros((n_nodes, N_NODE))
    if len(node_i) == n_nodes - 1:
        total[:-1] = force[:, :N_NODE]
        total[1:, :AXIAL] += force[:, N_NODE:]
        return total
    total[node_i] = force[:, :N_NODE]
    # A node ends at most one element, so no index occurs twice.
    total[node_i + 1, :AXIAL] += force[:, N_NODE:]
    return total


def gather(unknowns: Array, node_i: Indices) -> Array:
    """Unknowns of each element.

    Args:
        unknowns: Shape (n_nodes, 7).
        node_i: First node of each element, shape (n,).

    Returns:
        (x_i, ω_i, F_n, x_j, ω_j), shape (n, 13).
    """
    own = np.empty((len(node_i), N_ELEMENT))
    if len(node_i) == len(unknowns) - 1:
        own[:, :N_NODE], own[:, N_NODE:] = unknowns[:-1], unknowns[1:, :AXIAL]
        return own
    own[:, :N_NODE] = unknowns[node_i]
    own[:, N_NODE:] = unknowns[node_i + 1, :AXIAL]
    return own
