"""Loads that pass a critical point, and cables almost without bending stiffness on coarse meshes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import Clamp, Guide, Pin, PointForce, PointMoment, Prescribed, Rod, Scene, Section
from verification.case import UPRIGHT
from verification.cases import cable, postbuckling, spans
from verification.hardcase import HardCase, Place, Refined, known

if TYPE_CHECKING:
    from dolfinrod.scene import Load, Support

__all__ = ["CASES"]

ROUND = Section(GJ=1.0 / 1.3, EI=1.0, rigid={"shear", "extension"})
EULER = np.pi**2 / 4
PASS = "past a critical point"


def column(factor: float, lateral: float, check: Place | Refined, *, unstable: bool = False) -> HardCase:
    """Column, clamped and free, under a multiple of its Euler load and a part of that across."""

    def scene() -> Scene:
        P = factor * EULER
        load = PointForce((-P, lateral * P, 0.0), at="end")
        return Scene(rods=[Rod.straight(length=1.0, section=ROUND)], supports=[Clamp(at="start")], loads=[load])

    title = f"Column at {factor:g} P_cr, lateral load {lateral:g} P"
    return HardCase(f"column-{factor:g}-{lateral:g}", PASS, title, scene, check, unstable=unstable)


def strip(aside: float) -> HardCase:
    """Strip, EI3 = 20 EI2, at 1.3 times its lateral buckling load, with a little force aside or none."""

    def scene() -> Scene:
        section = Section(GJ=1.0, EI=(1.0, 20.0), rigid={"shear", "extension"})
        rod = Rod.straight(length=1.0, section=section)
        load = PointForce((0.0, -1.3 * 4.2748, 1.3 * 4.2748 * aside), at="end")
        return Scene(rods=[rod], supports=[Clamp(at="start")], loads=[load])

    title = f"Strip at 1.3 times its lateral buckling load, {aside:g} of it aside"
    return HardCase(f"strip-{aside:g}", PASS, title, scene, Refined(steps=50), unstable=aside == 0.0)


def arch(factor: float) -> HardCase:
    """Shallow arch, pinned at both ends, pressed down at its middle: it snaps through where the load is large."""

    def scene() -> Scene:
        section = Section(EA=1e4, GJ=1.0, EI=1.0, rigid={"shear"})
        rod = Rod.arc(
            radius=2.0,
            angle=0.5,
            section=section,
            direction=(np.cos(0.25), np.sin(0.25), 0.0),
            towards=(np.sin(0.25), -np.cos(0.25), 0.0),
        )
        held = Guide(at="start", free={"rz"}), Guide(at="end", free={"rz"})
        return Scene(rods=[rod], supports=held, loads=[PointForce((0.0, -factor, 0.0), at=0.5)])

    title = f"Shallow arch between hinges, middle pressed by {factor:g} EI/L²"
    return HardCase(f"arch-{factor:g}", PASS, title, scene, Refined(steps=1, at=0.5))


def writhing(turns: float) -> HardCase:
    """Rod between clamps that may approach, pushed aside a little, twisted far beyond 8.99 EI/L: it writhes."""

    def scene() -> Scene:
        rod = Rod.straight(length=1.0, section=ROUND)
        turned = Prescribed(at="end", displacement=(None, 0.0, 0.0), rotation=(2.0 * np.pi * turns, 0.0, 0.0))
        loads = [PointForce((30.0, 0.0, 0.0), at="end"), PointForce((0.0, 0.0, 0.1), at=0.45)]
        return Scene(rods=[rod], supports=[Clamp(at="start"), turned], loads=loads)

    title = f"Rod between clamps, pulled by 30 EI/L², twisted by {turns:g} turns"
    return HardCase(f"writhing-{turns:g}", PASS, title, scene, Refined(at=0.5, steps=50))


def moment_on_pins() -> HardCase:
    """A planar frame moment past lateral buckling: strip under a dead end moment about its stiff axis."""

    def scene() -> Scene:
        section = Section(GJ=1.0, EI=(1.0, 50.0), rigid={"shear", "extension"})
        rod = Rod.straight(length=1.0, section=section)
        loads: list[Load] = [PointMoment((0.0, 0.0, 4.0), at="end"), PointForce((0.0, 0.0, 0.01), at="end")]
        return Scene(rods=[rod], supports=[Clamp(at="start")], loads=loads)

    return HardCase("strip-moment", PASS, "Strip under an end moment about its stiff axis", scene, Refined(steps=50))


def sinking(sink: float) -> HardCase:
    """The arc on three supports of which one sinks; between its equilibria it can jump."""
    case = spans.settled(0.15)
    rod = case.scene(UPRIGHT)

    def scene() -> Scene:
        sunk = Prescribed(at=spans.PINS[0], displacement=(0.6 * sink, -sink, 0.0))
        supports: list[Support] = [Clamp(at="start"), sunk, Pin(at=spans.PINS[1]), Pin(at="end")]
        return Scene(rods=rod.rods, supports=supports, loads=rod.loads)

    title = f"Arc on a support that sinks by {sink:g} radii"
    return HardCase(f"sinking-{sink:g}", PASS, title, scene, Refined(at=0.4375, steps=50), elements=32, discrete=160)


CASES = (
    column(1.5, 1e-3, Refined(steps=50)),
    column(1.5, 1e-6, Refined(steps=50)),
    column(4.0, 1e-3, Refined(steps=50)),
    column(1.5, 0.0, Place((1.0, 0.0, 0.0), 1.0, "straight"), unstable=True),
    column(0.999, 1e-4, Refined(steps=50)),
    *(known(case, PASS) for case in postbuckling.CASES),
    strip(1e-3),
    strip(0.0),
    *map(arch, (20.0, 400.0)),
    *map(writhing, (2.0, 4.0)),
    moment_on_pins(),
    *map(sinking, (0.15, 0.25)),
    *(known(case, PASS) for case in spans.FAR),
    *(known(cable.hung(ratio, level=level), "nearly a cable") for ratio in (1e-5, 1e-6) for level in (False, True)),
    *(
        known(cable.spanning(ratio), "nearly a cable", elements=n, discrete=4 * n, name=f"spanning-{ratio:g}-{n}")
        for ratio in (1e-3, 1e-4, 1e-6)
        for n in (16, 64)
    ),
    # Here elements longer than the layer at a clamp, or nearly as long, have equilibria that no rod has.
    known(cable.spanning(1e-6), "nearly a cable", elements=64, discrete=256, degree=4, name="spanning-1e-06-64-P4"),
    known(cable.spanning(1e-5, level=True), "nearly a cable", elements=32, discrete=128, degree=4),
)
