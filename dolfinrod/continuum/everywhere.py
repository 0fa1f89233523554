"""The nodes of all rods as one table that every rank has, rods one after the other."""

from __future__ import annotations

from typing import TYPE_CHECKING

from mpi4py import MPI

import numpy as np

from dolfinrod.continuum.nodes import element_ends
from dolfinrod.scene.meeting import Strands

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.continuum.problem import Problem

    Array = NDArray[np.float64]
    Integers = NDArray[np.int64]

__all__ = ["Everywhere", "strands"]


class Everywhere:
    """Numbers of the nodes of all rods, and their values gathered from all ranks.

    Args:
        problem: Owner of the state.

    Attributes:
        comm: All its ranks.
        cells: Numbers of the nodes of every element of the scene, ascending along it, shape (n_cells, k + 1).
        own: Numbers of this rank's own nodes, in the order of `Discretization.owned_nodes`.
        r: Dofs of their centreline on this rank, shape (n_own, d).
        q: Dofs of their rotation, shape (n_own, n_q).
        dofs: Those of the positions and rotations of all nodes among the unknowns of all ranks, (n_nodes, d + n_q).
    """

    def __init__(self, problem: Problem) -> None:
        d = problem.discretization
        self.comm, k = d.comm, d.degree
        first = np.concatenate([[0], np.cumsum(np.array(d.elements) * k + 1)])
        along = [first[j] + k * np.arange(n)[:, None] + np.arange(k + 1) for j, n in enumerate(d.elements)]
        self.cells, self.n = np.concatenate(along), int(first[-1])
        self.r, self.q = d.owned_nodes("r"), d.owned_nodes("q")
        number = np.zeros(len(problem.x), dtype=np.int64)
        number[d.dofs["r"][:, np.argsort(d.nodes), 0]] = self.cells[d.cell]
        self.own: Integers = number[self.r[:, 0]]
        every = self.comm.allgather(self.own)
        self._order, self._counts = np.concatenate(every), np.array([len(own) for own in every])
        local = np.concatenate([self.r, self.q], axis=1).ravel().astype(np.int32)
        numbers = d.matrix.getLGMap()[0].apply(local)
        mine = numbers.reshape(len(self.own), -1).astype(float)
        self.dofs: NDArray[np.int32] = self.gathered(mine).astype(np.int32)

    def gathered(self, own: Array) -> Array:
        """Values of all nodes from those of each rank's own, shape (n_own, m) to (n_nodes, m)."""
        table = np.empty((self.n, own.shape[1]))
        if self.comm.size == 1:
            table[self.own] = own
            return table
        everyone = np.empty_like(table)
        self.comm.Allgatherv(np.ascontiguousarray(own), (everyone, self._counts * own.shape[1]))
        table[self._order] = everyone
        return table

    def summed(self, values: Array) -> Array:
        """What all ranks have put on all nodes, added up in place."""
        if self.comm.size > 1:
            self.comm.Allreduce(MPI.IN_PLACE, values)
        return values


def strands(problem: Problem, cells: Integers) -> Strands:
    """The centrelines of all rods, element by element.

    Args:
        problem: Their discretization.
        cells: Numbers of the nodes of every element, ascending along it, shape (n_cells, k + 1).

    Returns:
        Lagrange's polynomials on the nodes of the elements, without the kinks that these have where they meet.
    """
    d, scene = problem.discretization, problem.scene
    ends = [element_ends(scene, j, n) for j, n in enumerate(d.elements)]
    return Strands.lagrange(
        np.repeat(np.arange(len(scene.rods)), d.elements),
        np.concatenate([np.stack([s[:-1], s[1:]], axis=1) for s in ends]),
        cells,
        np.sort(d.nodes),
        np.array([rod.section.radius or np.nan for rod in scene.rods]),
    )
