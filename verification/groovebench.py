"""The fibre in the groove by both models: errors against steps, elements, penalty and seconds, and what lies where.

Either model is measured against the other one, solved on a fine mesh in short steps in the same run, never against
itself; how far that reference still moves when it is halved both ways stands beside the errors.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.result import NotConverged
from dolfinrod.scene import Midpoint, Penalty, Spatial
from verification.answers import other
from verification.contacts.groove import FEED, GrooveCase, stations
from verification.motion import self_order

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.result import Result
    from dolfinrod.scene.motion import Scheme

    Array = NDArray[np.float64]

__all__ = ["LIMIT", "TIGHT", "kind", "GrooveSweep", "GroovePoint", "Setup", "reference", "solve", "sweep", "sweeps"]

TIGHT = Penalty.tight()
# Way that errors are divided by: from where the fibre starts to the middle of the groove [m].
WAY = abs(FEED)
# Error of the finest of a sweep beyond which the models do not agree.
LIMIT = 1e-2


@dataclass(frozen=True)
class Setup:
    """How a case is solved.

    Args:
        model: "continuum" (cubic elements) or "discrete".
        elements: Of the fibre.
        steps: Equal steps, of the load or in time.
        scheme: In time; None: implicit Euler.
        eps_N: Of the wall [N/m²].
    """

    model: str
    elements: int
    steps: int
    scheme: Scheme | None = None
    eps_N: float = TIGHT.eps_N

    def words(self, case: GrooveCase) -> str:
        """Model and scheme."""
        if case.t_end is None:
            return self.model
        return f"{self.model}, {'midpoint' if isinstance(self.scheme, Midpoint) else 'implicit Euler'}"

    @property
    def mesh(self) -> str:
        """Elements and steps."""
        kind = " × P3" if self.model == "continuum" else ""
        return f"{self.elements}{kind} elements, {self.steps} steps"


# What each sweep departs from, and the references, by model, of statics and of motions.
BASES = {
    None: (Setup("discrete", 80, 40), Setup("continuum", 20, 40)),
    "motion": (Setup("discrete", 80, 200), Setup("continuum", 20, 200), Setup("continuum", 20, 100, Midpoint())),
}
FINE = {
    ("discrete", None): Setup("discrete", 320, 80),
    ("continuum", None): Setup("continuum", 40, 80),
    ("discrete", "motion"): Setup("discrete", 160, 400),
    ("continuum", "motion"): Setup("continuum", 40, 200, Midpoint()),
}
MESHES = {"discrete": (40, 80, 160, 320), "continuum": (5, 10, 20, 40)}
STEPS = {None: (10, 20, 40, 80), "motion": (25, 50, 100, 200)}
# The stiffest is a tenth of what the references have.
STIFFNESSES = tuple(part * TIGHT.eps_N for part in (1e-3, 1e-2, 1e-1))


@dataclass(frozen=True)
class GroovePoint:
    """One solve of a sweep.

    Args:
        at: Elements, steps, or ε_N [N/m²].
        error: Largest distance of the stations from the reference over 1 mm; NaN where refused.
        force: Difference of the resultants of contact over that of the reference.
        seconds: Of the solve [s].
        steps: Accepted.
        iterations: Newton iterations, those of failed attempts included.
        cuts: Failed attempts.
        failure: Why it was refused, or nothing.
    """

    at: float
    error: float
    force: float
    seconds: float
    steps: int
    iterations: int
    cuts: int
    failure: str = ""


@dataclass(frozen=True)
class GrooveSweep:
    """A case by one model and scheme over one of its resolutions.

    Args:
        case: Its name.
        title: For people.
        solver: Model and scheme.
        over: "elements", "steps" or "penalty".
        fixed: What stays the same.
        points: Coarse to fine, soft to stiff.
        order: With which the solution settles, of the differences between the three finest; None: of the penalty, and
            of load steps.
        reference: The other model's, in words.
        settled: How far the reference moves when its elements and steps are halved, over 1 mm.
    """

    case: str
    title: str
    solver: str
    over: str
    fixed: str
    points: tuple[GroovePoint, ...]
    order: float | None
    reference: str
    settled: float

    @property
    def holds(self) -> bool:
        """Everything was solved, and on its finest the models agree."""
        return not any(p.failure for p in self.points) and self.points[-1].error <= LIMIT


def solve(case: GrooveCase, how: Setup) -> Result:
    """The case as set up.

    Raises:
        NotConverged: A step could not be taken.
    """
    scene = case.scene(Penalty(how.eps_N, TIGHT.g_0), case.motion(how.steps, how.scheme))
    if how.model == "continuum":
        from dolfinrod.continuum import solve as solve_continuum

        return solve_continuum(scene, elements=how.elements, degree=3, kinematics=Spatial())
    from discrete import solve as solve_discrete

    return solve_discrete(scene, elements=how.elements)


@cache
def reference(case: GrooveCase, model: str) -> tuple[Array, Array, float]:
    """Stations [m] and resultant of contact [N] by a model at its finest, and how far halving it moves them.

    Implicit Euler, which falls short by what half the steps change, is extrapolated to steps of no length.
    """
    how = FINE[model, kind(case)]
    fine, coarse = solve(case, how), solve(case, replace(how, steps=how.steps // 2))
    x, force = stations(fine), fine.contacts[0].force[-1]
    if kind(case) == "motion" and how.scheme is None:
        x, force = 2.0 * x - stations(coarse), 2.0 * force - coarse.contacts[0].force[-1]
    rough = solve(case, replace(how, elements=how.elements // 2, steps=how.steps // 2))
    moved = stations(coarse) - stations(rough) if how.scheme is None else stations(rough) - x
    return x, force, float(np.linalg.norm(moved, axis=1).max() / WAY)


def kind(case: GrooveCase) -> str | None:
    """Of its tables: None for statics."""
    return None if case.t_end is None else "motion"


def sweeps(case: GrooveCase) -> tuple[tuple[Setup, str], ...]:
    """Base and name of every sweep of a case."""
    return tuple((base, over) for base in BASES[kind(case)] for over in ("elements", "steps", "penalty"))


def setups(case: GrooveCase, base: Setup, over: str) -> tuple[tuple[float, Setup], ...]:
    """Places on the axis of a sweep and what is solved there."""
    if over == "elements":
        return tuple((float(n), replace(base, elements=n)) for n in MESHES[base.model])
    if over == "steps":
        return tuple((float(n), replace(base, steps=n)) for n in STEPS[kind(case)])
    return tuple((eps_N, replace(base, eps_N=eps_N)) for eps_N in STIFFNESSES)


def sweep(case: GrooveCase, base: Setup, over: str, last: int | None = None) -> GrooveSweep:
    """Solve over one resolution.

    Args:
        case: What is solved.
        base: What stays the same.
        over: What does not.
        last: How many of the coarsest are solved; None: all.

    Returns:
        The sweep, also of what was refused.
    """
    x, force, settled = reference(case, other(base.model))
    points, found = [], []
    for at, how in setups(case, base, over)[:last]:
        try:
            result = solve(case, how)
        except NotConverged as failed:
            s = failed.result.statistics
            taken = len(failed.result.log), s.newton_iterations, sum(row.cuts for row in failed.result.log)
            points.append(GroovePoint(at, np.nan, np.nan, s.seconds_solve, *taken, failed.reason))
            continue
        found.append(stations(result))
        s = result.statistics
        taken = len(result.log), s.newton_iterations, sum(row.cuts for row in result.log)
        off = float(np.linalg.norm(found[-1] - x, axis=1).max() / WAY)
        apart = float(np.linalg.norm(result.contacts[0].force[-1] - force) / np.linalg.norm(force))
        points.append(GroovePoint(at, off, apart, s.seconds_solve, *taken))
    counts = tuple(round(p.at) for p in points if not p.failure)
    # Where the way through the loads leaves next to no trace, differences between numbers of steps have no order.
    ordered = len(found) > 2 and (over == "elements" or (over == "steps" and case.t_end is not None))
    how = FINE[other(base.model), kind(case)]
    words = f"{how.words(case)}, {how.mesh}, ε_N = {how.eps_N:g} N/m²"
    fixed = base.mesh if over == "penalty" else f"{base.mesh}, ε_N = {base.eps_N:g} N/m²"
    order = self_order(found, counts) if ordered else None
    return GrooveSweep(case.name, case.title, base.words(case), over, fixed, tuple(points), order, words, settled)
