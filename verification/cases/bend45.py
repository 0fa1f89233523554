"""Bathe and Bolourchi: an eighth of a circle, bent out of its plane by 300 and 600."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import Clamp, PointForce, Rod, Scene, Section
from verification.case import Case
from verification.references import tabulated

if TYPE_CHECKING:
    from verification.case import Pose

__all__ = ["CASES", "bend", "shear_corrected", "st_venant"]

RADIUS, ANGLE = 100.0, np.pi / 4
LENGTH = RADIUS * ANGLE
FORCES = (300.0, 600.0)
# Unit square, E = 1e7, ν = 0, G = E/2 without shear factor, polar torsion constant 1/6.
SIMO_REISSNER = Section(EA=1e7, GA=5e6, GJ=1e7 / 12, EI=1e7 / 12)
KIRCHHOFF = Section(GJ=1e7 / 12, EI=1e7 / 12, rigid={"shear", "extension"})
# The same with the shear factor 5/6, and with St-Venant's torsion constant 0.1406 besides.
CORRECTED = Section(EA=1e7, GA=5e6 * 5.0 / 6.0, GJ=1e7 / 12, EI=1e7 / 12)
ST_VENANT = Section(EA=1e7, GA=5e6 * 5.0 / 6.0, GJ=702885.0705, EI=1e7 / 12)


def bend(force: float, *, kirchhoff: bool = False) -> Case:
    """Arc in the x-y plane with a dead tip force along z.

    Args:
        force: 300 or 600 [N].
        kirchhoff: Without shear and extension, as the discrete model poses it.

    Returns:
        The case.
    """
    if kirchhoff:
        return posed(force, KIRCHHOFF, "K-J1_6", "kirchhoff", "Kirchhoff", models=("continuum", "discrete"))
    return posed(force, SIMO_REISSNER, "SR-J1_6", "", "Simo–Reissner")


def shear_corrected(force: float) -> Case:
    """The bend with the shear factor 5/6; argument and return as for `bend`."""
    return posed(force, CORRECTED, "SR-J1_6-ks", "shear-factor", "Simo–Reissner, shear factor 5/6")


def st_venant(force: float) -> Case:
    """The bend with St-Venant's torsion constant, as Ibrahimbegović must have used it; as for `bend`."""
    return posed(force, ST_VENANT, "SR-JSV", "st-venant", "Simo–Reissner, St-Venant torsion")


def posed(
    force: float, section: Section, known: str, suffix: str, words: str, models: tuple[str, ...] = ("continuum",)
) -> Case:
    """The arc with one of its sections.

    Args:
        force: 300 or 600 [N].
        section: Its stiffness.
        known: Of the id under which it is tabulated.
        suffix: Of the name.
        words: For the title.
        models: That pose it.

    Returns:
        The case.
    """

    def scene(pose: Pose) -> Scene:
        arc = Rod.arc(
            radius=RADIUS,
            angle=ANGLE,
            section=section,
            start=pose.start(LENGTH),
            direction=pose.vector(1.0, 0.0),
            towards=pose.vector(0.0, 1.0),
        )
        load = PointForce(pose.vector(0.0, 0.0, force), at="end")
        return Scene(rods=[arc], supports=[Clamp(at="start")], loads=[load])

    return Case(
        name="-".join(filter(None, (f"bend45-{force:g}", suffix))),
        title=f"45° bend, force {force:g}, {words}",
        family="bend45",
        scene=scene,
        reference=tabulated(f"D-{known}-F{force:g}"),
        length=LENGTH,
        models=models,
        planar=False,
    )


CASES = (
    *map(bend, FORCES),
    *(bend(force, kirchhoff=True) for force in FORCES),
    *map(shear_corrected, FORCES),
    *map(st_venant, FORCES),
)
