"""Planar rods in large motion under a smooth pulse (K10): one clamped, one flying."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import Clamp, Planar, PointForce, PointMoment, Rod, Scene, Section
from verification.motioncase import MotionCase, Run
from verification.references.moving import moving
from verification.stepper import both_schemes

if TYPE_CHECKING:
    from collections.abc import Callable

    from dolfinrod.result import Result
    from dolfinrod.scene import Dynamic
    from verification.case import Array

__all__ = ["CASES"]

# Of a square, L/h = 10.
SECTION = Section(EA=1200.0, GA=400.0, GJ=0.8, EI=1.0, rhoA=1.0, rhoI=(2 / 1200, 1 / 1200, 1 / 1200))
MIDPOINT, EULER = both_schemes(6, 4, Planar((0.0, 0.0, 1.0)))
DIGITS = 1e-6


def pulse(duration: float) -> Callable[[float], float]:
    """sin⁴ for so long [s]."""
    return lambda t: float(np.sin(np.pi * t / duration) ** 4) if t < duration else 0.0


def pushed(motion: Dynamic) -> Scene:
    """A cantilever whose end is pushed across."""
    push = PointForce((0.0, 6.0, 0.0), at="end", history=pulse(0.8))
    return Scene(rods=[Rod.straight(1.0, SECTION)], supports=[Clamp(at="start")], loads=[push], motion=motion)


def thrown(motion: Dynamic) -> Scene:
    """A free rod, 3-4-5 inclined, whose start is pushed and turned."""
    rod = Rod.straight(1.0, SECTION, direction=(0.6, 0.8, 0.0), d2=(-0.8, 0.6, 0.0))
    loads = (
        PointForce((8.0, 0.0, 0.0), at="start", history=pulse(1.0)),
        PointMoment((0.0, 0.0, 3.0), at="start", history=pulse(1.0)),
    )
    return Scene(rods=[rod], loads=loads, motion=motion)


def end(result: Result) -> Array:
    """Tip in the plane."""
    return result.tip[:2]


def ends(result: Result) -> Array:
    """Both ends in the plane."""
    return result.rods[0].r[-1][[0, -1], :2].ravel()


CASES = (
    MotionCase(
        name="motion-pulse-cantilever",
        title="K10, cantilever under a pulse, at 0.4 s",
        scene=pushed,
        t_end=0.4,
        reference=moving("K10-cantilever", "x1@0.4", "y1@0.4"),
        scale=1.0,
        read=end,
        runs=(
            Run(MIDPOINT, (40, 80, 160), limit=DIGITS, quick=True),
            Run(EULER, (80, 160, 320)),
        ),
    ),
    MotionCase(
        name="motion-pulse-flying",
        title="K10, flying rod under a pulse, both ends at 0.5 s",
        scene=thrown,
        t_end=0.5,
        reference=moving("K10-flying", "x0@0.5", "y0@0.5", "x1@0.5", "y1@0.5"),
        scale=1.0,
        quantity="positions of both ends, m",
        read=ends,
        runs=(
            Run(MIDPOINT, (100, 200, 400), limit=DIGITS),
            Run(EULER, (100, 200, 400)),
        ),
    ),
    MotionCase(
        name="motion-pulse-cantilever-late",
        title="K10, cantilever under a pulse, at 2 s",
        scene=pushed,
        t_end=2.0,
        reference=moving("K10-cantilever", "x1@2", "y1@2"),
        scale=1.0,
        read=end,
        runs=(Run(MIDPOINT, (1000, 2000, 4000), limit=DIGITS),),
    ),
    MotionCase(
        name="motion-pulse-flying-late",
        title="K10, flying rod under a pulse, both ends at 2 s",
        scene=thrown,
        t_end=2.0,
        reference=moving("K10-flying", "x0@2", "y0@2", "x1@2", "y1@2"),
        scale=1.0,
        quantity="positions of both ends, m",
        read=ends,
        runs=(Run(MIDPOINT, (2000, 4000, 8000), limit=DIGITS),),
    ),
)
