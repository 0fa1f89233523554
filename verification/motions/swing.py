"""Swinging rods, in no coordinate plane: released from the horizontal (P5 of the peers), and pushed aside meanwhile."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import Gravity, Pin, PointForce, Rod, Scene, Section, Spatial
from verification.case import SKEW
from verification.motioncase import MotionCase, Run
from verification.references.lines import Thick, Thin
from verification.references.moving import moving
from verification.stepper import DiscreteStepper, both_schemes

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from dolfinrod.scene import Dynamic
    from verification.case import Array

__all__ = ["CASES", "SWING", "pushed_forces", "solved_anew"]

G = 9.81
# Something must resist the spin of a thin rod about its axis; this changes the tip by less than 1e-6.
THIN = Section(EA=1e4, GJ=1.0 / 1.3, EI=1.0, rhoA=1.0, rhoI=(1e-6, 0.0, 0.0), rigid={"shear"})
SHEARABLE = Section(EA=1e4, GA=1e4, GJ=1.0 / 1.3, EI=1.0, rhoA=1.0, rhoI=(2e-4, 1e-4, 1e-4))
# No two stiffnesses or inertias alike, thick enough for the turning of its sections to count.
THICK = Section(EA=1200.0, GA=(400.0, 300.0), GJ=0.8, EI=(1.0, 2.0), rhoA=1.0, rhoI=(3e-2, 1e-2, 2e-2))
RISE, PUSH = 0.5, 4.0


def risen(t: float) -> float:
    """From 0 to 1 as smoothly as sin⁴."""
    return float(np.sin(0.5 * np.pi * t / RISE) ** 4) if t < RISE else 1.0


def pulse(t: float) -> float:
    """sin⁴, gone when the weight has risen."""
    return float(np.sin(np.pi * t / RISE) ** 4) if t < RISE else 0.0


def pushed_forces(t: float) -> tuple[Array, Array]:
    """Weight per length and push at the end of the rods pushed aside, in their own axes."""
    return np.array([0.0, -G * risen(t), 0.0]), np.array([0.0, 0.0, PUSH * pulse(t)])


def rod(section: Section) -> Rod:
    """Along x, d2 along y, in the skew pose."""
    return Rod.straight(1.0, section, start=SKEW.start(1.0), direction=SKEW.vector(1, 0, 0), d2=SKEW.vector(0, 1, 0))


def released(section: Section, motion: Dynamic) -> Scene:
    """Pinned, its weight suddenly there."""
    weight = Gravity(SKEW.vector(0.0, -G, 0.0))
    return Scene(rods=[rod(section)], supports=[Pin(at="start")], loads=[weight], motion=motion)


def pushed(section: Section, motion: Dynamic) -> Scene:
    """Pinned, its weight growing, its end pushed across the plane of the fall meanwhile."""
    weight = Gravity(SKEW.vector(0.0, -G, 0.0), history=risen)
    push = PointForce(SKEW.vector(0.0, 0.0, PUSH), at="end", history=pulse)
    return Scene(rods=[rod(section)], supports=[Pin(at="start")], loads=[weight, push], motion=motion)


def end(result: Result) -> Array:
    """Tip in the axes of the problem."""
    return SKEW.back(result.tip, 1.0)


def solved_anew() -> dict[str, tuple[Array, Array]]:
    """References by their ids: tips on a finer and on a coarser polynomial."""
    thin = Thin(1e4)
    thick = Thick((1200.0, 400.0, 300.0), (0.8, 1.0, 2.0), (3e-2, 1e-2, 2e-2))
    return {
        "aside-thin": (thin.tip(pushed_forces, 1.0, degree=16), thin.tip(pushed_forces, 1.0, degree=14)),
        "aside-thick": (thick.tip(pushed_forces, 1.0, degree=16), thick.tip(pushed_forces, 1.0, degree=14)),
    }


MIDPOINT, EULER = both_schemes(4, 3, Spatial())

SWING = MotionCase(
    name="motion-swing",
    title="Swinging rod P5, thin, in a skew plane in space, at 1 s",
    scene=lambda motion: released(THIN, motion),
    t_end=1.0,
    reference=moving("P5-eb", "x", "y", "z"),
    scale=1.0,
    read=end,
    runs=(
        Run(MIDPOINT, (50, 100, 200, 400), limit=1e-3, ordered=False, quick=True),
        Run(EULER, (200, 400, 800), ordered=False),
        Run(DiscreteStepper(20), (200, 400, 800), ordered=False),
    ),
    note="The weight is there at once, so that waves run up and down the rod which no step resolves: the error falls, "
    "but with no order to be read off; rods pushed aside show it under smooth loads.",
)

CASES = (
    SWING,
    MotionCase(
        name="motion-swing-shearable",
        title="Swinging rod P5, shearable, in a skew plane in space, at 1 s",
        scene=lambda motion: released(SHEARABLE, motion),
        t_end=1.0,
        reference=moving("P5-se", "x", "y", "z"),
        scale=1.0,
        read=end,
        runs=(Run(MIDPOINT, (100, 200, 400), limit=1e-3, ordered=False),),
        note=SWING.note,
    ),
    MotionCase(
        name="motion-aside-thin",
        title="Rod pushed aside as it falls, thin, at 1 s",
        scene=lambda motion: pushed(THIN, motion),
        t_end=1.0,
        reference=moving("aside-thin"),
        scale=1.0,
        read=end,
        runs=(
            Run(MIDPOINT, (400, 800, 1600), limit=1e-4),
            Run(EULER, (200, 400, 800), ordered=False),
            Run(DiscreteStepper(20), (200, 400, 800), ordered=False),
        ),
        note="Backward Euler is still off by several per cent, its order on the way to one; both models are so alike.",
    ),
    MotionCase(
        name="motion-aside-thick",
        title="Rod pushed aside as it falls, thick, at 1 s",
        scene=lambda motion: pushed(THICK, motion),
        t_end=1.0,
        reference=moving("aside-thick"),
        scale=1.0,
        read=end,
        runs=(
            Run(MIDPOINT, (100, 200, 400), limit=1e-4),
            Run(EULER, (200, 400, 800)),
        ),
    ),
)
