"""Motion in time, step after step, from the velocities that a scene begins with."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from mpi4py import MPI

import numpy as np

from dolfinrod.continuum.couples import Couples
from dolfinrod.continuum.ledger import Ledger
from dolfinrod.continuum.motion import Motion
from dolfinrod.continuum.pace import Pace
from dolfinrod.continuum.predictor import Predictor
from dolfinrod.continuum.restart import rates
from dolfinrod.continuum.stepping import StepFailed
from dolfinrod.continuum.trajectory import Mark, Trajectory
from dolfinrod.result import StepLog
from dolfinrod.scene import corners

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from dolfinrod.continuum.moving import Moving
    from dolfinrod.continuum.newton import Newton, Outcome
    from dolfinrod.continuum.readout import Readout, State
    from dolfinrod.scene import Dynamic, Scene

    Array = NDArray[np.float64]

__all__ = ["March", "begin"]

# Halvings of a step that does not converge.
MOST_CUTS = 10
# Times closer than this part of a step are one.
SAME = 1e-9
# Error allowed in a step of free length, in L, and the first such step over the unit of time.
TOLERANCE, FIRST = 1e-6, 1e-4


def begin(problem: Moving) -> None:
    """Give the nodes the velocities and momenta of the scene at t = 0."""
    d, place, scene = problem.discretization, problem.placement, problem.scene
    second = problem.lumped.second
    v, ω = np.zeros(len(problem.x)), np.zeros(len(problem.x))
    r = d.dofs["r"]
    for velocity in scene.velocities:
        cells = np.arange(len(problem.rod)) if velocity.rod is None else np.flatnonzero(problem.rod == velocity.rod)
        at = place.to_space(problem.x[r[cells]]).reshape(-1, 3)
        moved = velocity.at(at).reshape(len(cells), r.shape[1], 3) @ place.axes * (second / place.length)
        v[r[cells]] += moved
        spin = np.asarray(velocity.omega) @ place.spin_axes * second
        ω[d.dofs["q"][cells][:, :, : len(spin)]] += spin
    v[problem.constraints.dofs] = 0.0
    ω[problem.constraints.dofs] = 0.0
    lumped = problem.lumped
    spins = np.einsum("nij,nj->ni", lumped.J, ω[lumped.q[:, : problem.kinematics.n_spin]])
    problem.motion = Motion(v[lumped.r], spins)


class March:
    """Steps a scene in time.

    Args:
        problem: Owner of the state.
        times: How far and how finely.
        newton: Solver of the steps.
        readout: Gathers states.
        trajectory: Grows.
        progress: Called with every step and the final time.

    Attributes:
        mark: The last state that counts.
    """

    def __init__(
        self,
        problem: Moving,
        times: Dynamic,
        newton: Newton,
        readout: Readout,
        trajectory: Trajectory,
        progress: Callable[[StepLog, float], None] | None,
    ) -> None:
        self.newton, self.readout, self.trajectory, self._progress = newton, readout, trajectory, progress
        self.problem, self._times = problem, times
        self.ledger, self._predictor = Ledger(problem), Predictor(problem, 0.0)
        self._couples = Couples(problem) if problem.turns else None
        order = problem.scheme.order + 1
        if times.dt is None:
            first = FIRST * min(problem.lumped.second, times.t_end)
            self._pace = Pace(first, order, TOLERANCE if times.tol is None else times.tol)
        else:
            self._pace = Pace(times.dt, order)
        self.mark = Mark(0.0, problem.x.copy(), problem.motion, self._pace.length, self.ledger.now())

    @property
    def even(self) -> bool:
        """Whether the scene says how long a step is."""
        return self._times.dt is not None

    def take_up(self, mark: Mark) -> None:
        """Go on from another state; the trajectory is that up to there."""
        self.mark = mark
        self._rewind()
        self._predictor = Predictor(self.problem, mark.t)

    def run(self, keep: Callable[[], None] | None = None) -> None:
        """Go from the present state to the end of the scene's time.

        Args:
            keep: Called at the end of every step.

        Raises:
            StepFailed: A step could not be taken, however short.
        """
        stored = outputs(self._times)
        self._begin()
        for target in targets(self.problem.scene, self._times):
            due = stored is not None and bool(np.abs(stored - target).min() <= SAME * target)
            while self.mark.t < target * (1.0 - SAME) and not self.mark.rested:
                t, outcome, cuts = self._step(self.mark.t, target)
                self._accept(t, outcome, cuts, store=stored is None or (due and t >= target * (1.0 - SAME)))
                if keep is not None:
                    keep()
                if self._progress is not None:
                    self._progress(self.trajectory.log[-1], self.problem.scene.motion.t_end)

    def settle(self) -> None:
        """Back to the mark: who interrupts may do so in the middle of a step."""
        self._rewind()
        self._begin()

    def store_last(self) -> None:
        """Store the state at the mark, unless it is already."""
        if self.trajectory.t[-1] < self.mark.t:
            self._store(self.mark.t)

    def _begin(self) -> None:
        """Store the first state."""
        if not self.trajectory.t:
            self._store(self.mark.t)
            self._set_mark(self.mark.t)

    def _step(self, t: float, target: float) -> tuple[float, Outcome, int]:
        """One step towards the target, shorter if it has to be; the time it leads to, and the attempts lost."""
        problem, pace = self.problem, self._pace
        start, motion = self.mark.x, self.mark.motion
        n = np.ceil((target - t) / pace.length * (1.0 - SAME))
        tried = (target - t) / max(n, 1.0)
        for cuts in range(max(1, MOST_CUTS + 1 - pace.halved(tried, target - t))):
            problem.begin_step(t, tried)
            problem.x[:] = self._predictor.guess(t + tried)
            outcome = self.newton.solve()
            self.trajectory.iterations += outcome.iterations
            if outcome.converged and problem.pairs is not None and (through := problem.pairs.pierced):
                outcome = replace(outcome, converged=False, reason=through)
            if outcome.converged:
                problem.end_step()
                if pace.allows(0.0 if self.even else problem.local_error(), tried):
                    return (target if n <= 1.0 and not cuts else t + tried), outcome, cuts
                tried = min(pace.length, tried)
            else:
                pace.fail(tried)
                tried /= 2
            problem.x[:] = start
            problem.motion = motion
        raise StepFailed(t=t, step=2 * tried, reason=outcome.reason)

    def _accept(self, t: float, outcome: Outcome, cuts: int, *, store: bool) -> None:
        """Book the step that has led to t."""
        self._predictor.learn(t)
        self.ledger.step()
        energy = self.ledger.strain() * self.problem.placement.moment
        self.trajectory.log.append(StepLog(t, outcome.iterations, cuts, outcome.residual, energy))
        rested = self._rests()
        if store or rested:
            self._store(t)
        self._set_mark(t, rested=rested)

    def _rests(self) -> bool:
        """Whether the fastest node has become slow enough for the motion to end."""
        problem, comm = self.problem, self.problem.discretization.comm
        if self._times.rest is None:
            return False
        slow = self._times.rest * problem.lumped.second / problem.placement.length
        was, now = (comm.allreduce(motion.speed, op=MPI.MAX) for motion in (self.mark.motion, problem.motion))
        return bool(was >= slow > now)

    def _store(self, t: float) -> None:
        self.trajectory.t.append(t)
        self.trajectory.states.append(self.state())
        self.ledger.store()

    def state(self) -> State:
        """Gathered state with velocities "v" and spins "omega", and the couples of sections that have inertia."""
        state = self.readout.state() | rates(self.problem, self.readout)
        if self._couples is not None:
            state |= self.readout.gather(couples=self._couples.rates())
        return state

    def _set_mark(self, t: float, *, rested: bool = False) -> None:
        problem, kept = self.problem, self.trajectory
        count = len(kept.t), len(kept.log), kept.iterations
        excess = problem.discretization.excess
        strained = None if excess is None else excess.step()
        touched = None if problem.contacts is None else problem.contacts.memory()
        now = problem.x.copy(), problem.motion, self._pace.length, self.ledger.now()
        self.mark = Mark(t, *now, *count, strained, touched, rested)

    def _rewind(self) -> None:
        """Forget what came after the mark."""
        mark, kept = self.mark, self.trajectory
        self.problem.x[:] = mark.x
        self.problem.motion, self._pace.length = mark.motion, mark.length
        if mark.strained is not None and self.problem.discretization.excess is not None:
            self.problem.discretization.excess.after(mark.strained)
        if mark.touched is not None and self.problem.contacts is not None:
            self.problem.contacts.take_back(mark.touched)
        del kept.t[mark.stored :], kept.states[mark.stored :], kept.log[mark.steps :]
        kept.iterations = mark.iterations
        self.ledger.rewind(mark.energy, mark.stored)


def targets(scene: Scene, times: Dynamic) -> list[float]:
    """Times that must be met: the end, the kinks of histories, the stored ones, and equal steps where dt is given."""
    end, dt = times.t_end, times.dt
    n = 1 if dt is None else int(np.ceil(end / dt * (1.0 - SAME)))
    even = end * (np.arange(1, n + 1) / n)
    stored = outputs(times)
    met = np.unique(np.concatenate([even, corners(scene), [] if stored is None else stored]))
    met = met[(met > 0.0) & (met <= end)]
    keep = np.append(np.diff(met) > SAME * end / n, True)
    return [float(t) for t in met[keep]]


def outputs(times: Dynamic) -> Array | None:
    """Times at which states are stored; None: after every step."""
    output = times.output
    if output is None:
        return None
    if not isinstance(output, float):
        return np.union1d(output, [times.t_end])
    n = int(np.floor(times.t_end / output * (1.0 + SAME)))
    return np.asarray(np.union1d(output * np.arange(1, n + 1), [times.t_end]))
