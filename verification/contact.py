"""Contact cases on finer and finer levels: errors against limits, the order they fall with, time and iterations."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.result import NotConverged
from verification.workprecision import LONG, Call, clocked

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from verification.contactcase import ContactCase, ContactRun

__all__ = ["MOST_ITERATIONS", "ContactRecord", "ContactStudy", "contactstudy"]

# Newton iterations a step on average, failed attempts included, that contact may take.
MOST_ITERATIONS = 12.0


@dataclass(frozen=True)
class ContactRecord:
    """A contact case on one level.

    Args:
        level: Which.
        error: Of the quantity, relative; NaN where there is no solution.
        found: The quantity; empty where there is none.
        ms: Of the stepping, warm, one thread [ms].
        iterations: Of Newton's method, those of failed attempts included.
        steps: Accepted.
        cuts: Failed attempts.
        failure: Why there is no solution.
    """

    level: int
    error: float
    found: tuple[float, ...]
    ms: float
    iterations: int
    steps: int
    cuts: int
    failure: str | None = None

    @property
    def a_step(self) -> float:
        """Newton iterations a step."""
        return self.iterations / max(self.steps, 1)

    @property
    def missed(self) -> str:
        """What keeps it from counting, whatever its error is; empty: nothing."""
        if self.failure:
            return f"no solution: {self.failure}"
        return (
            ""
            if self.a_step <= MOST_ITERATIONS
            else f"{self.a_step:.1f} iterations a step, at most {MOST_ITERATIONS:g}"
        )


@dataclass(frozen=True)
class ContactStudy:
    """A contact case by one model on its levels.

    Args:
        case: Its name.
        title: For people.
        family: Of the case.
        quantity: What is read off.
        provenance: Of the reference.
        digits: It is trusted to.
        model: "continuum" or "discrete".
        label: What stays the same on all levels.
        unit: What a level counts.
        records: In the order of the levels.
        order: Power of the level with which errors fall between the last two; None where there are fewer, or no error.
        least: Order that must show; None where none is asked for.
        limit: Of the error on the last level; None where only the order is asked for.
        note: Of the case.
    """

    case: str
    title: str
    family: str
    quantity: str
    provenance: str
    digits: int
    model: str
    label: str
    unit: str
    records: tuple[ContactRecord, ...]
    order: float | None
    least: float | None
    limit: float | None
    note: str

    @property
    def holds(self) -> bool:
        """Solved on every level in few iterations, within the limit on the last, with the order asked for."""
        if any(r.missed for r in self.records):
            return False
        if self.least is not None and (self.order is None or self.order < self.least):
            return False
        return self.limit is None or self.records[-1].error <= self.limit


def contactstudy(case: ContactCase, run: ContactRun) -> ContactStudy:
    """Take a case on one level after the other.

    Args:
        case: With its reference.
        run: The model and its levels.

    Returns:
        The record, also of levels without a solution.
    """
    records = tuple(_record(case, run, level) for level in run.levels)
    reference = case.reference
    return ContactStudy(
        case=case.name,
        title=case.title,
        family=case.family,
        quantity=case.quantity,
        provenance=f"{reference.id}; {reference.method}; {reference.source}",
        digits=reference.digits_trusted,
        model=run.model,
        label=run.label,
        unit=run.unit,
        records=records,
        order=observed(records),
        least=run.order,
        limit=run.limit,
        note=case.note,
    )


def observed(records: tuple[ContactRecord, ...]) -> float | None:
    """log(e₁/e₂)/log(n₂/n₁) of the last two levels; None where there are fewer, no solution or no error."""
    if len(records) < 2:
        return None
    first, second = records[-2:]
    if not (first.error > 0.0 < second.error):
        return None
    return float(np.log(first.error / second.error) / np.log(second.level / first.level))


def _record(case: ContactCase, run: ContactRun, level: int) -> ContactRecord:
    """One level; what takes long is its own warm-up."""
    try:
        first = run.solve(level)
    except NotConverged as failed:
        return _counted(level, failed.result, np.nan, (), 1e3 * failed.result.statistics.seconds_solve, failed.reason)
    found = tuple(np.asarray(case.read(first), dtype=float).tolist())
    return _counted(level, first, case.error(first), found, _solve_ms(run, level, first))


def _counted(
    level: int, result: Result, error: float, found: tuple[float, ...], ms: float, failure: str | None = None
) -> ContactRecord:
    """With what the solve cost."""
    s = result.statistics
    cuts = sum(row.cuts for row in result.log)
    return ContactRecord(level, error, found, ms, s.newton_iterations, s.load_steps, cuts, failure)


def _solve_ms(run: ContactRun, level: int, first: Result) -> float:
    """Least time of the stepping alone [ms]."""
    if first.statistics.seconds_solve > LONG:
        return 1e3 * first.statistics.seconds_solve
    before = [Call(1e3 * first.statistics.seconds_solve, first.statistics)]
    return clocked(lambda: run.solve(level), first, 2, before).solve_min
