"""Stability of an equilibrium: how many independent motions lower the potential energy.

The tangent of a mixed form has one negative eigenvalue for each free unknown of its dual fields N, m and the
multiplier, whatever the state; every further one is a direction in which the equilibrium is unstable (Sylvester's law
of inertia; MUMPS counts the negative pivots of its symmetric factorisation). Loads that have no potential, as dead
moments in space and follower loads, make the tangent unsymmetric: there the sign of its determinant tells whether an
odd number of directions has been lost (divergence), and the eigenvalues of K v = ω² M v, dearer, how many and whether
the rod would flutter.

A planar equilibrium is judged in space, where it may leave its plane, unless the plane was asked for.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING

from petsc4py import PETSc
from slepc4py import SLEPc

import numpy as np

from dolfinrod.continuum.direct import lu
from dolfinrod.continuum.lift import lifted
from dolfinrod.continuum.mass import densities
from dolfinrod.continuum.neutral import PhaseCondition
from dolfinrod.continuum.placement import Placement
from dolfinrod.continuum.pool import borrowed
from dolfinrod.continuum.problem import Problem
from dolfinrod.continuum.readout import Readout
from dolfinrod.continuum.spatial import SpatialRods
from dolfinrod.scene import Spatial

if TYPE_CHECKING:
    from dolfinrod.continuum.readout import State

__all__ = ["Judge", "Verdict", "judging"]

# Per cent of extra room for MUMPS: near critical points it puts off far more pivots than in Newton's method.
ROOM = 5000
# Eigenvalues looked at where loads have no potential.
FEW = 4
# How well they need to be known: their signs are asked for.
ROUGH = 1e-8
# Imaginary part of ω² over its magnitude from which a vibration counts as flutter: it grows by a hundredth a radian,
# more than the lightest damping takes, which a twisted cantilever under a dead moment never does (Nicolai's paradox).
FLUTTER = 0.02


@dataclass(frozen=True)
class Verdict:
    """Stability of an equilibrium.

    Args:
        stable: Whether no motion lowers the energy; None where that is not known.
        directions: Number of independent motions that do; None where it is not known.
        avoidable: Whether there is such a motion, and loads with a potential made it one: then the way to a stable
            state may only have been too steep.
    """

    stable: bool | None
    directions: int | None = None
    avoidable: bool = False


class Judge:
    """Inertia of the tangent of one problem.

    Args:
        problem: Owner of the state.
    """

    def __init__(self, problem: Problem) -> None:
        self._problem, self._phase = problem, PhaseCondition(problem)
        d = problem.discretization
        owned = [d.owned_nodes(f) for f in d.dofs if f in ("N", "m", "multiplier")]
        duals = np.concatenate([dofs.ravel() for dofs in owned])
        self._n_dual = int(d.comm.allreduce(len(np.setdiff1d(duals, problem.constraints.dofs))))
        self._densities = densities(problem.scene)
        self._lumped: PETSc.Mat | None = None
        self._symmetric: PETSc.PC | None = None
        self._unsymmetric: PETSc.PC | None = None

    def verdict(self, state: State, t: float, *, closely: bool) -> Verdict:
        """Stability of an equilibrium.

        Args:
            state: The problem's own current state.
            t: Its pseudo-time.
            closely: Whether eigenvalues are worth their price where loads have no potential.
        """
        problem, A = self._problem, self._problem.discretization.matrix
        problem.hold(np.zeros(0, dtype=np.int32))
        if self._phase.needed:
            problem.assemble_tangent(A)
            self._phase.hold_null(A)
        problem.assemble_tangent(A, on_sphere=True)
        if problem.conservative:
            unstable = self._inertia(A) - self._n_dual
            return Verdict(unstable == 0, unstable, avoidable=unstable > 0)
        sign = self._determinant(A) * (-1.0) ** self._n_dual
        if sign < 0.0:
            return Verdict(False)
        return self._vibrating(A) if closely else Verdict(None)

    def _vibrating(self, K: PETSc.Mat) -> Verdict:
        """From the vibrations nearest to rest, ω² = 1/θ with θ an eigenvalue of K⁻¹M, factored already."""
        eps = SLEPc.EPS().create(K.getComm())
        eps.setOptionsPrefix("rod_stability_")
        eps.setOperators(self._mass(K), K)
        eps.setProblemType(SLEPc.EPS.ProblemType.GNHEP)
        solver = PETSc.KSP().create(K.getComm())
        solver.setType(PETSc.KSP.Type.PREONLY)
        solver.setOperators(K)
        solver.setPC(self._unsymmetric)
        eps.getST().setKSP(solver)
        eps.setDimensions(FEW)
        eps.setTolerances(ROUGH)
        eps.solve()
        θ = np.array([eps.getEigenvalue(i) for i in range(eps.getConverged())])
        for owned in (eps, solver):
            owned.destroy()
        lost = int((θ.real < 0.0).sum())
        steady = bool((np.abs(θ.imag) <= FLUTTER * np.abs(θ)).all())
        return Verdict(lost == 0 and steady, lost)

    def _mass(self, K: PETSc.Mat) -> PETSc.Mat:
        """Masses ρA and rotary inertia of the sections, shared equally among the nodes of each element."""
        if self._lumped is None:
            problem, d = self._problem, self._problem.discretization
            mine = slice(0, d.n_owned_cells)
            share = np.diff(problem.ends[mine], axis=1)[:, :, None] / (d.degree + 1)
            m = np.zeros(len(problem.x))
            for field, density in zip(("r", "q"), self._densities, strict=True):
                np.add.at(m, d.dofs[field][mine], share * density[problem.rod[mine], None, None])
            m[problem.constraints.dofs] = 0.0
            self._lumped = K.duplicate(copy=False)
            diagonal = K.createVecLeft()
            diagonal.array[:] = m[: d.n_owned]
            self._lumped.setDiagonal(diagonal)
            self._lumped.assemble()
            diagonal.destroy()
        return self._lumped

    def _determinant(self, A: PETSc.Mat) -> float:
        """Sign of the determinant of a tangent that is not symmetric; its factors stay."""
        if self._unsymmetric is None:
            self._unsymmetric = PETSc.PC().create(self._problem.discretization.comm)
            self._band = lu(self._unsymmetric, A, self._problem.discretization.band)
            if self._band is None:
                for option, value in ((14, ROOM), (33, 1)):
                    self._unsymmetric.getFactorMatrix().setMumpsIcntl(option, value)
        A.setOption(PETSc.Mat.Option.SYMMETRIC, False)
        self._unsymmetric.setOperators(A)
        self._unsymmetric.setUp()
        if self._band is not None:
            return self._band.sign()
        return float(np.sign(self._unsymmetric.getFactorMatrix().getMumpsRinfog(12)))

    def _inertia(self, A: PETSc.Mat) -> int:
        """Negative pivots of a symmetric tangent."""
        pc = self._symmetric
        if pc is None:
            pc = self._symmetric = PETSc.PC().create(self._problem.discretization.comm)
            pc.setOperators(A)
            pc.setType(PETSc.PC.Type.CHOLESKY)
            pc.setFactorSolverType(PETSc.Mat.SolverType.MUMPS)
            pc.setFactorSetUpSolverType()
            # Pivots are counted without ScaLAPACK at the root and with null pivots on record; delayed ones want room.
            for option, value in ((13, 1), (14, ROOM), (24, 1)):
                pc.getFactorMatrix().setMumpsIcntl(option, value)
        A.setOption(PETSc.Mat.Option.SYMMETRIC, True)
        pc.setOperators(A)
        pc.setUp()
        return int(pc.getFactorMatrix().getInertia()[0])

    def close(self) -> None:
        """Free what PETSc holds, on all ranks together."""
        for owned in (self._symmetric, self._unsymmetric, self._lumped):
            if owned is not None:
                owned.destroy()


class LiftedJudge(Judge):
    """Judges the states of a planar problem in space.

    Args:
        planar: Where the states come from.
        spatial: The same scene on the same elements in space.
    """

    def __init__(self, planar: Problem, spatial: Problem) -> None:
        super().__init__(spatial)
        self._plane, self._readout = planar.placement, Readout(spatial)

    def verdict(self, state: State, t: float, *, closely: bool) -> Verdict:
        """Stability in space of a state of the planar problem."""
        problem = self._problem
        self._readout.restore(lifted(state, self._plane))
        problem.advance_to(t)
        b = problem.discretization.assembled_residual()
        problem.balance_multipliers(b)
        return super().verdict(state, t, closely=closely)


@contextmanager
def judging(problem: Problem, *, in_space: bool) -> Iterator[Judge]:
    """A judge of the states of a problem.

    Args:
        problem: Owner of the states.
        in_space: Whether planar states may leave their plane.

    Yields:
        The judge; closed at the end.
    """
    d = problem.discretization
    if not in_space or d.kinematics.dim == 3:
        judge = Judge(problem)
        try:
            yield judge
        finally:
            judge.close()
        return
    with borrowed(d.comm, SpatialRods(), d.degree, d.elements) as (discretization, _):
        lifted = Problem(problem.scene, discretization, Placement.of(problem.scene, Spatial()))
        judge = LiftedJudge(problem, lifted)
        try:
            yield judge
        finally:
            judge.close()
