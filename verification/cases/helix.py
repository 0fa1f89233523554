"""Ibrahimbegović: a straight cantilever wound up to ten turns by a dead end moment, pulled out by a dead force."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import Clamp, PointForce, PointMoment, Rod, Scene, Section, Static
from verification.case import Case
from verification.references import tabulated

if TYPE_CHECKING:
    from collections.abc import Callable

    from verification.case import Pose

__all__ = ["BEYOND", "CASES", "wound"]

LENGTH, FORCE, MOMENT = 10.0, 50.0, 200.0 * np.pi
STIFFNESS = 1e4
SIMO_REISSNER = Section(EA=STIFFNESS, GA=STIFFNESS, GJ=100.0, EI=100.0)
KIRCHHOFF = Section(GJ=100.0, EI=100.0, rigid={"shear", "extension"})
FACTORS = (0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0)
# Load factors that are among all cases; the others take minutes together.
FEW = 2


def wound(factor: float, *, kirchhoff: bool = False, steps: int | None = None) -> Case:
    """A share of the moment 200π about z and of the force 50 along z, on the path that starts without load.

    With EA = GA a force F moves the section at s by F s/EA more than it moves a Kirchhoff rod: exactly, since its
    resultant is the same everywhere and the compliance the same in all directions.

    Args:
        factor: Of the load, one of those tabulated.
        kirchhoff: Without shear and extension, as the discrete model poses it.
        steps: Equal load steps; None: the whole load first.

    Returns:
        The case.
    """
    shift = factor * FORCE * LENGTH / STIFFNESS if kirchhoff else 0.0

    return Case(
        name=f"helix-{factor:g}" + ("-kirchhoff" if kirchhoff else ""),
        title=f"Helix, load factor {factor:g}, {'Kirchhoff' if kirchhoff else 'Simo–Reissner'}",
        family="helix",
        scene=loaded(factor, KIRCHHOFF if kirchhoff else SIMO_REISSNER, steps),
        reference=tabulated(
            "E-SR-F50",
            at=factor,
            shift=(0.0, 0.0, -shift),
            why=f"EA = GA: exact shift λ F L/EA = {shift:g}" if kirchhoff else "",
        ),
        length=LENGTH,
        models=("continuum", "discrete") if kirchhoff else ("continuum",),
        planar=False,
        turns=max(1, round(10.0 * factor)),
    )


def loaded(factor: float, section: Section, steps: int | None) -> Callable[[Pose], Scene]:
    """The cantilever along x under that share of its loads."""

    def scene(pose: Pose) -> Scene:
        rod = Rod.straight(
            length=LENGTH,
            section=section,
            start=pose.start(LENGTH),
            direction=pose.vector(1.0, 0.0),
            d2=pose.vector(0.0, 1.0),
        )
        return Scene(
            rods=[rod],
            supports=[Clamp(at="start")],
            loads=[
                PointForce(pose.vector(0.0, 0.0, factor * FORCE), at="end"),
                PointMoment(pose.vector(0.0, 0.0, factor * MOMENT), at="end"),
            ],
            motion=Static(steps=steps),
        )

    return scene


CASES = tuple(wound(factor, kirchhoff=k) for k in (False, True) for factor in FACTORS[:FEW])
BEYOND = tuple(
    wound(factor, kirchhoff=k, steps=round(100.0 * factor)) for k in (False, True) for factor in FACTORS[FEW:]
)
