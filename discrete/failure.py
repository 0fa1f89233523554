"""Why no equilibrium was found, and what to try, in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

from discrete.neutral import UNBALANCED
from discrete.statics import INTERRUPTED
from discrete.watch import ALIASED
from dolfinrod.scene import Static
from dolfinrod.scene.mechanism import free_motions

if TYPE_CHECKING:
    from collections.abc import Sequence

    from discrete.statics import StepFailed
    from dolfinrod.result import StepLog
    from dolfinrod.scene import Scene

__all__ = ["advice"]

# Turn of the ends of an element against each other from which its law is no longer near that of the rod [rad].
COARSE = 1.0


def advice(scene: Scene, failure: StepFailed, log: Sequence[StepLog]) -> str:
    """The likely cause of a failure and what to try against it.

    Args:
        scene: The scene that was not solved.
        failure: How it ended.
        log: Steps that were taken before.

    Returns:
        Sentences without the last full stop.
    """
    if failure.reason == INTERRUPTED:
        return "`.result` holds what was reached; discrete.solve(scene, start=...) goes on from there"
    free = free_motions(scene)
    if free and (failure.t == 0.0 or failure.reason == UNBALANCED):
        return f"Likely a mechanism. Nothing holds the rods completely: {'; '.join(free)}. Try more supports"
    if failure.reason == ALIASED:
        return "Likely too few elements for so many turns: try more elements"
    if failure.turned > COARSE:
        return (
            f"Likely too few elements for such loads: at t = {failure.t:.6g} the ends of one have turned by "
            f"{failure.turned:.2g} rad against each other. Try more elements"
        )
    if failure.critical is not None:
        return (
            f"Likely a critical point was passed: the loads are critical at t = {failure.critical:.6g}, and beyond it "
            "no equilibrium lies near. `.result` holds what converged; try prescribed displacements instead of loads"
        )
    lost = next((row.t for row in log if row.stable is False), None)
    if lost is not None:
        return (
            f"Likely a critical point was passed: what converged is unstable from t = {lost:.6g} on, and such paths "
            "are easily lost. Look at `.result` (what converged), or try a small load across the rod, which leads to a "
            "stable branch"
        )
    steps = scene.motion.steps if isinstance(scene.motion, Static) else None
    return (
        f"The iteration did not settle. Try Static(steps={2 * steps if steps else 8}), more elements, or look at "
        "`.result` (what converged)"
    )
