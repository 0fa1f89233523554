"""The middle of the bundle as one cylinder along X: at rest in the bottom of the groove, or free to roll there."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

from dolfinrod.groove.bundle import OFFSETS, Bundle
from dolfinrod.groove.limits import limited
from dolfinrod.groove.sections import CrossSection
from dolfinrod.scene import Core, Cylinder, Prescribed, Rod, WallMotion
from dolfinrod.scene.quantity import Vector, assign
from dolfinrod.scene.supports import Support

__all__ = ["AnyCore", "FixedCore", "RollingCore"]

RADIUS = 0.08e-3
# Fibres of a yarn of 36 Nm, 57 [C from P], but for the five that are computed one by one.
OTHERS = 52.0
# Line load above all that air and fibres put on the core [N/m], and part of its radius by which it bends under it.
LOAD, BENDS = 1.0, 1e-6


@dataclass(frozen=True)
class FixedCore:
    """The paper's central cylinder, which edge fibres touch, at rest in the bottom: it touches both flanks.

    Args:
        radius: 1e-5 to 1e-3 m; 0.08 mm [I]: 57 fibres at a packing of 0.9 [C].

    Raises:
        SceneError: A radius out of its range.
    """

    radius: float = RADIUS

    def __post_init__(self) -> None:
        assign(self, radius=limited(self.radius, "FixedCore.radius", "m", 1e-5, 1e-3))

    def surface(self, groove: CrossSection, motion: WallMotion | None, *, mirrored: bool) -> Cylinder:
        """What fibres touch.

        Args:
            groove: In whose bottom it lies.
            motion: Of the roller, with which it goes along.
            mirrored: Whether left is right.

        Returns:
            The cylinder.
        """
        y, z = groove.seat(self.radius)
        return Cylinder((0.0, y, -z if mirrored else z), (1.0, 0.0, 0.0), self.radius, motion=motion)


@dataclass(frozen=True)
class RollingCore:
    """A rigid cylinder that walls, fibres and air touch: it moves along Y and Z and rolls about X.

    An extension of the paper, not its model. It begins on the left flank and rolls into the corner; rolling a way s
    without slip winds edge fibres, which it carries along, by at most s/(2π radius) turns. As heavy as it is, fibres
    that cross between it and a wall need a stiffer `Scenario.law`: variant "L2" has one.

    Args:
        radius: 1e-5 to 1e-3 m; 0.08 mm [I].
        start: z where it begins, −0.05 to 0.05 m; None: in the middle of the fibres, −1 mm in lateral grooves [P].
        fibres: For how many it stands, as heavy as these, 1 to 1000; 52 [C].

    Raises:
        SceneError: A number out of its range.
    """

    radius: float = RADIUS
    start: float | None = None
    fibres: float = OTHERS

    def __post_init__(self) -> None:
        assign(
            self,
            radius=limited(self.radius, "RollingCore.radius", "m", 1e-5, 1e-3),
            start=None if self.start is None else limited(self.start, "RollingCore.start", "m", -0.05, 0.05),
            fibres=limited(self.fibres, "RollingCore.fibres", "", 1.0, 1000.0),
        )

    def rod(self, groove: CrossSection, kind: str, bundle: Bundle, gap: float, *, mirrored: bool) -> Rod:
        """The cylinder as a rod that stays straight.

        Args:
            groove: On whose left flank it begins.
            kind: Of groove.
            bundle: The fibres.
            gap: Between it and the flank [m].
            mirrored: Whether left is right.

        Returns:
            The rod.
        """
        start = OFFSETS[kind] if self.start is None else self.start
        y, z = groove.ramp(start, self.radius + gap)
        return self._core(bundle, (0.0, y, -z if mirrored else z)).rod

    def supports(self, rod: int, bundle: Bundle, advance: float) -> tuple[Support, ...]:
        """What keeps it along X.

        Args:
            rod: Its number.
            bundle: The fibres.
            advance: How far fibres and roller go along X, and it with them, until the time ends [m].

        Returns:
            Supports.
        """
        along = Prescribed("start", (advance, None, None), rod=rod)
        return (*self._core(bundle, (0.0, 0.0, 0.0)).supports(rod), along)

    def _core(self, bundle: Bundle, start: Vector) -> Core:
        """The cylinder, which a line load of 1 N/m puts out of line by 1e-6 of its radius at most."""
        radius, load = self.radius, LOAD * bundle.length
        assert bundle.section.rhoA is not None
        density = self.fibres * bundle.section.rhoA / (pi * radius**2)
        E = load * bundle.length**3 / (12.0 * BENDS * radius) / (0.25 * pi * radius**4)
        return Core(start, (1.0, 0.0, 0.0), radius, bundle.length, density, E, free=("x", "y", "z", "roll"))


AnyCore = FixedCore | RollingCore
