"""Rods in grooves: on two flanks at once, at the bottom of a round one, and pushed up its side."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import AugmentedLagrangian, Contact, Cylinder, Groove, Guide, LineForce, Penalty, Plane, Rod, Scene
from dolfinrod.scene.normallaw import NormalLaw
from dolfinrod.scene.surfaces import Surface
from verification.contactcase import ContactCase, ContactRun
from verification.contacts.runs import DISCRETE, RADIUS, SPACE, THIN, on_meshes, pressed, rod, touch
from verification.references.contact import touching
from verification.references.moving import Moving, exact

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from verification.case import Array

__all__ = ["CASES"]

LAW = Penalty(1e4, 1e-3)
MULTIPLIED = AugmentedLagrangian(1e4, 1e-10)
LENGTH, WIDE = 1.0, 0.1
# Nothing but round-off: what is even is so on any mesh.
EVEN = 1e-8


def resting(weight: float, push: float, height: float, walls: tuple[Surface, ...], law: NormalLaw) -> Scene:
    """A rod along x that rises, sinks and moves aside freely, its weight along −y and a push along z."""
    return Scene(
        rods=[Rod.straight(LENGTH, THIN, start=(0.0, height, 0.0))],
        supports=[Guide("start", free=("y", "z", "ry", "rz"))],
        loads=[LineForce((0.0, -weight, push))],
        contacts=[Contact(wall, law) for wall in walls],
    )


def flanks(slope: float) -> tuple[Plane, Plane]:
    """Two planes that meet along x, each so much off the horizontal."""
    c, s = float(np.cos(slope)), float(np.sin(slope))
    return Plane((0.0, 0.0, 0.0), (0.0, c, s)), Plane((0.0, 0.0, 0.0), (0.0, c, -s))


def everywhere(scene: Scene, *, quick: bool = False) -> tuple[ContactRun, ...]:
    """Both models on few and on many elements."""
    return (
        on_meshes(SPACE, scene, (1, 6), limit=EVEN, quick=quick),
        on_meshes(DISCRETE, scene, (2, 20), limit=EVEN, quick=quick),
    )


def sides_found(result: Result) -> Array:
    """Line load of each flank, and the lowest and the highest point of the axis over where g = g_0."""
    return np.array([*(pressed(result, k) / LENGTH for k in (0, 1)), *(touch(result, k).gap[-1].max() for k in (0, 1))])


def v_case(name: str, weight: float, slope: float, law: NormalLaw, reference: Moving) -> ContactCase:
    """A rod on both flanks of a V."""
    N, gap = reference.value[0], reference.value[2]
    scene = resting(weight, 0.0, RADIUS / float(np.cos(slope)), flanks(slope), law)
    depth = abs(law.g_0 - gap) or RADIUS
    return ContactCase(
        name=name,
        title=f"Heavy rod in a V of flanks {np.degrees(slope):.0f}° off the horizontal",
        family="normal",
        reference=reference,
        scale=(N, N, depth, depth),
        runs=everywhere(scene, quick=True),
        quantity="line load of each flank, gap to each; N/m, N/m, m, m",
        read=sides_found,
    )


def yielding(slope: float, weight: float, known: Moving | None = None) -> Moving:
    """N = W/(2 cos β) and g = g_0 − N/ε_N; N from the references where they hold it."""
    N = weight / (2.0 * float(np.cos(slope))) if known is None else known.value[0]
    gap = LAW.g_0 - N / LAW.eps_N
    source = "process.md 6.8, C4" if known is None else known.source
    words = "N = W/(2 cos β)" if known is None else known.id
    return exact(words, source, N, N, gap, gap)


def round_found(result: Result) -> Array:
    """Where the axis lies, at both ends, and the line load."""
    r = rod(result).r[-1]
    return np.array([*r[0, 1:], *r[-1, 1:], pressed(result) / LENGTH])


def round_case(name: str, title: str, push: float, wall: Surface, weight: float = 2.0) -> ContactCase:
    """A rod within a round wall about the x axis; the resultant of weight and push goes through the axis."""
    N = float(np.hypot(weight, push))
    off = WIDE - RADIUS - LAW.g_0 + N / LAW.eps_N
    y, z = -off * weight / N, off * push / N
    scene = resting(weight, push, RADIUS - WIDE, (wall,), LAW)
    return ContactCase(
        name=name,
        title=title,
        family="normal",
        reference=exact("N = √(W² + H²), at atan(H/W) from the bottom", "statics", y, z, y, z, N),
        scale=(off, off, off, off, N),
        runs=everywhere(scene, quick=True),
        quantity="place of both ends, line load; m, m, m, m, N/m",
        read=round_found,
    )


TUBE = Cylinder((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), WIDE, "inside")
TROUGH = Groove.round(WIDE, point=(0.0, 0.0, 0.0))
LIV = {name: touching(name, "N") for name in ("Liv-groove-45-mu0.2", "Liv-groove-30-mu0.1")}

CASES = (
    v_case("contact-v-15", 1.0, np.pi / 12, LAW, yielding(np.pi / 12, 1.0)),
    v_case("contact-v-45", 1.0, np.pi / 4, LAW, yielding(np.pi / 4, 1.0, LIV["Liv-groove-45-mu0.2"])),
    v_case("contact-v-60", 2.5, np.pi / 3, LAW, yielding(np.pi / 3, 2.5, LIV["Liv-groove-30-mu0.1"])),
    v_case(
        "contact-v-45-multipliers",
        1.0,
        np.pi / 4,
        MULTIPLIED,
        exact("N = W/(2 cos β), g = 0", "process.md 6.8, C4", np.sqrt(0.5), np.sqrt(0.5), 0.0, 0.0),
    ),
    round_case("contact-tube-bottom", "Heavy rod at the bottom of a tube", 0.0, TUBE),
    round_case("contact-tube-side", "Heavy rod pushed up the side of a tube, by 45°", 2.0, TUBE),
    round_case("contact-round-bottom", "Heavy rod at the bottom of a round groove", 0.0, TROUGH),
    round_case("contact-round-side", "Heavy rod pushed up the side of a round groove, by 27°", 1.0, TROUGH),
)
