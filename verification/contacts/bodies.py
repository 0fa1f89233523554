"""Stiff rods on rough walls: blocks that lie along a slope and can only slide, rollers that lie across it."""

from __future__ import annotations

from dataclasses import replace
from math import cos, sin
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import (
    Contact,
    Coulomb,
    Gravity,
    ImplicitEuler,
    Midpoint,
    Penalty,
    Planar,
    Plane,
    Rod,
    Scene,
    Section,
    Spatial,
    Velocity,
)
from verification.stepper import ContinuumStepper, DiscreteStepper, Stepper

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from dolfinrod.scene.friction import Friction
    from dolfinrod.scene.motion import Motion
    from verification.case import Array

__all__ = [
    "BLOCKS",
    "EPS",
    "MASS",
    "RADIUS",
    "ROLLERS",
    "THIN",
    "THIN_RADIUS",
    "WALL",
    "block",
    "roller",
    "spun",
    "way",
]

MASS, RADIUS = 1.0, 0.1
# A solid round body.
INERTIA = (0.5 * MASS * RADIUS**2, 0.25 * MASS * RADIUS**2, 0.25 * MASS * RADIUS**2)
STIFF = Section(EA=1e6, EI=1e2, GJ=1e2, rhoA=MASS, rhoI=INERTIA, radius=RADIUS, rigid={"shear"})
# So thin that the moment of friction about its centreline does not tilt a block that slides.
THIN_RADIUS = 1e-4
THIN = replace(STIFF, radius=THIN_RADIUS, rhoI=(0.0, 0.0, 0.0))
LENGTH = 1.0
# A weight of 10 N/m presses a body 1e-7 m into its wall; friction holds it by anchors as stiff.
EPS = 1e8
WALL = Penalty(EPS)
PLANE = Planar((0.0, 0.0, 1.0))

BLOCKS: tuple[Stepper, ...] = (
    ContinuumStepper(ImplicitEuler(), 2, 2, PLANE),
    ContinuumStepper(Midpoint(), 2, 2, PLANE),
    DiscreteStepper(4),
)
ROLLERS: tuple[Stepper, ...] = (
    ContinuumStepper(ImplicitEuler(), 2, 2, Spatial()),
    ContinuumStepper(Midpoint(), 2, 2, Spatial()),
    DiscreteStepper(4),
)


def block(
    motion: Motion, *, phi: float, friction: Friction | None, v: float = 0.0, g: float = 9.81, law: Penalty = WALL
) -> Scene:
    """A rod along a slope that falls towards +x, pressed in by its weight, with a speed v down it."""
    down, normal = np.array([cos(phi), -sin(phi), 0.0]), np.array([sin(phi), cos(phi), 0.0])
    start = (THIN_RADIUS - MASS * g * cos(phi) / law.eps_N) * normal
    rod = Rod.straight(LENGTH, THIN, start=tuple(start), direction=tuple(down), d2=tuple(normal))
    return Scene(
        rods=[rod],
        loads=[Gravity((0.0, -g, 0.0))],
        contacts=[Contact(Plane((0.0, 0.0, 0.0), tuple(normal)), law, friction)],
        velocities=[Velocity(tuple(v * down))] if v else [],
        motion=motion,
    )


def roller(motion: Motion, *, phi: float, mu: float, v: float = 0.0, g: float = 9.81) -> Scene:
    """A rod across such a slope, free to roll, with a speed v down it and no spin."""
    down, normal = np.array([cos(phi), -sin(phi), 0.0]), np.array([sin(phi), cos(phi), 0.0])
    start = (RADIUS - MASS * g * cos(phi) / EPS) * normal
    rod = Rod.straight(LENGTH, STIFF, start=tuple(start), direction=(0.0, 0.0, 1.0), d2=tuple(normal))
    return Scene(
        rods=[rod],
        loads=[Gravity((0.0, -g, 0.0))],
        contacts=[Contact(Plane((0.0, 0.0, 0.0), tuple(normal)), WALL, Coulomb(mu))],
        velocities=[Velocity(tuple(v * down))] if v else [],
        motion=motion,
    )


def way(result: Result, phi: float) -> tuple[Array, Array]:
    """Mean way and speed of the ends down a slope at the stored times [m, m/s]."""
    down, rod = np.array([cos(phi), -sin(phi), 0.0]), result.rods[0]
    start = result.scene.rods[0].centerline(np.array([0.0, result.scene.rods[0].length]))
    ends = np.asarray(rod.v)[:, [0, -1]]
    return (rod.r[:, [0, -1]] - start).mean(axis=1) @ down, ends.mean(axis=1) @ down


def spun(result: Result) -> Array:
    """Angular velocity of the middle about z, as it rolls down, at the stored times [rad/s]."""
    ω = np.asarray(result.rods[0].omega)
    return -np.asarray(ω[:, ω.shape[1] // 2, 2])
