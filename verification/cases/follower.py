"""Cantilever under a tip force that turns with the tip section: P L²/EI = 1 to 20, and Argyris and Symeonidis's."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import Clamp, FollowerForce, Rod, Scene, Section
from verification.case import Case
from verification.cases.elastica import RIGID, in_plane
from verification.references import follower, tabulated

if TYPE_CHECKING:
    from collections.abc import Callable

    from verification.case import Pose

__all__ = ["CASES", "inextensible", "shearable"]

LOADS = (1.0, 2.0, 5.0, 10.0, 20.0)
FORCES = (10e3, 50e3, 100e3, 130e3)
LENGTH = 100.0
# E = 4.2e8, unit area, I = 1/12; torsion, which plane problems never use, at ν = 0.3.
ARGYRIS = Section(EA=4.2e8, GA=1.61538e8, GJ=3.5e7 / 1.3, EI=3.5e7)


def loaded(force: float, section: Section, length: float) -> Callable[[Pose], Scene]:
    """Cantilever along x with a force along d2 of its tip section, y at first."""

    def scene(pose: Pose) -> Scene:
        x, y = pose.vector(1.0, 0.0), pose.vector(0.0, 1.0)
        rod = Rod.straight(length=length, section=section, start=pose.start(length), direction=x, d2=y)
        load = FollowerForce((0.0, force, 0.0), at="end")
        return Scene(rods=[rod], supports=[Clamp(at="start")], loads=[load])

    return scene


def inextensible(alpha: float) -> Case:
    """Tip force P L²/EI = α that stays normal to the rod, its shape by Jacobi's functions.

    Args:
        alpha: 1, 2, 5, 10 or 20.

    Returns:
        The case.
    """
    return Case(
        name=f"follower-{alpha:g}",
        title=f"Follower tip force, PL²/EI = {alpha:g}, inextensible",
        family="follower",
        scene=loaded(alpha, RIGID, 1.0),
        reference=tabulated(f"C1-inext-alpha{alpha:g}"),
        length=1.0,
        centreline=lambda s: in_plane(follower(alpha, s)),
    )


def shearable(force: float) -> Case:
    """Argyris and Symeonidis's cantilever as a Simo–Reissner rod; the force stays normal to the section.

    Args:
        force: 10e3, 50e3, 100e3 or 130e3 [N].

    Returns:
        The case.
    """
    thousands = np.rint(force / 1e3)
    return Case(
        name=f"follower-{thousands:g}k-shear",
        title=f"Follower tip force {thousands:g} kN, Argyris–Symeonidis, Simo–Reissner",
        family="follower",
        scene=loaded(force, ARGYRIS, LENGTH),
        reference=tabulated(f"C2-SR-P{thousands:g}k"),
        length=LENGTH,
        models=("continuum",),
    )


CASES = (*map(inextensible, LOADS), *map(shearable, FORCES))
