"""The contacts of rods with rods of a problem, each rank with its own elements, and whether steps went too far."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.continuum.everywhere import strands
from dolfinrod.continuum.mass import inertia
from dolfinrod.scene import Dynamic
from dolfinrod.scene.meeting import Meeting

if TYPE_CHECKING:
    from collections.abc import Sequence

    from dolfinrod.continuum.everywhere import Everywhere
    from dolfinrod.continuum.problem import Problem

__all__ = ["led_past", "meetings"]


def meetings(problem: Problem, everywhere: Everywhere, level: float) -> list[Meeting]:
    """One for each contact of rods in the scene.

    Args:
        problem: Its discretization.
        everywhere: The nodes of all rods.
        level: Where in a step forces act.
    """
    d, scene = problem.discretization, problem.scene
    lines, mine, density = strands(problem, everywhere.cells), None, None
    if d.comm.size > 1:
        mine = np.zeros(len(everywhere.cells), dtype=bool)
        mine[d.cell[: d.n_owned_cells]] = True
    inert = isinstance(scene.motion, Dynamic)
    if inert:
        density = inertia(scene)[0]
    return [Meeting(one, lines, level, inert=inert, mine=mine, density=density) for one in scene.meetings]


def led_past(meetings: Sequence[Meeting], everywhere: Everywhere) -> bool:
    """Whether the last answer is to a step past a rod by which contact wins energy; all ranks call this together."""
    won = everywhere.summed(np.array([meeting.won() for meeting in meetings]))
    return any(meeting.leapt(one) for meeting, one in zip(meetings, won, strict=True))
