"""Extreme numbers: slenderness, stiffness ratios, units, meshes, degrees, supports that barely hold."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from dolfinrod.scene import Clamp, Guide, LineForce, Pin, PointForce, Rod, Scene, Section
from verification.case import Case, Pose
from verification.cases import bend45, elastica
from verification.hardcase import HardCase, Refined, known
from verification.references import cantilever

if TYPE_CHECKING:
    from dolfinrod.scene import Load

__all__ = ["CASES"]

LARGE = 10.0


def slenderness() -> tuple[HardCase, ...]:
    """Elastica of round section, L/d = 10 to 10⁶, with shear for the continuum model and without for both."""
    powers = [10.0**k for k in range(1, 7)]
    sheared = (known(elastica.slender(LARGE, r), "slenderness") for r in powers)
    return (*sheared, *(known(elastica.shear_rigid(LARGE, r), "slenderness") for r in powers))


def flat(ratio: float) -> HardCase:
    """Cantilever with EI2 = 1 and EI3 = ratio, bent about both axes and twisted by a force aslant."""

    def scene() -> Scene:
        section = Section(GJ=1.0 / 1.3, EI=(1.0, ratio), rigid={"shear", "extension"})
        rod = Rod.straight(length=1.0, section=section)
        return Scene(rods=[rod], supports=[Clamp(at="start")], loads=[PointForce((0.0, 2.0, 3.0), at="end")])

    return HardCase(f"ratio-{ratio:g}", "stiffness ratio", f"Cantilever, EI₃/EI₂ = {ratio:g}", scene, Refined())


def in_units(length: float, EI: float) -> HardCase:
    """Elastica with L/d = 200 in other units of length and of force."""
    unit = EI / length**2
    section = elastica.circular(200.0)
    scaled = Section(EA=section.EA * unit, GJ=EI / 1.3, EI=EI, rigid={"shear"})
    tip = cantilever(LARGE, EA=section.EA, GA=float("inf"))
    x, y, z = (length * v for v in tip.value)

    def scene(pose: Pose) -> Scene:
        along, across = pose.vector(1.0, 0.0), pose.vector(0.0, 1.0)
        rod = Rod.straight(length=length, section=scaled, start=pose.start(length), direction=along, d2=across)
        load = PointForce(pose.vector(0.0, LARGE * unit), at="end")
        return Scene(rods=[rod], supports=[Clamp(at="start")], loads=[load])

    case = Case(
        name=f"units-{length:g}-{EI:g}",
        title=f"Elastica, L = {length:g} m, EI = {EI:g} N m²",
        family="elastica",
        scene=scene,
        reference=replace(tip, value=(x, y, z)),
        length=length,
    )
    return known(case, "units")


def meshes() -> tuple[HardCase, ...]:
    """The same load on one element and on ten thousand."""
    found = []
    # One cubic, two straight elements: their discretisation error is a few hundredths.
    for n, coarse, limit in ((1, 4, 5e-2), (2, 8, 2e-2), (4, 16, 1e-2), (100, 100, 1e-2), (1000, 1000, 1e-2)):
        case = elastica.inextensible(LARGE)
        found.append(
            known(
                case,
                "elements",
                f"Elastica on {n} elements",
                elements=n,
                discrete=coarse,
                name=f"mesh-{n}",
                limit=limit,
            )
        )
    ten = known(
        elastica.inextensible(LARGE),
        "elements",
        "Elastica on 10⁴ elements",
        elements=10000,
        discrete=10000,
        name="mesh-10000",
    )
    return (*found, ten)


def degrees() -> tuple[HardCase, ...]:
    """Degrees 1 to 5, in a plane and in space."""
    continuum = ("continuum",)
    plane = [
        replace(
            known(elastica.inextensible(LARGE), "degree", f"Elastica, P{k}", degree=k, name=f"degree-{k}"),
            models=continuum,
        )
        for k in range(1, 6)
    ]
    space = [
        known(bend45.bend(600.0), "degree", f"45° bend, force 600, P{k}", degree=k, name=f"degree-{k}-bend")
        for k in range(1, 6)
    ]
    return (*plane, *space)


def barely_held(gap: float) -> HardCase:
    """Cantilever in space whose clamp is a sleeve of a small length: two pins and a hold against the spin."""

    def scene() -> Scene:
        section = Section(GJ=1.0 / 1.3, EI=1.0, rigid={"shear", "extension"})
        rod = Rod.straight(length=1.0, section=section)
        supports = [Guide(at="start", free={"ry", "rz"}), Guide(at=gap, free={"x", "rx", "ry", "rz"})]
        return Scene(rods=[rod], supports=supports, loads=[PointForce((0.0, 2.0, 1.0), at="end")])

    return HardCase(f"sleeve-{gap:g}", "nearly singular supports", f"Two pins {gap:g} L apart", scene, Refined())


def hanging(stiffness: float) -> HardCase:
    """Rod that hangs from a pin and is pushed aside: nothing but its weight holds it."""

    def scene() -> Scene:
        section = Section(GJ=stiffness, EI=stiffness, rigid={"shear", "extension"})
        rod = Rod.straight(length=1.0, section=section)
        loads: list[Load] = [LineForce((0.0, -1.0, 0.0)), PointForce((0.3, 0.0, 0.0), at="end")]
        return Scene(rods=[rod], supports=[Pin(at="start")], loads=loads)

    title = f"Rod laid out level on a pin falls and hangs, EI = {stiffness:g} w L³"
    return HardCase(f"hanging-{stiffness:g}", "nearly singular supports", title, scene, Refined(at=0.5))


def softly_held(EI: float) -> HardCase:
    """A rod almost without bending stiffness, clamped, pulled straight across its axis."""

    def scene() -> Scene:
        section = Section(EA=1e4, GJ=EI, EI=EI, rigid={"shear"})
        rod = Rod.straight(length=1.0, section=section)
        return Scene(rods=[rod], supports=[Clamp(at="start")], loads=[PointForce((0.3, 1.0, 0.2), at="end")])

    title = f"Cantilever pulled aside by {1 / EI:g} EI/L²"
    return HardCase(f"soft-{EI:g}", "nearly singular supports", title, scene, Refined(elements=100))


CASES = (
    *slenderness(),
    *map(flat, (1.0, 10.0, 100.0, 1e3, 1e4)),
    *(in_units(unit, 1.0) for unit in (1e-12, 1e-6, 1e6, 1e12)),
    *(in_units(1.0, EI) for EI in (1e-12, 1e-6, 1e6, 1e12)),
    in_units(1e-6, 1e-12),
    *meshes(),
    *degrees(),
    *map(barely_held, (1e-1, 1e-2, 1e-4)),
    *map(hanging, (1.0, 1e-2)),
    *map(softly_held, (1e-2, 1e-4)),
)
