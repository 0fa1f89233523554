"""A core that rolls: under a plank, driven by the rod beside it, and never winding more than its way allows."""

from __future__ import annotations

from dataclasses import replace
from math import pi
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import Contact, Coulomb, Guide, Penalty, Plane, Prescribed, Rod, RodContact, Scene, Section, Static
from verification.contactcase import ContactCase
from verification.contacts.runs import DISCRETE, SPACE, on_meshes
from verification.references.moving import exact
from verification.references.rolling import Plank, driven, most_turns

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from verification.case import Array

__all__ = ["CASES", "beside", "planked"]

# So stiff that nothing bends or twists: what turns and moves does so as a whole.
STIFF = Section(EA=1e9, EI=1e5, GJ=1e5, radius=0.1, rigid={"shear"})
THIN = replace(STIFF, radius=0.02)
LENGTH, STEPS = 1.0, 20
LAW, ROUGH = Penalty(1e6), Coulomb(0.5)
# Depth by which they are pressed together [m].
PRESSED = 1e-5
PLANK = Plank(STIFF.radius or 0.0, 0.2, -PRESSED)
DRIVEN = 1.0


def planked() -> Scene:
    """A core along x, pressed into a floor by a little; a thinner rod across its top is drawn along z."""
    R, r = STIFF.radius or 0.0, THIN.radius or 0.0
    rods = [
        Rod.straight(LENGTH, STIFF, start=(-0.5 * LENGTH, R - 0.1 * PRESSED, 0.0)),
        Rod.straight(LENGTH, THIN, start=(0.0, 2.0 * R + r - PRESSED, -0.5 * LENGTH), direction=(0.0, 0.0, 1.0)),
    ]
    supports: list[Guide | Prescribed] = [
        Guide("start", free=("y", "z", "rx"), rod=0),
        Prescribed("start", displacement=(0.0, 0.0, PLANK.way), rod=1),
        Prescribed("start", rotation=(0.0, 0.0, 0.0), rod=1),
        Prescribed("end", displacement=(0.0, 0.0, None), rod=1),
    ]
    floor = Contact(Plane((0.0, 0.0, 0.0), (0.0, 1.0, 0.0)), LAW, ROUGH, rod=0)
    return Scene(rods=rods, supports=supports, contacts=[floor, RodContact(LAW, ROUGH)], motion=Static(steps=STEPS))


def rolled(result: Result) -> Array:
    """Angle of the core, way of its axis, and turns over the most that its way allows."""
    core = result.rods[0]
    at = len(core.s) // 2
    angle, way = turned(result, 0), float(core.r[-1, at, 2])
    return np.array([angle, way, angle / (2.0 * pi) / most_turns(way, STIFF.radius or 0.0)])


def turned(result: Result, rod: int) -> float:
    """Angle of the middle section about x, followed over all stored times [rad]."""
    frames = result.rods[rod].frames
    at = frames.shape[1] // 2
    angles = np.arctan2(frames[:, at, 2, 1], frames[:, at, 1, 1])
    return float(np.unwrap(angles)[-1] - angles[0])


def beside() -> Scene:
    """Two rods side by side, both held; one is turned, the other one is free to."""
    R, r = STIFF.radius or 0.0, THIN.radius or 0.0
    rods = [
        Rod.straight(LENGTH, STIFF),
        Rod.straight(LENGTH, THIN, start=(0.0, R + r - PRESSED, 0.0)),
    ]
    supports: list[Guide | Prescribed] = [
        Prescribed("start", displacement=(0.0, 0.0, 0.0), rotation=(DRIVEN, 0.0, 0.0), rod=0),
        Prescribed("end", displacement=(None, 0.0, 0.0), rod=0),
        Guide("start", free=("rx",), rod=1),
        Guide("end", free=("x", "rx", "ry", "rz"), rod=1),
    ]
    return Scene(rods=rods, supports=supports, contacts=[RodContact(LAW, ROUGH)], motion=Static(steps=STEPS))


def core_case(
    name: str, title: str, scene: Scene, value: tuple[float, ...], formula: str, quantity: str
) -> ContactCase:
    """By both models."""
    read = rolled if name == "core-plank" else _both
    return ContactCase(
        name=name,
        title=title,
        family="core",
        reference=exact(formula, "verification/references/rolling.py", *value),
        scale=value,
        quantity=quantity,
        read=read,
        runs=(
            on_meshes(SPACE, scene, (4, 8), limit=1e-4, quick=True),
            on_meshes(DISCRETE, scene, (4, 8), limit=1e-4, quick=True),
        ),
    )


def _both(result: Result) -> Array:
    """Angles of both rods."""
    return np.array([turned(result, 0), turned(result, 1)])


CASES = (
    core_case(
        "core-plank",
        "Core on a rough floor that a rod drawn across its top rolls along",
        planked(),
        (PLANK.angle, PLANK.axis, 1.0),
        "φ = v/(2R + g/2), way R φ, turns s/2πR",
        "angle, way of the axis, turns over the most its way allows; rad, m, 1",
    ),
    core_case(
        "core-driven",
        "Rod turned by the rough one beside it",
        beside(),
        (DRIVEN, driven(DRIVEN, STIFF.radius or 0.0, THIN.radius or 0.0, -PRESSED)),
        "−(r_A + g/2)/(r_B + g/2)",
        "angles of both, rad",
    ),
)
