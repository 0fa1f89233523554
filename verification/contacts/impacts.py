"""Rods that hit walls: how deep, for how long, how they leave, straight, at an angle and across a cylinder (C2)."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from math import pi
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import Contact, Coulomb, Cylinder, Penalty, Planar, Plane, Rod, Scene, Section, Velocity
from verification.contactcase import ContactCase
from verification.contacts.bodies import BLOCKS, MASS, RADIUS, ROLLERS, STIFF, spun
from verification.contacts.timed import in_time
from verification.references.friction import Bounce, restitution
from verification.references.moving import exact
from verification.stepper import DiscreteStepper, both_schemes

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from dolfinrod.scene import Dynamic
    from verification.case import Array
    from verification.stepper import Stepper

__all__ = ["CASES", "balance", "fallen", "thrown"]

# C2: the paper's fibre and wall, 1 m/s.
FIBRE = Section.ramie(rigid={"shear"})
FIBRE_LENGTH, FIBRE_RADIUS = 1e-3, 1e-5
HIT = Bounce(1.0, FIBRE.rhoA or 0.0, 2e4)
# How long it is looked at, in contact times.
LOOKED = 1.5
# Damping of a wall over the critical one: it takes half of the energy, or nearly all.
LIGHT, CRITICAL = 0.1, 1.0
# A roller thrown at a wall at an angle, so fast along it that it slides until it leaves.
ALONG, AGAINST, FRICTION = 3.0, 1.0, 0.3
THROWN = Bounce(AGAINST, MASS, 1e4)


def dropped(motion: Dynamic) -> Scene:
    """The fibre as it comes to the wall broadside on."""
    rod = Rod.straight(FIBRE_LENGTH, FIBRE, start=(0.0, FIBRE_RADIUS, 0.0))
    contact = Contact(Plane((0.0, 0.0, 0.0), (0.0, 1.0, 0.0)), Penalty(HIT.eps_N))
    return Scene(rods=[rod], contacts=[contact], velocities=[Velocity((0.0, -HIT.v, 0.0))], motion=motion)


def damped(motion: Dynamic, ratio: float) -> Scene:
    """The same fibre and a wall with damping."""
    scene = dropped(motion)
    law = Penalty(HIT.eps_N, damping=2.0 * ratio * HIT.time / pi)
    return replace(scene, contacts=[replace(scene.walls[0], law=law)])


def back(result: Result) -> Array:
    """Speed after the impact over that before."""
    return np.asarray(result.rods[0].v)[-1, :1, 1] / HIT.v


def left(result: Result) -> Array:
    """Depth over what it should be at half the contact time, speed over that of the impact, height at the end."""
    r, v = result.rods[0].r[:, 0, 1] - FIBRE_RADIUS, np.asarray(result.rods[0].v)[-1, 0, 1]
    return np.array([-r[1] / HIT.depth, v / HIT.v, r[-1] / (HIT.v * (LOOKED - 1.0) * HIT.time)])


def thrown(motion: Dynamic) -> Scene:
    """A roller thrown at a rough wall at an angle, without spin."""
    rod = Rod.straight(1.0, STIFF, start=(0.0, RADIUS, 0.0), direction=(0.0, 0.0, 1.0), d2=(0.0, 1.0, 0.0))
    contact = Contact(Plane((0.0, 0.0, 0.0), (0.0, 1.0, 0.0)), Penalty(THROWN.eps_N), Coulomb(FRICTION))
    return Scene(rods=[rod], contacts=[contact], velocities=[Velocity((ALONG, -AGAINST, 0.0))], motion=motion)


def leaves(result: Result) -> Array:
    """Speeds along and off the wall, and that of its surface by its spin."""
    v = np.asarray(result.rods[0].v)[-1].mean(axis=0)
    return np.array([v[0], v[1], RADIUS * spun(result)[-1]])


def fallen(motion: Dynamic, mu: float = FRICTION) -> Scene:
    """A rod that falls across a rough cylinder off its middle, bends and rebounds."""
    section = Section(EA=1e4, GJ=0.5, EI=0.5, rhoA=1.0, rhoI=(1e-4, 5e-5, 5e-5), radius=0.01, rigid={"shear"})
    rod = Rod.straight(1.0, section, start=(-0.4, 0.115, 0.0))
    drum = Cylinder((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), 0.1)
    contact = Contact(drum, Penalty(1e5), Coulomb(mu))
    return Scene(rods=[rod], contacts=[contact], velocities=[Velocity((0.3, -1.0, 0.0))], motion=motion)


def balance(result: Result) -> Array:
    """What the ledger leaves open, and the largest total energy beyond the start, both over the energy at the start."""
    e = result.energy
    total = np.sum([e[name] for name in ("kinetic", "strain", "potential", "contact")], axis=0)
    works = sum(
        e[name] for name in ("load work", "support work", "drag", "damping", "numerical", "friction", "wall work")
    )
    return np.array([np.abs(total - total[0] - works).max(), max(0.0, (total - total[0]).max())]) / total[0]


def drop_case() -> ContactCase:
    """C2."""
    t = LOOKED * HIT.time
    return ContactCase(
        name="impact-drop",
        title="C2, fibre that hits a wall at 1 m/s, ε_N = 2e4 N/m²",
        family="impact",
        reference=exact("v √(ρA/ε), π √(ρA/ε)", "process.md 6.8", 1.0, 1.0, 1.0),
        scale=1.0,
        quantity="greatest depth, speed after and height it has then reached, over what they should be",
        read=left,
        runs=tuple(
            in_time(
                stepper,
                dropped,
                t,
                (60, 120, 240),
                output=(0.0, 0.5 * HIT.time, t),
                limit=limit,
                order=order,
                quick=True,
            )
            for stepper, (limit, order) in zip(BLOCKS, ((0.05, 0.9), (1e-4, 1.9), (0.05, 0.9)), strict=True)
        ),
    )


def damp_case(ratio: float) -> ContactCase:
    """C2 with damping."""
    return ContactCase(
        name=f"impact-damped-{ratio:g}",
        title=f"C2, fibre that hits a wall with damping, {ratio:g} of the critical one",
        family="impact",
        reference=exact("coefficient of restitution", "Schwager & Pöschel 2007", restitution(ratio)),
        scale=1.0,
        quantity="speed after over that before",
        read=back,
        runs=tuple(
            in_time(stepper, partial(damped, ratio=ratio), 2.0 * HIT.time, (80, 160, 320), limit=limit, order=order)
            # When in a step it strikes decides more of the second order's error than the step's length.
            for stepper, (limit, order) in zip(BLOCKS, ((0.05, 0.9), (1e-4, None), (0.05, 0.9)), strict=True)
        ),
    )


def throw_case() -> ContactCase:
    """An oblique impact with friction."""
    along, spin = THROWN.slides(FRICTION, ALONG)
    t = LOOKED * THROWN.time
    return ContactCase(
        name="impact-oblique",
        title="Roller thrown at a rough wall at an angle: slides until it leaves, μ = 0.3",
        family="impact",
        reference=exact("v_t − 2μv_n, v_n, 4μv_n", "impulses; I = m r²/2", along, AGAINST, spin),
        scale=AGAINST,
        quantity="speed along the wall and off it, radius times spin, m/s",
        read=leaves,
        runs=tuple(
            in_time(stepper, thrown, t, (60, 120, 240), limit=limit, order=order)
            for stepper, (limit, order) in zip(ROLLERS, ((0.05, 0.9), (1e-6, 1.9), (0.05, 0.9)), strict=True)
        ),
    )


def finer() -> tuple[Stepper, ...]:
    """The same models on meshes on which the rod bends."""
    midpoint, euler = both_schemes(8, 3, Planar((0.0, 0.0, 1.0)))
    return euler, midpoint, DiscreteStepper(32)


def fall_case() -> ContactCase:
    """Energy only: it is never more than at the start, and the ledger accounts for all of it."""
    return ContactCase(
        name="impact-cylinder",
        title="Rod falling across a rough cylinder, rebounding: energy",
        family="impact",
        reference=exact("total ≤ that at the start; changes add up to works", "balance of energy", 0.0, 0.0),
        scale=(1.0, 1.0),
        quantity="open in the ledger, gained, over the energy at the start",
        read=balance,
        runs=tuple(
            in_time(stepper, fallen, 0.5, (250, 500), output=tuple(np.linspace(0.0, 0.5, 51)), limit=limit)
            for stepper, limit in zip(finer(), (1e-9, 1e-9, 1e-9), strict=True)
        ),
    )


CASES = (drop_case(), damp_case(LIGHT), damp_case(CRITICAL), throw_case(), fall_case())
