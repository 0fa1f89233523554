"""Load stepping: the whole load first, halved where no equilibrium is found."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.continuum.neutral import equilibrium
from dolfinrod.result import StepLog
from dolfinrod.scene.history import kinks

if TYPE_CHECKING:
    from collections.abc import Callable

    from dolfinrod.continuum.neutral import PhaseCondition
    from dolfinrod.continuum.newton import Newton, Outcome
    from dolfinrod.continuum.readout import Readout, State
    from dolfinrod.scene import Scene

__all__ = ["Path", "StepFailed", "targets", "walk"]

# Halvings of the way from one target to the next after which a step is too small to be taken.
MOST_CUTS = 12
# A prescribed turn of more than this in one step [rad] would send the interpolated quaternion through zero.
LARGEST_PRESCRIBED_TURN = np.pi / 2


class StepFailed(RuntimeError):  # noqa: N818
    """No equilibrium at the smallest step tried."""

    def __init__(self, *, t: float, step: float, reason: str) -> None:
        super().__init__(reason)
        self.t, self.step, self.reason = t, step, reason


@dataclass
class Path:
    """States accepted so far.

    Args:
        t: Their pseudo-times.
        states: Their gathered states.
        energy: Their strain energies [J].
        log: One row a step.
        iterations: All Newton iterations, failed attempts included.
    """

    t: list[float] = field(default_factory=list)
    states: list[State] = field(default_factory=list)
    energy: list[float] = field(default_factory=list)
    log: list[StepLog] = field(default_factory=list)
    iterations: int = 0


def targets(scene: Scene, t_0: float) -> list[float]:
    """Pseudo-times after t_0 that must be met: the asked-for steps and the kinks of histories."""
    motion = scene.motion
    even = np.arange(1, (motion.steps or 1) + 1) / (motion.steps or 1) * motion.t_end
    corners = [t for part in (*scene.supports, *scene.loads) for t in kinks(getattr(part, "history", None))]
    return sorted({float(t) for t in (*even, *corners) if t_0 < t <= motion.t_end})


def walk(
    newton: Newton,
    phase: PhaseCondition,
    readout: Readout,
    path: Path,
    progress: Callable[[StepLog, float], None] | None,
) -> None:
    """Go from the last state in `path` to the end, adding every accepted state.

    Raises:
        StepFailed: No equilibrium was found even at the smallest step.
    """
    problem = newton.problem
    scene = problem.scene
    t, step = path.t[-1], np.inf
    for target in targets(scene, t):
        cuts, smallest = 0, (target - t) / 2**MOST_CUTS
        while t < target:
            trial = min(step, target - t)
            while problem.constraints.largest_turn(t, t + trial) > LARGEST_PRESCRIBED_TURN * (1 + 1e-12):
                trial /= 2
            t_next = target if trial >= target - t else t + trial
            problem.advance_to(t_next)
            outcome = equilibrium(newton, phase)
            path.iterations += outcome.iterations
            if outcome.converged:
                t = t_next
                _accept(path, t, outcome, cuts, readout)
                step, cuts = (2 * step if cuts == 0 else trial), 0
                if progress is not None:
                    progress(path.log[-1], scene.motion.t_end)
            else:
                cuts += 1
                readout.restore(path.states[-1])
                step = trial / 2
                if step <= smallest:
                    raise StepFailed(t=t, step=trial, reason=outcome.reason)


def _accept(path: Path, t: float, outcome: Outcome, cuts: int, readout: Readout) -> None:
    path.t.append(t)
    path.states.append(readout.state())
    path.energy.append(readout.energy())
    path.log.append(StepLog(t, outcome.iterations, cuts, outcome.residual, path.energy[-1]))
