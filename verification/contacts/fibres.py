"""The paper's fibre along a round groove and on a wall that moves: C6 and C9."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from math import cos, radians, sin
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import (
    Contact,
    Coulomb,
    Cylinder,
    Guide,
    LineForce,
    Plane,
    Rod,
    Scene,
    Section,
    WallMotion,
)
from verification.contactcase import ContactCase
from verification.contacts.bodies import BLOCKS, ROLLERS, WALL
from verification.contacts.timed import in_time
from verification.references.friction import moved_wall, swing_time
from verification.references.moving import exact

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from dolfinrod.scene import Dynamic
    from verification.case import Array

__all__ = ["CASES", "FIBRE", "LOAD", "MU", "dragged", "groove", "slip"]

# The paper's friction and fibre, under a load of 0.01 N/m (C5, C9).
MU, LOAD = 0.64, 0.01
FIBRE = Section.ramie(rigid={"shear"})
# It rests in a groove by the moment of friction, too, which would twist it: GJ as large as makes that nothing.
UNTWISTED = replace(FIBRE, GJ=1e-6)
FIBRE_LENGTH, FIBRE_RADIUS = 1e-3, 1e-5
# Stiff enough for what slides 1 µm: it yields by 3e-5 of that.
FIBRE_EPS = 2e8


def slip(result: Result) -> Array:
    """Largest way of any anchor, at the stored times."""
    rod = result.contacts[0].rods[0]
    assert rod is not None
    return np.asarray(rod.slip.max(axis=1))


def groove(motion: Dynamic, *, amplitude: float, mu: float | None, R: float = 0.5e-3) -> Scene:
    """C6: the fibre along a round groove, released at an angle from its bottom; its sections do not turn."""
    depth = LOAD * cos(amplitude) / FIBRE_EPS
    ℓ = R - FIBRE_RADIUS + depth
    rod = Rod.straight(FIBRE_LENGTH, UNTWISTED, start=(0.0, -ℓ * cos(amplitude), ℓ * sin(amplitude)))
    wall = Cylinder((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), R, side="inside")
    friction = None if mu is None else Coulomb(mu)
    untwisted = [] if mu is None else [Guide(at="start", free={"x", "y", "z", "ry", "rz"})]
    return Scene(
        rods=[rod],
        supports=untwisted,
        loads=[LineForce((0.0, -LOAD, 0.0))],
        contacts=[Contact(wall, replace(WALL, eps_N=FIBRE_EPS), friction)],
        motion=motion,
    )


def angle(result: Result) -> Array:
    """From the bottom of the groove, at the stored times."""
    middle = result.rods[0].r.mean(axis=1)
    return np.arctan2(middle[:, 2], -middle[:, 1])


def dragged(motion: Dynamic, *, v: float) -> Scene:
    """C9: the fibre at rest, pressed by q against a wall that moves along it."""
    rod = Rod.straight(FIBRE_LENGTH, FIBRE, start=(0.0, FIBRE_RADIUS - LOAD / FIBRE_EPS, 0.0))
    wall = Plane((0.0, 0.0, 0.0), (0.0, 1.0, 0.0), motion=WallMotion(velocity=(v, 0.0, 0.0)))
    law = replace(WALL, eps_N=FIBRE_EPS)
    return Scene(
        rods=[rod], loads=[LineForce((0.0, -LOAD, 0.0))], contacts=[Contact(wall, law, Coulomb(MU))], motion=motion
    )


def wall_case(v: float) -> ContactCase:
    """C9: what a moving wall gives a fibre, and what friction takes of it."""
    t, behind = moved_wall(v, MU, LOAD, FIBRE.rhoA or 0.0)
    work = (FIBRE.rhoA or 0.0) * v**2 * FIBRE_LENGTH

    def read(result: Result) -> Array:
        speed = np.asarray(result.rods[0].v)[:, :, 0].mean(axis=1)
        lag = v * result.t[-1] - (result.rods[0].r[-1, 0, 0] - result.rods[0].r[0, 0, 0])
        ledger = [float(result.energy[name][-1]) / work for name in ("wall work", "kinetic", "friction")]
        return np.array([speed[1] / v, speed[2] / v, lag / behind, *ledger])

    return ContactCase(
        name="friction-moving-wall",
        title="C9, fibre at rest on a wall that moves at 0.1716 m/s, q = 0.01 N/m, μ = 0.64",
        family="friction",
        reference=exact("v μq t/(ρA v), work ρA v² per length", "process.md 6.8", 0.5, 1.0, 1.0, 1.0, 0.5, -0.5),
        scale=1.0,
        quantity="speed at half the time and later, way lagged, work of the wall, kinetic energy, friction; relative",
        read=read,
        runs=tuple(
            in_time(
                stepper,
                partial(dragged, v=v),
                4.0 * t,
                (40, 80, 160),
                output=(0.0, 0.5 * t, 4.0 * t),
                limit=5e-2,
                quick=True,
            )
            for stepper in BLOCKS
        ),
    )


def swing_case() -> ContactCase:
    """C6: no friction."""
    a = radians(10.0)
    ℓ = 0.5e-3 - FIBRE_RADIUS + LOAD / FIBRE_EPS
    period = swing_time(a, ℓ, LOAD / (FIBRE.rhoA or 1.0))
    return ContactCase(
        name="friction-groove-swing",
        title="C6, fibre that swings by ±10° in a round groove, R = 0.5 mm, without friction",
        family="groove",
        reference=exact("T = 4 √(ρA (R − r)/q) K(sin²(a/2))", "pendulum; process.md 6.8", 0.0, -a, a),
        scale=a,
        quantity="angle after a quarter, half and full period, rad",
        read=lambda result: angle(result)[1:],
        runs=tuple(
            in_time(
                stepper,
                partial(groove, amplitude=a, mu=None),
                period,
                (80, 160, 320),
                output=(0.0, 0.25 * period, 0.5 * period, period),
                limit=limit,
                order=order,
            )
            for stepper, (limit, order) in zip(ROLLERS, ((0.2, 0.8), (1e-3, 1.8), (0.2, 0.8)), strict=True)
        ),
    )


def rest_case(degrees: float) -> ContactCase:
    """C6 with friction: rests within the friction angle, at which it was put."""
    a = radians(degrees)
    return ContactCase(
        name=f"friction-groove-rest-{degrees:g}",
        title=f"C6, fibre put into a round groove {degrees:g}° from its bottom, μ = 0.64, after 5 ms",
        family="groove",
        reference=exact("rests below atan μ = 32.62°", "process.md 6.8", a, 0.0),
        scale=a,
        quantity="angle, rad, and largest slip, m",
        read=lambda result: np.array([angle(result)[-1], slip(result)[-1]]),
        runs=tuple(
            in_time(stepper, partial(groove, amplitude=a, mu=MU), 5e-3, (50, 100), limit=1e-6)
            for stepper in (ROLLERS[0], ROLLERS[2])
        ),
    )


CASES = (wall_case(0.17157), swing_case(), rest_case(30.0))
