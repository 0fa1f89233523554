"""Motion in time, step after step, from the velocities that a scene begins with."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.continuum.couples import Couples
from dolfinrod.continuum.ledger import Ledger
from dolfinrod.continuum.motion import Motion
from dolfinrod.continuum.pace import Pace
from dolfinrod.continuum.predictor import Predictor
from dolfinrod.continuum.stepping import StepFailed
from dolfinrod.result import StepLog
from dolfinrod.scene.history import kinks

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from dolfinrod.continuum.moving import Moving
    from dolfinrod.continuum.newton import Newton, Outcome
    from dolfinrod.continuum.readout import Readout, State
    from dolfinrod.scene import Dynamic, Scene

    Array = NDArray[np.float64]

__all__ = ["March", "Trajectory", "begin"]

# Halvings of a step that does not converge.
MOST_CUTS = 10
# Times closer than this part of a step are one.
SAME = 1e-9
# Error allowed in a step of free length, in L, and the first such step over the unit of time.
TOLERANCE, FIRST = 1e-6, 1e-4


@dataclass
class Trajectory:
    """What is kept of a motion.

    Args:
        t: Stored times [s].
        states: Gathered states at them, with velocities "v" and momenta "π".
        log: One row a step.
        iterations: All Newton iterations, failed attempts included.
    """

    t: list[float] = field(default_factory=list)
    states: list[State] = field(default_factory=list)
    log: list[StepLog] = field(default_factory=list)
    iterations: int = 0


def begin(problem: Moving) -> None:
    """Give the nodes the velocities and momenta of the scene at t = 0."""
    d, place, scene = problem.discretization, problem.placement, problem.scene
    second = problem.lumped.second
    v, ω = np.zeros(len(problem.x)), np.zeros(len(problem.x))
    r = d.dofs["r"]
    for velocity in scene.velocities:
        cells = np.arange(len(problem.rod)) if velocity.rod is None else np.flatnonzero(problem.rod == velocity.rod)
        at = place.to_space(problem.x[r[cells]]).reshape(-1, 3)
        moved = velocity.at(at).reshape(len(cells), -1, 3) @ place.axes * (second / place.length)
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
        self.newton, self._readout, self.trajectory, self._progress = newton, readout, trajectory, progress
        self.problem, self._times = problem, times
        self.ledger, self._predictor = Ledger(problem), Predictor(problem)
        self._couples = Couples(problem) if problem.lumped.J.any() else None
        order = problem.scheme.order + 1
        if times.dt is None:
            first = FIRST * min(problem.lumped.second, times.t_end)
            self._pace = Pace(first, order, TOLERANCE if times.tol is None else times.tol)
        else:
            self._pace = Pace(times.dt, order)

    def run(self) -> None:
        """Go from the present state to the end of the scene's time.

        Raises:
            StepFailed: A step could not be taken, however short.
        """
        t, stored = 0.0, outputs(self._times)
        self._store(t)
        for target in targets(self.problem.scene, self._times):
            while t < target * (1.0 - SAME):
                t = self._step(t, target)
                if stored is None:
                    self._store(t)
            if stored is not None and np.abs(stored - target).min() <= SAME * target:
                self._store(t)

    def _step(self, t: float, target: float) -> float:
        """One step towards the target, shorter if it has to be; the time it leads to."""
        problem, trajectory, pace = self.problem, self.trajectory, self._pace
        start, motion = problem.x.copy(), problem.motion
        n = np.ceil((target - t) / pace.length * (1.0 - SAME))
        tried = (target - t) / max(n, 1.0)
        for cuts in range(MOST_CUTS + 1):
            problem.begin_step(t, tried)
            problem.x[:] = self._predictor.guess(t + tried)
            outcome = self.newton.solve()
            trajectory.iterations += outcome.iterations
            if outcome.converged:
                problem.end_step()
                if pace.allows(problem.local_error(), tried):
                    self._predictor.learn(t + tried)
                    self.ledger.step()
                    self._log(t + tried, outcome, cuts)
                    return target if n <= 1.0 and not cuts else t + tried
                tried = min(pace.length, tried)
            else:
                pace.fail(tried)
                tried /= 2
            problem.x[:] = start
            problem.motion = motion
        raise StepFailed(t=t, step=2 * tried, reason=outcome.reason)

    def _log(self, t: float, outcome: Outcome, cuts: int) -> None:
        energy = self.ledger.strain() * self.problem.placement.moment
        row = StepLog(t, outcome.iterations, cuts, outcome.residual, energy)
        self.trajectory.log.append(row)
        if self._progress is not None:
            self._progress(row, self.problem.scene.motion.t_end)

    def _store(self, t: float) -> None:
        self.trajectory.t.append(t)
        state = self._readout.state() | self.problem.rates(self._readout)
        if self._couples is not None:
            state |= self._readout.gather(couples=self._couples.rates())
        self.trajectory.states.append(state)
        self.ledger.store()


def targets(scene: Scene, times: Dynamic) -> list[float]:
    """Times that must be met: the end, the kinks of histories, the stored ones, and equal steps where dt is given."""
    end, dt = times.t_end, times.dt
    n = 1 if dt is None else int(np.ceil(end / dt * (1.0 - SAME)))
    even = end * np.arange(1, n + 1) / n
    corners = [t for part in (*scene.supports, *scene.loads) for t in kinks(getattr(part, "history", None))]
    stored = outputs(times)
    met = np.unique(np.concatenate([even, corners, [] if stored is None else stored]))
    met = met[(met > 0.0) & (met <= end)]
    keep = np.append(np.diff(met) > SAME * end / n, True)
    return [float(t) for t in met[keep]]


def outputs(times: Dynamic) -> Array | None:
    """Times at which states are stored; None: after every step."""
    output = times.output
    if output is None:
        return None
    if not isinstance(output, float):
        return np.array(output)
    n = int(np.floor(times.t_end / output * (1.0 + SAME)))
    return np.asarray(np.union1d(output * np.arange(1, n + 1), [times.t_end]))
