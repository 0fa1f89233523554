"""Our models on rods in equilibrium, in a sweep like that of the others, in no coordinate plane."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.output import versions
from dolfinrod.result import NotConverged
from dolfinrod.scene import Planar, Spatial, Static
from verification.case import SKEW
from verification.models import Continuum, Discrete
from verification.peers.alone import cold
from verification.peers.clock import quickest
from verification.peers.contest import Attempt, Contender, Measured, Taker, contest
from verification.peers.conversation import Refused
from verification.peers.parts import parts_of
from verification.peers.rodothers import BUDGET, HOW, LADDER, QUICK_BUDGET, QUICK_REPEATS, REPEATS, SOUGHT

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from dolfinrod.scene import Scene
    from verification.models import Model
    from verification.peers.rods import RodProblem

__all__ = ["ROD_OURS", "RodOwn", "rod_ours_measured"]

# Numbers of load steps that find the equilibrium without a cut, of which the quickest counts, as for the others.
FEWEST = 2
# Of which rods whole processes are timed: they do all that rods can.
WHOLE = "sheared"


@dataclass(frozen=True)
class RodOwn:
    """One of our models with one assumption of rods.

    Args:
        taker: For the table.
        meshes: Model and number of elements, one pair a setting.
        whole: Whether a whole process is timed as well, of which nearly all is the same whatever rods cannot do.
    """

    taker: Taker
    meshes: tuple[tuple[Model, int], ...]
    whole: bool = True

    def without(self, problem: RodProblem) -> str:
        """Why it does not take a problem; "" where it does."""
        return "" if self.taker.space or problem.planar else "a model in the plane"

    def poses(self, problem: RodProblem) -> bool:
        """Whether it is asked at all."""
        return self.taker.assumes in problem.ours or self.taker.name == "discrete"

    def words(self, k: int) -> str:
        """A mesh."""
        model, n = self.meshes[k]
        return f"{n} × P{model.degree}" if model.family == "continuum" else f"{n}"


def continuum(assumes: str, kinematics: Planar | Spatial) -> RodOwn:
    """The continuum model of every degree on few elements."""
    models = {k: Continuum(k, kinematics) for k in MESHES}
    name = f"continuum, {models[2].kinematics_name}"
    space = isinstance(kinematics, Spatial)
    taker = Taker(name, True, True, HOW, "mixed elements × degree", assumes, space, exact=True)
    meshes = tuple((models[k], n) for k, numbers in MESHES.items() for n in numbers)
    return RodOwn(taker, meshes, whole=assumes == WHOLE)


MESHES = {2: (2, 4, 16), 3: (1, 2, 4, 8, 16), 4: (1, 2, 4, 6), 5: (1, 2, 3, 4)}
DISCRETE = RodOwn(
    Taker("discrete", True, True, HOW, "12 × 12 elements of the paper", "stretched"),
    tuple((Discrete(), n) for n in (4, 8, 16, 32, 64, 128)),
)
ROD_OURS = (*(continuum(a, k) for k in (Planar(), Spatial()) for a in ("sheared", "stretched", "rigid")), DISCRETE)


def rod_ours_measured(own: RodOwn, problem: RodProblem, *, quick: bool) -> Contender:
    """One of our models on one problem.

    Args:
        own: Which.
        problem: The rod.
        quick: On a third of the meshes only.

    Returns:
        Its attempts.
    """
    absent = own.without(problem)
    if absent:
        return Contender(problem.name, own.taker, (), absent)
    chosen = range(0, len(own.meshes), 3 if quick else 1)
    effort = (QUICK_REPEATS, QUICK_BUDGET) if quick else (REPEATS, BUDGET)
    settings = [(own.words(k), "") for k in chosen]
    assumes = own.taker.assumes
    found = contest(
        problem.name, own.taker, settings, lambda j: measured(problem, assumes, own.meshes[chosen[j]], effort)
    )
    contender = replace(found, attempts=tuple(map(with_steps, found.attempts)))
    best = contender.quickest()
    if best is None or best.found is None or quick or not own.whole:
        return contender
    k = chosen[contender.attempts.index(best)]
    return replace(contender, cold=cold(problem.name, ROD_OURS.index(own), k, best.found.steps or 1))


def with_steps(attempt: Attempt) -> Attempt:
    """Its load steps in words."""
    steps = None if attempt.found is None else attempt.found.steps
    return attempt if steps is None else replace(attempt, stepping=f"{steps} step" + "s" * (steps > 1))


def measured(problem: RodProblem, assumes: str, mesh: tuple[Model, int], effort: tuple[int, float]) -> Measured:
    """One mesh in the better of its fewest numbers of load steps.

    Raises:
        NotConverged: None of the numbers found the equilibrium.
    """
    model, n = mesh
    solve, first = settled(problem, assumes, model, n)
    error = away(first, problem, assumes)
    return Measured(
        error=error,
        final=error,
        solve=quickest(solve, *effort),
        setup=first.statistics.seconds_setup,
        once=first.statistics.seconds_compile,
        steps=first.statistics.load_steps,
        version=f"dolfinrod {versions()['dolfinrod']}",
        parts=parts_of(model.family, solve),
    )


def settled(problem: RodProblem, assumes: str, model: Model, n: int) -> tuple[Callable[[], Result], Result]:
    """A solve in that of its fewest numbers of load steps that takes fewest iterations, and its result.

    Raises:
        NotConverged: None of the numbers led to an equilibrium.
        Refused: None of them led to the one that is sought.
    """
    found: list[tuple[int, Result]] = []
    uncut = 0
    reason: NotConverged | Refused = Refused("another equilibrium")
    for steps in LADDER:
        try:
            result = model.solve(posed(problem, assumes, steps), n)
        except NotConverged as failed:
            reason = failed
            continue
        if away(result, problem, assumes) <= SOUGHT:
            found.append((steps, result))
            uncut += all(step.cuts == 0 for step in result.log)
        if uncut == FEWEST:
            break
    if not found:
        raise reason
    steps, result = min(found, key=lambda one: one[1].statistics.newton_iterations)
    return partial(model.solve, posed(problem, assumes, steps), n), result


def posed(problem: RodProblem, assumes: str, steps: int) -> Scene:
    """The problem in so many equal load steps, halved where one fails."""
    return replace(problem.scene(assumes), motion=Static(steps=steps))


def away(result: Result, problem: RodProblem, assumes: str) -> float:
    """Distance of the tip from where it should be, over the length."""
    tip = SKEW.back(result.tip, problem.length)
    return float(np.linalg.norm(tip - problem.tips[assumes]) / problem.length)
