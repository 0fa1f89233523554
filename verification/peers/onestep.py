"""How much of a tip load everybody takes in one load step on sixteen elements: P1 with other loads."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from dolfinrod.result import NotConverged
from dolfinrod.scene import Planar, Spatial
from verification.models import Continuum, Discrete
from verification.peers.contest import Attempt, Contender, Measured, Taker
from verification.peers.conversation import Answer, Refused, ask_all
from verification.peers.environment import ABSENT, Environment
from verification.peers.rodothers import HOW, attempt
from verification.peers.rodours import away, posed
from verification.peers.rods import cantilever
from verification.references.robustness import PEER_LOADS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from verification.models import Model
    from verification.peers.rodothers import RodOther
    from verification.peers.rods import RodProblem

__all__ = ["ONCE", "ONCE_OURS", "largest", "others_at_once", "ours_at_once"]

ONCE = "once"
# P L²/EI: those of peers.md and on.
LOADS = (*PEER_LOADS, 1000.0, 5000.0)
ELEMENTS = 16
# Off the solution, over the length, beyond which it is another equilibrium: at 5000 the bend lies within one element.
SOUGHT = 0.05
ONCE_OURS: tuple[tuple[Taker, Model], ...] = (
    *(
        (
            Taker(f"continuum, {words}", True, True, HOW, "16 × P3", assumes, words == "spatial"),
            Continuum(3, kinematics),
        )
        for words, kinematics in (("planar", Planar()), ("spatial", Spatial()))
        for assumes in ("sheared", "rigid")
    ),
    (Taker("discrete", True, True, HOW, "16 elements of the paper", "stretched"), Discrete()),
)


def problems() -> tuple[RodProblem, ...]:
    """P1 at every load."""
    return tuple(cantilever("P1", f"tip load {load:g}", load, 1e4, 1e4) for load in LOADS)


def largest(contender: Contender) -> float:
    """Largest load up to which every one was taken, 0 where the first was not."""
    taken = 0.0
    for load, one in zip(LOADS, contender.attempts, strict=False):
        if one.found is None:
            break
        taken = load
    return taken


def others_at_once(others: Sequence[RodOther], environment: Environment | None) -> tuple[Contender, ...]:
    """The elements of somebody else's solver under every load.

    Args:
        others: Of one module.
        environment: Where it lives; None: nowhere.

    Returns:
        An attempt a load of each.
    """
    if environment is None:
        return tuple(Contender(ONCE, other.taker, (), ABSENT) for other in others)
    asked = problems()
    question = {
        "module": f"verification.peers.{others[0].module}",
        "package": others[0].package,
        "pose": "rod",
        "problem": asked[0].told,
        "settings": [at_once(other, problem) for other in others for problem in asked],
        "repeats": 1,
        "budget": 0.0,
    }
    answers = iter(ask_all(environment.python, question))
    loads = tuple(zip(asked, LOADS, strict=True))
    return tuple(
        Contender(ONCE, other.taker, tuple(taken(other, *one, next(answers)) for one in loads)) for other in others
    )


def at_once(other: RodOther, problem: RodProblem) -> dict[str, Any]:
    """One element under one load."""
    sought = {"near": problem.tips[other.taker.assumes], "within": SOUGHT, "ladder": (1,)}
    return {"elements": ELEMENTS, **other.options, "problem": problem.told, **sought}


def taken(other: RodOther, problem: RodProblem, load: float, answer: Answer | Refused) -> Attempt:
    """What became of it."""
    return replace(attempt(other, problem, ELEMENTS, answer), stepping=f"{load:g}")


def ours_at_once(taker: Taker, model: Model) -> Contender:
    """One of our models under every load; a step that is halved was not taken at once.

    Args:
        taker: For the table.
        model: Which.

    Returns:
        An attempt a load.
    """
    return Contender(
        ONCE, taker, tuple(one(taker.assumes, model, p, load) for load, p in zip(LOADS, problems(), strict=True))
    )


def one(assumes: str, model: Model, problem: RodProblem, load: float) -> Attempt:
    """One load."""
    words = f"{ELEMENTS}", f"{load:g}"
    try:
        result = model.solve(posed(problem, assumes, 1), ELEMENTS)
    except NotConverged as failed:
        return Attempt(*words, refused=failed.reason)
    error, s = away(result, problem, assumes), result.statistics
    if len(result.log) > 1:
        return Attempt(*words, refused=f"takes {len(result.log)} load steps")
    if error > SOUGHT:
        return Attempt(*words, refused=f"the tip ends {error:.2g} L from where it should")
    return Attempt(*words, Measured(error, error, s.seconds_solve, s.seconds_setup, s.seconds_compile, 1, "dolfinrod"))
