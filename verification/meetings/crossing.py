"""Two rods under tension that cross at right angles, their ends drawn past each other: how far they lift, how hard."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import Guide, Penalty, PointForce, Prescribed, Rod, RodContact, Scene, Section, Static
from verification.contactcase import ContactCase
from verification.contacts.runs import DISCRETE, SPACE, on_meshes
from verification.references.meetings import CROSSINGS, meeting

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from verification.case import Array
    from verification.references.crossing import Strand

__all__ = ["CASES", "crossing", "found"]

# They are tightened first; then their ends sink, from where they only just touch.
TIGHTEN, SINK = ((0.0, 0.0), (0.2, 1.0), (1.0, 1.0)), ((0.0, 0.0), (0.2, 0.0), (1.0, 1.0))
STEPS = 10


def crossing(name: str, *, swapped: bool = False) -> Scene:
    """The rods along x, above, and along y, below; the other one named first where swapped.

    Their starts move along them to where the reference has them, so that they cross in their middles, their ends are
    pulled: wherever nodes lie, none is held.
    """
    posed = CROSSINGS[name]
    above, below = posed.strands
    order = [(above, (1.0, 0.0, 0.0), 1.0), (below, (0.0, 1.0, 0.0), -1.0)]
    rods: list[Rod] = []
    supports: list[Prescribed | Guide] = []
    loads: list[PointForce] = []
    ends = dict(zip(posed.strands, meeting(name, "end0", "end1").value, strict=True))
    for k, (strand, along, side) in enumerate(order[::-1] if swapped else order):
        straight, (x, y, _) = 0.5 * posed.reach, along
        section = Section(EA=strand.EA, EI=strand.EI, GJ=strand.EI, radius=0.5 * posed.apart, rigid={"shear"})
        start = np.array([-0.5 * strand.length * x, -0.5 * strand.length * y, side * straight])
        rods.append(Rod.straight(strand.length, section, start=tuple(start), direction=along))
        down = side * (strand.height - straight)
        across = (None, 0.0, down) if x else (0.0, None, down)
        supports += [Prescribed(end, displacement=across, history=SINK, rod=k) for end in ("start", "end")]
        back = 0.5 * strand.length - ends[strand]
        supports.append(Prescribed("start", displacement=(back, None, None) if x else (None, back, None), rod=k))
        supports.append(Guide("start", free={"x", "y", "z", "rx", "ry", "rz"} - {"rx" if x else "ry"}, rod=k))
        loads.append(PointForce(tuple(strand.pull * np.array(along)), at="end", rod=k, history=TIGHTEN))
    contacts = [RodContact(Penalty(posed.eps_N, posed.g_0))]
    return Scene(rods=rods, supports=supports, loads=loads, contacts=contacts, motion=Static(steps=STEPS))


def found(result: Result, strands: tuple[Strand, Strand]) -> Array:
    """Lifts of both middles over the ends, and the force across, of the rods in the order of the reference."""
    middles = [rod.at(0.5 * strand.length)[-1, 2] for rod, strand in zip(result.rods, strands, strict=True)]
    (above, below), force = middles, result.meetings[0].force(-1, 0, 1)[2]
    return np.array([above - strands[0].height, -below - strands[1].height, force])


def crossing_case(name: str, title: str, levels: tuple[tuple[int, ...], tuple[int, ...]], quick: bool) -> ContactCase:
    """By both models on finer and finer meshes."""
    posed = CROSSINGS[name]
    reference = meeting(name, "lift0", "lift1", "force")
    continuum, discrete = levels
    return ContactCase(
        name=f"crossing-{name}",
        title=title,
        family="crossing",
        reference=reference,
        scale=reference.value,
        runs=(
            on_meshes(SPACE, crossing(name), continuum, limit=1e-3, quick=quick),
            on_meshes(SPACE, crossing(name), (4, 8), limit=1e-3, words="nodes at the crossing", quick=quick),
            on_meshes(DISCRETE, crossing(name), discrete, limit=1e-3, quick=quick),
        ),
        quantity="lift of either middle over its ends, force between the rods; m, m, N",
        read=lambda result: found(result, posed.strands),
    )


CASES = (
    crossing_case(
        "fibres",
        "Two fibres of the paper, 10 mm, under 0.1 mN, crossed, their ends level",
        ((3, 5, 9), (10, 20, 40)),
        True,
    ),
    crossing_case(
        "even", "Rods under tension, crossed, their ends drawn past each other", ((5, 9, 17), (20, 40, 80)), False
    ),
    crossing_case(
        "uneven",
        "The same, the one below longer, stiffer and tighter: both lifts follow from the balance of forces",
        ((5, 9, 17), (20, 40, 80)),
        False,
    ),
)
