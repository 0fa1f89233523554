"""The paper's fibre in air: falling, and held at both ends in a wind across it."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import Air, Gravity, Pin, Planar, Rod, Scene, Section, Velocity
from verification.motioncase import MotionCase, Run
from verification.references.moving import Moving
from verification.references.wind import Fibre
from verification.stepper import DiscreteStepper, both_schemes

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from dolfinrod.scene import Dynamic
    from verification.case import Array

__all__ = ["CASES", "FIBRE", "RAMIE"]

RAMIE = Section.ramie()
LENGTH = 0.04
# The same fibre in the words of the reference, from the paper's numbers.
FIBRE = Fibre(diameter=2e-5, mass=4.83805e-7, EA=10.7627, EI=2.690683e-10, length=LENGTH)
PLANE = Planar((0.0, 0.0, 1.0))
# Speed at which a fall is begun, so that drag is a smooth function of time, and when it is looked at.
BEGUN, ONSET, LONG = 0.01, 0.01, 0.2
WIND = 1.0
AGREED = "written out anew from Marheineke & Wegener, Int. J. Multiphase Flow 37, 2011"


@cache
def solved(words: str, value: float, digits: int, method: str) -> Moving:
    """A reference of this file."""
    return Moving(words, (value,), method, f"verification/references/wind.py, drag {AGREED}", digits)


def falling(motion: Dynamic) -> Scene:
    """Level, at 1 cm/s at first."""
    return Scene(
        rods=[Rod.straight(LENGTH, RAMIE)],
        loads=[Gravity((0.0, -9.81, 0.0))],
        air=Air(),
        motion=motion,
        velocities=[Velocity(v=(0.0, -BEGUN, 0.0))],
    )


def blown(motion: Dynamic) -> Scene:
    """Pinned at both ends, at rest in a wind that is there at once."""
    fibre = Rod.straight(LENGTH, RAMIE)
    air = Air(field=(0.0, WIND, 0.0))
    return Scene(rods=[fibre], supports=[Pin(at="start"), Pin(at="end")], air=air, motion=motion)


def speed(result: Result) -> Array:
    """At which the tip falls."""
    return -np.asarray(result.rods[0].v)[-1, -1, 1:2]


def sag(result: Result) -> Array:
    """Of the middle."""
    return result.rods[0].at(0.5 * LENGTH)[-1, 1:2]


MIDPOINT, EULER = both_schemes(2, 2, PLANE)

CASES = (
    MotionCase(
        name="motion-falling-onset",
        title="Level fibre that begins to fall, 10 ms later",
        scene=falling,
        t_end=ONSET,
        reference=solved("m v′ = m g − f(v)", FIBRE.speed(ONSET, begun=BEGUN), 6, "DOP853 on the one equation"),
        scale=0.08695,
        quantity="speed, m/s",
        read=speed,
        runs=(
            Run(MIDPOINT, (10, 20, 40), limit=1e-5, quick=True),
            Run(EULER, (20, 40, 80), limit=1e-3, quick=True),
            Run(DiscreteStepper(10), (20, 40, 80), limit=1e-3, quick=True),
        ),
        note="The paper's numbers are given to six digits, and so is the reference.",
    ),
    MotionCase(
        name="motion-falling",
        title="Level fibre that falls as fast as the air lets it",
        scene=falling,
        t_end=LONG,
        reference=solved("drag = weight, 0.08695 m/s", FIBRE.terminal_speed(), 6, "root of one equation"),
        scale=0.08695,
        quantity="speed, m/s",
        read=speed,
        runs=tuple(
            Run(stepper, (50,), limit=1e-5, ordered=False, quick=True)
            for stepper in (MIDPOINT, EULER, DiscreteStepper(10))
        ),
        note="What is left after 23 relaxation times does not depend on the time step.",
    ),
    MotionCase(
        name="motion-sag",
        title="Fibre pinned at both ends in a wind across it, when it has come to rest",
        scene=blown,
        t_end=0.4,
        reference=solved("sag of a pinned fibre in a wind of 1 m/s", FIBRE.sag(WIND), 5, "collocation (solve_bvp)"),
        scale=FIBRE.sag(WIND),
        quantity="sag, m",
        read=sag,
        runs=(
            Run(both_schemes(8, 3, PLANE)[1], (20,), limit=1e-5, ordered=False, quick=True),
            *(
                Run(DiscreteStepper(n), (20,), limit=limit, ordered=False, quick=n == 20)
                for n, limit in ((20, 1.2e-3), (40, 3e-4), (80, 7.5e-5))
            ),
        ),
        note="The static limit of a motion, to which backward Euler goes in long steps; the midpoint rule, which "
        "damps nothing itself, is still 5e-3 off then. The "
        "limits of the discrete model fall with the square of its elements.",
    ),
)
