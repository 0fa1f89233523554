"""45° bend of Bathe and Bolourchi: a quarter right angle of arc, bent out of its plane by 300 and 600."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import Clamp, PointForce, Rod, Scene, Section
from verification.case import Case
from verification.references import tabulated

if TYPE_CHECKING:
    from verification.case import Pose

__all__ = ["CASES", "bend"]

RADIUS, ANGLE = 100.0, np.pi / 4
# Unit square, E = 1e7, ν = 0, G = E/2 without shear factor, polar torsion constant 1/6.
SIMO_REISSNER = Section(EA=1e7, GA=5e6, GJ=1e7 / 12, EI=1e7 / 12)
KIRCHHOFF = Section(GJ=1e7 / 12, EI=1e7 / 12, rigid={"shear", "extension"})


def bend(force: float, *, kirchhoff: bool = False) -> Case:
    """Arc in the x-y plane with a dead tip force along z.

    Args:
        force: 300 or 600 [N].
        kirchhoff: Without shear and extension, as the discrete model poses it.

    Returns:
        The case.
    """
    section = KIRCHHOFF if kirchhoff else SIMO_REISSNER
    length = RADIUS * ANGLE

    def scene(pose: Pose) -> Scene:
        arc = Rod.arc(
            radius=RADIUS,
            angle=ANGLE,
            section=section,
            start=pose.start(length),
            direction=pose.vector(1.0, 0.0),
            towards=pose.vector(0.0, 1.0),
        )
        load = PointForce(pose.vector(0.0, 0.0, force), at="end")
        return Scene(rods=[arc], supports=[Clamp(at="start")], loads=[load])

    return Case(
        name=f"bend45-{force:g}" + ("-kirchhoff" if kirchhoff else ""),
        title=f"45° bend, force {force:g}, {'Kirchhoff' if kirchhoff else 'Simo–Reissner'}",
        family="bend45",
        scene=scene,
        reference=tabulated(f"D-{'K' if kirchhoff else 'SR'}-J1_6-F{force:g}"),
        length=length,
        models=("continuum", "discrete") if kirchhoff else ("continuum",),
        planar=False,
    )


CASES = (bend(300.0), bend(600.0), bend(300.0, kirchhoff=True), bend(600.0, kirchhoff=True))
