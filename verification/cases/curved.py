"""A helical rod whose section turns along it, bent and twisted further by a dead force and moment at its tip.

No two stiffnesses are equal and no plane holds anything: κ₀, pretwist, EI2 against EI3, GJ and EA against GA all enter
the position of the tip.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from dolfinrod.scene import Clamp, PointForce, PointMoment, Rod, Scene, Section
from verification.case import UPRIGHT, Case
from verification.references import rod_problem, solved

if TYPE_CHECKING:
    from collections.abc import Iterable

    from verification.case import Pose

__all__ = ["CASES", "coil", "helix"]

LENGTH = 2.0
NAMES = {0: ("", "Simo–Reissner"), 1: ("-unshearable", "unshearable"), 2: ("-kirchhoff", "Kirchhoff")}


def helix(section: Section, pose: Pose) -> Rod:
    """Rod of 2 m with κ₀ = (0.4, 0.3, 1.2)/m and 1.5 rad/m of pretwist, along x with d2 = y at its start."""
    return Rod.curved(
        LENGTH,
        section,
        (0.4, 0.3, 1.2),
        start=pose.start(LENGTH),
        direction=pose.vector(1.0, 0.0),
        d2=pose.vector(0.0, 1.0),
        pretwist=1.5,
    )


def coil(load: float, rigid: Iterable[str] = ()) -> Case:
    """Helix clamped at its start.

    Args:
        load: Factor of the tip force (0.4, −0.8, 1.2) N and the tip moment (0.5, −0.3, 0.4) N m.
        rigid: Strains that are exactly zero: none, shear, or shear and extension.

    Returns:
        The case.
    """
    section = Section(EA=300.0, GA=(90.0, 150.0), GJ=0.6, EI=(1.0, 2.5), rigid=rigid)
    suffix, words = NAMES[len(section.rigid)]
    name = f"coil-{load:g}{suffix}"

    def scene(pose: Pose) -> Scene:
        force, moment = (0.4, -0.8, 1.2), (0.5, -0.3, 0.4)
        return Scene(
            rods=[helix(section, pose)],
            supports=[Clamp(at="start")],
            loads=[
                PointForce(pose.vector(*(load * f for f in force)), at="end"),
                PointMoment(pose.vector(*(load * m for m in moment)), at="end"),
            ],
        )

    return Case(
        name=name,
        title=f"Pretwisted helix, load {load:g}, {words}",
        family="curved",
        scene=scene,
        reference=solved(name, rod_problem(scene(UPRIGHT)), LENGTH),
        length=LENGTH,
        models=("continuum", "discrete") if section.rigid else ("continuum",),
        planar=False,
    )


CASES = (coil(1.0), coil(2.0), coil(2.0, {"shear"}), coil(2.0, {"shear", "extension"}))
