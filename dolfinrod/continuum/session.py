"""A scene opened for more than one solve: its equilibria one after the other, ready for what is asked about them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from mpi4py import MPI

from dolfinrod.continuum.failure import findings
from dolfinrod.continuum.lift import lifted
from dolfinrod.continuum.neutral import PhaseCondition, equilibrium
from dolfinrod.continuum.newton import Newton
from dolfinrod.continuum.path import Path
from dolfinrod.continuum.placement import Placement
from dolfinrod.continuum.planar import PlanarRods
from dolfinrod.continuum.pool import borrowed
from dolfinrod.continuum.problem import Problem
from dolfinrod.continuum.readout import Readout
from dolfinrod.continuum.rubbing import remembers
from dolfinrod.continuum.solver import check_degree, choose, record
from dolfinrod.continuum.spatial import SpatialRods
from dolfinrod.continuum.stability import Judge, Verdict
from dolfinrod.continuum.stepping import StepFailed, Walk
from dolfinrod.result import NotConverged, Result, Statistics
from dolfinrod.scene import Planar, SceneError, Spatial
from dolfinrod.scene.advice import advice
from dolfinrod.scene.options import element_counts

if TYPE_CHECKING:
    from dolfinrod.continuum.kinematics import Kinematics
    from dolfinrod.continuum.readout import State
    from dolfinrod.continuum.stepping import Found
    from dolfinrod.scene import Scene

__all__ = ["Session", "opened"]


class DivergenceJudge(Judge):
    """Looks for divergence only: what flutters is past no critical load."""

    def verdict(self, state: State, t: float, *, closely: bool, doubt: float = 0.0) -> Verdict:
        """Stability by pivots or the sign of the determinant, never by vibrations."""
        return super().verdict(state, t, closely=False, doubt=doubt)


class Followed(Walk):
    """Never leaves the path it is on, so that a load at which the path turns back is met, not jumped over."""

    def _beside(self, t: float, found: Found) -> Found:
        """What was found."""
        return found


@dataclass
class Session:
    """Equilibria of one scene on one mesh.

    Args:
        problem: Owner of the state.
        newton: Its solver.
        phase: Its free rigid motions.
        judge: Tells states beyond a critical point from others.
        readout: Its states as records.
        path: Equilibria found, the last one current.
    """

    problem: Problem
    newton: Newton
    phase: PhaseCondition
    judge: Judge
    readout: Readout
    path: Path = field(default_factory=Path)

    @property
    def t(self) -> float:
        """Pseudo-time of the current equilibrium."""
        return self.path.t[-1]

    def begin(self, at: Result | None) -> None:
        """Equilibrium at t = 0, or at the end of an earlier result.

        Raises:
            SceneError: A result of something else.
            NotConverged: No equilibrium there.
        """
        state = None if at is None else self._state(at)
        t = 0.0 if at is None else float(at.t[-1])
        self.problem.advance_to(t)
        if state is not None:
            self.readout.restore(state)
            self.problem.advance_to(t)
        before = self.readout.state()
        outcome = equilibrium(self.newton, self.phase)
        if not outcome.converged:
            self.readout.restore(before)
        self.path.t.append(t)
        self.path.states.append(self.readout.state())
        self.path.energy.append(self.readout.energy())
        self.path.iterations += outcome.iterations
        if not outcome.converged:
            raise self.failed(StepFailed(t=t, step=0.0, reason=outcome.reason))

    def go_to(self, t: float) -> None:
        """Follow the path on to pseudo-time t, with steps so short that it stays stable as far as it can.

        Raises:
            StepFailed: No equilibrium was found on the way.
        """
        Followed(self.newton, self.phase, self.judge, self.readout, self.path, None).run(until=t)

    def judge_start(self) -> None:
        """Find out whether the current equilibrium is stable: only then do steps that follow shy away from others."""
        self.path.stable = self.judge.verdict(self.path.states[-1], self.t, closely=False).stable

    def go_back(self, n: int, *, stable: bool | None) -> None:
        """Forget all equilibria but the first n, the last of which was stable or not as told."""
        for states in (self.path.t, self.path.states, self.path.energy):
            del states[n:]
        del self.path.log[max(n - 1, 0) :]
        self.path.stable = stable
        self.restore()

    def restore(self) -> None:
        """Make the last equilibrium of the path the current state again."""
        self.problem.advance_to(self.t)
        self.readout.restore(self.path.states[-1])

    def result(self, *, converged: bool = True) -> Result:
        """The path so far as a record."""
        d = self.problem.discretization
        statistics = Statistics(d.n_dofs, len(self.path.log), self.path.iterations, self.newton.factorizations)
        return record(self.problem, self.phase.notes, self.readout, self.path, statistics, converged=converged)

    def failed(self, failure: StepFailed) -> NotConverged:
        """The public exception for a step that could not be taken."""
        words = advice(self.problem.scene, findings(self.readout, self.path, failure))
        result = self.result(converged=False)
        return NotConverged(result=result, t=failure.t, step=failure.step, reason=failure.reason, advice=words)

    def _state(self, at: Result) -> State:
        """The last state of a result in the working coordinates of this problem."""
        if not isinstance(at, Result) or at.formulation.model != "continuum":
            raise SceneError("at must be a result of `dolfinrod.solve`")
        scene, state = self.problem.scene, at.state
        if at.scene != scene:
            raise SceneError("at must be a result of the same scene")
        if at.formulation.kinematics == "planar" and self.problem.kinematics.name == "spatial":
            state = lifted(state, Placement.of(scene, choose(scene, Planar())), self.problem.placement)
        wanted = self.readout.state()
        if any(state[f].shape != wanted[f].shape for f in self.problem.kinematics.fields):
            raise SceneError("at must be a result on the same elements, degree and kinematics")
        return state


@contextmanager
def opened(
    scene: Scene,
    kinematics: Planar | Spatial | None,
    comm: MPI.Comm | None,
    degree: int,
    elements: int | Sequence[int],
) -> Iterator[Session]:
    """A session for the time of one analysis; in space unless a plane is asked for, as rods buckle where they can.

    Raises:
        SceneError: An option that does not fit the scene.
    """
    check_degree(degree)
    if remembers(scene):
        raise SceneError(
            "must not rub nor have multipliers here: such contact has a memory, and no tangent tells what is critical",
            field="contacts",
        )
    if scene.meetings:
        raise SceneError(
            "must not hold RodContact here: critical loads and vibrations of rods that touch one another are not known",
            field="contacts",
        )
    chosen = choose(scene, Spatial() if kinematics is None else kinematics)
    rods: Kinematics = PlanarRods() if isinstance(chosen, Planar) else SpatialRods()
    comm = MPI.COMM_WORLD if comm is None else comm
    with borrowed(comm, rods, degree, element_counts(elements, len(scene.rods))) as (discretization, _):
        problem = Problem(scene, discretization, Placement.of(scene, chosen))
        newton = Newton(problem)
        judge = DivergenceJudge(problem)
        try:
            yield Session(problem, newton, PhaseCondition(problem), judge, Readout(problem))
        finally:
            judge.close()
            newton.close()
