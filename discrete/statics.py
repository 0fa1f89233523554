"""Load stepping, 2.3.3: the load grows in increments, each from the configuration that the last one reached.

With equilibrium iterations the whole load is tried first, a step is halved on failure and doubled after success.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Generic, TypeVar

import numpy as np

from discrete.assembly import SingularTangentError
from dolfinrod.result import StepLog
from dolfinrod.scene import kinks

if TYPE_CHECKING:
    from collections.abc import Callable

    from discrete.equilibrium import Equilibrium, State
    from discrete.increments import Carried, Increments
    from discrete.neutral import PhaseCondition
    from discrete.record import Snapshot
    from dolfinrod.scene import Scene

    Progress = Callable[[StepLog, float], None]

__all__ = ["Path", "StepFailed", "stride", "targets", "walk"]

# Successive halvings of a step after which it cannot be taken.
MOST_CUTS = 12
# Increments of the paper's loading where the scene asks for no number: it wants each of them small.
MANY = 100


class StepFailed(RuntimeError):  # noqa: N818
    """No equilibrium at the smallest step tried."""

    def __init__(self, *, t: float, step: float, reason: str) -> None:
        super().__init__(reason)
        self.t, self.step, self.reason = t, step, reason


AnyState = TypeVar("AnyState")


@dataclass
class Path(Generic[AnyState]):
    """Accepted states.

    Args:
        state: The last one.
        kept: What is kept of all.
        log: One row a step.
        iterations: All iterations, failed attempts included.
    """

    state: AnyState
    kept: list[Snapshot] = field(default_factory=list)
    log: list[StepLog] = field(default_factory=list)
    iterations: int = 0

    def accept(self, kept: Snapshot, iterations: int, cuts: int, residual: float, unit_of_energy: float) -> None:
        """Add a state and its row in the log."""
        self.kept.append(kept)
        self.log.append(StepLog(kept.t, iterations, cuts, residual, kept.energy * unit_of_energy))


def targets(scene: Scene, t_0: float, steps: int) -> list[float]:
    """Pseudo-times after t_0 that are met exactly: equal steps and the kinks of tables.

    Args:
        scene: The problem.
        t_0: Where the path begins.
        steps: Number of equal steps over the whole pseudo-time.

    Returns:
        Ascending times, the last one the end.
    """
    t_end = scene.motion.t_end
    even = np.linspace(0.0, t_end, steps + 1)[1:]
    corners = [t for part in (*scene.supports, *scene.loads) for t in kinks(getattr(part, "history", None))]
    times = sorted({*map(float, even), *corners})
    return [t for t in times if t_0 < t <= t_end]


def walk(
    equilibrium: Equilibrium,
    phase: PhaseCondition,
    path: Path[State],
    t: float,
    scene: Scene,
    progress: Callable[[StepLog, float], None] | None,
) -> None:
    """Follow the loads to their end, adding every accepted state to a path.

    Args:
        equilibrium: The solver.
        phase: Its free motions.
        path: Where to begin; grows.
        t: Pseudo-time there.
        scene: The problem.
        progress: Called with every accepted step and the final pseudo-time.

    Raises:
        StepFailed: A step could not be taken after `MOST_CUTS` halvings.
    """
    step = np.inf
    for target in targets(scene, t, scene.motion.steps or 1):
        cuts, smallest = 0, (target - t) / 2**MOST_CUTS
        while t < target:
            trial = min(step, target - t)
            t_next = target if trial >= target - t else t + trial
            outcome = phase.find(path.state, t_next)
            path.iterations += outcome.iterations
            if not outcome.converged:
                cuts, step = cuts + 1, trial / 2.0
                if step <= smallest:
                    raise StepFailed(t=t, step=trial, reason=outcome.reason)
                continue
            path.state, t = outcome.state, t_next
            kept = equilibrium.snapshot(path.state, t)
            path.accept(kept, outcome.iterations, cuts, outcome.residual, equilibrium.mesh.units.moment)
            if progress is not None:
                progress(path.log[-1], scene.motion.t_end)
            step, cuts = (2.0 * step if cuts == 0 else trial), 0


def stride(
    increments: Increments,
    path: Path[Carried],
    t: float,
    scene: Scene,
    progress: Callable[[StepLog, float], None] | None,
) -> None:
    """Follow the loads in increments that are solved once each; arguments as for `walk`.

    Raises:
        StepFailed: Something is free to move.
    """
    for target in targets(scene, t, scene.motion.steps or MANY):
        try:
            path.state, residual = increments.take(path.state, target)
        except SingularTangentError as error:
            raise StepFailed(t=t, step=target - t, reason=str(error)) from error
        path.accept(increments.snapshot(path.state, target), 1, 0, residual, increments.mesh.units.moment)
        path.iterations += 1
        t = target
        if progress is not None:
            progress(path.log[-1], scene.motion.t_end)
