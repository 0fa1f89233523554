"""Why no equilibrium was found, and what to try."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from discrete.neutral import UNBALANCED
from discrete.statics import INTERRUPTED
from discrete.watch import ALIASED
from dolfinrod.scene.advice import Findings
from dolfinrod.scene.advice import advice as words

if TYPE_CHECKING:
    from collections.abc import Sequence

    from discrete.mesh import Mesh
    from discrete.statics import StepFailed
    from dolfinrod.checkpoint import Checkpoint
    from dolfinrod.result import StepLog
    from dolfinrod.scene import Scene

__all__ = ["advice", "rounding"]


def rounding(mesh: Mesh) -> float:
    """What double precision rounds off 12 EI/l³ of the elements of a rod over 3 EI/L³ of the rod; the largest.

    Every node has such an error of its own, and n of them add up as √n at least: 2 ε (L/l)³ √n.
    """
    counts = np.bincount(mesh.elements.rod)
    length = np.bincount(mesh.elements.rod, mesh.elements.l)
    shortest = np.full(len(counts), np.inf)
    np.minimum.at(shortest, mesh.elements.rod, mesh.elements.l)
    return float(np.max(2.0 * np.finfo(float).eps * (length / shortest) ** 3 * np.sqrt(counts)))


def advice(
    scene: Scene, mesh: Mesh, failure: StepFailed, log: Sequence[StepLog], file: Checkpoint | None = None
) -> str:
    """The likely cause of a failure and what to try against it.

    Args:
        scene: The scene that was not solved.
        mesh: On which it was not.
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
        rounding=rounding(mesh),
    )
    return words(scene, found)
