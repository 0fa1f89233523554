"""Hard cases of contact: ended where an independent answer says, or refused in words; never without end or wrong."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.result import NotConverged
from dolfinrod.scene import Dynamic, ImplicitEuler, Midpoint, SceneError, Static
from verification.answers import solved
from verification.contact import MOST_ITERATIONS
from verification.contactaudit import audit, deepest_of
from verification.hardmotion import ROUND_OFF
from verification.patience import CRAWLS, Patience

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from dolfinrod.scene import Scene
    from dolfinrod.scene.motion import Scheme
    from verification.answers import Answer

__all__ = ["ContactRow", "HardContact", "hard_contact", "pairs"]


@dataclass(frozen=True)
class HardContact:
    """A contact that solvers stumble over.

    Args:
        name: Short, unique.
        group: What is hard about it.
        title: For people.
        scene: The problem; the scheme of a motion is replaced.
        answer: Where it should end.
        elements: Of the continuum model, cubic.
        discrete: Elements of the discrete model.
        limit: Error beyond which the end is another one.
    """

    name: str
    group: str
    title: str
    scene: Callable[[], Scene] = field(repr=False)
    answer: Answer
    elements: int = 16
    discrete: int = 40
    limit: float = 1e-3


@dataclass(frozen=True)
class ContactRow:
    """A hard contact by one model and scheme.

    Args:
        case: Its name.
        group: What is hard about it.
        title: For people.
        solver: Model, scheme and mesh.
        outcome: "converged"; "elsewhere": another equilibrium, called unstable; "refused"; "crawls": stopped, its steps
            fail more often than they succeed; "WRONG": another end, or energy that a scheme which only dissipates has
            made.
        reason: Of anything else than convergence, with the advice that a refusal gives.
        steps: Accepted.
        iterations: Newton iterations, those of failed attempts included.
        cuts: Failed attempts.
        error: Relative.
        answer: What it is measured against.
        ms: Of all steps [ms].
        deepest: How far rods came into one another at most, over their radii; NaN where none touched another.
    """

    case: str
    group: str
    title: str
    solver: str
    outcome: str
    reason: str
    steps: int
    iterations: int
    cuts: int
    error: float
    answer: str
    ms: float
    deepest: float = np.nan

    @property
    def a_step(self) -> float:
        """Newton iterations a step."""
        return self.iterations / self.steps if self.steps else np.nan

    @property
    def holds(self) -> bool:
        """The end sought with few iterations, another one with a warning, or a refusal in words."""
        if self.outcome == "converged":
            return self.a_step <= MOST_ITERATIONS
        return self.outcome in ("elsewhere", "refused") and bool(self.reason)


def pairs(case: HardContact) -> tuple[tuple[str, Scheme | None], ...]:
    """Models and schemes that take a case; statics knows no scheme."""
    if isinstance(case.scene().motion, Static):
        return ("discrete", None), ("continuum", None)
    return ("discrete", ImplicitEuler()), ("continuum", ImplicitEuler()), ("continuum", Midpoint())


def hard_contact(case: HardContact, model: str, scheme: Scheme | None) -> ContactRow:
    """Solve with default settings and check.

    Args:
        case: What touches.
        model: "continuum" or "discrete".
        scheme: Of the steps in time; None: statics.

    Returns:
        The row, also of what was refused.
    """
    started, patience, result, reason = time.perf_counter(), None, None, ""
    outcome, error = "converged", np.nan
    try:
        scene = case.scene()
        if isinstance(scene.motion, Dynamic) and scheme is not None:
            motion = replace(scene.motion, scheme=scheme)
            scene, patience = replace(scene, motion=motion), Patience(motion)
        result = solved(scene, model, case.elements, case.discrete, patience)
    except NotConverged as failed:
        result, outcome, reason = failed.result, "refused", f"{failed.reason}. {failed.advice}"
        if patience is not None and patience.over:
            outcome, reason = "crawls", CRAWLS
    except SceneError as refused:
        outcome, reason = "refused", str(refused)
    ms = 1e3 * (time.perf_counter() - started)
    if outcome == "converged" and result is not None:
        ms = 1e3 * result.statistics.seconds_solve
        outcome, error, reason = _checked(case, model, scheme, result)
    taken, deepest = (0, 0, 0), np.nan
    if result is not None:
        deepest = deepest_of(result)
        taken = len(result.log), result.statistics.newton_iterations, sum(row.cuts for row in result.log)
    words = _words(case, model, scheme)
    found = words, outcome, reason, *taken, error
    return ContactRow(case.name, case.group, case.title, *found, case.answer.words, ms, deepest)


def _checked(case: HardContact, model: str, scheme: Scheme | None, result: Result) -> tuple[str, float, str]:
    """Outcome, error and reason of what came to its end."""
    try:
        error = case.answer.error(result, case, model)
    except NotConverged as failed:
        return "WRONG", np.nan, f"no check: {failed.reason}"
    if isinstance(scheme, ImplicitEuler):
        *_, gained = audit(result.energy)
        if gained > ROUND_OFF:
            return "WRONG", error, f"the steps made {gained:.2g} times the energy that went in"
    if error <= case.limit:
        return "converged", error, ""
    told = result.log[-1].stable is False
    return "elsewhere" if told else "WRONG", error, f"ends {error:.2g} off" + (", called unstable" if told else "")


def _words(case: HardContact, model: str, scheme: Scheme | None) -> str:
    """Model, scheme and mesh."""
    mesh = f"{case.elements} × P3" if model == "continuum" else f"{case.discrete}"
    kind = "" if scheme is None else "midpoint, " if isinstance(scheme, Midpoint) else "implicit Euler, "
    return f"{model}, {kind}{mesh}"
