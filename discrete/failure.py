"""Why no equilibrium was found, and what to try."""

from __future__ import annotations

from typing import TYPE_CHECKING

from discrete.neutral import UNBALANCED
from discrete.statics import INTERRUPTED
from discrete.watch import ALIASED
from dolfinrod.scene.advice import Findings
from dolfinrod.scene.advice import advice as words

if TYPE_CHECKING:
    from collections.abc import Sequence

    from discrete.statics import StepFailed
    from dolfinrod.result import StepLog
    from dolfinrod.scene import Scene

__all__ = ["advice"]


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
    found = Findings(
        t=failure.t,
        pushed=failure.reason == UNBALANCED,
        aliased=failure.reason == ALIASED,
        turned=failure.turned,
        critical=failure.critical,
        lost=next((row.t for row in log if row.stable is False), None),
    )
    return words(scene, found)
