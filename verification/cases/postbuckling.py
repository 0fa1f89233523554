"""Columns on their buckled branch: pushed aside, loaded beyond the Euler load, then let go."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import Clamp, Pin, PointForce, Prescribed, Scene, Section
from verification.case import Case
from verification.cases.elastica import straight
from verification.references.reference import Reference
from verification.references.scalar import column_tip, parameter

if TYPE_CHECKING:
    from collections.abc import Callable

    from dolfinrod.result import Result
    from verification.case import Array, Pose

__all__ = ["CASES", "buckled", "shortened"]

EULER = np.pi**2 / 4
# Stiffer across than in the plane: a round column, once let go, turns freely about its axis, and round-off would choose
# among a whole circle of equilibria.
ACROSS = (4.0, 1.0)
FIRM = Section(GJ=1.0 / 1.3, EI=ACROSS, rigid={"shear", "extension"})
SOFT = Section(EA=1200.0, GA=500.0, GJ=1.0 / 1.3, EI=ACROSS)
LONG = Section(EA=1e8, GJ=1.0 / 1.3, EI=ACROSS, rigid={"shear"})
STAND_IN = (
    "EA = 10⁸ EI/L² stands for a column that does not stretch, between held ends a mechanism without a unique tension; "
    "it moves the middle by 2 to 5 parts in 10⁸, however fine the mesh."
)
# The load comes while a force holds the column aside, which then goes.
LOADED = ((0.0, 0.0), (0.25, 0.0), (0.75, 1.0), (1.0, 1.0))
ASIDE = ((0.0, 0.0), (0.25, 1.0), (0.75, 1.0), (1.0, 0.0))
PUSH = 0.05


def pushed(load: float, section: Section) -> Callable[[Pose], Scene]:
    """Cantilever along x under a force along −x, a little force along y on the way."""

    def scene(pose: Pose) -> Scene:
        return Scene(
            rods=[straight(section, pose)],
            supports=[Clamp(at="start")],
            loads=[
                PointForce(pose.vector(-load, 0.0), at="end", history=LOADED),
                PointForce(pose.vector(0.0, PUSH * load), at="end", history=ASIDE),
            ],
        )

    return scene


def buckled(known: str, *, elastic: bool = False) -> Case:
    """Column, clamped and free, at a multiple of its Euler load.

    Args:
        known: Id of the tabulated state.
        elastic: With EA = 1200 and GA = 500, as the state was tabulated.

    Returns:
        The case.
    """
    ratio = parameter(known, "ratio" if elastic else "P_over_Pcr")
    load = parameter(known, "P") if elastic else ratio * EULER
    return Case(
        name=f"buckled-{ratio:.4g}" + ("-elastic" if elastic else ""),
        title=f"Buckled column, P = {ratio:.4g} P_cr, " + ("EA = 1200, GA = 500" if elastic else "inextensible"),
        family="postbuckling",
        scene=pushed(load, SOFT if elastic else FIRM),
        reference=column_tip(known),
        length=1.0,
        models=("continuum",) if elastic else ("continuum", "discrete"),
    )


def shortened(known: str) -> Case:
    """Column between pins whose ends approach each other by a given way, pushed aside until they have.

    By symmetry the middle stays level; held so, the column does not spin about itself.

    Args:
        known: Id of the tabulated state.

    Returns:
        The case; the middle is read.
    """
    u, w = parameter(known, "u_pp"), parameter(known, "w_pp")
    tip = column_tip_of(known, (0.5 * (1.0 - u), w, 0.0))

    def scene(pose: Pose) -> Scene:
        x, y = pose.vector(-u, 0.0), pose.vector(0.0, PUSH * np.pi**2)
        return Scene(
            rods=[straight(LONG, pose)],
            supports=[
                Pin(at="start"),
                Prescribed(at=0.5, rotation=(0.0, 0.0, 0.0)),
                Prescribed(at="end", displacement=x, history=LOADED),
            ],
            loads=[PointForce(y, at=0.5, history=ASIDE)],
        )

    return Case(
        name=f"shortened-{u:.3g}",
        title=f"Column between pins that approach by {u:.3g} L",
        family="postbuckling",
        scene=scene,
        reference=tip,
        length=1.0,
        quantity=middle,
        quantity_name="middle of the column",
        note=STAND_IN,
    )


def column_tip_of(known: str, value: tuple[float, float, float]) -> Reference:
    """The provenance of a tabulated state with another of its places."""
    found = column_tip(known)
    return Reference(known, value, found.method, found.source, found.digits_trusted, found.agreement)


def middle(result: Result) -> Array:
    """Centreline at half the length."""
    return np.asarray(result.rods[0].at(0.5)[-1])


CASES = (
    *map(buckled, ("F2a-alpha40", "F2a-alpha80", "F2a-alpha120")),
    *(buckled(known, elastic=True) for known in ("F3-SRpost-1.05-EA1200", "F3-SRpost-1.5-EA1200")),
    *map(shortened, ("F2-post-1.152", "F2-post-1.518")),
)
