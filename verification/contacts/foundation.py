"""Rods on ground that yields in proportion: Winkler's foundation, held from both sides or from one."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import Contact, Guide, LineForce, Penalty, Plane, PointForce, Rod, Scene
from verification.contactcase import ContactCase
from verification.contacts.runs import DISCRETE, PLANE, RADIUS, SPACE, THIN, angle, marks, on_meshes
from verification.references.contact import edges, touching
from verification.references.moving import Moving

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from verification.case import Array

__all__ = ["CASES", "MODULUS", "pressed_down", "settled"]

# β = (k/4EI)^¼ = 1.
MODULUS = 4.0
# So light that slopes stay near 1e-4, where linear theory is exact to 1e-8; so heavy that no place lifts off.
LOAD, WEIGHT = 4e-4, 4e-3
TENSIONLESS = 1e-3
# The infinite rod: exp(−βL/2) = 2e-9 is left at its ends.
LONG = 40.0
NODE = "a node where the rod lifts off"


def settled(length: float) -> Scene:
    """Half of a heavy rod, its load at the middle; ground so high that the rod alone would lie at y = 0."""
    ground = Plane((0.0, WEIGHT / MODULUS - RADIUS, 0.0), (0.0, 1.0, 0.0))
    return _half(length, LOAD, [Contact(ground, Penalty(MODULUS))], LineForce((0.0, -WEIGHT, 0.0)))


def between(length: float) -> Scene:
    """Half of a weightless rod between two planes that press it from both sides and share the modulus."""
    halo, law = WEIGHT / MODULUS, Penalty(0.5 * MODULUS)
    below = Plane((0.0, halo - RADIUS, 0.0), (0.0, 1.0, 0.0))
    above = Plane((0.0, RADIUS - halo, 0.0), (0.0, -1.0, 0.0))
    return _half(length, LOAD, [Contact(below, law), Contact(above, law)])


def pressed_down(load: float, length: float, places: tuple[float, ...] = ()) -> Scene:
    """Half of a weightless rod on ground that only pushes."""
    ground = Plane((0.0, -RADIUS, 0.0), (0.0, 1.0, 0.0))
    return _half(length, load, [Contact(ground, Penalty(MODULUS))], *marks(places))


def _half(length: float, load: float, contacts: list[Contact], *more: LineForce | PointForce) -> Scene:
    """From the middle on, where half of the load acts and nothing turns."""
    return Scene(
        rods=[Rod.straight(0.5 * length, THIN)],
        supports=[Guide("start", free=("y",))],
        loads=[PointForce((0.0, -0.5 * load, 0.0), at="start"), *more],
        contacts=contacts,
    )


def sunk(result: Result) -> Array:
    """How far middle and end sink in P β/k, and the moment at the middle in P/β."""
    rod = result.rods[0]
    down = -rod.r[-1, [0, -1], 1] * MODULUS / LOAD
    return np.array([*down, rod.m[-1, 0, 2] / LOAD])


def lifted(result: Result) -> Array:
    """How far the middle sinks, the moment there, and the slope of the end, in P β/k, P/β and P β²/k."""
    rod, unit = result.rods[0], MODULUS / TENSIONLESS
    return np.array([-rod.r[-1, 0, 1] * unit, rod.m[-1, 0, 2] / TENSIONLESS, angle(result, -1) * unit])


def winkler(name: str, length: float) -> ContactCase:
    """Against Hetényi's closed form."""
    infinite = name.endswith("inf")
    found = touching(name, "wc_k_over_Pbeta", *(() if infinite else ("wend_k_over_Pbeta",)), "Mc_beta_over_P")
    middle, *end, moment = found.value
    reference = Moving(found.id, (middle, *(end or (0.0,)), moment), found.method, found.source, found.digits_trusted)
    scene, elements = settled(length), 16 if infinite else 4
    return ContactCase(
        name=f"contact-{name[5:].lower()}",
        title=f"Rod on a foundation, βL = {'infinite' if infinite else f'{length:g}'}, its load at the middle",
        family="normal",
        reference=reference,
        scale=(middle, middle, moment),
        runs=(
            on_meshes(PLANE, scene, (elements, 2 * elements, 4 * elements), limit=1e-6, quick=True),
            on_meshes(SPACE, between(length), (4 * elements,), limit=1e-6, words="pressed from both sides"),
            on_meshes(DISCRETE, scene, (10 * elements, 20 * elements), order=1.8),
        ),
        quantity="middle and end below the settled rod, moment at the middle; P β/k, P β/k, P/β",
        read=sunk,
    )


def tensionless() -> ContactCase:
    """Against the closed form of the long rod."""
    found = touching("Liii-tensionless", "wc_k_over_Pbeta", "Mc_beta_over_P", "end_slope_k_over_Pbeta2")
    posed, noded = (pressed_down(TENSIONLESS, 8.0, places) for places in ((), edges("tensionless")))
    return ContactCase(
        name="contact-tensionless",
        title="Rod pressed down on ground that only pushes",
        family="normal",
        reference=found,
        scale=found.value,
        runs=(
            on_meshes(PLANE, noded, (16, 32), limit=1e-7, words=NODE, quick=True),
            on_meshes(PLANE, posed, (40, 80, 160), limit=1e-5),
            on_meshes(DISCRETE, noded, (40, 80, 160), order=1.8, words=NODE, quick=True),
        ),
        quantity="depth and moment at the load, slope of the free ends; P β/k, P/β, P β²/k",
        read=lifted,
        note="Where the rod lifts off p has a kink: without a node there errors fall with h² at best.",
    )


CASES = (
    *(winkler(f"Liii-winkler-bL{length:.1f}", length) for length in (1.0, 3.0, 6.0)),
    winkler("Liii-winkler-inf", LONG),
    tensionless(),
)
