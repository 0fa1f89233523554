"""Motions in ever smaller steps: errors against step and time, the order they fall with, what no step would leave."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.result import NotConverged
from verification.workprecision import LONG, Call, clocked

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from verification.case import Array
    from verification.motioncase import MotionCase, Run

__all__ = ["SLACK", "MotionRecord", "MotionStudy", "extrapolated", "motionstudy", "self_order"]

# How far an observed order may lie from theory, either way.
SLACK = 0.25


@dataclass(frozen=True)
class MotionRecord:
    """A motion in steps of one length.

    Args:
        steps: Of it.
        dt: Time step [s].
        error: Of the quantity, relative; NaN where a step could not be taken.
        found: The quantity; empty where a step could not be taken.
        ms: Of all steps, warm, one thread [ms].
        iterations: Newton iterations.
        cuts: Failed attempts at steps.
        failure: Why a step could not be taken.
    """

    steps: int
    dt: float
    error: float
    found: tuple[float, ...]
    ms: float
    iterations: int
    cuts: int
    failure: str | None = None


@dataclass(frozen=True)
class MotionStudy:
    """A motion by one model and scheme in ever smaller steps.

    Args:
        case: Its name.
        title: For people.
        quantity: What is read off.
        provenance: Of the reference.
        digits: It is trusted to.
        model: Name of the model and the scheme.
        mesh: In words.
        seconds: Of the motion [s].
        records: Coarse to fine.
        order: Observed, of the differences between the three finest; None where there are fewer or they do not differ.
        theory: Order of the scheme.
        ordered: Whether it has to show.
        rest: Error of what steps of no length would give, by the order of theory; of the finest where none is sought.
        limit: Of that; None where only the order is asked for.
        note: Of the case.
    """

    case: str
    title: str
    quantity: str
    provenance: str
    digits: int
    model: str
    mesh: str
    seconds: float
    records: tuple[MotionRecord, ...]
    order: float | None
    theory: int
    ordered: bool
    rest: float
    limit: float | None
    note: str

    @property
    def holds(self) -> bool:
        """All steps taken, the order of theory where it should show, and the error within its limit."""
        if any(r.failure for r in self.records):
            return False
        if self.ordered and (self.order is None or abs(self.order - self.theory) > SLACK):
            return False
        return self.limit is None or self.rest <= self.limit


def motionstudy(case: MotionCase, run: Run) -> MotionStudy:
    """Take a motion in steps of one length after the other.

    Args:
        case: With its reference.
        run: The model and the numbers of steps.

    Returns:
        The record, also of steps that could not be taken.
    """
    records = tuple(_record(case, run, n) for n in run.steps)
    found = [np.asarray(r.found) for r in records if not r.failure]
    enough = len(found) == len(records) > 2
    theory = run.stepper.order
    limit = np.nan
    if found:
        ratio = run.steps[-1] / run.steps[-2] if len(run.steps) > 1 else np.inf
        limit = case.error(extrapolated(found, theory, ratio) if run.ordered and len(found) > 1 else found[-1])
    reference = case.reference
    return MotionStudy(
        case=case.name,
        title=case.title,
        quantity=case.quantity,
        provenance=f"{reference.id}; {reference.method}; {reference.source}",
        digits=reference.digits_trusted,
        model=run.stepper.name,
        mesh=run.stepper.mesh,
        seconds=case.t_end,
        records=records,
        order=self_order(found, run.steps) if enough else None,
        theory=theory,
        ordered=run.ordered,
        rest=limit,
        limit=run.limit,
        note=case.note,
    )


def self_order(found: list[Array], steps: tuple[int, ...]) -> float | None:
    """Order of the differences between three solutions, which no error of mesh or reference disturbs.

    Args:
        found: Coarse to fine.
        steps: Their numbers, the last three of one ratio.

    Returns:
        log(|f₁ − f₂| / |f₂ − f₃|) / log(n₃/n₂); None where they do not differ.
    """
    first, second = (float(np.linalg.norm(b - a)) for a, b in zip(found[-3:-1], found[-2:], strict=True))
    return float(np.log(first / second) / np.log(steps[-1] / steps[-2])) if first > 0.0 < second else None


def extrapolated(found: list[Array], order: int, ratio: float) -> Array:
    """What steps of no length would give, from the two finest (Richardson)."""
    return np.asarray(found[-1] + (found[-1] - found[-2]) / (ratio**order - 1.0))


def _record(case: MotionCase, run: Run, steps: int) -> MotionRecord:
    """One number of steps; what takes long is its own warm-up."""
    dt = case.t_end / steps
    try:
        first = case.solve(run.stepper, steps)
    except NotConverged as failed:
        s = failed.result.statistics
        cuts = sum(row.cuts for row in failed.result.log)
        return MotionRecord(steps, dt, np.nan, (), 1e3 * s.seconds_solve, s.newton_iterations, cuts, failed.reason)
    s = first.statistics
    quantity = np.asarray(case.read(first), dtype=float)
    return MotionRecord(
        steps=steps,
        dt=dt,
        error=case.error(quantity),
        found=tuple(quantity.tolist()),
        ms=_solve_ms(case, run, steps, first),
        iterations=s.newton_iterations,
        cuts=sum(row.cuts for row in first.log),
    )


def _solve_ms(case: MotionCase, run: Run, steps: int, first: Result) -> float:
    """Least time of the stepping alone [ms]."""
    if first.statistics.seconds_solve > LONG:
        return 1e3 * first.statistics.seconds_solve
    before = [Call(1e3 * first.statistics.seconds_solve, first.statistics)]
    return clocked(lambda: case.solve(run.stepper, steps), first, 2, before).solve_min
