"""Load stepping, 2.3.3: the load grows in increments, each from the configuration that the last one reached.

Where increments end and what is recorded of them; `stepping` finds their size where equilibrium is iterated to.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Generic, TypeVar

import numpy as np

from discrete.assembly import SingularTangentError
from dolfinrod.result import StepLog
from dolfinrod.scene import Static, kinks

if TYPE_CHECKING:
    from collections.abc import Callable

    from discrete.increments import Carried, Increments
    from discrete.record import Snapshot
    from dolfinrod.scene import Scene

    Progress = Callable[[StepLog, float], None]

__all__ = ["INTERRUPTED", "Path", "Progress", "StepFailed", "corners", "stride", "targets"]

# Why a path ends that the user has stopped.
INTERRUPTED = "interrupted by the user"
# Increments of the paper's loading where the scene asks for no number: it wants each of them small.
MANY = 100


class StepFailed(RuntimeError):  # noqa: N818
    """No equilibrium at the smallest step tried.

    Attributes:
        t: Pseudo-time of the last equilibrium.
        step: Step tried last.
        reason: Why the iteration stopped.
        critical: Pseudo-time close ahead at which the loads are critical; None where they are not.
        turned: Largest turn of the ends of an element against each other in the last equilibrium [rad].
    """

    def __init__(
        self, *, t: float, step: float, reason: str, critical: float | None = None, turned: float = 0.0
    ) -> None:
        super().__init__(reason)
        self.t, self.step, self.reason, self.critical, self.turned = t, step, reason, critical, turned


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

    def accept(self, kept: Snapshot, row: StepLog, progress: Progress | None, t_end: float) -> None:
        """Add a state and its row in the log."""
        self.kept.append(kept)
        self.log.append(row)
        if progress is not None:
            progress(row, t_end)


def corners(scene: Scene) -> set[float]:
    """Pseudo-times at which the slope of a history may jump."""
    return {t for part in (*scene.supports, *scene.loads, *scene.walls) for t in kinks(getattr(part, "history", None))}


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
    return [t for t in sorted({*map(float, even), *corners(scene)}) if t_0 < t <= t_end]


def stride(increments: Increments, path: Path[Carried], t: float, scene: Scene, progress: Progress | None) -> None:
    """Follow the loads in increments that are solved once each, adding every state to a path.

    Args:
        increments: The solver.
        path: Where to begin; grows.
        t: Pseudo-time there.
        scene: The problem.
        progress: Called with every accepted step and the final pseudo-time.

    Raises:
        StepFailed: Something is free to move.
    """
    assert isinstance(scene.motion, Static)
    for target in targets(scene, t, scene.motion.steps or MANY):
        try:
            path.state, residual = increments.take(path.state, target)
        except SingularTangentError as error:
            raise StepFailed(t=t, step=target - t, reason=str(error)) from error
        kept, path.iterations = increments.snapshot(path.state, target), path.iterations + 1
        row = StepLog(target, 1, 0, residual, kept.energy * increments.mesh.units.moment)
        path.accept(kept, row, progress, scene.motion.t_end)
        t = target
