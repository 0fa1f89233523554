"""Rods that stick or slide on rough walls at rest and on the move: C5, C6, C9 and C10, Lv and Liv, P7a."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from math import cos, pi, radians, sin
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import (
    Contact,
    Coulomb,
    CreepingCoulomb,
    LineForce,
    Penalty,
    Plane,
    Prescribed,
    Rod,
    Scene,
    Static,
)
from verification.contactcase import ContactCase
from verification.contacts import fibres
from verification.contacts.bodies import BLOCKS, EPS, MASS, THIN, THIN_RADIUS, WALL, block, way
from verification.contacts.fibres import FIBRE, LOAD, MU, slip
from verification.contacts.runs import DISCRETE, PLANE, SPACE, on_meshes
from verification.contacts.timed import in_time
from verification.references.friction import Incline, Slide, creep, friction_angle, wedge
from verification.references.moving import exact

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from verification.case import Array

__all__ = ["CASES", "pushed", "slope_found", "wedged"]

# Anchors that yield while a block gets going let it: it is v = g sin φ √(ρA/ε_T) faster for ever, at the most.
HARD = Penalty(1e12)


def pushed(phi: float, mu: float) -> Scene:
    """A block on a slope, pushed down it by an end until it slides: what the push comes to is read off."""
    start = block(Static(steps=4), phi=phi, friction=Coulomb(mu))
    down = np.array([cos(phi), -sin(phi), 0.0])
    reach = 10.0 * mu * MASS * 9.81 / THIN.EA
    hold = Prescribed(at="start", displacement=(reach * down[0], None, None))
    return replace(
        start, supports=[hold], loads=[replace(load, history=((0.0, 0.0), (0.25, 1.0))) for load in start.loads]
    )


def slope_found(result: Result, phi: float) -> Array:
    """tan of the slope on which the block would just slide unpushed: its push along x is W tan(φ_μ − φ)."""
    push = -result.contacts[0].force[-2:, 0] / (MASS * 9.81)
    return np.tan(phi + np.arctan(push))


def wedged(degrees: float, mu: float, weight: float) -> Scene:
    """A rod in a V of two planes, pulled along it by an end."""
    α = radians(degrees)
    walls = [Plane((0.0, 0.0, 0.0), (0.0, sin(α), side * cos(α))) for side in (1.0, -1.0)]
    depth = wedge(weight, degrees, mu)[0] / EPS
    height = (THIN_RADIUS - depth) / sin(α)
    rod = Rod.straight(1.0, THIN, start=(0.0, height, 0.0))
    return Scene(
        rods=[rod],
        supports=[Prescribed(at="end", displacement=(10.0 * mu * weight / THIN.EA, None, None))],
        loads=[LineForce((0.0, -weight, 0.0), history=((0.0, 0.0), (0.25, 1.0)))],
        contacts=[Contact(wall, WALL, Coulomb(mu)) for wall in walls],
        motion=Static(steps=4),
    )


def wedged_force(result: Result) -> Array:
    """Normal force of each wall and the drag of both, over the last two steps."""
    normals = [np.einsum("s,ts->t", side.share, side.pressure[-2:]) for c in result.contacts for side in c.rods if side]
    along = -sum(contact.force[-2:, 0] for contact in result.contacts)
    return np.concatenate([*normals, along])


def slope_case(phi: float, mu: float, words: str) -> ContactCase:
    """C5 in equilibrium: the slope on which a block slides, located by pushing it."""
    return ContactCase(
        name=f"friction-threshold-{np.degrees(phi):.0f}",
        title=f"C5, threshold slope of a block, found {words}, μ = {mu:g}",
        family="friction",
        reference=exact("tan β = μ; a push along x of W tan(atan μ − φ)", "process.md 6.8", mu, mu),
        scale=1.0,
        quantity="tan of the threshold slope, on two load steps of sliding",
        read=lambda result: slope_found(result, phi),
        runs=(
            on_meshes(PLANE, pushed(phi, mu), (1, 2, 4), limit=1e-6, quick=True),
            on_meshes(DISCRETE, pushed(phi, mu), (2, 4, 8), limit=1e-6, quick=True),
        ),
    )


def block_case(name: str, title: str, body: Incline, t: float, limit: float, law: Penalty = WALL) -> ContactCase:
    """A block released on a slope."""
    return ContactCase(
        name=f"friction-block-{name}",
        title=title,
        family="friction",
        reference=exact(
            "a = g (sin φ − μ cos φ)", "Lv of the references; process.md 6.8", 0.5 * body.block * t**2, body.block * t
        ),
        scale=(0.5 * body.g * t**2, body.g * t),
        quantity="way and speed, m, m/s",
        read=lambda result: np.array([value[-1] for value in way(result, body.phi)]),
        runs=tuple(
            in_time(
                stepper,
                partial(block, phi=body.phi, friction=Coulomb(body.mu), g=body.g, law=law),
                t,
                (50, 100, 200),
                limit=limit,
                quick=True,
            )
            for stepper in BLOCKS
        ),
    )


def wedge_case(degrees: float, mu: float, weight: float) -> ContactCase:
    """Liv: a rod in a V, pulled along it."""
    N, F = wedge(weight, degrees, mu)
    return ContactCase(
        name=f"friction-wedge-{degrees:g}-{mu:g}",
        title=f"Liv, rod pulled along a V groove, walls at {degrees:g}° from the middle, μ = {mu:g}",
        family="friction",
        reference=exact("N = W/(2 sin α), F = 2 μ N", "Liv of the references", *4 * (N,), F, F),
        scale=F,
        quantity="force of each wall and of friction on two load steps, N",
        read=wedged_force,
        runs=(
            on_meshes(SPACE, wedged(degrees, mu, weight), (1, 2, 4), limit=1e-6, quick=True),
            on_meshes(DISCRETE, wedged(degrees, mu, weight), (2, 4, 8), limit=1e-6, quick=True),
        ),
    )


def stop_case() -> ContactCase:
    """P7a: a block pushed along a plane stops."""
    _, path = Slide(1.0, 0.3).stops
    return ContactCase(
        name="friction-block-stops",
        title="Lvb, P7a: rod pushed along itself at 1 m/s, μ = 0.3, stops",
        family="friction",
        reference=exact("v²/2μg", "Lvb of the references; peers.md P7a", path, 0.0),
        scale=(path, 1.0),
        quantity="way and speed after 1 s, m, m/s",
        read=lambda result: np.array([value[-1] for value in way(result, 0.0)]),
        runs=tuple(
            in_time(
                stepper,
                partial(block, phi=0.0, friction=Coulomb(0.3), v=1.0),
                1.0,
                (50, 100, 200),
                limit=2e-2,
            )
            for stepper in BLOCKS
        ),
    )


def stick_case() -> ContactCase:
    """C10: what has settled slips no more."""
    phi, g, t = radians(15.0), LOAD / (FIBRE.rhoA or 1.0), 1e-2

    def read(result: Result) -> Array:
        later = slip(result)[1:]
        return np.array([way(result, phi)[0][-1], float(np.ptp(later))])

    shift = g * sin(phi) / EPS
    return ContactCase(
        name="friction-stick",
        title="C10, block on 15°, μ = 0.64, after 10 ms",
        family="friction",
        reference=exact("q sin b/ε_T", "process.md 6.8", shift, 0.0),
        scale=(shift, 1e-300),
        quantity="way, m, and change of slip after settling, m, which must be zero to the last digit",
        read=read,
        runs=tuple(
            in_time(
                stepper,
                partial(block, phi=phi, friction=Coulomb(MU), g=g),
                t,
                (100, 200),
                output=(0.0, 0.5 * t, t),
                limit=limit,
                quick=True,
            )
            for stepper, limit in ((BLOCKS[0], 1e-5), (BLOCKS[2], 1e-4))
        ),
        note="The way is 5e-5 of the rod's length, of which 1e-9 is where Newton's method of the discrete model stops.",
    )


def creep_case() -> ContactCase:
    """The paper's rule to the letter, beside it."""
    phi, v_0 = radians(15.0), 1e-3
    v = creep(v_0, MU, cos(phi), sin(phi))
    return ContactCase(
        name="friction-creep",
        title="C10 by the paper's literal rule: block on 15°, μ = 0.64, creeps",
        family="friction",
        reference=exact("v_0 W/√(μ²N² − W²)", "process.md 0.8", v),
        scale=v,
        quantity="speed, m/s",
        read=lambda result: way(result, phi)[1][-1:],
        runs=tuple(
            in_time(stepper, partial(block, phi=phi, friction=CreepingCoulomb(MU, v_0)), 0.05, (100, 200), limit=1e-6)
            for stepper in (BLOCKS[0], BLOCKS[2])
        ),
    )


CASES = (
    slope_case(0.0, 0.3, "on the level"),
    slope_case(radians(20.0), MU, "on 20°"),
    slope_case(friction_angle(MU), MU, "on itself"),
    block_case(
        "45-0.64",
        "C5, block on 45°, μ = 0.64, q/ρA = 20669 m/s²: 5262 m/s²",
        Incline(pi / 4.0, MU, LOAD / (FIBRE.rhoA or 1.0)),
        1e-2,
        1e-2,
        HARD,
    ),
    block_case("30-0.2", "Lv, block on 30°, μ = 0.2: slides", Incline(pi / 6.0, 0.2), 1.0, 1e-2),
    block_case("20-0.5", "Lv, block on 20°, μ = 0.5: rests", Incline(pi / 9.0, 0.5), 1.0, 1e-6),
    stop_case(),
    stick_case(),
    creep_case(),
    wedge_case(45.0, 0.2, 1.0),
    wedge_case(30.0, 0.1, 2.5),
    *fibres.CASES,
)
