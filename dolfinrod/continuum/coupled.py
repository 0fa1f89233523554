"""Linear solution where rods touch one another: J = P + C, with P of the elements and single nodes and C between nodes.

P is a band, for rods are chains; C links as few nodes as touch, of any two rods, and changes its pattern as they move.
MUMPS factorises J, in motions, too: it fills in little, and its solutions take less time than those of the band, of
which a Krylov method preconditioned by P needs several. (Five rods of 20 cubic elements in the midpoint rule: 33 ms for
factors and 1.7 ms for a solution, against 16 ms and, in three to seven iterations, 10 to 19 ms.)
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from petsc4py import PETSc

import numpy as np
from scipy.sparse import csr_array

from dolfinrod.continuum.direct import LIBRARY_ERROR, ROOM, lu

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.continuum.banded import BandedLU
    from dolfinrod.continuum.links import Links
    from dolfinrod.continuum.pairs import Pairs
    from dolfinrod.continuum.problem import Problem

__all__ = ["CoupledLU", "coupled", "linear_solver"]


def linear_solver(pc: PETSc.PC, P: PETSc.Mat, problem: Problem) -> BandedLU | CoupledLU | None:
    """Make a preconditioner the solution with the tangent of a problem; what does that, None where PETSc does alone."""
    if problem.pairs is None:
        return lu(pc, P, problem.discretization.band)
    solver = CoupledLU(problem.pairs)
    pc.setType(PETSc.PC.Type.PYTHON)
    pc.setPythonContext(solver)
    pc.setOperators(P)
    return solver


def _linked(P: PETSc.Mat, pairs: Pairs) -> PETSc.Mat:
    """C: what links different nodes, at the state at which P was assembled last."""
    every = [_entries(pairs, links) for links in pairs.links]
    rows, columns, values = (np.concatenate(parts) for parts in zip(*every, strict=True))
    comm, (start, end), N = P.getComm(), P.getOwnershipRange(), P.getSize()[0]
    if comm.size > 1:
        gathered = comm.tompi4py().allgather((rows, columns, values))
        rows, columns, values = (np.concatenate(parts) for parts in zip(*gathered, strict=True))
        mine = (rows >= start) & (rows < end)
        rows, columns, values = rows[mine] - start, columns[mine], values[mine]
    C = csr_array((values, (rows, columns)), shape=(end - start, N))
    csr = C.indptr.astype(np.int32), C.indices.astype(np.int32), C.data
    return PETSc.Mat().createAIJ(P.getSizes(), csr=csr, comm=comm)


def _entries(pairs: Pairs, links: Links) -> tuple[NDArray[np.int32], NDArray[np.int32], NDArray[np.float64]]:
    """Rows, columns and values that are not zero, numbered over all ranks."""
    m, M, n = links.blocks.shape[:3]
    dofs = pairs.everywhere.dofs[links.nodes][:, :, :n].reshape(m, M * n)
    blocks = links.blocks.reshape(m, M * n, M * n)
    p, i, j = np.nonzero(blocks)
    return dofs[p, i], dofs[p, j], blocks[p, i, j]


@contextmanager
def coupled(P: PETSc.Mat, problem: Problem) -> Iterator[PETSc.Mat]:
    """J of a problem whose P has just been assembled; P itself where no rods may touch."""
    if problem.pairs is None:
        yield P
        return
    J = _whole(P, problem.pairs)
    yield J
    J.destroy()


def _whole(P: PETSc.Mat, pairs: Pairs) -> PETSc.Mat:
    J, C = P.copy(), _linked(P, pairs)
    J.axpy(1.0, C, structure=PETSc.Mat.Structure.DIFFERENT_NONZERO_PATTERN)
    C.destroy()
    return J


class CoupledLU:
    """A PETSc preconditioner (type python) that is the LU factors of J by MUMPS.

    Args:
        pairs: What the rods do to each other.

    Attributes:
        singular: Whether there are no factors.
    """

    singular = False

    def __init__(self, pairs: Pairs) -> None:
        self._pairs = pairs
        self._factors: PETSc.PC | None = None

    def setUp(self, pc: PETSc.PC) -> None:
        """Factorise J."""
        self.destroy(pc)
        J = _whole(pc.getOperators()[1], self._pairs)
        self._factors = PETSc.PC().create(J.getComm())
        self._factors.setType(PETSc.PC.Type.LU)
        self._factors.setFactorSolverType(PETSc.Mat.SolverType.MUMPS)
        self._factors.setOperators(J)
        self._factors.setFactorSetUpSolverType()
        self._factors.getFactorMatrix().setMumpsIcntl(14, ROOM)
        try:
            self._factors.setUp()
            self.singular = self._factors.getFactorMatrix().getMumpsInfog(1) < 0
        except PETSc.Error as error:
            if error.ierr != LIBRARY_ERROR:
                raise
            self.singular = True
        J.destroy()

    def apply(self, pc: PETSc.PC, b: PETSc.Vec, x: PETSc.Vec) -> None:
        """Solve; not a number where J is singular, which ends SNES."""
        if self.singular or self._factors is None:
            x.set(np.nan)
            return
        self._factors.apply(b, x)

    def destroy(self, pc: PETSc.PC) -> None:
        """Free the factors."""
        if self._factors is not None:
            self._factors.destroy()
            self._factors = None
