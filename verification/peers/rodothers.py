"""Other people's solvers on rods in equilibrium: which elements each has, and the meshes it is tried on."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import groupby
from typing import TYPE_CHECKING, Any

import numpy as np

from verification.peers.contest import Attempt, Contender, Measured, Taker
from verification.peers.conversation import Answer, Refused, ask_all, ask_cold
from verification.peers.environment import ABSENT, Environment
from verification.peers.rods import RODS

if TYPE_CHECKING:
    from verification.peers.rods import RodProblem

__all__ = ["LADDER", "ROD_OTHERS", "RodOther", "rod_others_measured", "together"]

# Equal load steps, of which the fewest that find the equilibrium count; another one is this far off, over the length.
LADDER, SOUGHT = (1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 64, 128), 0.1
REPEATS, BUDGET = 10, 0.25
# For all meshes of a solver; more than ten times what the slowest takes on an idle machine [s].
PATIENCE = 600.0
HOW, RELAXED = "load steps, Newton", "damped motion until it rests"
QUICK_REPEATS, QUICK_BUDGET = 3, 0.1


@dataclass(frozen=True)
class RodOther:
    """Somebody else's element for rods.

    Args:
        taker: For the table.
        module: Adapter in this package.
        package: As it is installed.
        meshes: Numbers of elements.
        options: What else the adapter is told.
        arcs: Whether it poses curved rods.
        needs: What it asks for where it is not installed.
        relaxes: Whether it has no statics, so that the rod comes to rest under damping; solved once, seconds long.
    """

    taker: Taker
    module: str
    package: str
    meshes: tuple[int, ...]
    options: Mapping[str, Any] = field(default_factory=dict)
    arcs: bool = True
    needs: str = ""
    relaxes: bool = False

    def without(self, problem: RodProblem) -> str:
        """Why it does not take a problem; "" where it does."""
        if self.relaxes and problem is not RODS[0]:
            return f"no statics: comes to rest under damping, tried on {RODS[0].name} only"
        if problem.angle != 0.0 and not self.arcs:
            return "an element for straight rods" if self.taker.space else "an element in the plane"
        return ""


def exudyn(element: str, words: str, assumes: str, meshes: tuple[int, ...], *, space: bool, arcs: bool) -> RodOther:
    """One of EXUDYN's."""
    exact = element.startswith("GE")
    taker = Taker(f"EXUDYN {element}", False, True, HOW, words, assumes, space, exact)
    return RodOther(taker, "exudynrods", "exudyn", meshes, {"element": element}, arcs)


def opensees(dimensions: int, meshes: tuple[int, ...]) -> RodOther:
    """OpenSees in two or three dimensions."""
    words = f"{dimensions}-D corotational beam column, 2 nodes"
    space = dimensions == 3
    taker = Taker(f"OpenSees corot {dimensions}D", False, True, HOW, words, "stretched", space)
    return RodOther(taker, "opensees", "openseespy", meshes, {"dimensions": dimensions}, space)


def xara(nodes: int, meshes: tuple[int, ...]) -> RodOther:
    """xara's exact element of so many nodes."""
    words = f"3-D geometrically exact, {nodes} nodes"
    taker = Taker(f"xara ExactFrame {nodes}", False, True, HOW, words, "sheared", exact=True)
    return RodOther(taker, "xara", "xara", meshes, {"nodes": nodes}, needs="needs Python 3.12 or later")


PYELASTICA = RodOther(
    Taker("PyElastica", False, False, RELAXED, "staggered Cosserat rod", "sheared", exact=True),
    "elasticarods",
    "pyelastica",
    (8, 16, 32),
    relaxes=True,
)
MUJOCO = RodOther(
    Taker("MuJoCo", False, False, RELAXED, "cable: chain of rigid bodies, elasticity plugin", "rigid"),
    "mujocorods",
    "mujoco",
    (8, 16),
    relaxes=True,
)
ROD_OTHERS = (
    exudyn("ANCF2D", "2-D cable, 2 nodes", "stretched", (4, 8, 16, 32, 64, 128), space=False, arcs=False),
    exudyn("ANCF3D", "3-D cable, no twist, 2 nodes", "stretched", (4, 8, 16, 32, 64), space=True, arcs=False),
    exudyn("GE2D", "2-D geometrically exact, 2 nodes", "sheared", (4, 8, 16, 32, 64, 128), space=False, arcs=False),
    exudyn("GE2D3", "2-D geometrically exact, 3 nodes", "sheared", (4, 8, 16, 32, 64), space=False, arcs=False),
    exudyn("GE3D", "3-D geometrically exact, 2 nodes", "sheared", (8, 16, 32), space=True, arcs=True),
    opensees(2, (4, 8, 16, 32, 64, 128)),
    opensees(3, (4, 8, 16, 32, 64, 128)),
    xara(2, (4, 8, 16, 32, 64, 128, 256)),
    xara(3, (4, 8, 16, 32, 64, 128)),
    xara(4, (2, 4, 8, 16, 32)),
    xara(5, (2, 4, 8, 16, 32)),
    PYELASTICA,
    MUJOCO,
)


def together() -> tuple[tuple[RodOther, ...], ...]:
    """Elements of each solver: one process tries them all, as some take seconds to import."""
    return tuple(tuple(own) for _, own in groupby(ROD_OTHERS, key=lambda other: other.module))


def rod_others_measured(
    others: Sequence[RodOther], problem: RodProblem, environment: Environment | None, *, quick: bool
) -> tuple[Contender, ...]:
    """The elements of one solver on one problem.

    Args:
        others: As `together` has them.
        problem: The rod.
        environment: Where it lives; None: nowhere.
        quick: On two meshes only.

    Returns:
        Attempts of each, and of the quickest the time of a whole process.
    """
    why = [ABSENT if environment is None else other.without(problem) for other in others]
    able = [other for other, reason in zip(others, why, strict=True) if not reason]
    found = iter(measured(able, problem, environment, quick=quick) if environment is not None and able else ())
    return tuple(
        Contender(problem.name, other.taker, (), reason) if reason else next(found)
        for other, reason in zip(others, why, strict=True)
    )


def measured(
    others: Sequence[RodOther], problem: RodProblem, environment: Environment, *, quick: bool
) -> list[Contender]:
    """Those that take it."""
    meshes = [other.meshes[1:3] if quick else other.meshes for other in others]
    question = asked(others, meshes, problem, quick=quick)
    answers = iter(ask_all(environment.python, question, patience=PATIENCE))
    found = [
        Contender(problem.name, other.taker, tuple(attempt(other, problem, n, next(answers)) for n in numbers))
        for other, numbers in zip(others, meshes, strict=True)
    ]
    quickest = [(best.found.solve, k) for k, c in enumerate(found) if (best := c.quickest()) and best.found]
    if quick or others[0].relaxes or not quickest:
        return found
    _, k = min(quickest)
    found[k] = replace(found[k], cold=cold(environment, question, found, found[k].quickest()))
    return found


def cold(
    environment: Environment, question: dict[str, Any], found: Sequence[Contender], best: Attempt | None
) -> float | None:
    """Seconds of a process that takes one of its attempts and does nothing else [s]."""
    attempts = [one for c in found for one in c.attempts]
    k = next(k for k, one in enumerate(attempts) if one is best)
    steps = best.found.steps if best is not None and best.found is not None else None
    settled = question["settings"][k] | {"ladder": (steps or 1,)}
    try:
        return ask_cold(environment.python, question | {"settings": [settled]})
    except Refused:
        return None


def asked(
    others: Sequence[RodOther], meshes: Sequence[Sequence[int]], problem: RodProblem, *, quick: bool
) -> dict[str, Any]:
    """The question, all meshes in one."""
    repeats, budget = (QUICK_REPEATS, QUICK_BUDGET) if quick else (REPEATS, BUDGET)
    return {
        "module": f"verification.peers.{others[0].module}",
        "package": others[0].package,
        "pose": "rod",
        "problem": problem.told,
        "settings": [
            {"elements": n, **other.options, **sought(other, problem)}
            for other, numbers in zip(others, meshes, strict=True)
            for n in numbers
        ],
        "repeats": 1 if others[0].relaxes else repeats,
        "budget": budget,
    }


def sought(other: RodOther, problem: RodProblem) -> dict[str, Any]:
    """The equilibrium that counts, and in which numbers of load steps it is looked for."""
    where: dict[str, Any] = {"near": problem.tips[other.taker.assumes], "within": SOUGHT * problem.length}
    return where if other.relaxes else where | {"ladder": LADDER}


def attempt(other: RodOther, problem: RodProblem, elements: int, answer: Answer | Refused) -> Attempt:
    """What became of one mesh."""
    if isinstance(answer, Refused):
        missing = other.needs and str(answer).startswith("ModuleNotFoundError")
        return Attempt(f"{elements}", "", refused=f"{answer}; {other.needs}" if missing else str(answer))
    error = float(np.linalg.norm(answer.tip[-1] - problem.tips[other.taker.assumes]) / problem.length)
    measured = Measured(
        error=error,
        final=error,
        solve=answer.solve,
        setup=answer.setup,
        once=answer.loading,
        steps=answer.steps,
        version=f"{other.package} {answer.version}",
    )
    steps = "" if answer.steps is None else "1 step" if answer.steps == 1 else f"{answer.steps} steps"
    return Attempt(f"{elements}", steps, measured)
