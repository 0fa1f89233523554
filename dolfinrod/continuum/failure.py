"""What is known where a step could not be taken."""

from __future__ import annotations

from typing import TYPE_CHECKING

from dolfinrod.continuum.ahead import critical_ahead
from dolfinrod.continuum.neutral import UNBALANCED
from dolfinrod.continuum.watch import largest_turn_between_nodes
from dolfinrod.scene.advice import Findings

if TYPE_CHECKING:
    from dolfinrod.continuum.path import Path
    from dolfinrod.continuum.readout import Readout
    from dolfinrod.continuum.stepping import StepFailed

__all__ = ["findings"]

# Part of the whole path within which a critical point explains that a step could not be taken.
CLOSE = 0.01


def findings(readout: Readout, path: Path, failure: StepFailed) -> Findings:
    """What the last equilibrium tells of a failure.

    Args:
        readout: Of the problem that was not solved; its state afterwards is the last equilibrium.
        path: Equilibria found.
        failure: How it ended.
    """
    problem, t = readout.problem, path.t[-1]
    readout.restore(path.states[-1])
    turned = largest_turn_between_nodes(problem)
    # What is ahead is not known of rods that touch one another.
    seen = bool(path.log) and problem.pairs is None
    critical = critical_ahead(readout, path.states[-1], t) if seen else float("inf")
    near = critical - t < CLOSE * problem.scene.motion.t_end
    return Findings(
        t=t,
        pushed=failure.reason == UNBALANCED,
        aliased=failure.coarse,
        turned=turned,
        critical=critical if near else None,
        lost=next((row.t for row in path.log if row.stable is False), None),
    )
