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
    from dolfinrod.checkpoint import Checkpoint
    from dolfinrod.result import StepLog
    from dolfinrod.scene import Scene

__all__ = ["advice"]


def advice(scene: Scene, failure: StepFailed, log: Sequence[StepLog], file: Checkpoint | None = None) -> str:
    """The likely cause of a failure and what to try against it.

    Args:
        scene: The scene that was not solved.
        failure: How it ended.
        log: Steps that were taken before.
        file: What they are kept in.

    Returns:
        Sentences without the last full stop.
    """
    if failure.reason == INTERRUPTED:
        way = "discrete.solve(scene, start=...)" if file is None else f"the same run with {file.name}"
        return f"`.result` holds what was reached; {way} goes on from there"
    found = Findings(
        t=failure.t,
        pushed=failure.reason == UNBALANCED,
        aliased=failure.reason == ALIASED,
        turned=failure.turned,
        critical=failure.critical,
        lost=next((row.t for row in log if row.stable is False), None),
    )
    return words(scene, found)
