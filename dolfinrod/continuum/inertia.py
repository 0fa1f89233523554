"""Signs of a tangent: how many of its eigenvalues are negative, or whether an odd number of them is."""

from __future__ import annotations

from typing import TYPE_CHECKING

from petsc4py import PETSc

from dolfinrod.continuum.backend import order_by_neighbours
from dolfinrod.continuum.banded import Band
from dolfinrod.continuum.direct import LIBRARY_ERROR, banded_lu, everywhere

if TYPE_CHECKING:
    from mpi4py import MPI

__all__ = ["Determinant", "NegativePivots"]

# Per cent of extra room for the pivots that MUMPS puts off, and how often it gets twice as much where that is short.
ROOM, DOUBLINGS = 200, 6


class NegativePivots:
    """Negative eigenvalues of symmetric matrices, counted in their factors LDLᵀ by MUMPS (Sylvester).

    The symbolic factors of one matrix serve again when it has other values.

    Args:
        comm: Communicator of the matrices.
    """

    def __init__(self, comm: MPI.Comm) -> None:
        self._comm, self._pc, self._room = comm, None, ROOM
        self._matrix: PETSc.Mat | None = None

    def beyond(self, A: PETSc.Mat, least: int) -> int | None:
        """How many there are beyond those that there must be.

        Args:
            A: The matrix.
            least: How many must be.

        Returns:
            Their number; None where some are zero to round-off, as at a critical point, or where one constraint
            implies another.
        """
        negative = self._counted(A)
        return None if negative is None or negative < least else negative - least

    def _counted(self, A: PETSc.Mat) -> int | None:
        A.setOption(PETSc.Mat.Option.SYMMETRIC, True)
        if self._matrix is not A:
            self.close()
            self._matrix = A
        for _ in range(DOUBLINGS):
            try:
                return self._count(A)
            except PETSc.Error as error:
                if error.ierr != LIBRARY_ERROR:
                    raise
            self.close()
            self._room *= 2
        return self._count(A)

    def _count(self, A: PETSc.Mat) -> int | None:
        pc = self._pc
        if pc is None:
            pc = self._pc = PETSc.PC().create(self._comm)
            pc.setOperators(A)
            pc.setType(PETSc.PC.Type.CHOLESKY)
            pc.setFactorSolverType(PETSc.Mat.SolverType.MUMPS)
            pc.setFactorSetUpSolverType()
            # Pivots are counted without ScaLAPACK at the root and with null pivots on record. The ordering that MUMPS
            # has for saddle points by itself takes a time quadratic in the number of elements.
            for option, value in ((12, 1), (13, 1), (14, self._room), (24, 1)):
                pc.getFactorMatrix().setMumpsIcntl(option, value)
        pc.setOperators(A)
        pc.setUp()
        negative, zero, _ = pc.getFactorMatrix().getInertia()
        return None if zero else int(negative)

    def close(self) -> None:
        """Free what PETSc holds, on all ranks together."""
        if self._pc is not None:
            self._pc.destroy()
            self._pc = None


class Determinant:
    """Sign of the determinant of matrices of one pattern, from their banded factors, which stay for solves.

    Every rank factors the whole matrix: MUMPS on several runs out of the workspace for its own determinant, however
    much it is given, and a band is quickly factored.

    Args:
        A: Any such matrix.
        band: Its layout as a band; None on several ranks.

    Attributes:
        matrix: The last matrix, whole on each rank.
        pc: Its factors.
    """

    def __init__(self, A: PETSc.Mat, band: Band | None) -> None:
        self._gathered = band is None
        self.matrix = everywhere(A) if band is None else A
        self.pc = PETSc.PC().create(PETSc.COMM_SELF)
        if band is None:
            band = Band(self.matrix, order_by_neighbours(self.matrix))
        self._lu = banded_lu(self.pc, self.matrix, band)

    def sign(self, A: PETSc.Mat) -> float:
        """1, −1, or 0 where the matrix is singular."""
        if self._gathered:
            everywhere(A, self.matrix)
        A.setOption(PETSc.Mat.Option.SYMMETRIC, False)
        self.pc.setOperators(self.matrix)
        self.pc.setUp()
        return self._lu.sign()

    def close(self) -> None:
        """Free what PETSc holds."""
        self.pc.destroy()
        if self._gathered:
            self.matrix.destroy()
