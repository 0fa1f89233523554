"""Long ways: huge loads at once, loads that come and go, many turns of bending and of twist, rods that close."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import Clamp, Guide, PointForce, PointMoment, Prescribed, Rod, Scene, Section, Steady
from verification.case import SKEW
from verification.cases import bend45, elastica, follower, helix, rollup
from verification.hardcase import HardCase, Place, known

if TYPE_CHECKING:
    from dolfinrod.scene import Load, Support
    from verification.case import Case

__all__ = ["CASES"]

ROUND = Section(GJ=1.0 / 1.3, EI=1.0, rigid={"shear", "extension"})
THERE_AND_BACK = ((0.0, 0.0), (0.5, 1.0), (1.0, 0.0))
TO_AND_FRO = ((0.0, 0.0), (0.25, 1.0), (0.75, -1.0), (1.0, 0.0))
TURNS = 20


def reversed_load(case: Case, history: tuple[tuple[float, float], ...], words: str, elements: int = 16) -> HardCase:
    """The loads of a case put on and taken off: the rod has to be where it was."""

    def scene() -> Scene:
        posed = case.scene(SKEW)
        return replace(posed, loads=[replace(load, history=history) for load in posed.loads])

    rod = case.scene(SKEW).rods[0]
    x, y, z = rest(rod)
    return HardCase(
        name=f"reversed-{case.name}-{len(history)}",
        group="reversed loads",
        title=f"{case.title}: {words}",
        scene=scene,
        check=Place((x, y, z), rod.length, "stress free again"),
        elements=elements,
        discrete=5 * elements,
        models=case.models,
        limit=1e-6,
    )


def rest(rod: Rod) -> tuple[float, float, float]:
    """Tip of a rod that is stress free."""
    r = rod.shape.centerline(np.array([rod.length]))[0]
    return float(r[0]), float(r[1]), float(r[2])


def wrung(tension: float, *, by_moment: bool) -> HardCase:
    """Rod twisted by twenty turns, straight under a tension that keeps it from writhing, or without and unstable.

    A long straight rod is stable where M² < 4 EI T (Greenhill 1883); 20 turns are M = 40π GJ/L = 96.7 EI/L.
    """
    angle = 2.0 * np.pi * TURNS

    def scene() -> Scene:
        rod = Rod.straight(length=1.0, section=ROUND)
        loads: list[Load] = [PointForce((tension, 0.0, 0.0), at="end", history=Steady())] if tension else []
        supports: list[Support]
        if by_moment:
            supports = [Clamp(at="start"), Guide(at="end", free={"x", "rx"})]
            loads.append(PointMoment((ROUND.GJ * angle, 0.0, 0.0), at="end"))
        else:
            turned = Prescribed(at="end", displacement=(None, 0.0, 0.0), rotation=(angle, 0.0, 0.0))
            supports = [Clamp(at="start"), turned]
        return Scene(rods=[rod], supports=supports, loads=loads)

    by = "moment" if by_moment else "prescribed rotation"
    return HardCase(
        name=f"twist-{TURNS}-{by.split()[0]}-{tension:g}",
        group="twenty turns of twist",
        title=f"Twenty turns of twist by a {by}, tension {tension:g} EI/L²",
        scene=scene,
        check=Place((1.0, 0.0, 0.0), 1.0, "straight"),
        elements=64,
        discrete=160,
        unstable=tension == 0.0,
    )


def closed_by_rotation() -> HardCase:
    """The end of a cantilever turned by 2π and left free otherwise: a circle.

    A straight rod with a full turn of twist has its ends held alike; where GJ < EI it has less energy, and the circle
    gives way.
    """

    def scene() -> Scene:
        rod = Rod.straight(length=1.0, section=ROUND)
        turned = Prescribed(at="end", rotation=(0.0, 0.0, 2.0 * np.pi))
        return Scene(rods=[rod], supports=[Clamp(at="start"), turned])

    exact = Place((0.0, 0.0, 0.0), 1.0, "a full circle")
    return HardCase("closed-rotation", "rods that close", "End turned by 2π", scene, exact, unstable=True)


def opened() -> HardCase:
    """A stress-free ring, cut and clamped, unrolled straight by an end moment."""

    def scene() -> Scene:
        ring = Rod.arc(radius=1.0, angle=2.0 * np.pi, section=ROUND)
        return Scene(rods=[ring], supports=[Clamp(at="start")], loads=[PointMoment((0.0, 0.0, -1.0), at="end")])

    exact = Place((2.0 * np.pi, 0.0, 0.0), 2.0 * np.pi, "straight")
    return HardCase("opened-ring", "rods that close", "Ring unrolled by an end moment", scene, exact)


CASES = (
    known(elastica.inextensible(1000.0), "huge load at once"),
    known(elastica.inextensible(5000.0), "huge load at once"),
    known(elastica.slender(1000.0, 200.0), "huge load at once"),
    known(elastica.slender(5000.0, 2000.0), "huge load at once"),
    known(elastica.shear_rigid(1000.0, 200.0), "huge load at once"),
    known(follower.inextensible(20.0), "huge load at once"),
    known(follower.shearable(130e3), "huge load at once"),
    reversed_load(elastica.inextensible(10.0), THERE_AND_BACK, "there and back"),
    reversed_load(elastica.inextensible(10.0), TO_AND_FRO, "to and fro"),
    reversed_load(elastica.inextensible(100.0), TO_AND_FRO, "to and fro"),
    reversed_load(rollup.rolled(2.0), THERE_AND_BACK, "there and back"),
    reversed_load(bend45.bend(600.0, kirchhoff=True), THERE_AND_BACK, "there and back"),
    reversed_load(follower.inextensible(10.0), THERE_AND_BACK, "there and back"),
    reversed_load(helix.wound(0.2, kirchhoff=True), THERE_AND_BACK, "there and back", elements=32),
    *(wrung(tension, by_moment=m) for tension in (4000.0, 0.0) for m in (True, False)),
    *(
        known(
            rollup.rolled(turns), "rods that close", elements=int(8 * max(turns, 2.0)), discrete=int(20 * max(turns, 2))
        )
        for turns in (1.0, 2.0, 5.0, 10.0)
    ),
    closed_by_rotation(),
    opened(),
    *(
        known(helix.wound(f, kirchhoff=k), "many turns", elements=max(16, int(80 * f)), discrete=int(400 * f) + 40)
        for f in (0.2, 1.0)
        for k in (False, True)
    ),
)
