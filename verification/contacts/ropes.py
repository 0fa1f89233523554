"""Ropes round drums, stress free as they lie there: pulled by an end, pulled to and fro, let go."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import cos, radians, sin
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import (
    AugmentedLagrangian,
    Contact,
    Coulomb,
    Cylinder,
    Dynamic,
    Gravity,
    Guide,
    Penalty,
    PointForce,
    Prescribed,
    Rod,
    Scene,
    Section,
    Static,
)
from verification.references.capstan import Drum, acceleration, euler, heavy, thick

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from verification.case import Array

__all__ = ["LEVEL", "STIFFNESS", "TILTED", "Loop", "Run", "Wrap"]

# Of all ropes here: radius of the centreline, and the tension to which both ends are raised, 1; EI/(T₁ ρ²) = 1e-5.
EI = 1e-5
# Stiffness of wall and anchors [T₁/ρ²]: the rope shifts by 1e-6 ρ before it slips where it carries T₁.
STIFFNESS = 1e6
LAW = AugmentedLagrangian(STIFFNESS, 1e-10)
# How far beyond the shift at which the rope slides everywhere its end is pulled, and in how many steps.
BEYOND, STEPS = 2.0, 8
LEVEL, TILTED = 0.0, 5.0


@dataclass(frozen=True)
class Wrap:
    """A rope posed along a drum, stress free as it lies there, both ends at the points where it leaves the drum.

    It is raised to T₁ at both ends; then one of them is pulled along by a prescribed displacement, free across.

    Args:
        mu: Coefficient of friction.
        degrees: Of the drum that it touches.
        tilt: Angle of its helix, so that turns lie beside each other [°].
        epsilon: Radius of the rope over that of its centreline.
        weight: Per length [T₁/ρ].
    """

    mu: float
    degrees: float
    tilt: float = LEVEL
    epsilon: float = 1e-6
    weight: float = 0.0

    @property
    def angle(self) -> float:
        """By which the rope turns [rad]: its curvature, cos²(tilt)/ρ, times its length."""
        return radians(self.degrees) * cos(radians(self.tilt))

    @property
    def limit(self) -> float:
        """T₂/T₁ at which it slides."""
        if self.weight:
            return self.weight * heavy(self.mu, 1.0 / self.weight)
        return thick(self.mu, self.angle, self.epsilon)

    @property
    def rod(self) -> Rod:
        """The rope; EA so that all its stretch is as small as its shift."""
        c, s = cos(radians(self.tilt)), sin(radians(self.tilt))
        section = Section(
            EA=STIFFNESS,
            GJ=1.0,
            EI=EI,
            rhoA=self.weight or 1.0,
            rhoI=(0.0, 0.0, 0.0),
            rigid={"shear"},
            radius=self.epsilon,
        )
        length, bend = radians(self.degrees) / c, (s * c, 0.0, c * c)
        return Rod.curved(length, section, bend, start=(-1.0, 0.0, 0.0), direction=(0.0, 1.0, 0.0), d2=(1.0, 0.0, 0.0))

    @property
    def drum(self) -> Cylinder:
        """Touched by the rope all along, which starts as deep in it as T₁ presses it into a wall of that stiffness."""
        c, s = cos(radians(self.tilt)), sin(radians(self.tilt))
        return Cylinder((0.0, 0.0, 0.0), (0.0, -s, c), 1.0 - self.epsilon + 1.0 / STIFFNESS)

    @property
    def light_end(self) -> Array:
        """Direction in which the rope leaves the drum where it is not pulled."""
        return np.asarray(self.rod.frames(np.array([self.rod.length]))[0, :, 0])

    def scene(self) -> Scene:
        """Both ends to T₁ until 1, then one is pulled until 2."""
        reach = BEYOND * (self.mu + 2.0 * self.angle) * self.limit / STIFFNESS
        held = ((0.0, 0.0), (1.0, 1.0), (2.0, 1.0))
        weight = [Gravity((0.0, -1.0, 0.0), history=held)] if self.weight else []
        untwisted = [] if self.tilt == LEVEL else [Guide(at="start", free={"x", "y", "z", "rx", "rz"})]
        pull = Prescribed(at="start", displacement=(None, -reach, None), history=((0.0, 0.0), (1.0, 0.0), (2.0, 1.0)))
        return Scene(
            rods=[self.rod],
            supports=[pull, *untwisted],
            loads=[PointForce(tuple(self.light_end), at="end", history=held), *weight],
            contacts=[Contact(self.drum, LAW, Coulomb(self.mu))],
            motion=Static(steps=STEPS, t_end=2.0),
        )

    def pulled(self, result: Result) -> Array:
        """T₂/T₁ while the end is pulled on for the last two steps, from the balance of the whole rope."""
        force = self.light_end + result.contacts[0].force[-2:]
        force[:, 1] -= self.weight * self.rod.length
        return np.asarray(force[:, 1])


@dataclass(frozen=True)
class Loop:
    """A rope that stretches, both ends raised to T₁; then one to T₂, back to T₁ and to T₂ again. Nothing is prescribed.

    Args:
        mu: Coefficient of friction.
        degrees: Of the drum that it touches.
        part: T₂ as a part of what would make it slide.
        EA: Axial stiffness [T₁].
        anchors: Their stiffness over that of the drum.
    """

    mu: float
    degrees: float
    part: float
    EA: float = 1e4
    anchors: float = 1.0

    @property
    def string(self) -> Drum:
        """Its closed form."""
        return Drum(self.mu, radians(self.degrees), 1.0, self.EA)

    @property
    def strong(self) -> float:
        """T₂."""
        return self.part * self.string.limit

    def scene(self, steps: int = 1) -> Scene:
        """So many load steps a stage."""
        wrap = Wrap(self.mu, self.degrees)
        rod = replace(wrap.rod, section=replace(wrap.rod.section, EA=self.EA))
        low = 1.0 / self.strong
        pull = PointForce((0.0, -self.strong, 0.0), at="start", history=((0, 0), (1, low), (2, 1), (3, low), (4, 1)))
        held = PointForce(tuple(wrap.light_end), at="end", history=((0, 0), (1, 1), (4, 1)))
        return Scene(
            rods=[rod],
            loads=[pull, held],
            contacts=[Contact(wrap.drum, LAW, Coulomb(self.mu, eps_T=self.anchors * STIFFNESS))],
            motion=Static(steps=4 * steps, t_end=4.0),
        )

    def ways(self, result: Result) -> Array:
        """Of the pulled end at all times; what the drum pushes the rope out from where it is posed counts as none."""
        out = 0.5 * self.string.angle / STIFFNESS
        return np.asarray(out - result.rods[0].r[:, 0, 1])

    def read(self, result: Result) -> Array:
        """Way of the pulled end at T₁, T₂, T₁ and T₂."""
        at = [int(np.argmin(np.abs(result.t - stage))) for stage in (1.0, 2.0, 3.0, 4.0)]
        return self.ways(result)[at]

    def lost(self, result: Result) -> Array:
        """∮ T du from T₂ to T₁ and to T₂ again."""
        last = result.t >= 2.0 - 1e-9
        t, u = result.t[last], self.ways(result)[last]
        T = np.interp(t, (2.0, 3.0, 4.0), (self.strong, 1.0, self.strong))
        return np.array([np.sum(0.5 * (T[1:] + T[:-1]) * np.diff(u))])


@dataclass(frozen=True)
class Run:
    """A rope whose ends are raised to T₁ in 0.1 s, then one of them to T₂ in as long, and that is left to them.

    Args:
        mu: Coefficient of friction.
        degrees: Of the drum that it touches.
        part: T₂ as a part of what it holds.
    """

    mu: float
    degrees: float
    part: float

    @property
    def acceleration(self) -> float:
        """With which it runs."""
        angle = radians(self.degrees)
        return acceleration(self.mu, angle, 1.0, self.part * euler(self.mu, angle), 1.0)

    def scene(self, motion: Dynamic) -> Scene:
        """ρA = 1."""
        wrap, strong = Wrap(self.mu, self.degrees), self.part * euler(self.mu, radians(self.degrees))
        raised, low = ((0.0, 0.0), (0.1, 1.0)), 1.0 / strong
        loads = (
            PointForce(tuple(wrap.light_end), at="end", history=raised),
            PointForce((0.0, -strong, 0.0), at="start", history=((0.0, 0.0), (0.1, low), (0.2, 1.0))),
        )
        contact = Contact(wrap.drum, Penalty(STIFFNESS), Coulomb(self.mu))
        return Scene(rods=[wrap.rod], loads=loads, contacts=[contact], motion=motion)

    def read(self, result: Result) -> Array:
        """Mean acceleration of both ends over the last two stored times."""
        v = np.asarray(result.rods[0].v)[-2:, [0, -1]]
        along = np.stack([-v[:, 0, 1], -v[:, 1] @ Wrap(self.mu, self.degrees).light_end], axis=1)
        return np.asarray((along[1] - along[0]) / (result.t[-1] - result.t[-2]))
