"""Which nodes surfaces press where a linear step leads, found with the factors of its tangent, by all ranks at once."""

from __future__ import annotations

from typing import TYPE_CHECKING

from mpi4py import MPI

import numpy as np

from dolfinrod.scene import Static
from dolfinrod.scene.pivoting import joined, pivoted

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from petsc4py import PETSc

    from numpy.typing import NDArray

    from dolfinrod.continuum.problem import Problem
    from dolfinrod.continuum.side import Side
    from dolfinrod.scene.pivoting import Outlook

    Array = NDArray[np.float64]
    Solve = Callable[[Array], Array]

__all__ = ["Pivoting", "Pivots"]

# Ways in L after which a linear step tells nothing of what it presses.
FAR = 1.0


class Pivoting:
    """What the linear steps of an iteration press, in equilibria: between steps in time sets hardly change.

    Args:
        problem: Owner of the state.
        r: Centreline dofs of this rank's own nodes, shape (n, d).

    Attributes:
        gives_way: Whether the last step was not the way to any set of points: rods give way on it.
    """

    def __init__(self, problem: Problem, r: NDArray[np.int32]) -> None:
        self._problem, self._r, self.gives_way = problem, r, False
        # Rods that touch others exchange points of these, too, of which the set would know nothing.
        sides = () if problem.walls is None or problem.scene.meetings else problem.walls.sides
        mine = isinstance(problem.scene.motion, Static) and any(side.touch.open for side in sides)
        self._asked = problem.discretization.comm.allreduce(mine, op=MPI.LOR)

    def begin(self) -> None:
        """An iteration begins."""
        self.gives_way = False

    def complete(self, factors: PETSc.KSP, X: PETSc.Vec, Y: PETSc.Vec) -> None:
        """Let a step Y from X, X − Y being next, press what it should where it leads, by factors of its tangent."""
        walls, x, y = self._problem.walls, X.array_r[self._r], Y.array_r[self._r]
        self.begin()
        if walls is None or not self._asked:
            return
        if self._problem.discretization.comm.allreduce(np.abs(y).max(initial=0.0), op=MPI.MAX) > FAR:
            return
        right, way = Y.duplicate(), Y.duplicate()

        def solve(b: Array) -> Array:
            right.array[:] = b
            factors.solve(right, way)
            return np.array(way.array_r)

        missing = Pivots(self._problem, walls.sides, self._r, x - y).step(solve, Y.getLocalSize())
        self.gives_way = missing is None
        if missing is not None:
            Y.array[:] -= missing
        right.destroy()
        way.destroy()


class Pivots:
    """A linear step of rods towards surfaces.

    Args:
        problem: Owner of the state where it is taken.
        sides: The surfaces, and the rank's own nodes.
        dofs: Of the centreline at all of its own nodes, shape (n, d).
        r: Where the step leads these, shape (n, d).
    """

    def __init__(self, problem: Problem, sides: Sequence[Side], dofs: NDArray[np.int32], r: Array) -> None:
        self._place, self._comm, self._sides = problem.placement, problem.discretization.comm, sides
        x = self._place.to_space(r)
        self._mine = joined([side.touch.ahead(x[side.nodes], side.share[:, 0]) for side in sides])
        counts = [side.touch.open for side in sides]
        at = np.concatenate([dofs[side.nodes[:n]] for side, n in zip(sides, counts, strict=True)])
        self._ends, self._dofs = np.cumsum(counts)[:-1], at
        free = ~problem.excluded[at]
        self._pushed = np.where(free, self._mine.normal @ self._place.axes, 0.0)
        every = self._comm.allgather(self._mine)
        self._all: Outlook = joined(every)
        sizes = [len(one.pressed) for one in every]
        self._first = int(np.sum(sizes[: self._comm.rank], dtype=int))

    def step(self, solve: Solve, n: int) -> Array | float | None:
        """What is missing from the step, and of the surfaces' answers where it leads.

        Args:
            solve: Ways of this rank's own unknowns under forces on them, by the tangent of the step; all ranks at once.
            n: Number of these unknowns.

        Returns:
            Shape (n,) or 0; None where it is not the way to any set of points.
        """
        found = pivoted(self._all, lambda point: self._moved(point, solve, n))
        if found is None:
            return None
        mine = slice(self._first, self._first + len(self._dofs))
        pressed, q = found[0][mine], found[1][mine]
        for side, those in zip(self._sides, np.split(pressed, self._ends), strict=True):
            side.touch.settle(those)
        return solve(self._forces(q, n)) if found[1].any() else 0.0

    def _moved(self, point: int, solve: Solve, n: int) -> Array:
        """Ways of all points along their normals under a unit force at one, shape (n_points,) [m/N]."""
        unit = np.zeros(len(self._dofs))
        if 0 <= point - self._first < len(unit):
            unit[point - self._first] = 1.0
        way = solve(self._forces(unit, n))[self._dofs] * self._place.length
        mine = np.einsum("ni,ni->n", self._mine.normal @ self._place.axes, way)
        return np.concatenate(self._comm.allgather(mine))

    def _forces(self, q: Array, n: int) -> Array:
        """Forces [N] along the normals of the rank's own points as a right-hand side."""
        b = np.zeros(n)
        np.add.at(b, self._dofs, q[:, None] * self._pushed / self._place.force)
        return b
