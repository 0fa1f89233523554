"""Straight columns: four end conditions, with and without stretch and shear, and under their own weight."""

from __future__ import annotations

from typing import TYPE_CHECKING

from dolfinrod.scene import Clamp, Gravity, Guide, Pin, PointForce, Rod, Scene, Section
from verification.eigencase import AtRest, Eigencase, Path
from verification.references.scalar import scalar

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["CASES", "ENDS", "KIRCHHOFF", "column", "heavy"]

KIRCHHOFF = Section(GJ=1.0 / 1.3, EI=1.0, rigid={"shear", "extension"})
FLEXIBLE = Section(EA=1200.0, GA=500.0, GJ=1.0 / 1.3, EI=1.0)
SLIDING = Guide(at="end", free={"x", "rx", "ry", "rz"})
# The far end slides along the axis.
ENDS = {
    "PP": ("pinned, pinned", (Pin(at="start"), SLIDING)),
    "CF": ("clamped, free", (Clamp(at="start"),)),
    "CC": ("clamped, clamped", (Clamp(at="start"), Guide(at="end", free={"x"}))),
    "CP": ("clamped, pinned", (Clamp(at="start"), SLIDING)),
}


def standing(ends: str, section: Section) -> Callable[[float], Scene]:
    """Unit column along x under a dead force along its axis."""

    def scene(P: float) -> Scene:
        rod = Rod.straight(length=1.0, section=section)
        return Scene(rods=[rod], supports=ENDS[ends][1], loads=[PointForce((-P, 0.0, 0.0), at="end")])

    return scene


def column(ends: str, *, flexible: bool = False) -> Eigencase:
    """Euler's column of round section, EI = L = 1.

    Args:
        ends: "PP", "CF", "CC" or "CP".
        flexible: With EA = 1200 and GA = 500 (Haringx's law); its critical load lies on a path of compression.

    Returns:
        The case.
    """
    known = "F1-Pcr-EA1200.0-GA500.0" if flexible else "F1-Pcr-EAinf-GAinf"
    words = "EA = 1200, GA = 500 EI/L²" if flexible else "inextensible"
    return Eigencase(
        name=f"column-{ends}" + ("-flexible" if flexible else ""),
        title=f"Column, {ENDS[ends][0]}, {words}",
        family="columns",
        quantity="P L²/EI",
        scene=standing(ends, FLEXIBLE if flexible else KIRCHHOFF),
        analysis=Path() if flexible else AtRest(),
        reference=scalar(known, f"P_{ends}"),
        multiplicity=2,
        models=("continuum",) if flexible else ("continuum", "discrete"),
    )


def heavy() -> Eigencase:
    """Column that stands clamped on its foot and buckles under its own weight (Greenhill 1881)."""

    def scene(weight: float) -> Scene:
        section = Section(GJ=1.0, EI=1.0, rhoA=1.0, rigid={"shear", "extension"})
        rod = Rod.straight(length=1.0, section=section, direction=(0.0, 0.0, 1.0))
        return Scene(rods=[rod], supports=[Clamp(at="start")], loads=[Gravity((0.0, 0.0, -weight))])

    return Eigencase(
        name="column-heavy",
        title="Column under its own weight, clamped, free",
        family="columns",
        quantity="w L³/EI",
        scene=scene,
        analysis=Path(),
        reference=scalar("J3-greenhill", "wL3_EI"),
        multiplicity=2,
    )


CASES = (*map(column, ENDS), *(column(ends, flexible=True) for ends in ENDS), heavy())
