"""Linear solution where rods touch one another: J = P + C, with P of the elements and single nodes and C between nodes.

P is a band, for rods are chains; C links as few nodes as touch, of any two rods, and changes its pattern as they move.
Equilibria: MUMPS factorises J. Motions: inertia holds each rod, so J x = b is solved as x = P⁻¹ (b + f) with the forces
f that P has not foreseen, f + C P⁻¹ f = −C P⁻¹ b, by GMRES, whose residual is what stays out of balance. Factors of J
cost about as much for a few rods, but for many that touch all round they fill in as those of a solid do.

Source: Saad & Schultz, SIAM J. Sci. Stat. Comput. 7, 1986, DOI 10.1137/0907058.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from petsc4py import PETSc

import numpy as np

from dolfinrod.continuum.banded import own_band
from dolfinrod.continuum.direct import lu
from dolfinrod.continuum.joint import Joint, JointLU
from dolfinrod.scene import Dynamic

if TYPE_CHECKING:
    from dolfinrod.continuum.banded import BandedLU
    from dolfinrod.continuum.pairs import Pairs
    from dolfinrod.continuum.problem import Problem

__all__ = ["CoupledLU", "coupled", "linear_solver"]

# Part of the forces not foreseen that GMRES leaves, far below the ratios of increments with which factors are kept; and
# its iterations before the factors of J are what costs less.
FINE, MOST = 1e-3, 60


def linear_solver(pc: PETSc.PC, P: PETSc.Mat, problem: Problem) -> BandedLU | CoupledLU | None:
    """Make a preconditioner the solution with the tangent of a problem; what does that, None where PETSc does alone."""
    if problem.pairs is None:
        return lu(pc, P, problem.discretization.band)
    solver = CoupledLU(problem)
    pc.setType(PETSc.PC.Type.PYTHON)
    pc.setPythonContext(solver)
    pc.setOperators(P)
    return solver


@contextmanager
def coupled(P: PETSc.Mat, problem: Problem) -> Iterator[PETSc.Mat]:
    """J of a problem whose P has just been assembled; P itself where no rods may touch."""
    if problem.pairs is None:
        yield P
        return
    joint = Joint(problem.pairs)
    yield joint.filled(P)
    joint.close()


class Unforeseen:
    """The operator 1 + C P⁻¹ on forces f with which J x = b has the solution x = P⁻¹ (b + f): a PETSc matrix (python).

    Args:
        pairs: Whose tangent P holds in part, C being the rest at the present state.
        P: With factors.
        x: Like the unknowns.
    """

    def __init__(self, pairs: Pairs, P: PETSc.PC, x: PETSc.Vec) -> None:
        self._pairs, self._P, self._inside = pairs, P, pairs.inside
        self._moved = x.duplicate()
        self.renew()

    def renew(self) -> None:
        """Take C where the rods are now."""
        self._links = self._pairs.links()

    def forces(self, x: PETSc.Vec, y: PETSc.Vec) -> None:
        """Add C x to y."""
        at = self._pairs.at
        u = x.array_r[at]
        y.array[at] += self._links.times(u) - np.matmul(self._inside, u[:, :, None])[:, :, 0]

    def mult(self, A: PETSc.Mat, f: PETSc.Vec, y: PETSc.Vec) -> None:
        """What is out of balance of forces f once they act."""
        self._P.apply(f, self._moved)
        f.copy(y)
        self.forces(self._moved, y)

    def destroy(self, A: PETSc.Mat) -> None:
        """Free what PETSc holds."""
        self._moved.destroy()


def _gmres(operator: Unforeseen, P: PETSc.Mat) -> PETSc.KSP:
    A, krylov = PETSc.Mat().createPython(P.getSizes(), operator, P.getComm()), PETSc.KSP().create(P.getComm())
    A.setUp()
    krylov.setType(PETSc.KSP.Type.GMRES)
    krylov.setOperators(A)
    krylov.getPC().setType(PETSc.PC.Type.NONE)
    krylov.setTolerances(rtol=FINE, max_it=MOST)
    krylov.setGMRESRestart(MOST)
    A.destroy()
    return krylov


class CoupledLU:
    """A PETSc preconditioner (type python) that solves with J.

    Equilibria by the LU factors of J by MUMPS. In a motion inertia holds each rod, and so P alone is factorised, at a
    cost that is linear in the number of rods, and what rods do to each other beyond it is found by GMRES, as forces;
    MUMPS, which fills in the more the more rods touch all round, does what GMRES does not.

    Args:
        problem: Of rods that touch one another.

    Attributes:
        singular: Whether there are no factors.
    """

    singular = False

    def __init__(self, problem: Problem) -> None:
        self._problem, d = problem, problem.discretization
        self._band = d.band or own_band(d.matrix)
        self._whole = JointLU(self._pairs)
        self._factors: PETSc.PC | None = None
        self._unforeseen: Unforeseen | None = None
        self._krylov: PETSc.KSP | None = None

    @property
    def follows(self) -> bool:
        """Whether solutions are with C where the rods are, not where they were when the factors were made."""
        return self._krylov is not None

    @property
    def _pairs(self) -> Pairs:
        assert self._problem.pairs is not None
        return self._problem.pairs

    def setUp(self, pc: PETSc.PC) -> None:
        """Factorise P or J."""
        self._forget()
        P = pc.getOperators()[1]
        if not isinstance(self._problem.scene.motion, Dynamic):
            self._whole.factorize(P)
            self.singular = self._whole.singular
            return
        self._factors = factors = PETSc.PC().create(P.getComm())
        band = lu(factors, P, self._band)
        factors.setUp()
        self.singular = band is not None and band.singular
        self._unforeseen = Unforeseen(self._pairs, factors, self._problem.discretization.x.vector)
        self._krylov = _gmres(self._unforeseen, P)

    def apply(self, pc: PETSc.PC, b: PETSc.Vec, x: PETSc.Vec) -> None:
        """Solve; not a number where J is singular, which ends SNES."""
        if self.singular:
            x.set(np.nan)
            return
        if self._krylov is not None:
            if self._iterated(b, x):
                return
            self._forget()
            self._whole.factorize(pc.getOperators()[1])
            self.singular = self._whole.singular
        self._whole.apply(b, x)

    def _iterated(self, b: PETSc.Vec, x: PETSc.Vec) -> bool:
        """Solve by GMRES; whether it could."""
        assert self._factors is not None
        assert self._krylov is not None
        assert self._unforeseen is not None
        first, f = b.duplicate(), b.duplicate()
        first.set(0.0)
        self._factors.apply(b, x)
        self._unforeseen.renew()
        self._unforeseen.forces(x, first)
        first.scale(-1.0)
        self._krylov.solve(first, f)
        f.axpy(1.0, b)
        self._factors.apply(f, x)
        for forces in (first, f):
            forces.destroy()
        return bool(self._krylov.getConvergedReason() > 0)

    def destroy(self, pc: PETSc.PC) -> None:
        """Free the factors."""
        self._forget()
        self._whole.close()

    def _forget(self) -> None:
        """Free what is of one state alone."""
        for part in (self._krylov, self._factors):
            if part is not None:
                part.destroy()
        self._krylov = self._factors = None
