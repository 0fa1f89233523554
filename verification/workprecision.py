"""Error against work. The only clock of the project: warm-up first, then repeats; compile time apart."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass
from statistics import median
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.result import NotConverged
from verification.case import UPRIGHT
from verification.order import Order, order

if TYPE_CHECKING:
    from collections.abc import Callable

    from dolfinrod.result import Result
    from verification.case import Case, Pose
    from verification.models import Model

__all__ = ["Record", "Study", "Timing", "clocked", "measure", "study"]

# Repeats of a measurement end after so many seconds.
BUDGET = 1.0


@dataclass(frozen=True)
class Timing:
    """Milliseconds of one solve, repeated with everything warm.

    Args:
        repeats: How many.
        solve: Median of the load stepping alone, what codes with a built model are timed by [ms].
        solve_min: Its minimum [ms].
        setup: Median of making mesh, spaces and solver [ms].
        call: Median of the whole call, scene to result [ms].
        call_min: Its minimum [ms].
        compile: Making or loading compiled forms in the first call, never part of the others [ms].
    """

    repeats: int
    solve: float
    solve_min: float
    setup: float
    call: float
    call_min: float
    compile: float


@dataclass(frozen=True)
class Record:
    """One case solved by one model on one mesh.

    Args:
        case: Its name.
        model: Its name.
        family: Of the model.
        elements: Of the rod.
        error: Of the quantity, relative; NaN where not converged.
        centreline_error: In L2, relative; None where no closed form is known.
        dofs: Unknowns.
        iterations: Newton iterations, those of failed attempts included.
        steps: Load steps accepted.
        timing: None where not timed.
        failure: Why it did not converge.
    """

    case: str
    model: str
    family: str
    elements: int
    error: float
    centreline_error: float | None
    dofs: int
    iterations: int
    steps: int
    timing: Timing | None = None
    failure: str | None = None


@dataclass(frozen=True)
class Study:
    """A case and a model on meshes from coarse to fine.

    Args:
        case: Name of the case.
        title: Its title.
        model: Name of the model.
        family: "continuum" or "discrete".
        degree: Of the elements.
        records: One a mesh.
        tip: Order of the quantity.
        centreline: Order of the centreline in L2; None where no closed form is known.
    """

    case: str
    title: str
    model: str
    family: str
    degree: int
    records: tuple[Record, ...]
    tip: Order
    centreline: Order | None


def measure(case: Case, model: Model, elements: int, *, repeats: int = 0, pose: Pose = UPRIGHT) -> Record:
    """Solve once for the numbers and to warm up, then repeatedly for the time.

    Args:
        case: What is solved.
        model: By what.
        elements: Of the rod.
        repeats: Timed calls after the first; 0: no timing.
        pose: In which the case is posed.

    Returns:
        The record; a solve that does not converge is a record too.
    """
    scene = case.scene(pose)
    try:
        first = model.solve(scene, elements)
    except NotConverged as failed:
        return _record(case, model, elements, failed.result, error=np.nan, failure=failed.reason)
    timing = clocked(lambda: model.solve(scene, elements), first, repeats) if repeats else None
    return _record(
        case,
        model,
        elements,
        first,
        error=case.error(first, pose),
        centreline_error=case.centreline_error(first, model.degree, pose),
        timing=timing,
    )


def clocked(solve: Callable[[], Result], first: Result, repeats: int) -> Timing:
    """Time calls after a first one; their number ends with `repeats` or the budget."""
    calls: list[float] = []
    statistics = []
    until = time.perf_counter() + BUDGET
    while len(calls) < repeats and (len(calls) < 2 or time.perf_counter() < until):
        started = time.perf_counter()
        result = solve()
        calls.append(1e3 * (time.perf_counter() - started))
        statistics.append(result.statistics)
    solves = [1e3 * s.seconds_solve for s in statistics]
    return Timing(
        repeats=len(calls),
        solve=median(solves),
        solve_min=min(solves),
        setup=1e3 * median(s.seconds_setup for s in statistics),
        call=median(calls),
        call_min=min(calls),
        compile=1e3 * first.statistics.seconds_compile,
    )


def study(
    case: Case, model: Model, meshes: Sequence[int], *, repeats: int = 0, timed: Sequence[int] | None = None
) -> Study:
    """The same on one mesh after the other, and the orders that shows.

    Args:
        case: What is solved.
        model: By what.
        meshes: Elements of the rod, coarse to fine.
        repeats: Timed calls a mesh.
        timed: Meshes that are timed; None: all.

    Returns:
        Records and orders.
    """
    clocked_on = meshes if timed is None else timed
    records = tuple(measure(case, model, n, repeats=repeats * (n in clocked_on)) for n in meshes)
    tips = [r.error for r in records]
    lines = [np.nan if r.centreline_error is None else r.centreline_error for r in records]
    return Study(
        case=case.name,
        title=case.title,
        model=model.name,
        family=model.family,
        degree=model.degree,
        records=records,
        tip=order(tips, meshes, model.tip_order),
        centreline=None if case.centreline is None else order(lines, meshes, model.centreline_order),
    )


def _record(
    case: Case,
    model: Model,
    elements: int,
    result: Result,
    *,
    error: float,
    centreline_error: float | None = None,
    timing: Timing | None = None,
    failure: str | None = None,
) -> Record:
    s = result.statistics
    return Record(
        case=case.name,
        model=model.name,
        family=model.family,
        elements=elements,
        error=error,
        centreline_error=centreline_error,
        dofs=s.dofs,
        iterations=s.newton_iterations,
        steps=s.load_steps,
        timing=timing,
        failure=failure,
    )
