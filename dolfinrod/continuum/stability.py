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

from mpi4py import MPI
from petsc4py import PETSc
from slepc4py import SLEPc

import numpy as np

from dolfinrod.continuum import backend
from dolfinrod.continuum.inertia import Determinant, NegativePivots
from dolfinrod.continuum.joint import Joint
from dolfinrod.continuum.lift import lifted
from dolfinrod.continuum.mass import ALIKE, densities
from dolfinrod.continuum.neutral import PhaseCondition
from dolfinrod.continuum.placement import Placement
from dolfinrod.continuum.pool import borrowed
from dolfinrod.continuum.problem import Problem
from dolfinrod.continuum.readout import Readout
from dolfinrod.continuum.rubbing import remembers
from dolfinrod.continuum.spatial import SpatialRods
from dolfinrod.scene import Spatial

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.continuum.readout import State

__all__ = ["Judge", "Verdict", "judging"]

# Motions whose ω² lies below this, in EI/(ρA L⁴) of the softest way to bend or twist a rod, cost nothing but round-off,
# as when a round rod turns about its own bent axis: they count as stable.
NEUTRAL = 1e-6
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
        self._lift: PETSc.Vec | None = None
        self._pivots, self._joint = NegativePivots(d.comm), None if problem.pairs is None else Joint(problem.pairs)
        self._determinant: Determinant | None = None

    def verdict(self, state: State, t: float, *, closely: bool, doubt: float = 0.0) -> Verdict:
        """Stability of an equilibrium.

        Args:
            state: The problem's own current state.
            t: Its pseudo-time.
            closely: Whether eigenvalues are worth their price where loads have no potential.
            doubt: Moment at a node up to which it is one, in EI/L.
        """
        problem, A = self._problem, self._problem.discretization.matrix
        problem.hold(np.zeros(0, dtype=np.int32))
        if self._phase.needed:
            self._phase.hold_unresisted()
        problem.assemble_tangent(A, on_sphere=True)
        A.setDiagonal(self._neutral(A, doubt), PETSc.InsertMode.ADD)
        if problem.conservative:
            unstable = self._pivots.beyond(A if self._joint is None else self._joint.filled(A), self._n_dual)
            return Verdict(None) if unstable is None else Verdict(unstable == 0, unstable, avoidable=unstable > 0)
        if problem.pairs is not None:
            return Verdict(None)
        self._determinant = self._determinant or Determinant(A, problem.discretization.band)
        if self._determinant.sign(A) * (-1.0) ** self._n_dual < 0.0:
            return Verdict(False)
        if not closely:
            return Verdict(None)
        return problem.discretization.comm.bcast(self._vibrating(self._determinant.matrix, self._determinant.pc))

    def _vibrating(self, K: PETSc.Mat, factors: PETSc.PC) -> Verdict:
        """From the vibrations nearest to rest, ω² = 1/θ with θ an eigenvalue of K⁻¹M; each rank by itself."""
        eps = SLEPc.EPS().create(K.getComm())
        eps.setOptionsPrefix("rod_stability_")
        eps.setOperators(self._mass(K), K)
        eps.setProblemType(SLEPc.EPS.ProblemType.GNHEP)
        solver = PETSc.KSP().create(K.getComm())
        solver.setType(PETSc.KSP.Type.PREONLY)
        solver.setOperators(K)
        solver.setPC(factors)
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
        """Masses ρA and rotary inertia of the sections, the whole matrix on each rank."""
        if self._lumped is None:
            d = self._problem.discretization
            self._lumped = K.duplicate(copy=False)
            diagonal = K.createVecLeft()
            diagonal.array[:] = np.concatenate(d.comm.allgather(self._shared(*self._densities)[: d.n_owned]))
            self._lumped.setDiagonal(diagonal)
            self._lumped.assemble()
            diagonal.destroy()
        return self._lumped

    def _neutral(self, A: PETSc.Mat, doubt: float) -> PETSc.Vec:
        """What lifts the motions that cost nothing off zero, a diagonal; no moment in doubt can turn a section then."""
        d, (rhoA, rhoI) = self._problem.discretization, self._densities
        if self._lift is None:
            self._lift = A.createVecLeft()
            softest = min(min(*rod.section.EI, rod.section.GJ) for rod in self._problem.scene.rods)
            least = NEUTRAL * softest / self._problem.placement.stiffness
            self._least = least * self._shared(rhoA, np.maximum(rhoI, ALIKE * rhoA))[: d.n_owned]
        self._lift.array[:] = self._least
        q = d.owned_nodes("q")
        # A moment M adds up to 4 M to the stiffness against a change of quaternion, which turns by twice its size.
        self._lift.array[q] = np.where(self._least[q] > 0.0, np.maximum(self._least[q], 4.0 * doubt), 0.0)
        return self._lift

    def _shared(self, rhoA: NDArray[np.float64], rhoI: NDArray[np.float64]) -> NDArray[np.float64]:
        """Densities of the rods shared equally among the nodes of each element, nothing where dofs are held."""
        problem, d = self._problem, self._problem.discretization
        mine = slice(0, d.n_owned_cells)
        share = np.diff(problem.ends[mine], axis=1)[:, :, None] / (d.degree + 1)
        lumped = backend.function(d.space)
        m = lumped.x.array
        for field, density in zip(("r", "q"), (rhoA, rhoI), strict=True):
            np.add.at(m, d.dofs[field][mine], share * density[problem.rod[mine], None, None])
        backend.sum_over_ranks(lumped)
        m[problem.constraints.dofs] = 0.0
        return m

    def close(self) -> None:
        """Free what PETSc holds, on all ranks together."""
        self._pivots.close()
        for part in (self._determinant, self._joint):
            if part is not None:
                part.close()
        for owned in (self._lumped, self._lift):
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
        self._residual = backend.function(spatial.discretization.space)

    def verdict(self, state: State, t: float, *, closely: bool, doubt: float = 0.0) -> Verdict:
        """Stability in space of a state of the planar problem, out of balance there by an error of the elements."""
        problem = self._problem
        self._readout.restore(lifted(state, self._plane, problem.placement))
        problem.advance_to(t)
        b = problem.discretization.assembled_residual()
        problem.balance_multipliers(b)
        b = self._residual.x.array
        b[:] = 0.0
        problem.add_residual(b)
        backend.sum_over_ranks(self._residual)
        problem.clear_held(b)
        q = problem.discretization.owned_nodes("q")
        left = problem.discretization.comm.allreduce(float(np.abs(b[q]).max(initial=0.0)), op=MPI.MAX)
        return super().verdict(state, t, closely=closely, doubt=max(doubt, left))


@contextmanager
def judging(problem: Problem, *, in_space: bool) -> Iterator[Judge | None]:
    """A judge of the states of a problem; none where what they touch has a memory: then no tangent tells.

    Args:
        problem: Owner of the states.
        in_space: Whether planar states may leave their plane.

    Yields:
        The judge; closed at the end.
    """
    d = problem.discretization
    if remembers(problem.scene):
        yield None
        return
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
