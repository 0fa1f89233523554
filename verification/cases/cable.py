"""Naturally straight rods that hang as cables do: the (elastic) catenary as EI/(w L³) falls to zero.

A rod with free ends tends to the catenary with EI, one with ends held level with √EI, the width of the layer in which
it bends there. The cable of weight w = 1 and unstretched length L = 1.2 spans d = 1 between ends of equal height.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import Clamp, LineForce, Pin, PointForce, Prescribed, Rod, Scene, Section
from verification.case import Case
from verification.cases.elastica import in_plane
from verification.references import Cable, Reference, catenary_tension

if TYPE_CHECKING:
    from collections.abc import Callable

    from dolfinrod.result import Result
    from verification.case import Array, Pose

__all__ = ["CASES", "EXTENSIBLE", "LENGTH", "SPAN", "hung", "spanning"]

LENGTH, SPAN = 1.2, 1.0
HALF = 0.5 * LENGTH
EXTENSIBLE = 20.0
# EI/(w L³) from which on √(EI/T) is no more than a quarter of the half.
THIN = 1e-2
# Where a rod is first laden, then its end moved; rows (t, factor).
LADEN, MOVED = ((0.0, 0.0), (0.5, 1.0)), ((0.5, 0.0), (1.0, 1.0))
STAND_IN = (
    "discrete: its stand-in EA = 1e8 EI/L² for a rigid extension falls with EI; what the tension stretches it by, "
    "T L²/(1e8 EI), stays however fine the mesh."
)

LAYER = (
    "On 4 elements each is as long as the end over which the cable bends, √(EI/T): orders settle on finer meshes, "
    "where those of P4 are round-off already."
)


def stiff(ratio: float, EA: float) -> Section:
    """Circular section without shear, EI = ratio·w L³."""
    EI = ratio * LENGTH**3
    if np.isinf(EA):
        return Section(GJ=EI / 1.3, EI=EI, rigid={"shear", "extension"})
    return Section(EA=EA, GJ=EI / 1.3, EI=EI, rigid={"shear"})


def hung(ratio: float, EA: float = np.inf, *, level: bool = False) -> Case:
    """Half a cable from its lowest point, clamped there, its end under the forces of the catenary's support.

    Args:
        ratio: EI/(w L³).
        EA: Axial stiffness [w L]; infinite: inextensible.
        level: Whether the section at the end is held level; otherwise it turns freely.

    Returns:
        The case.
    """
    section, tension = stiff(ratio, EA), catenary_tension(0.5 * SPAN, HALF, EA=EA)
    rod = Cable(HALF, ratio * LENGTH**3, EA, clamped=level)

    def scene(pose: Pose) -> Scene:
        held = [Prescribed(at="end", rotation=(0.0, 0.0, 0.0))] if level else []
        return Scene(
            rods=[straight(section, HALF, pose)],
            supports=[Clamp(at="start"), *held],
            loads=[
                LineForce(pose.vector(0.0, -1.0)),
                PointForce(pose.vector(tension, HALF), at="end"),
            ],
        )

    end, kind = "level" if level else "free", "" if np.isinf(EA) else "-elastic"
    return Case(
        name=f"cable-hung-{ratio:g}" + ("-level" if level else "") + kind,
        title=f"Half a cable, EI/(wL³) = {ratio:g}, {end} end, {stretch(EA)}",
        family="cable",
        scene=scene,
        reference=collocated(rod, lambda s: rod.under(tension, s), HALF),
        length=HALF,
        centreline=lambda s: in_plane(rod.under(tension, s)),
        note=STAND_IN if np.isinf(EA) and ratio < 1e-3 else LAYER if ratio <= THIN else "",
    )


def spanning(ratio: float, *, level: bool = False) -> Case:
    """The whole cable of EA = 20 w L: laden between its ends first, then one of them moved towards the other.

    Inextensible, the straight rod between two held ends would be a statically indeterminate mechanism: its tangent is
    singular. By symmetry the middle stays level; held so, a pinned rod does not spin about itself.

    Args:
        ratio: EI/(w L³).
        level: Whether the ends are clamped; otherwise they are pinned.

    Returns:
        The case; its quantity is the middle.
    """
    rod = Cable(HALF, ratio * LENGTH**3, EXTENSIBLE, clamped=level)

    def scene(pose: Pose) -> Scene:
        rotation = (0.0, 0.0, 0.0) if level else None
        end = Prescribed(at="end", displacement=pose.vector(SPAN - LENGTH, 0.0), rotation=rotation, history=MOVED)
        held = (Clamp(at="start"),) if level else (Pin(at="start"), Prescribed(at=HALF, rotation=(0.0, 0.0, 0.0)))
        return Scene(
            rods=[straight(stiff(ratio, EXTENSIBLE), LENGTH, pose)],
            supports=[*held, end],
            loads=[LineForce(pose.vector(0.0, -1.0), history=LADEN)],
        )

    return Case(
        name=f"cable-{'clamped' if level else 'pinned'}-{ratio:g}",
        title=f"Cable, EI/(wL³) = {ratio:g}, {'clamped' if level else 'pinned'}, {stretch(EXTENSIBLE)}",
        family="cable",
        scene=scene,
        reference=collocated(rod, lambda s: middle(rod.across(0.5 * SPAN, s)), HALF),
        length=LENGTH,
        quantity=lowest,
        quantity_name="middle of the cable",
    )


def collocated(rod: Cable, end: Callable[[Array], Array], at: float) -> Reference:
    """Reference from a collocation."""
    x, y = end(np.array([at]))[0]
    return Reference(
        id=f"Cable(EI={rod.EI:.6g}, EA={rod.EA:g}, clamped={rod.clamped})",
        value=(float(x), float(y), 0.0),
        method="Chebyshev collocation; agrees with itself on half as many more terms to 2e-15 (test)",
        source="verification/references/cable.py; tends to Irvine 1981, Cable Structures, ch. 2 (test)",
        digits_trusted=13,
        agreement=2e-15,
    )


def middle(end: Array) -> Array:
    """The middle seen from the start, where the end is known from the middle."""
    return np.asarray(end * (1.0, -1.0))


def lowest(result: Result) -> Array:
    """The middle of the first rod at the last stored state."""
    return np.asarray(result.rods[0].at(HALF)[-1])


def straight(section: Section, length: float, pose: Pose) -> Rod:
    """Rod along the pose's x with d2 along its y."""
    x, y = pose.vector(1.0, 0.0), pose.vector(0.0, 1.0)
    return Rod.straight(length=length, section=section, start=pose.start(length), direction=x, d2=y)


def stretch(EA: float) -> str:
    """Axial stiffness in words."""
    return "inextensible" if np.isinf(EA) else f"EA = {EA:g} wL"


CASES = (
    *(hung(ratio, EA) for EA in (np.inf, EXTENSIBLE) for ratio in (1e-2, 1e-4, 1e-5, 1e-6)),
    *(hung(ratio, EA, level=True) for EA in (np.inf, EXTENSIBLE) for ratio in (1e-2, 1e-3)),
    *(spanning(ratio) for ratio in (1e-3, 1e-4)),
    spanning(1e-2, level=True),
)
