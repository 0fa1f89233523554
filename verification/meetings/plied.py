"""Two rods twisted together: grips turn their ends about the axis until they are an even ply under tension."""

from __future__ import annotations

from functools import partial
from math import cos, pi, sin
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import Penalty, PointForce, Prescribed, Rod, RodContact, Scene, Section, Static
from verification.contactcase import ContactCase
from verification.contacts.runs import DISCRETE, SPACE, on_meshes
from verification.references.moving import Moving
from verification.references.plied import Ply

if TYPE_CHECKING:
    from collections.abc import Callable

    from dolfinrod.result import Result, RodHistory
    from verification.case import Array

__all__ = ["CASES", "even", "plied"]

# How steep the helices are stress free, which touch, and as a ply.
LOOSE, TIGHT = 0.3, 0.35
LENGTH = 20.0
STEPS = 40
# They are tightened first, and turned while they are tight.
TIGHTEN, TURN = ((0.0, 0.0), (0.1, 1.0), (1.0, 1.0)), ((0.0, 0.0), (0.1, 0.0), (1.0, 1.0))


def even(loose: float) -> Ply:
    """The ply of rods that were helices of an angle about each other, or straight beside each other, stress free."""
    natural = sin(loose) * cos(loose), sin(loose) ** 2
    return Ply(radius=0.9998, angle=TIGHT, rod=1.0, eps_N=1e3, g_0=0.0, EA=400.0, GJ=0.77, EI=1.0, natural=natural)


def plied(loose: float, length: float = LENGTH, steps: int = STEPS) -> Scene:
    """Rods around each other whose ends are turned on about the x axis, tilted as the ply is, and pulled along it."""
    ply = even(loose)
    section = Section(EA=ply.EA, EI=ply.EI, GJ=ply.GJ, radius=ply.rod, rigid={"shear"})
    curvature, wound = (ply.natural[0], 0.0, ply.natural[1]), sin(loose) * length / ply.rod
    on = ply.turn * length - wound
    rods, supports, loads = [], [], []
    for k, phase in enumerate((0.0, pi)):
        out, around, end = _radial(phase), _radial(phase + 0.5 * pi), _radial(phase + wound)
        along = np.array([cos(loose), 0.0, 0.0]) + sin(loose) * around
        rods.append(Rod.curved(length, section, curvature, tuple(ply.rod * out), tuple(along), tuple(-out)))
        inwards = tuple((ply.radius - ply.rod) * out)
        supports += [
            Prescribed("start", inwards, tuple((loose - ply.angle) * out), TURN, rod=k),
            *(Prescribed("end", shift, history=way, rod=k) for shift, way in _circled(ply, on, phase + wound)),
            Prescribed("end", rotation=tuple((loose - ply.angle) * end), history=TURN, rod=k),
            Prescribed("end", rotation=(on, 0.0, 0.0), history=TURN, rod=k),
        ]
        loads.append(PointForce((0.5 * ply.tension, 0.0, 0.0), at="end", history=TIGHTEN, rod=k))
    contacts = [RodContact(Penalty(ply.eps_N))]
    return Scene(rods=rods, supports=supports, loads=loads, contacts=contacts, motion=Static(steps=steps))


def _radial(φ: float) -> Array:
    return np.array([0.0, cos(φ), sin(φ)])


def _circled(
    ply: Ply, turn: float, phase: float
) -> tuple[tuple[tuple[float | None, ...], Callable[[float], float]], ...]:
    """Displacements across, each with its own history, that together lead an end around the axis."""

    def along(t: float, of: Callable[[float], float]) -> float:
        way = float(np.interp(t, [row[0] for row in TURN], [row[1] for row in TURN]))
        return (ply.rod + (ply.radius - ply.rod) * way) * of(phase + turn * way) - ply.rod * of(phase)

    return ((None, 1.0, None), partial(along, of=cos)), ((None, None, 1.0), partial(along, of=sin))


def twisted(result: Result, length: float) -> Array:
    """Distance of the axes half-way, length of the ply, torque there, and sum of the line load."""
    first, second = result.rods
    middle = len(first.s) // 2
    torque = sum(_torque(rod, middle) for rod in (first, second))
    apart = np.linalg.norm(first.at(0.5 * length)[-1] - second.at(0.5 * length)[-1])
    return np.array([apart, first.r[-1, -1, 0] - first.r[-1, 0, 0], torque, result.meetings[0].total(-1)])


def _torque(rod: RodHistory, k: int) -> float:
    """About the x axis of what a section hands on [N m]."""
    r, (n, m) = rod.r[-1, k], (rod.frames[-1, k] @ part[-1, k] for part in (rod.n, rod.m))
    return float(m[0] + r[1] * n[2] - r[2] * n[1])


def ply_case(name: str, title: str, loose: float) -> ContactCase:
    """By both models."""
    ply = even(loose)
    value = 2.0 * ply.radius, ply.stretch * cos(ply.angle) * LENGTH, ply.torque, ply.line_load * LENGTH
    return ContactCase(
        name=name,
        title=title,
        family="plied",
        reference=Moving(
            id="even ply",
            value=value,
            method="algebra: uniform helix, one equation for the stretch",
            source="verification/references/plied.py",
            digits_trusted=12,
        ),
        # Distances by how deep the rods press into each other.
        scale=(abs(ply.gap), *(abs(v) for v in value[1:])),
        runs=(
            on_meshes(SPACE, plied(loose), (8, 16, 32), limit=1e-2, order=2.0),
            on_meshes(DISCRETE, plied(loose), (40, 80), limit=1e-2, order=1.5),
        ),
        quantity="distance of the axes half-way (by the depth of contact), length of the ply, torque about its axis, "
        "line load added up; m, m, N m, N",
        read=lambda result: twisted(result, LENGTH),
    )


CASES = (ply_case("plied-pair", "Two helices about each other, tightened and turned on by their ends", LOOSE),)
