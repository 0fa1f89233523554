"""Cantilever under a dead tip force, P L²/EI = 0.2 to 10 and beyond."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import Clamp, PointForce, Rod, Scene, Section
from verification.case import Case
from verification.references import cantilever, elastica, tabulated

if TYPE_CHECKING:
    from collections.abc import Callable

    from verification.case import Array, Pose

__all__ = [
    "CASES",
    "RIGID",
    "circular",
    "inextensible",
    "isotropic",
    "loaded",
    "shear_rigid",
    "shearable",
    "slender",
    "straight",
]

LOADS = (0.2, 0.4, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0)
# The loads at which stretch and shear are compared.
FEW = (1.0, 2.0, 5.0, 10.0)
# L/h → Poisson's ratio and shear factor of the tabulated rectangular sections, and their loads.
RECTANGLES = {10.0: (0.3, 5.0 / 6.0), 5.0: (0.0, 1.0)}
SHEARED = (0.4, 1.0, 4.0, 10.0)
# Inextensible, unshearable, EI = L = 1; torsion of a circle at ν = 0.3, which plane problems never use.
RIGID = Section(GJ=1.0 / 1.3, EI=1.0, rigid={"shear", "extension"})


def circular(slenderness: float) -> Section:
    """Solid circle with ν = 0.3 in units of EI and L.

    EA = 16 (L/d)² EI/L², GA = 0.9 EA/2.6, GJ = EI/1.3.

    Args:
        slenderness: L/d.

    Returns:
        The section.
    """
    EA = 16.0 * slenderness**2
    return Section(EA=EA, GA=0.9 * EA / 2.6, GJ=1.0 / 1.3, EI=1.0)


def loaded(alpha: float, section: Section) -> Callable[[Pose], Scene]:
    """Cantilever along x with a dead force along y."""

    def scene(pose: Pose) -> Scene:
        return Scene(
            rods=[straight(section, pose)],
            supports=[Clamp(at="start")],
            loads=[PointForce(pose.vector(0.0, alpha), at="end")],
        )

    return scene


def straight(section: Section, pose: Pose) -> Rod:
    """Unit rod along the pose's x with d2 along its y."""
    x, y = pose.vector(1.0, 0.0), pose.vector(0.0, 1.0)
    return Rod.straight(length=1.0, section=section, start=pose.start(1.0), direction=x, d2=y)


def inextensible(alpha: float) -> Case:
    """The elastica, its tip by elliptic integrals, its shape by Jacobi's functions."""
    reference = tabulated(f"A1-inext-alpha{alpha:g}") if alpha in LOADS else cantilever(alpha, EA=np.inf, GA=np.inf)
    return Case(
        name=f"elastica-{alpha:g}",
        title=f"Elastica, PL²/EI = {alpha:g}, inextensible",
        family="elastica",
        scene=loaded(alpha, RIGID),
        reference=reference,
        length=1.0,
        centreline=(lambda s: in_plane(elastica(alpha, s))) if alpha <= 100.0 else None,
    )


def isotropic(alpha: float, EA: float = 1e4) -> Case:
    """EA = GA: the elastica plus the uniform shift P s/EA along the load."""
    shift = alpha / EA
    rigid = inextensible(alpha)
    return replace(
        rigid,
        name=f"elastica-{alpha:g}-isotropic",
        title=f"Elastica, PL²/EI = {alpha:g}, EA = GA = 10⁴ EI/L²",
        scene=loaded(alpha, Section(EA=EA, GA=EA, GJ=1.0 / 1.3, EI=1.0)),
        reference=tabulated(
            f"A1-inext-alpha{alpha:g}", shift=(0.0, shift, 0.0), why=f"EA = GA: exact shift P L/EA = {shift:g}"
        ),
        models=("continuum",),
        centreline=lambda s: in_plane(elastica(alpha, s)) + np.outer(s, (0.0, shift, 0.0)),
    )


def shearable(alpha: float, slenderness: float = 10.0) -> Case:
    """Simo–Reissner rod of rectangular section: ν = 0.3, shear factor 5/6, or, for L/h = 5, ν = 0 without one.

    Args:
        alpha: Load P L²/EI.
        slenderness: L/h, 10 or 5.

    Returns:
        The case.
    """
    poisson, factor = RECTANGLES[slenderness]
    EA = 12.0 * slenderness**2
    GA = factor * EA / (2.0 * (1.0 + poisson))
    known = f"A2-SR-alpha{alpha:g}-Lh{slenderness:g}-nu{poisson}"
    return Case(
        name=f"elastica-{alpha:g}-shear" + ("" if slenderness == 10.0 else f"-{slenderness:g}"),
        title=f"Elastica, PL²/EI = {alpha:g}, Simo–Reissner, L/h = {slenderness:g}",
        family="elastica",
        scene=loaded(alpha, Section(EA=EA, GA=GA, GJ=1.0, EI=1.0)),
        reference=tabulated(known) if alpha in SHEARED else cantilever(alpha, EA=EA, GA=GA),
        length=1.0,
        models=("continuum",),
    )


def slender(alpha: float, slenderness: float) -> Case:
    """Circular section of a given L/d."""
    section = circular(slenderness)
    return Case(
        name=f"elastica-{alpha:g}-circle-{slenderness:g}",
        title=f"Elastica, PL²/EI = {alpha:g}, circle, L/d = {slenderness:g}",
        family="elastica",
        scene=loaded(alpha, section),
        reference=cantilever(alpha, EA=section.EA, GA=section.GA[0]),
        length=1.0,
        models=("continuum",),
    )


def shear_rigid(alpha: float, slenderness: float) -> Case:
    """Circular section of a given L/d that cannot shear, as the discrete model poses it."""
    EA = circular(slenderness).EA
    return replace(
        slender(alpha, slenderness),
        name=f"elastica-{alpha:g}-circle-{slenderness:g}-unshearable",
        title=f"Elastica, PL²/EI = {alpha:g}, circle, L/d = {slenderness:g}, unshearable",
        scene=loaded(alpha, Section(EA=EA, GJ=1.0 / 1.3, EI=1.0, rigid={"shear"})),
        reference=cantilever(alpha, EA=EA, GA=np.inf),
        models=("continuum", "discrete"),
    )


def in_plane(points: Array) -> Array:
    """Points (n, 2) with z = 0."""
    return np.column_stack([points, np.zeros(len(points))])


CASES = (
    *map(inextensible, LOADS),
    *map(isotropic, FEW),
    *map(shearable, sorted({*FEW, *SHEARED})),
    *(shearable(alpha, 5.0) for alpha in SHEARED),
)
