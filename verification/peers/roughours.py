"""Our models on rough surfaces: pushed along a plane in time steps, drawn over a drum in load steps."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.output import versions
from dolfinrod.scene import ImplicitEuler, Midpoint
from verification.contacts.ropes import STEPS, Wrap
from verification.contacts.runs import DISCRETE, PLANE
from verification.peers.clock import quickest
from verification.peers.contest import Contender, Measured, Taker, contest
from verification.peers.rough import CAPSTAN, HALF, MU, ROUGH, pushed
from verification.stepper import ContinuumStepper, DiscreteStepper

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from verification.case import Array
    from verification.models import Model
    from verification.peers.rough import RoughProblem
    from verification.stepper import Stepper

__all__ = ["ROUGH_OURS", "RoughOwn", "rough_ours_measured"]

ROPE = Wrap(MU, HALF)


@dataclass(frozen=True)
class Setting:
    """A solve.

    Args:
        mesh: In words.
        stepping: In words.
        solve: Does it.
        read: What was asked for, shape (times, 3).
    """

    mesh: str
    stepping: str
    solve: Callable[[], Result]
    read: Callable[[Result], Array]


@dataclass(frozen=True)
class RoughOwn:
    """One of our models on one problem.

    Args:
        problem: What.
        taker: For the table.
        sweep: Settings; the quick run takes the first.
    """

    problem: RoughProblem
    taker: Taker
    sweep: tuple[Setting, ...]


def moving(problem: RoughProblem, name: str, method: str, stepper: Stepper, steps: tuple[int, ...]) -> RoughOwn:
    """A model on the plane."""
    element = "mixed elements × degree" if stepper.family == "continuum" else "12 × 12 elements of the paper"
    taker = Taker(name, True, True, method, element, "stretched", exact=stepper.family == "continuum")
    settings = (
        Setting(
            stepper.mesh.removesuffix(" spatial"),
            f"1/{n} s",
            partial(moved, problem, stepper, n),
            partial(way, problem),
        )
        for n in steps
    )
    return RoughOwn(problem, taker, tuple(settings))


def moved(problem: RoughProblem, stepper: Stepper, steps: int) -> Result:
    """A rod on its plane in so many equal steps."""
    return stepper.solve(pushed(problem, stepper.motion(problem.times[-1], steps, problem.times)))


def way(problem: RoughProblem, result: Result) -> Array:
    """Of the middle of both ends at the times of the problem, shape (times, 3) [m]."""
    at = [int(np.argmin(np.abs(result.t - t))) for t in problem.times]
    start = result.scene.rods[0].centerline(np.array([0.0, result.scene.rods[0].length]))
    return np.asarray((result.rods[0].r[at][:, [0, -1]] - start).mean(axis=1))


def drawn(name: str, model: Model, elements: tuple[int, ...], *, space: bool) -> RoughOwn:
    """A model on the drum, drawn in load steps."""
    continuum = model.family == "continuum"
    element = "mixed elements × degree" if continuum else "12 × 12 elements of the paper"
    taker = Taker(name, True, True, "load steps, Newton", element, "stretched", space, exact=continuum)
    settings = (
        Setting(
            f"{n} × P{model.degree}" if continuum else f"{n}",
            f"{STEPS} steps",
            partial(model.solve, ROPE.scene(), n),
            held,
        )
        for n in elements
    )
    return RoughOwn(CAPSTAN, taker, tuple(settings))


def held(result: Result) -> Array:
    """Pull over counterpull at the end, shape (1, 3)."""
    return np.array([[ROPE.pulled(result)[-1], 0.0, 0.0]])


def _all() -> tuple[RoughOwn, ...]:
    """On the planes in space, on the drum in its plane; one element, because the rod stays straight."""
    owns = []
    for problem in ROUGH[:2]:
        for name, method, stepper, steps in (
            ("continuum, midpoint", "midpoint rule", ContinuumStepper(Midpoint(), 1, 2), (100, 50, 200, 400)),
            ("continuum, Euler", "backward Euler", ContinuumStepper(ImplicitEuler(), 1, 2), (100, 400)),
            ("discrete", "backward Euler", DiscreteStepper(2), (100, 400)),
        ):
            owns.append(moving(problem, name, method, stepper, steps))
    owns.append(drawn("continuum, planar", PLANE, (8, 2, 4, 16), space=False))
    owns.append(drawn("discrete", DISCRETE, (16, 8, 32, 64), space=True))
    return tuple(owns)


ROUGH_OURS = _all()


def rough_ours_measured(own: RoughOwn, *, quick: bool) -> Contender:
    """One of our models on its problem.

    Args:
        own: Which.
        quick: Only the first setting.
    """
    sweep = own.sweep[:1] if quick else own.sweep
    words = [(s.mesh, s.stepping) for s in sweep]
    return contest(own.problem.name, own.taker, words, lambda k: measured(own.problem, sweep[k]))


def measured(problem: RoughProblem, setting: Setting) -> Measured:
    """One setting: a solve for the numbers, and as warm-up, and one for the time.

    Raises:
        NotConverged: A step could not be taken.
    """
    first = setting.solve()
    off = problem.off(setting.read(first))
    return Measured(
        error=float(off.max()),
        final=float(off[-1]),
        solve=min(first.statistics.seconds_solve, quickest(setting.solve, 1, 0.0)),
        setup=first.statistics.seconds_setup,
        once=first.statistics.seconds_compile,
        steps=first.statistics.load_steps,
        version=f"dolfinrod {versions()['dolfinrod']}",
    )
