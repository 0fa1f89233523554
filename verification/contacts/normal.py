"""Rods that lie evenly: along a plane, between two, along the crest of a cylinder; the same on every mesh."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import (
    AugmentedLagrangian,
    Contact,
    Cylinder,
    Guide,
    LineForce,
    Penalty,
    Plane,
    Rod,
    Scene,
    Section,
    SmoothPenalty,
    WallMotion,
)
from dolfinrod.scene.normallaw import NormalLaw
from dolfinrod.scene.surfaces import Surface
from verification.contactcase import ContactCase, ContactRun
from verification.contacts.runs import DISCRETE, PLANE, SPACE, marks, on_meshes, pressed, touch
from verification.models import Continuum
from verification.references.moving import exact

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from verification.case import Array

__all__ = ["CASES"]

# process.md 6.8, C1: the paper's fibre in the zone, its law of contact, a line load that sinks it in by 0.5 µm.
FIBRE = Section(EI=2.690683e-10, GJ=2.569006e-11, radius=1e-5, rigid={"shear", "extension"})
FIBRE_RADIUS, LENGTH, LOAD = 1e-5, 0.04, 0.01
# So short that it does not roll off sideways: q/ρ < EI (1.875/L)⁴.
SHORT = 1e-3
PAPER = Penalty.paper()
UP = (0.0, 1.0, 0.0)
# Nothing but round-off: what is even is so on any mesh.
EVEN = 1e-8
# Parts of the length at which no mesh has a node by itself, so that elements differ in length.
UNEVEN = (0.0779, 0.4413, 0.7321)
GROUND = Plane((0.0, 0.0, 0.0), UP)


def lying(surface: Surface, law: NormalLaw, length: float, places: tuple[float, ...] = ()) -> Scene:
    """A fibre under a line load on a surface that it touches at y = its radius; it rises and sinks freely."""
    return Scene(
        rods=[Rod.straight(length, FIBRE, start=(0.0, FIBRE_RADIUS, 0.0))],
        supports=[Guide("start", free=("y", "rz"))],
        loads=[LineForce((0.0, -LOAD, 0.0)), *marks(tuple(length * s for s in places))],
        contacts=[Contact(surface, law)],
    )


def spread(result: Result) -> Array:
    """Least and largest gap, least and largest line load, resultant."""
    one = touch(result)
    gap, p = one.gap[-1], one.pressure[-1]
    return np.array([gap.min(), gap.max(), p.min(), p.max(), result.contacts[0].force[-1, 1]])


def everywhere(scene: Scene, odd: Scene, *, planar: bool = True) -> tuple[ContactRun, ...]:
    """Both models on a single element and on many, on even and on odd ones."""
    plane = (on_meshes(PLANE, scene, (1, 7, 20), limit=EVEN, quick=True),) if planar else ()
    return (
        *plane,
        on_meshes(Continuum(1), scene, (7,), limit=EVEN),
        on_meshes(Continuum(5), scene, (3,), limit=EVEN),
        on_meshes(SPACE, odd, (9,), limit=EVEN, words="elements of all lengths"),
        on_meshes(DISCRETE, scene, (2, 7, 80), limit=EVEN, quick=True),
        on_meshes(DISCRETE, odd, (9,), limit=EVEN, words="elements of all lengths"),
    )


def lying_case(name: str, title: str, surface: Surface, law: NormalLaw, gap: float, formula: str) -> ContactCase:
    """Gap and line load as by a closed form; they err by parts of the penetration, or of the radius where none is."""
    depth = abs(law.g_0 - gap) or FIBRE_RADIUS
    length = LENGTH if surface is GROUND else SHORT
    return ContactCase(
        name=name,
        title=title,
        family="normal",
        reference=exact(formula, "process.md 6.8, C1", gap, gap, LOAD, LOAD, LOAD * length),
        scale=(depth, depth, LOAD, LOAD, LOAD * length),
        runs=everywhere(lying(surface, law, length), lying(surface, law, length, UNEVEN), planar=surface is GROUND),
        quantity="least and largest gap, least and largest line load, resultant; m, m, N/m, N/m, N",
        read=spread,
    )


# δ = √(2 q w/ε_N) on the foot, q being less than ε_N w/2.
SMOOTH = SmoothPenalty(PAPER.eps_N, 2e-6, PAPER.g_0)
ON_FOOT = float(np.sqrt(2.0 * LOAD * SMOOTH.foot / SMOOTH.eps_N))
MULTIPLIED = AugmentedLagrangian(PAPER.eps_N, 1e-12)
CREST = Cylinder((0.0, -0.08e-3, 0.0), (1.0, 0.0, 0.0), 0.08e-3)

# Between two planes: the upper one comes down until both are pressed, by a load as well.
STIFF, SOFT = Penalty(4e5, 1e-6), Penalty(1e5, 2e-6)
APART, DOWN = 2e-6, 4e-6


def squeezed() -> Scene:
    """A fibre between a stiff plane and a softer one that moves down."""
    above = Plane((0.0, 2.0 * FIBRE_RADIUS + APART, 0.0), (0.0, -1.0, 0.0), WallMotion(displacement=(0.0, -DOWN, 0.0)))
    return Scene(
        rods=[Rod.straight(LENGTH, FIBRE, start=(0.0, FIBRE_RADIUS, 0.0))],
        supports=[Guide("start", free=("y", "rz"))],
        loads=[LineForce((0.0, -LOAD, 0.0))],
        contacts=[Contact(GROUND, STIFF), Contact(above, SOFT)],
    )


def pinched() -> tuple[float, float, float, float]:
    """Gaps and line loads below and above, p₁ = p₂ + q and g₁ + g₂ = what is left between the planes."""
    left = APART - DOWN
    matrix = np.array([[STIFF.eps_N, -SOFT.eps_N], [1.0, 1.0]])
    below, above = np.linalg.solve(matrix, [STIFF.eps_N * STIFF.g_0 - SOFT.eps_N * SOFT.g_0 - LOAD, left])
    return below, above, STIFF.eps_N * (STIFF.g_0 - below), SOFT.eps_N * (SOFT.g_0 - above)


def pinched_found(result: Result) -> Array:
    """Largest gap below and above, resultant line loads."""
    sides = [touch(result, k) for k in (0, 1)]
    return np.array([*(one.gap[-1].max() for one in sides), *(pressed(result, k) / LENGTH for k in (0, 1))])


BETWEEN = ContactCase(
    name="contact-two-planes",
    title="Fibre squeezed between a stiff plane and a softer one that comes down",
    family="normal",
    reference=exact("p₁ = p₂ + q, g₁ + g₂ = distance − 2r", "statics", *pinched()),
    scale=(DOWN, DOWN, LOAD, LOAD),
    runs=(
        on_meshes(PLANE, squeezed(), (1, 7, 20), limit=EVEN, quick=True),
        on_meshes(SPACE, squeezed(), (7,), limit=EVEN),
        on_meshes(DISCRETE, squeezed(), (2, 20), limit=EVEN, quick=True),
    ),
    quantity="gaps and line loads below and above; m, m, N/m, N/m",
    read=pinched_found,
)

CASES = (
    lying_case(
        "contact-line-load",
        "Fibre under a line load on a plane, C1",
        GROUND,
        PAPER,
        PAPER.g_0 - LOAD / PAPER.eps_N,
        "g = g_0 − q/ε_N",
    ),
    lying_case(
        "contact-line-load-smooth",
        "Fibre under a line load on a plane, the law with a round foot",
        GROUND,
        SMOOTH,
        SMOOTH.g_0 - ON_FOOT,
        "g = g_0 − √(2 q w/ε_N)",
    ),
    lying_case(
        "contact-line-load-multipliers",
        "Fibre under a line load on a plane, with multipliers",
        GROUND,
        MULTIPLIED,
        0.0,
        "g = 0",
    ),
    lying_case(
        "contact-crest",
        "Fibre under a line load along the crest of the core cylinder",
        CREST,
        PAPER,
        PAPER.g_0 - LOAD / PAPER.eps_N,
        "g = g_0 − q/ε_N",
    ),
    BETWEEN,
)
