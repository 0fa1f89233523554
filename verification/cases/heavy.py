"""Cantilever that sags under its own weight w: w L³/EI = 0.5 to 50."""

from __future__ import annotations

from typing import TYPE_CHECKING

from dolfinrod.scene import Clamp, LineForce, Scene, Section
from verification.case import Case
from verification.cases.elastica import RIGID, in_plane, straight
from verification.references import heavy, tabulated

if TYPE_CHECKING:
    from collections.abc import Callable

    from verification.case import Pose

__all__ = ["CASES", "inextensible", "shearable"]

WEIGHTS = (0.5, 1.0, 2.0, 5.0, 8.0, 10.0, 20.0, 50.0)
SHEARABLE = Section(EA=1200.0, GA=500.0, GJ=1.0 / 1.3, EI=1.0)


def loaded(beta: float, section: Section) -> Callable[[Pose], Scene]:
    """Cantilever along x with a dead force per reference length along −y."""

    def scene(pose: Pose) -> Scene:
        return Scene(
            rods=[straight(section, pose)],
            supports=[Clamp(at="start")],
            loads=[LineForce(pose.vector(0.0, -beta))],
        )

    return scene


def inextensible(beta: float) -> Case:
    """The heavy elastica, its shape by collocation.

    Args:
        beta: w L³/EI, one of 0.5, 1, 2, 5, 8, 10, 20 and 50.

    Returns:
        The case.
    """
    return Case(
        name=f"heavy-{beta:g}",
        title=f"Heavy cantilever, wL³/EI = {beta:g}, inextensible",
        family="heavy",
        scene=loaded(beta, RIGID),
        reference=tabulated(f"J1-heavy-beta{beta:g}"),
        length=1.0,
        centreline=lambda s: in_plane(heavy(beta, s)),
    )


def shearable(beta: float) -> Case:
    """Simo–Reissner rod with EA = 1200 and GA = 500 EI/L².

    Args:
        beta: w L³/EI, 5 or 20.

    Returns:
        The case.
    """
    section = SHEARABLE
    return Case(
        name=f"heavy-{beta:g}-shear",
        title=f"Heavy cantilever, wL³/EI = {beta:g}, Simo–Reissner",
        family="heavy",
        scene=loaded(beta, section),
        reference=tabulated(f"J2-heavySR-beta{beta:g}-EA1200"),
        length=1.0,
        models=("continuum",),
        centreline=lambda s: in_plane(heavy(beta, s, EA=section.EA, GA=section.GA[0])),
    )


CASES = (*map(inextensible, WEIGHTS), *map(shearable, (5.0, 20.0)))
