"""How far rods that touch one another may go in an iteration."""

from __future__ import annotations

from typing import TYPE_CHECKING

from mpi4py import MPI

import numpy as np

from dolfinrod.scene import Static

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.continuum.problem import Problem

__all__ = ["part_taken"]

# Of the least radius: half of it leaves normals what they are, a diameter leads past the rod that was touched.
PART = 0.5


def part_taken(problem: Problem, ways: NDArray[np.float64]) -> float:
    """Part of a step of statics by which no rod that may touch another leaps past it; all of it where none touches.

    Where contact has just begun nothing but it may hold a rod, and the first linear step is far too long. The next one
    leaves out that normals turn: forces far from balance, which turn with them, would push the rods anywhere.

    Args:
        problem: With its rods where the step begins.
        ways: Of this rank's own nodes, shape (n, d).
    """
    pairs = problem.pairs
    if pairs is None or not isinstance(problem.scene.motion, Static) or not pairs.met:
        return 1.0
    longest = float(np.sqrt(np.einsum("ni,ni->n", ways, ways).max(initial=0.0)))
    longest = problem.discretization.comm.allreduce(longest, op=MPI.MAX)
    radius = min(rod.section.radius or np.inf for rod in problem.scene.rods) / problem.placement.length
    for meeting in pairs.meetings:
        meeting.steady = longest > PART * radius
    return min(1.0, PART * radius / longest) if longest > 0.0 else 1.0
