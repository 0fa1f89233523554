"""The hard cases with default settings: what converges, what is refused and why, and whether anything is wrong."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.result import NotConverged
from dolfinrod.scene import SceneError
from verification.hardcases import CASES

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from dolfinrod.scene import Scene
    from verification.hardcase import HardCase

__all__ = ["FAMILIES", "SHARE", "HardRow", "Share", "hard", "pairs", "share", "shares", "wrong"]

FAMILIES = ("continuum", "discrete")
# Part of the continuum rows that must converge.
SHARE = 0.95


@dataclass(frozen=True)
class HardRow:
    """A hard case by one model.

    Args:
        case: Its name.
        group: What is hard about it.
        title: For people.
        model: "continuum" or "discrete".
        mesh: Such as "16 × P3".
        outcome: "converged"; "flagged": the equilibrium sought, called unstable; "elsewhere": another one, called
            unstable; "refused"; "WRONG": anything else, without a warning, or what could not be checked.
        reason: Of a refusal, or why there is no check.
        steps: Load steps accepted.
        iterations: Newton iterations, those of failed attempts included.
        cuts: Failed attempts.
        stable: Verdict on the last state; None where not judged.
        error: Relative to the size of the rod; NaN where nothing converged.
        check: What it is measured against.
        ms: Of the whole call, forms at hand [ms].
    """

    case: str
    group: str
    title: str
    model: str
    mesh: str
    outcome: str
    reason: str
    steps: int
    iterations: int
    cuts: int
    stable: bool | None
    error: float
    check: str
    ms: float

    @property
    def converged(self) -> bool:
        """Whether the equilibrium sought was found, stable or called unstable."""
        return self.outcome in ("converged", "flagged")

    @property
    def holds(self) -> bool:
        """Everything but a wrong answer without a warning; a refusal with a reason is no lie."""
        return self.outcome != "WRONG"


@dataclass(frozen=True)
class Share:
    """How many of all hard cases the continuum model solves.

    Args:
        converged: Rows.
        total: Rows.
        least: Part of them that has to converge.
    """

    converged: int
    total: int
    least: float

    @property
    def holds(self) -> bool:
        """Enough of them."""
        return self.converged >= self.least * self.total


def pairs() -> tuple[tuple[HardCase, str], ...]:
    """Every case with every model that poses it."""
    return tuple((case, family) for case in CASES for family in FAMILIES if family in case.models)


def hard(case: HardCase, family: str) -> HardRow:
    """Solve with default settings and check.

    Args:
        case: What is solved.
        family: "continuum" or "discrete".

    Returns:
        The row, also of what was refused.
    """
    scene = case.scene()
    started = time.perf_counter()
    reason, result, error, reached = "", None, np.nan, False
    try:
        result = _solved(case, family, scene)
        reached = True
    except NotConverged as failed:
        result, reason = failed.result, failed.reason
    except SceneError as refused:
        reason = str(refused)
    ms = 1e3 * (time.perf_counter() - started)
    if reached and result is not None:
        ms -= 1e3 * result.statistics.seconds_compile
        error, reason = _checked(case, result)
    return HardRow(
        case=case.name,
        group=case.group,
        title=case.title,
        model=family,
        mesh=f"{case.elements} × P{case.degree}" if family == "continuum" else f"{case.discrete}",
        outcome=_outcome(case, result if reached else None, error),
        reason=reason,
        steps=0 if result is None else result.statistics.load_steps,
        iterations=0 if result is None else result.statistics.newton_iterations,
        cuts=0 if result is None else sum(step.cuts for step in result.log),
        stable=result.log[-1].stable if result is not None and result.log else None,
        error=error,
        check=case.check.words,
        ms=ms,
    )


def _checked(case: HardCase, result: Result) -> tuple[float, str]:
    """Error of what was found; what cannot be checked counts as wrong, with the reason."""
    try:
        return case.check.error(result, case), ""
    except NotConverged as failed:
        return np.nan, f"the check has no equilibrium itself: {failed.reason}"


def _outcome(case: HardCase, result: Result | None, error: float) -> str:
    """In one word; an equilibrium that ought to be called unstable and is not, is wrong wherever it lies."""
    if result is None:
        return "refused"
    stable = result.log[-1].stable if result.log else None
    if stable is False:
        return "flagged" if error <= case.limit else "elsewhere"
    return "WRONG" if not error <= case.limit or case.unstable else "converged"


def _solved(case: HardCase, family: str, scene: Scene) -> Result:
    if family == "continuum":
        from dolfinrod.continuum import solve

        return solve(scene, elements=case.elements, degree=case.degree)
    from discrete import solve as solve_discrete

    return solve_discrete(scene, elements=case.discrete)


def share(rows: tuple[HardRow, ...], family: str = "continuum") -> float:
    """Part of the rows of a model that converge."""
    of_model = [row for row in rows if row.model == family]
    return sum(row.converged for row in of_model) / len(of_model) if of_model else np.nan


def shares(rows: tuple[HardRow, ...]) -> tuple[Share, ...]:
    """The share that is asked for; none where only some of the hard cases were solved, of which it says nothing."""
    found = [row for row in rows if row.model == "continuum"]
    everything = {case.name for case, family in pairs() if family == "continuum"}
    if {row.case for row in found} != everything:
        return ()
    return (Share(sum(row.converged for row in found), len(found), SHARE),)


def wrong(rows: tuple[HardRow, ...], family: str = "continuum") -> tuple[HardRow, ...]:
    """Rows of a model that are wrong and called converged."""
    return tuple(row for row in rows if row.model == family and not row.holds)
