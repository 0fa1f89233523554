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
from verification.models import elongation
from verification.order import FLOOR, Order, floor_of, order

if TYPE_CHECKING:
    from collections.abc import Callable

    from dolfinrod.result import Result, Statistics
    from verification.case import Case, Pose, Vector
    from verification.models import Model

__all__ = ["Record", "Study", "Timing", "clocked", "measure", "study"]

# Repeats of a measurement end after so many seconds.
BUDGET = 1.0
# A solve of so many seconds needs no warm-up.
LONG = 0.2


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
class Call:
    """One timed call.

    Args:
        ms: From scene to result [ms].
        statistics: What the model says of it.
    """

    ms: float
    statistics: Statistics


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
        found: The quantity, in the axes of the problem; None where not converged [m].
        elongation: Of rods that should not grow longer, relative to the length of the case.
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
    found: Vector | None = None
    elongation: float = 0.0
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
        floor: Relative error below which nothing can be said.
    """

    case: str
    title: str
    model: str
    family: str
    degree: int
    records: tuple[Record, ...]
    tip: Order
    centreline: Order | None
    floor: float = FLOOR

    @property
    def smallest(self) -> float:
        """Least error on any mesh, infinite where none converged."""
        return min((r.error for r in self.records if r.failure is None), default=np.inf)


def measure(
    case: Case, model: Model, elements: int, *, repeats: int = 0, pose: Pose = UPRIGHT, warm: bool = False
) -> Record:
    """Solve once for the numbers and to warm up, then repeatedly for the time.

    Args:
        case: What is solved.
        model: By what.
        elements: Of the rod.
        repeats: Timed calls after the first; 0: no timing.
        pose: In which the case is posed.
        warm: Whether the model has just solved the case on another mesh: then the first call is timed as well.

    Returns:
        The record, also of a solve that does not converge.
    """
    scene = case.scene(pose)
    started = time.perf_counter()
    try:
        first = model.solve(scene, elements)
    except NotConverged as failed:
        return _record(case, model, elements, failed.result, error=np.nan, failure=failed.reason)
    call = Call(1e3 * (time.perf_counter() - started), first.statistics)
    # Where the solve takes long, it warms up itself.
    long = first.statistics.seconds_solve > max(LONG, 20.0 * first.statistics.seconds_compile)
    before = [call] if warm or long else []
    timing = clocked(lambda: model.solve(scene, elements), first, repeats, before) if repeats else None
    return _record(
        case,
        model,
        elements,
        first,
        error=case.error(first, pose),
        pose=pose,
        centreline_error=case.centreline_error(first, model.degree, pose),
        timing=timing,
    )


def clocked(solve: Callable[[], Result], first: Result, repeats: int, before: Sequence[Call] = ()) -> Timing:
    """Time calls until there are `repeats`, or two and the budget is spent; some may have been timed before."""
    calls = list(before)
    until = time.perf_counter() + BUDGET
    while len(calls) < repeats and (len(calls) < 2 or time.perf_counter() < until):
        started = time.perf_counter()
        result = solve()
        calls.append(Call(1e3 * (time.perf_counter() - started), result.statistics))
    solves = [1e3 * call.statistics.seconds_solve for call in calls]
    return Timing(
        repeats=len(calls),
        solve=median(solves),
        solve_min=min(solves),
        setup=1e3 * median(call.statistics.seconds_setup for call in calls),
        call=median(call.ms for call in calls),
        call_min=min(call.ms for call in calls),
        compile=1e3 * first.statistics.seconds_compile,
    )


def study(case: Case, model: Model, meshes: Sequence[int], *, repeats: int = 0) -> Study:
    """The same on one mesh after the other, and the orders that shows.

    Args:
        case: What is solved.
        model: By what.
        meshes: Elements of the rod, coarse to fine.
        repeats: Timed calls a mesh.
    """
    records = tuple(measure(case, model, n, repeats=repeats, warm=k > 0) for k, n in enumerate(meshes))
    # What the discrete model stretches does not fall with the mesh; five times that leaves an order certain to 0.3.
    floor = max(floor_of(case), 5.0 * max(r.elongation for r in records))
    tips = [r.error for r in records]
    lines = [np.nan if r.centreline_error is None else r.centreline_error for r in records]
    return Study(
        case=case.name,
        title=case.title,
        model=model.name,
        family=model.family,
        degree=model.degree,
        records=records,
        tip=order(tips, meshes, model.tip_order, floor),
        centreline=None if case.centreline is None else order(lines, meshes, model.centreline_order),
        floor=floor_of(case),
    )


def _record(
    case: Case,
    model: Model,
    elements: int,
    result: Result,
    *,
    error: float,
    pose: Pose = UPRIGHT,
    centreline_error: float | None = None,
    timing: Timing | None = None,
    failure: str | None = None,
) -> Record:
    s = result.statistics
    x, y, z = (float(v) for v in pose.back(case.quantity(result), case.length))
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
        found=(x, y, z) if failure is None else None,
        elongation=elongation(result) / case.length,
        timing=timing,
        failure=failure,
    )
