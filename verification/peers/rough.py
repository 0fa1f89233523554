"""Problems of friction on which everybody is tried: P7a and P7b, a rod pushed along a rough plane, and a capstan.

In metres, kilograms, seconds and newtons; each has an answer in closed form that knows nothing of how stiff the rod is.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import radians
from typing import TYPE_CHECKING, Any

import numpy as np

from dolfinrod.scene import Contact, Coulomb, Gravity, Plane, Rod, Scene, Section, Velocity
from verification.contacts.bodies import EPS, WALL
from verification.references.capstan import euler
from verification.references.friction import Slide

if TYPE_CHECKING:
    from collections.abc import Mapping

    from dolfinrod.scene.motion import Motion
    from verification.case import Array, Vector

__all__ = ["CAPSTAN", "HALF", "MU", "ROUGH", "RoughProblem", "pushed"]

MU, G, SPEED = 0.3, 9.81, 1.0
TIMES = tuple(k / 10 for k in range(1, 11))
# A solid round rod of L = ρA = 1 that stays straight.
LENGTH, RADIUS, EA = 1.0, 0.1, 1e4
EI = 0.25 * EA * RADIUS**2
BODY: dict[str, Any] = {
    "length": LENGTH,
    "radius": RADIUS,
    "rhoA": 1.0,
    "rhoI": 0.25 * RADIUS**2,
    "EA": EA,
    "GA": EA / 2.6,
    "EI": EI,
    "GJ": EI / 1.3,
    "g": G,
}
# A limp rope, half round a drum of radius 1 and straight before and after it: so light that ρA v² does not count.
HALF, TAIL = 180.0, 0.5
TURN = radians(HALF)
ROPE: dict[str, Any] = {
    "length": TURN + 2.0 * TAIL,
    "tail": TAIL,
    "radius": 1e-2,
    "rhoA": 0.1,
    "rhoI": 1e-4,
    "EA": 1e3,
    "GA": 1e3,
    "EI": 1e-3,
    "GJ": 1e-3,
    "force": 1.0,
    "speed": 0.02,
}


@dataclass(frozen=True)
class RoughProblem:
    """What slides, and how far, or what it holds.

    Args:
        name: Of the problem.
        title: For people.
        pose: Under which adapters know it.
        answer: Way of the middle at the times [m], or holding ratio at the only one; shape (times, 3).
        scale: Of errors, as the answer.
        source: Of the answer.
        numbers: What else an adapter is told.
        times: At which the answer is read off [s].
    """

    name: str
    title: str
    pose: str
    answer: tuple[Vector, ...]
    scale: float
    source: str
    numbers: Mapping[str, Any] = field(default_factory=dict)
    times: tuple[float, ...] = TIMES

    @property
    def told(self) -> dict[str, Any]:
        """The problem in numbers, as an adapter is told it."""
        return {"name": self.name, "times": self.times, "mu": MU, **self.numbers}

    def off(self, found: Array) -> Array:
        """Errors at the times, over the scale.

        Args:
            found: What was found, shape (times, 3).
        """
        return np.linalg.norm(found - np.asarray(self.answer), axis=1) / self.scale


def slid(t: float) -> Vector:
    """Way along the rod, which stops: v t − μ g t²/2 [m]."""
    body = Slide(SPEED, MU, G)
    stops, way = body.stops
    return (SPEED * t - 0.5 * MU * G * t * t if t < stops else way, 0.0, 0.0)


def rolled(t: float) -> Vector:
    """Way across the rod, which slides until it rolls [m]."""
    body = Slide(SPEED, MU, G)
    return (0.0, SPEED * t - 0.5 * MU * G * t * t if t < body.rolls[0] else body.cylinder(t), 0.0)


TEXTBOOK = "textbook, verification/references/friction.py"
CAPSTAN = RoughProblem(
    "capstan",
    "Rope drawn over half a drum, μ = 0.3: pull over counterpull",
    "capstan",
    ((euler(MU, TURN), 0.0, 0.0),),
    euler(MU, TURN),
    "Euler 1769, e^{μθ}",
    ROPE,
    (5.0,),
)
ROUGH = (
    RoughProblem(
        "P7a",
        "Rod pushed along itself at 1 m/s on a rough plane, μ = 0.3: slides and sticks",
        "plane",
        tuple(map(slid, TIMES)),
        LENGTH,
        TEXTBOOK,
        {**BODY, "velocity": (SPEED, 0.0, 0.0)},
    ),
    RoughProblem(
        "P7b",
        "Rod pushed across itself at 1 m/s on a rough plane, μ = 0.3: slides and rolls",
        "plane",
        tuple(map(rolled, TIMES)),
        LENGTH,
        TEXTBOOK,
        {**BODY, "velocity": (0.0, SPEED, 0.0)},
    ),
    CAPSTAN,
)


def pushed(problem: RoughProblem, motion: Motion) -> Scene:
    """A rod on its plane for our models, pressed in by its weight.

    Args:
        problem: P7a or P7b.
        motion: How time is stepped.
    """
    told = problem.told
    inertia = (2.0 * told["rhoI"], told["rhoI"], told["rhoI"])
    section = Section(
        EA=told["EA"], EI=told["EI"], GJ=told["GJ"], rhoA=1.0, rhoI=inertia, radius=RADIUS, rigid={"shear"}
    )
    start = (0.0, 0.0, RADIUS - told["rhoA"] * G / EPS)
    rod = Rod.straight(LENGTH, section, start=start, direction=(1.0, 0.0, 0.0), d2=(0.0, 0.0, 1.0))
    return Scene(
        rods=[rod],
        loads=[Gravity((0.0, 0.0, -G))],
        contacts=[Contact(Plane((0.0, 0.0, 0.0), (0.0, 0.0, 1.0)), WALL, Coulomb(MU))],
        velocities=[Velocity(told["velocity"])],
        motion=motion,
    )
