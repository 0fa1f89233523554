"""Stability maps of contact: step × penalty × element length, by model, scheme and friction.

A centimetre of the paper's fibre, clamped 20 µm above a floor, is pressed onto it by the drag of air at 20 m/s, aslant
by less than friction bears, in something as thick as oil: there every motion dies out within 20 µs, so that what does
not come to rest in the end is of the steps' making.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from math import pi, sqrt
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.result import NotConverged
from dolfinrod.scene import (
    Air,
    Clamp,
    Contact,
    Coulomb,
    CreepingCoulomb,
    Dynamic,
    ImplicitEuler,
    LineForce,
    Midpoint,
    Penalty,
    Plane,
    Rod,
    Scene,
    Section,
    Spatial,
)
from verification.contactaudit import audit
from verification.hardmotion import GAIN
from verification.patience import CRAWLS, Patience

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.result import Result
    from dolfinrod.scene.motion import Scheme

    Array = NDArray[np.float64]
    Friction = Coulomb | CreepingCoulomb

__all__ = [
    "ENDED",
    "LENGTH",
    "MESHES",
    "SCHEMES",
    "STEPS",
    "STIFFNESSES",
    "ContactCell",
    "ContactScheme",
    "cells",
    "period",
]

# Of the fibre, the height of the clamp above the floor, the end of the motion [m, m, s].
LENGTH, HEIGHT, ENDED = 0.01, 2e-5, 6e-4
# Pressing load and its part along the floor, across the fibre [N/m]; friction bears twice as much.
PRESS, ASLANT = 9.3e-3, 0.3
MU, SLOW = 0.64, 1e-2
# Sixteen times as thick as water [Pa s].
THICK = Air(viscosity=1.7e-2)
# Part of the time at the end in which everything should be at rest.
LAST = 1.0 / 3.0
# Swing of the resultant over its mean, and way along the floor over the radius, that count as rest.
SETTLED, CREEP = 1e-2, 1e-3
# What is tried: steps [s], penalties [N/m²], elements of the fibre.
STEPS = (5e-6, 1e-5, 2e-5, 5e-5)
STIFFNESSES = (1e3, 1e4, 1e5, 1e6, 1e7, 1e8)
MESHES = (5, 10, 20)


@dataclass(frozen=True)
class ContactCell:
    """One step length on one wall by one mesh.

    Args:
        scheme: In words.
        l: Length of the elements [m].
        eps_N: Of the wall [N/m²].
        dt: Step [s].
        outcome: "converged"; "creeps": comes to rest but along the floor; "chatters": the resultant swings by more
            than 1 % of its mean in the last third, or a node changes between open, sticking and sliding more than
            once there, or swings along the floor about anchors that stay where they are; "failed": refused, or more
            steps failed than were asked for, or the steps made half as much energy as went in, or more.
        swing: Of the resultant over its mean in the last third; NaN where it failed, as what follows.
        flips: Most changes of a node there.
        crept: Longest way along the floor there [m].
        pressed: Resultant along the normal over the load.
        made: Most energy that the steps had made, over all that went in.
        iterations: Newton iterations a step, failed attempts included.
        ms: Of a step [ms].
        reason: Of a failure.
    """

    scheme: str
    l: float
    eps_N: float
    dt: float
    outcome: str
    swing: float
    flips: int
    crept: float
    pressed: float
    made: float
    iterations: float
    ms: float
    reason: str

    @property
    def holds(self) -> bool:
        """Implicit Euler never fails, the midpoint rule not as long as a step is shorter than a touch.

        Friction that sticks does not creep.
        """
        if self.outcome == "creeps":
            return "creeping" in self.scheme
        return self.outcome != "failed" or ("midpoint" in self.scheme and self.dt > period(self.eps_N))


@dataclass(frozen=True)
class ContactScheme:
    """A model, a scheme and a friction.

    Args:
        model: "continuum" or "discrete".
        scheme: In time.
        friction: Of the floor.
    """

    model: str
    scheme: Scheme
    friction: Friction

    @property
    def name(self) -> str:
        """In words."""
        kind = "midpoint" if isinstance(self.scheme, Midpoint) else "implicit Euler"
        rubs = "creeping friction" if isinstance(self.friction, CreepingCoulomb) else "friction that sticks"
        return f"{self.model}, {kind}, {rubs}"

    def solve(self, elements: int, eps_N: float, dt: float, patience: Patience) -> Result:
        """The fibre pressed onto the floor.

        Raises:
            NotConverged: A step could not be taken.
        """
        scene = posed(eps_N, self.friction, Dynamic(ENDED, dt, scheme=self.scheme))
        if self.model == "continuum":
            from dolfinrod.continuum import solve

            return solve(scene, elements=elements, degree=3, kinematics=Spatial(), progress=patience)
        from discrete import solve as solve_discrete

        return solve_discrete(scene, elements=elements, progress=patience)


STICKS, CREEPS = Coulomb(MU), CreepingCoulomb(MU, SLOW)
SCHEMES = (
    ContactScheme("discrete", ImplicitEuler(), STICKS),
    ContactScheme("discrete", ImplicitEuler(), CREEPS),
    ContactScheme("continuum", ImplicitEuler(), STICKS),
    ContactScheme("continuum", ImplicitEuler(), CREEPS),
    ContactScheme("continuum", Midpoint(), STICKS),
)


def posed(eps_N: float, friction: Friction, motion: Dynamic) -> Scene:
    """The fibre above the floor, its load all there from the start."""
    section = Section.ramie()
    assert section.radius is not None
    rod = Rod.straight(length=LENGTH, section=section, start=(0.0, 0.0, section.radius + HEIGHT))
    load = LineForce((0.0, ASLANT * PRESS, -PRESS))
    floor = Contact(Plane((0.0, 0.0, 0.0), (0.0, 0.0, 1.0)), Penalty(eps_N), friction)
    return Scene([rod], [Clamp("start")], [load], [floor], air=THICK, motion=motion)


def period(eps_N: float) -> float:
    """Time for which the fibre touches when it bounces, π √(ρA/ε_N) (process.md 6.8, C2) [s]."""
    mass = Section.ramie().rhoA
    assert mass is not None
    return pi * sqrt(mass / eps_N)


def cells(
    scheme: ContactScheme, elements: int, eps_N: float, steps: tuple[float, ...] = STEPS
) -> tuple[ContactCell, ...]:
    """One line of a map: a cell for every step."""
    return tuple(cell(scheme, elements, eps_N, dt) for dt in steps)


def cell(scheme: ContactScheme, elements: int, eps_N: float, dt: float) -> ContactCell:
    """Go to the end and look at the last third."""
    found = partial(ContactCell, scheme.name, LENGTH / elements, eps_N, dt)
    patience = Patience(Dynamic(ENDED, dt))
    try:
        result = scheme.solve(elements, eps_N, dt, patience)
    except NotConverged as failed:
        reason = CRAWLS if patience.over else failed.reason
        return found("failed", np.nan, 0, np.nan, np.nan, np.nan, np.nan, np.nan, reason)
    *_, made = audit(result.energy)
    swing, flips, crept, slipped = rest(result)
    pressed = float(result.contacts[0].force[-1, 2] / (PRESS * LENGTH))
    taken = result.statistics.newton_iterations / len(result.log)
    ms = 1e3 * result.statistics.seconds_solve / len(result.log)
    held = isinstance(scheme.friction, Coulomb) and slipped == 0.0
    words, reason = outcome(swing, flips, crept, held=held), ""
    if not made <= GAIN:
        words, reason = "failed", f"the steps made {made:.2g} times the energy that went in"
    return found(words, swing, flips, crept, pressed, made, taken, ms, reason)


def outcome(swing: float, flips: int, crept: float, *, held: bool) -> str:
    """Of a run that reached the end; held: by anchors of friction that have not moved."""
    if not swing <= SETTLED or flips > 1:
        return "chatters"
    radius = Section.ramie().radius
    assert radius is not None
    if crept <= CREEP * radius:
        return "converged"
    return "chatters" if held else "creeps"


def rest(result: Result) -> tuple[float, int, float, float]:
    """How far from rest the last third is.

    Returns:
        Swing of the resultant along the normal over its mean, most changes of state of a node, longest way of a node
        that touches along the floor [m], and the longest of its anchors [m].
    """
    rod = result.contacts[0].rods[0]
    assert rod is not None
    late = result.t >= (1.0 - LAST) * ENDED
    force, state = result.contacts[0].force[late, 2], rod.state[late]
    swing = float(np.ptp(force) / max(abs(float(force.mean())), np.finfo(float).tiny))
    flips = int((state[1:] != state[:-1]).sum(axis=0).max(initial=0))
    touching = (state > 0).all(axis=0)
    at = result.rods[0].r[late][:, :, :2][:, touching]
    ways = np.linalg.norm(at - at[:1], axis=2)
    slipped = np.ptp(rod.slip[late][:, touching], axis=0)
    return swing, flips, float(ways.max(initial=0.0)), float(slipped.max(initial=0.0))
