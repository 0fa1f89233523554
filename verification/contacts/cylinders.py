"""Rods pulled over a cylinder, without friction: a fibre as good as a string, and stiff rods that lift off early."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import (
    AugmentedLagrangian,
    Contact,
    Cylinder,
    Guide,
    Penalty,
    Planar,
    PointForce,
    Rod,
    Scene,
    Section,
    Static,
)
from dolfinrod.scene.normallaw import NormalLaw
from verification.contactcase import ContactCase
from verification.contacts.runs import DISCRETE, PLANE, RADIUS, SPACE, THIN, marks, on_meshes, pressed, stiffer, touch
from verification.models import Continuum
from verification.references.contact import edges, touching, value, wound_evenly
from verification.references.contactposed import WOUND, Wound
from verification.references.moving import Moving, exact

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from verification.case import Array

__all__ = ["CASES", "wound"]

# process.md 6.8, C3: the paper's fibre over a roller, EI/(T R²) = 4e-4; half of its wrap and of its length.
FIBRE = Section(EI=2.690683e-10, GJ=2.569006e-11, radius=1e-5, rigid={"shear", "extension"})
ROLLER, TENSION, WRAP = 25e-3, 1e-3, 0.25 * np.pi
TIGHT = Penalty.tight()
# In one step the rod could come out on the other side of the cylinder.
STEPS = 8
STIFFER = (1_000, 10_000, 100_000)
# Of the radius, what multipliers leave of penetration: over the square of the distance of nodes it is a curvature.
CLOSE = 1e-11
HIGH = Continuum(5, Planar())
NODE = "a node where contact ends"
TABLED = {"120": "Lib-stiffrod-F4.0-R1.0-EI1.0-120", "180": "Lib-stiffrod-F1.0-R1.0-EI1.0-180"}


def over(section: Section, radius: float, length: float, law: NormalLaw, *loads: PointForce) -> Scene:
    """Half of a rod over the crest of a cylinder whose surface its own just touches."""
    r = section.radius or 0.0
    return Scene(
        rods=[Rod.straight(length, section, start=(0.0, radius + r, 0.0))],
        supports=[Guide("start", free=("y",))],
        loads=loads,
        contacts=[Contact(Cylinder((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), radius), law)],
        motion=Static(steps=STEPS),
    )


def roller() -> Scene:
    """The fibre is taut all the way: its pull turns down at full strength."""
    along = PointForce((TENSION, 0.0, 0.0), at="end", history=lambda t: float(np.cos(WRAP * t)))
    down = PointForce((0.0, -TENSION, 0.0), at="end", history=lambda t: float(np.sin(WRAP * t)))
    return over(FIBRE, ROLLER, 1.7 * ROLLER, TIGHT, along, down)


def wound(half: Wound, law: NormalLaw, *places: float) -> Scene:
    """The problem of the references, the radius counted to the axis of the rod."""
    pull = PointForce((half.pull * np.cos(half.below), -half.pull * np.sin(half.below), 0.0), at="end")
    return over(THIN, half.radius - RADIUS, half.length, law, pull, *marks(places))


def fibre_found(result: Result) -> Array:
    """Components of the resultant, tension, line load and gap at the crest."""
    one, rod = touch(result), result.rods[0]
    return np.array([*result.contacts[0].force[-1, :2], rod.n[-1, 0, 0], one.pressure[-1, 0], one.gap[-1, 0]])


def wound_found(result: Result) -> Array:
    """Tension and moment at the crest, ∫ p ds, and where the crest is and the end."""
    rod = result.rods[0]
    return np.array([rod.n[-1, 0, 0], rod.m[-1, 0, 2], pressed(result), rod.r[-1, 0, 1], *rod.r[-1, -1, :2]])


def rigid_found(result: Result) -> Array:
    """Tension and moment at the crest, ∫ p ds."""
    return wound_found(result)[:3]


def fibre_case() -> ContactCase:
    """C3: what balance asks of the resultant, and the even part in between."""
    T, p, g = wound_evenly(TENSION, FIBRE.EI[0], TIGHT.eps_N, ROLLER + 1e-5, TIGHT.g_0)
    balance = (TENSION - TENSION * np.cos(WRAP), TENSION * np.sin(WRAP))
    scene = roller()
    # The start is held against moving along x by the other half, which pulls with the tension of the crest.
    reference = exact(
        "resultant T sin b down a half; ε_N δ ρ and T + EI/2ρ² − ε_N δ²/2 along the rod",
        "process.md 6.8, C3; verification/references/contact.py",
        T - TENSION * np.cos(WRAP),
        balance[1],
        T,
        p,
        g,
    )
    return ContactCase(
        name="contact-fibre-over-roller",
        title="Paper's fibre over a roller of 25 mm, 1 mN, half wrap 45°, C3",
        family="normal",
        reference=reference,
        scale=(TENSION, TENSION, TENSION, p, TIGHT.g_0 - g),
        runs=(
            on_meshes(PLANE, scene, (100, 200), limit=1e-6),
            on_meshes(SPACE, scene, (100,), limit=1e-5),
            on_meshes(DISCRETE, scene, (100, 200), limit=1e-4),
        ),
        quantity="resultant along and across, tension, line load and gap at the crest; N, N, N, N/m, m",
        read=fibre_found,
        note="The string's T/R is met to EI/(2 T R²) = 2e-4 only: bending takes that part of the tension. "
        "The discrete model lends the fibre EA = 1e8 EI/L², which lengthens it, and p, by 7e-5.",
    )


def wound_case(turn: str) -> ContactCase:
    """Against the boundary-value problem."""
    name, half = f"wound-{turn}", WOUND[turn]
    found = touching(name, "n_x0", "m0", "pressed", "y0", "x1", "y1")
    law = Penalty(half.eps_N)
    posed, noded = wound(half, law), wound(half, law, *edges(name))
    return ContactCase(
        name=f"contact-{name}",
        title=f"Stiff rod bent by {turn}° over a cylinder that yields",
        family="normal",
        reference=found,
        scale=(half.pull, 1.0, value(name, "pressed"), half.radius, half.length, half.length),
        runs=(
            on_meshes(PLANE, noded, (80, 160), limit=1e-6, order=4.0, words=NODE, quick=turn == "120"),
            on_meshes(PLANE, posed, (100, 200, 400), limit=1e-5),
            on_meshes(SPACE, noded, (160,), limit=1e-6, words=NODE),
            on_meshes(DISCRETE, noded, (400, 800), order=1.8, words=NODE),
        ),
        quantity="tension and moment at the crest, ∫ p ds, height of the crest, place of the end; N, N m, N, m, m, m",
        read=wound_found,
        note="Where contact ends p has a kink: without a node there errors fall with h² at best.",
    )


def wound_rigid(turn: str) -> ContactCase:
    """Against the closed form of the rigid cylinder."""
    name, half = TABLED[turn], WOUND[turn]
    found = touching(name, "T_contact", "point_force", "contact_angle")
    T, point, contact = found.value
    reference = Moving(found.id, (T, -1.0, point + 0.5 * T * contact), found.method, found.source, 14)
    law = AugmentedLagrangian(1e8, CLOSE)
    multiplied, noded = wound(half, law), wound(half, law, 0.5 * contact * half.radius)
    return ContactCase(
        name=f"contact-wound-{turn}-rigid",
        title=f"Stiff rod bent by {turn}° over a rigid cylinder",
        family="normal",
        reference=reference,
        scale=(half.pull, 1.0, reference.value[2]),
        runs=(
            stiffer(PLANE, lambda ε: wound(half, Penalty(ε)), 400, STIFFER, order=0.5, quick=turn == "120"),
            stiffer(DISCRETE, lambda ε: wound(half, Penalty(ε)), 400, STIFFER, limit=1e-2),
            on_meshes(PLANE, multiplied, (100, 200, 400), limit=1e-4, order=1.5, words="multipliers"),
            on_meshes(HIGH, noded, (25,), limit=1e-6, words=f"multipliers, {NODE}"),
            on_meshes(DISCRETE, multiplied, (100, 200), limit=1e-3, words="multipliers"),
        ),
        quantity="tension and moment at the crest, ∫ p ds: two point forces and T/R between; N, N m, N",
        read=rigid_found,
        note="Two point forces where the rod lifts off are spread over a length (EI/ε_N)^¼ where the wall yields. "
        "With multipliers, moments are as right as the penetration allowed over the square of the distance of nodes: "
        "1e-11 of the radius leaves 4e-6 of them on 50 elements of degree 5 that are right to 1e-6 on 25.",
    )


CASES = (fibre_case(), *(wound_case(turn) for turn in WOUND), *(wound_rigid(turn) for turn in WOUND))
