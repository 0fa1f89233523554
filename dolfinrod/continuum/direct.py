"""Direct solution with pivoting, as zero compliances and multipliers need it: a band on one rank, MUMPS on several."""

from __future__ import annotations

from typing import TYPE_CHECKING

from petsc4py import PETSc

from dolfinrod.continuum.banded import BandedLU

if TYPE_CHECKING:
    from dolfinrod.continuum.banded import Band

__all__ = ["LIBRARY_ERROR", "banded_lu", "everywhere", "lu", "mumps"]

# PETSC_ERR_LIB, an error in a library that PETSc calls.
LIBRARY_ERROR = 76

# Per cent of extra room for what MUMPS puts off, the zero pivots of multipliers; the fifth it takes by itself is short.
ROOM = 200


def everywhere(A: PETSc.Mat, whole: PETSc.Mat | None = None) -> PETSc.Mat:
    """The whole matrix on every rank, new or in the memory of an earlier one of the same pattern."""
    every = PETSc.IS().createStride(A.getSize()[0], step=1, comm=PETSc.COMM_SELF)
    (gathered,) = A.createSubMatrices(every, every, None if whole is None else [whole])
    every.destroy()
    return gathered


def lu(pc: PETSc.PC, A: PETSc.Mat, band: Band | None) -> BandedLU | None:
    """Make a preconditioner the LU factors of a tangent.

    Args:
        pc: The preconditioner.
        A: The tangent.
        band: Its layout as a band; None where it has none, as on several ranks.

    Returns:
        The band's factors, or None where MUMPS has them.
    """
    if band is None:
        mumps(pc, A)
        return None
    return banded_lu(pc, A, band)


def mumps(pc: PETSc.PC, A: PETSc.Mat) -> PETSc.PC:
    """Make a preconditioner the LU factors of a matrix by MUMPS; it is returned."""
    pc.setType(PETSc.PC.Type.LU)
    pc.setFactorSolverType(PETSc.Mat.SolverType.MUMPS)
    pc.setOperators(A)
    pc.setFactorSetUpSolverType()
    pc.getFactorMatrix().setMumpsIcntl(14, ROOM)
    return pc


def banded_lu(pc: PETSc.PC, A: PETSc.Mat, band: Band) -> BandedLU:
    """Make a preconditioner on one rank the banded LU factors of a matrix; these are returned."""
    factors = BandedLU(band)
    pc.setType(PETSc.PC.Type.PYTHON)
    pc.setPythonContext(factors)
    pc.setOperators(A)
    return factors
