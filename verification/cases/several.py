"""Three rods in one scene, each with its own length, section, support and load: none knows of the others."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from dolfinrod.scene import Clamp, LineForce, Pin, PointForce, PointMoment, Rod, Scene, Section
from verification.case import UPRIGHT, Case
from verification.cases.curved import LENGTH, helix
from verification.references import rod_problem, solved

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from verification.case import Array, Pose

__all__ = ["CASES", "alone", "member", "together"]

WORDS = ("a pretwisted helix", "an arc", "a straight one")
NOTES = {0: "Degree 4 shows its order 8 from 16 elements on; coarser ones do not resolve the helix finely enough."}


def together(pose: Pose) -> Scene:
    """All three, from one start.

    A helix of 2 m pulled out of every plane, an arc of 1.5 m on a pin between its ends under a line force and a moment,
    and a cantilever of 1 m bent by a tip force.
    """
    start = pose.start(LENGTH)
    sections = (
        Section(EA=300.0, GJ=0.6, EI=(1.0, 2.5), rigid={"shear"}),
        Section(EA=5000.0, GJ=4.0, EI=(9.0, 6.0), rigid={"shear"}),
        Section(GJ=0.5, EI=1.0, rigid={"shear", "extension"}),
    )
    x, y = pose.vector(1.0, 0.0), pose.vector(0.0, 1.0)
    return Scene(
        rods=[
            helix(sections[0], pose),
            Rod.arc(1.2, 1.25, sections[1], start, x, y),
            Rod.straight(1.0, sections[2], start, pose.vector(0.0, 0.0, 1.0), d2=x),
        ],
        supports=[Clamp(at="start"), Pin(at=0.625 * 1.5, rod=1)],
        loads=pulls(pose),
    )


def pulls(pose: Pose) -> list[PointForce | LineForce | PointMoment]:
    """The loads of all three, each on its rod."""
    return [
        PointForce(pose.vector(0.8, -1.6, 2.4), at="end", rod=0),
        LineForce(pose.vector(0.0, -20.0, 5.0), rod=1),
        PointMoment(pose.vector(3.0, -2.0, 4.0), at="end", rod=1),
        PointForce(pose.vector(3.0, 2.0, 1.0), at="end", rod=2),
    ]


def alone(pose: Pose, rod: int) -> Scene:
    """One of the three without the others.

    Args:
        pose: Of the scene.
        rod: 0, 1 or 2.
    """
    scene = together(pose)
    return Scene(
        rods=[scene.rods[rod]],
        supports=[replace(part, rod=0) for part in scene.supports if part.rod in (None, rod)],
        loads=[replace(load, rod=0) for load in pulls(pose) if load.rod == rod],
    )


def member(rod: int) -> Case:
    """All three rods solved together, the tip of one of them read.

    Args:
        rod: 0, 1 or 2.

    Returns:
        The case; lengths are divided by that of the longest rod.
    """
    name = f"several-{rod}"

    def tip(result: Result) -> Array:
        return result.rods[rod].r[-1, -1]

    scene = together(UPRIGHT)
    return Case(
        name=name,
        title=f"Three rods at once, {WORDS[rod]}",
        family="several",
        scene=together,
        reference=solved(name, rod_problem(scene, rod), scene.rods[rod].length),
        length=LENGTH,
        planar=False,
        quantity=tip,
        quantity_name=f"tip position of rod {rod}",
        note=NOTES.get(rod, ""),
    )


CASES = (member(0), member(1), member(2))
