"""Direct solution of the tangent as a band: rods are chains, and LAPACK pivots within the band."""

from __future__ import annotations

from typing import TYPE_CHECKING

from mpi4py import MPI

import numpy as np
from scipy.linalg.lapack import dgbtrf, dgbtrs

from dolfinrod.continuum.backend import order_by_neighbours

if TYPE_CHECKING:
    from petsc4py import PETSc

    from numpy.typing import NDArray

__all__ = ["Band", "BandedLU", "own_band"]


class Band:
    """Where the entries of a sparse matrix lie once its unknowns are lined up.

    Args:
        A: Matrix on one rank, with its final pattern.
        order: Its unknowns in an order of small bandwidth.

    Attributes:
        width: Entries on either side of the diagonal.
    """

    def __init__(self, A: PETSc.Mat, order: NDArray[np.int32]) -> None:
        pointers, columns, _ = A.getValuesCSR()
        n = A.getSize()[0]
        self.order = order
        place = np.empty(n, dtype=np.int64)
        place[self.order] = np.arange(n)
        row, column = place[np.repeat(np.arange(n), np.diff(pointers))], place[columns]
        self.width = int(np.abs(row - column).max())
        # LAPACK's layout for dgbtrf, column by column: `width` rows for fill by pivoting, then 2 width + 1 diagonals.
        self.rows = 3 * self.width + 1
        self.entries = column * self.rows + 2 * self.width + row - column
        self.storage = np.zeros(n * self.rows)


def own_band(A: PETSc.Mat) -> Band | None:
    """Layout of the unknowns of each rank; None where some depend on those of another, as in a rod that is cut."""
    start, end = A.getOwnershipRange()
    columns = A.getValuesCSR()[1]
    cut = bool(((columns < start) | (columns >= end)).any())
    if A.getComm().tompi4py().allreduce(cut, op=MPI.LOR):
        return None
    own = A.getDiagonalBlock()
    return Band(own, order_by_neighbours(own))


class BandedLU:
    """A PETSc preconditioner (type python): LAPACK's banded LU with partial pivoting, of each rank's own unknowns.

    Cost is linear in the number of elements; a zero compliance, whose diagonal is zero, needs the pivoting.

    Args:
        band: Layout of the matrix, or of what each rank has of it where no rank's unknowns depend on another's.

    Attributes:
        singular: Whether the last factorisation met a zero pivot, on any rank.
    """

    singular = False

    def __init__(self, band: Band) -> None:
        self._band = band

    def setUp(self, pc: PETSc.PC) -> None:
        """Factorise the operator."""
        band = self._band
        band.storage[:] = 0.0
        A = pc.getOperators()[1]
        band.storage[band.entries] = A.getDiagonalBlock().getValuesCSR()[2]
        matrix = band.storage.reshape(-1, band.rows).T
        self._lu, self._pivots, info = dgbtrf(matrix, band.width, band.width, overwrite_ab=True)
        self.singular = A.getComm().tompi4py().allreduce(info > 0, op=MPI.LOR)

    def sign(self) -> float:
        """Sign of the determinant, zero where it is."""
        swaps = int((self._pivots != np.arange(len(self._pivots))).sum())
        return float(np.prod(np.sign(self._lu[2 * self._band.width])) * (-1.0) ** swaps)

    def apply(self, pc: PETSc.PC, b: PETSc.Vec, x: PETSc.Vec) -> None:
        """Solve; not a number where a pivot is zero, which ends SNES."""
        band = self._band
        if self.singular:
            x.set(np.nan)
            return
        solution, _ = dgbtrs(self._lu, band.width, band.width, b.array_r[band.order], self._pivots)
        x.array[band.order] = solution
