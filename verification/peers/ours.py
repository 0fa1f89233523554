"""Our models on the swinging rod, in a sweep like that of the others; always in space."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from dolfinrod.output import versions
from dolfinrod.scene import Dynamic, ImplicitEuler, Midpoint
from verification.peers.clock import quickest
from verification.peers.contest import Contender, Measured, Taker, contest
from verification.peers.parts import parts_of
from verification.peers.swing import SWING, scene, solution, tips
from verification.stepper import ContinuumStepper, DiscreteStepper, Stepper

__all__ = ["OURS", "Own", "ours_measured"]


@dataclass(frozen=True)
class Setting:
    """A model on a mesh, and how it steps.

    Args:
        stepper: The model.
        steps: Equal steps in a second; None: error-controlled.
        tol: Of error-controlled steps; None: equal ones.
    """

    stepper: Stepper
    steps: int | None = None
    tol: float | None = None

    @property
    def words(self) -> tuple[str, str]:
        """Mesh and stepping."""
        return self.stepper.mesh.removesuffix(" spatial"), f"1/{self.steps} s" if self.steps else f"tol {self.tol:g}"

    @property
    def motion(self) -> Dynamic:
        """For the scene."""
        if self.steps is not None:
            return self.stepper.motion(SWING.times[-1], round(self.steps * SWING.times[-1]), SWING.times)
        return Dynamic(t_end=SWING.times[-1], tol=self.tol, scheme=Midpoint(), output=SWING.times)


@dataclass(frozen=True)
class Own:
    """One of our models.

    Args:
        taker: For the table.
        sweep: Settings; the quick run takes the first.
    """

    taker: Taker
    sweep: tuple[Setting, ...]


def midpoint(assumes: str, meshes: tuple[tuple[int, int, int], ...]) -> Own:
    """The continuum model in equal steps: elements, degree, steps a second."""
    method = "midpoint rule with mean strains, second order"
    taker = Taker("continuum, midpoint", True, True, method, "mixed elements × degree", assumes)
    return Own(taker, tuple(Setting(ContinuumStepper(Midpoint(), n, k), steps) for n, k, steps in meshes))


EULER = "backward Euler, first order"
OURS = (
    midpoint("sheared", ((1, 5, 200), (1, 5, 160), (2, 3, 200), (2, 4, 200), (3, 3, 200), (4, 3, 400))),
    midpoint("stretched", ((1, 5, 200), (1, 5, 160), (2, 4, 180), (2, 3, 200), (3, 3, 160), (4, 3, 400))),
    midpoint("rigid", ((1, 5, 200), (2, 4, 180), (3, 3, 200), (4, 3, 400))),
    Own(
        Taker(
            "continuum, midpoint, error-controlled",
            True,
            True,
            "midpoint rule with mean strains, steps by their error",
            "mixed elements × degree",
            "sheared",
        ),
        tuple(Setting(ContinuumStepper(Midpoint(), 2, 4), tol=tol) for tol in (1e-5, 2e-5, 5e-5)),
    ),
    Own(
        Taker("continuum, Euler", True, True, EULER, "mixed elements × degree", "sheared"),
        tuple(Setting(ContinuumStepper(ImplicitEuler(), 2, 3), steps) for steps in (200, 800)),
    ),
    Own(
        Taker("discrete", True, True, EULER, "12 × 12 elements of the paper, rigid-mass nodes", "stretched"),
        tuple(Setting(DiscreteStepper(n), steps) for n, steps in ((16, 200), (16, 800), (32, 800))),
    ),
)


def ours_measured(own: Own, *, quick: bool) -> Contender:
    """One of our models on the swinging rod.

    Args:
        own: Which.
        quick: Only the first setting.
    """
    sweep = own.sweep[:1] if quick else own.sweep
    return contest(SWING.name, own.taker, [s.words for s in sweep], lambda k: measured(own.taker.assumes, sweep[k]))


def measured(assumes: str, setting: Setting) -> Measured:
    """One setting: a solve for the numbers, and as warm-up, and one for the time.

    Args:
        assumes: What the rod cannot do.
        setting: How it is solved.

    Returns:
        Error and seconds.

    Raises:
        NotConverged: A step could not be taken.
    """
    posed = scene(assumes, setting.motion)
    first = setting.stepper.solve(posed)
    again = quickest(lambda: setting.stepper.solve(posed), 1, 0.0)
    away = np.linalg.norm(tips(first) - solution(assumes), axis=1) / SWING.length
    return Measured(
        error=float(away.max()),
        final=float(away[-1]),
        solve=min(first.statistics.seconds_solve, again) / SWING.times[-1],
        setup=first.statistics.seconds_setup,
        once=first.statistics.seconds_compile,
        steps=first.statistics.load_steps,
        version=f"dolfinrod {versions()['dolfinrod']}",
        parts=parts_of(setting.stepper.family, lambda: setting.stepper.solve(posed)),
    )
