"""Rods on a flat wall: an elastica that its thrust presses against it, and a heavy rod lifted off the ground."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import (
    AugmentedLagrangian,
    Contact,
    Guide,
    LineForce,
    Penalty,
    Plane,
    PointForce,
    Prescribed,
    Rod,
    Scene,
    Static,
)
from dolfinrod.scene.normallaw import NormalLaw
from verification.case import SKEW, UPRIGHT, Pose
from verification.contactcase import ContactCase
from verification.contacts.runs import DISCRETE, PLANE, RADIUS, SPACE, THIN, angle, marks, on_meshes, pressed, stiffer
from verification.references.contact import edges, touching, value
from verification.references.contactposed import FALLS, WALLS
from verification.references.moving import Moving

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from verification.case import Array

__all__ = ["CASES", "elastica", "touchdown"]

# Stiffness of the walls for which the boundary-value problems are solved [N/m²].
EPS_N = 1e6
STIFFER = (10_000, 1_000_000, 100_000_000)
NODE = "a node where contact begins"
POINT = (
    "A rigid wall answers with a point force; on one of stiffness ε_N that is spread over a length (EI/ε_N)^¼, and "
    "sinks in by as much as ε_N^−¾; at the passage to a line of contact, which these cases are, slopes feel more of it."
)


def elastica(beta: int, law: NormalLaw, places: tuple[float, ...] = ()) -> Scene:
    """Half of the pinned elastica, its middle guided; pushed aside on the way so that it buckles towards the wall."""
    h, thrust = WALLS[beta]
    aside = LineForce((0.0, 100.0, 0.0), history=lambda t: t * (1.0 - t))
    return Scene(
        rods=[Rod.straight(0.5, THIN)],
        supports=[Guide("start", free=("x", "rz")), Guide("end", free=("y",))],
        loads=[PointForce((thrust, 0.0, 0.0), at="start"), aside, *marks(places)],
        contacts=[Contact(Plane((0.0, h + RADIUS, 0.0), (0.0, -1.0, 0.0)), law)],
        motion=Static(steps=8),
    )


def elastica_found(result: Result) -> Array:
    """Displacement and slope of the end, and the force of the wall on the half."""
    return np.array([result.rods[0].r[-1, 0, 0], angle(result, 0), pressed(result)])


def elastica_case(beta: int) -> ContactCase:
    """Against the boundary-value problem."""
    name = f"wall-beta{beta}"
    reference = touching(name, "x0", "angle0", "pressed")
    law = Penalty(EPS_N)
    posed, noded = elastica(beta, law), elastica(beta, law, edges(name))
    return ContactCase(
        name=f"contact-{name}",
        title=f"Elastica pressed against a wall that yields, slope {beta}° at the touch",
        family="normal",
        reference=reference,
        scale=(0.5, 1.0, value(name, "pressed")),
        runs=(
            on_meshes(PLANE, noded, (10, 20, 40), limit=1e-8, order=5.0, words=NODE, quick=beta == 10),
            on_meshes(PLANE, posed, (40, 80, 160), limit=1e-5),
            on_meshes(SPACE, noded, (20, 40), limit=1e-8, words=NODE),
            on_meshes(DISCRETE, noded, (40, 80, 160), order=1.8, words=NODE, quick=beta == 10),
        ),
        quantity="displacement and slope of the end, force of the wall; m, rad, N",
        read=elastica_found,
        note="Where contact begins p has a kink: without a node there errors fall with h² at best.",
    )


def elastica_rigid(beta: int) -> ContactCase:
    """Against the closed form of the rigid wall."""
    name = f"Lii-wall-beta{beta}"
    found = touching(name, "span", "end_slope", "F_wall")
    span, slope, force = found.value
    reference = Moving(found.id, (0.5 * (1.0 - span), slope, 0.5 * force), found.method, found.source, 14)
    multiplied, softly = (elastica(beta, AugmentedLagrangian(eps_N, 1e-9)) for eps_N in (1e12, 1e10))
    return ContactCase(
        name=f"contact-wall-beta{beta}-rigid",
        title=f"Elastica pressed against a rigid wall, slope {beta}° at the touch",
        family="normal",
        reference=reference,
        scale=(0.5, 1.0, 0.5 * force),
        runs=(
            stiffer(PLANE, lambda ε: elastica(beta, Penalty(ε)), 80, STIFFER, order=0.3, quick=beta == 10),
            stiffer(DISCRETE, lambda ε: elastica(beta, Penalty(ε)), 160, STIFFER, limit=1e-2),
            on_meshes(PLANE, multiplied, (10, 20, 40), limit=1e-6, words="multipliers"),
            on_meshes(DISCRETE, softly, (40, 80, 160), order=1.5, words="multipliers"),
        ),
        quantity="displacement and slope of the end, force of the wall; m, rad, N",
        read=elastica_found,
        note=POINT,
    )


def touchdown(h: float, length: float, law: NormalLaw, places: tuple[float, ...] = (), pose: Pose = UPRIGHT) -> Scene:
    """A heavy rod lies on the ground, then its clamp is lifted by h; ground that yields is put up by as much.

    In eight steps: an iteration lifts off no more of it than (EI/ε_N)^¼, over which such ground feels a rod.
    """
    sunk = 1.0 / law.eps_N if isinstance(law, Penalty) else 0.0
    ground = Plane(pose.vector(0.0, sunk - RADIUS), pose.vector(0.0, 1.0))
    lifted = Prescribed("start", displacement=pose.vector(0.0, h), rotation=(0.0, 0.0, 0.0))
    weight = LineForce(pose.vector(0.0, -1.0), history=lambda _: 1.0)
    return Scene(
        rods=[Rod.straight(length, THIN, direction=pose.vector(1.0, 0.0), d2=pose.vector(0.0, 1.0))],
        supports=[lifted],
        loads=[weight, *marks(places)],
        contacts=[Contact(ground, law)],
        motion=Static(steps=8),
    )


def lifted_found(result: Result) -> Array:
    """Moment and force across at the clamp, in its own axes, and how far the end was drawn in."""
    rod = result.rods[0]
    along = rod.frames[-1, 0, :, 0]
    return np.array([rod.m[-1, 0, 2], rod.n[-1, 0, 1], rod.s[-1] - along @ (rod.r[-1, -1] - rod.r[-1, 0])])


def touchdown_case(h: float, length: float, eps_N: float) -> ContactCase:
    """Against the boundary-value problem."""
    name = f"touchdown-h{h:g}"
    found = touching(name, "m0", "n_y0", "drawn_in")
    m, n, _ = found.value
    law = Penalty(eps_N)
    posed, noded = touchdown(h, length, law), touchdown(h, length, law, edges(name))
    skew = touchdown(h, length, law, edges(name), SKEW)
    return ContactCase(
        name=f"contact-{name}",
        title=f"Heavy rod, its clamp lifted by {h:g} from ground that yields",
        family="normal",
        reference=found,
        scale=(abs(m), abs(n), h),
        runs=(
            on_meshes(PLANE, noded, (80, 160), limit=1e-8, order=4.0, words=NODE, quick=h == 0.05),
            on_meshes(PLANE, posed, (80, 160, 320), limit=1e-5),
            on_meshes(SPACE, skew, (160,), limit=1e-8, words=f"skew, {NODE}"),
            on_meshes(DISCRETE, noded, (100, 200, 400), order=1.8, words=NODE, quick=h == 0.05),
        ),
        quantity="moment and shear force at the clamp, shift of the free end; N m, N, m",
        read=lifted_found,
        note="Where contact begins p has a kink: without a node there errors fall with h² at best.",
    )


CASES = (
    *(elastica_case(beta) for beta in WALLS),
    *(elastica_rigid(beta) for beta in WALLS),
    *(touchdown_case(*fall) for fall in FALLS),
)
