"""A round core that rolls: a cylinder that does not bend, as a stiff rod and what keeps it parallel to its axis."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from math import pi

import numpy as np

from dolfinrod.scene.errors import SceneError, quoted
from dolfinrod.scene.quantity import VectorLike, assign, direction, names, positive, require, vector
from dolfinrod.scene.rod import Rod
from dolfinrod.scene.section import Section
from dolfinrod.scene.supports import ROTATIONS, TRANSLATIONS, Guide

__all__ = ["STRAIGHT", "Core"]

# Part of its radius by which a core is out of line under a force as large as its weight [1].
STRAIGHT = 1e-6
# With which that weight is reckoned [m/s²].
GRAVITY = 9.81
# Sine up to which an axis is along x, y or z.
ALIGNED = 1e-9


@dataclass(frozen=True)
class Core:
    """A cylinder that moves as a rigid body, parallel to its axis: touched by walls, rods and air as any rod is.

    It is a rod whose ends do not tilt. Any force F across it that another balances moves one of its sections off the
    line of the others by F L³/12EI at most, the sway of a beam between ends that stay parallel. Where E is not given it
    is such that this is 1e-6 of the radius for F = its weight, E = m g L³/(12·1e-6·radius·I): stiff enough not to bend,
    not so stiff that numbers beside it drown. A core that is pressed with more than its weight is given a larger E. Its
    shear modulus is E/2, so that GJ = EI; shear itself is rigid. A core that cannot move at all is a `Cylinder`.

    Args:
        point: Centre of its first face [m].
        axis: From there to the other face, of any length; along x, y or z where it rolls.
        radius: Of the cylinder [m].
        length: Between its faces [m].
        density: Of a solid cylinder [kg/m³]; None where `section` is given.
        E: Young's modulus of a solid cylinder [Pa]; None: as above.
        section: Stiffness and inertia of any other body, with this radius; None: those of a solid cylinder.
        free: What is free, out of "x", "y", "z" and "roll", which is the turn about its axis.

    Raises:
        SceneError: A field that cannot be.
    """

    point: VectorLike
    axis: VectorLike
    radius: float
    length: float
    density: float | None = None
    E: float | None = None
    section: Section | None = None
    free: Iterable[str] = ("y", "z", "roll")

    def __post_init__(self) -> None:
        assign(
            self,
            point=vector(self.point, "Core.point", "m"),
            axis=direction(self.axis, "Core.axis"),
            radius=positive(self.radius, "Core.radius", "m"),
            length=positive(self.length, "Core.length", "m"),
            free=names(self.free, "Core.free", (*TRANSLATIONS, "roll")),
        )
        if "roll" in self.free and not self._about:
            raise SceneError(
                f"must be along x, y or z, since the core may roll about it, got {self.axis}", field="Core.axis"
            )
        assign(self, section=self._solid() if self.section is None else self._checked())

    @property
    def rod(self) -> Rod:
        """The core as a rod, d1 along its axis."""
        assert self.section is not None
        return Rod.straight(self.length, self.section, start=self.point, direction=self.axis)

    def supports(self, rod: int) -> tuple[Guide, Guide]:
        """What keeps it parallel to its axis, and holds what is not free.

        Args:
            rod: Its number among the rods of the scene.

        Returns:
            Guides of its start, which hold translations and turns, and of its end, which hold turns only.
        """
        rolls = self._about if "roll" in self.free else ()
        moves = tuple(name for name in TRANSLATIONS if name in self.free)
        return Guide("start", (*moves, *rolls), rod), Guide("end", (*TRANSLATIONS, *rolls), rod)

    @property
    def _about(self) -> tuple[str, ...]:
        """The component of the rotation vector about its axis; none where that is askew."""
        size = np.abs(self.axis)
        i = int(np.argmax(size))
        return (ROTATIONS[i],) if np.delete(size, i).max() <= ALIGNED else ()

    def _solid(self) -> Section:
        """A solid cylinder, stiff enough."""
        require("Core", {"density": self.density})
        ρ, d = positive(self.density, "Core.density", "kg/m³"), 2.0 * self.radius
        weight = ρ * pi * self.radius**2 * self.length * GRAVITY
        EI = weight * self.length**3 / (12.0 * STRAIGHT * self.radius)
        E = EI / (pi * self.radius**4 / 4.0) if self.E is None else positive(self.E, "Core.E", "Pa")
        assign(self, density=ρ, E=E)
        return Section.circle(diameter=d, E=E, G=E / 2.0, density=ρ, rigid={"shear"})

    def _checked(self) -> Section:
        """A section that is given: round, and with all there is to know of the body."""
        if not isinstance(self.section, Section):
            raise SceneError(f"must be a Section or None, got {quoted(self.section)}", field="Core.section")
        for name in ("density", "E"):
            if getattr(self, name) is not None:
                got = quoted(getattr(self, name))
                raise SceneError(f"must be left out where section is given, got {got}", field=f"Core.{name}")
        if self.section.radius != self.radius:
            other = f"must be the radius of the core, {self.radius} m, got {self.section.radius} m"
            raise SceneError(other, field="Core.section.radius")
        return self.section
