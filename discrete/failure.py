"""Why no equilibrium was found, and what to try, in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

from discrete.neutral import UNBALANCED
from discrete.watch import ALIASED
from dolfinrod.scene.mechanism import free_motions

if TYPE_CHECKING:
    from discrete.statics import StepFailed
    from dolfinrod.scene import Scene

__all__ = ["advice"]


def advice(scene: Scene, failure: StepFailed) -> str:
    """The likely cause of a failure and what to try against it.

    Args:
        scene: The scene that was not solved.
        failure: How it ended.

    Returns:
        Sentences without the last full stop.
    """
    free = free_motions(scene)
    if free and (failure.t == 0.0 or failure.reason == UNBALANCED):
        return f"Likely a mechanism. Nothing holds the rods completely: {'; '.join(free)}. Try more supports"
    if failure.reason == ALIASED:
        return "Likely too few elements for so many turns: try more elements"
    if failure.critical is not None:
        return (
            f"Likely a critical point was passed: the loads are critical at t = {failure.critical:.6g}, and beyond it "
            "no equilibrium lies near. `.result` holds what converged; try prescribed displacements instead of loads"
        )
    steps = scene.motion.steps
    return (
        f"The iteration did not settle. Try Static(steps={2 * steps if steps else 8}), more elements, or look at "
        "`.result` (what converged)"
    )
