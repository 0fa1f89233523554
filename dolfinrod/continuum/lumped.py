"""Inertia of the rods gathered at the nodes, by the Gauss-Lobatto rule whose points are the nodes of P_k.

The rule keeps the order of the elements, as in spectral elements, and leaves blocks of single nodes: no mass couples
one node with another, and none enters the weak form.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.continuum import backend, reference
from dolfinrod.continuum.mass import inertia

if TYPE_CHECKING:
    from petsc4py import PETSc

    from numpy.typing import NDArray

    from dolfinrod.continuum.problem import Problem

    Array = NDArray[np.float64]

__all__ = ["Lumped", "NodeBlocks", "node_lengths", "summed"]


@dataclass(frozen=True, eq=False)
class Lumped:
    """Masses of this rank's own nodes, in ρA L and ρA L³ with the largest ρA.

    Args:
        r: Centreline dofs, shape (n, d).
        q: Rotation dofs of the same nodes, shape (n, n_q).
        m: Masses, shape (n,).
        J: Rotary inertia about stress-free directions, shape (n, n_spin, n_spin).
        J_inverse: Its inverse; zero where there is none.
        second: Unit of time √(ρA L⁴/EI) [s].
    """

    r: NDArray[np.intp]
    q: NDArray[np.intp]
    m: Array
    J: Array
    J_inverse: Array
    second: float

    @classmethod
    def of(cls, problem: Problem) -> Lumped:
        """Masses of the rods of a problem at its nodes.

        Raises:
            SceneError: A rod without them.
        """
        rhoA, rhoI = inertia(problem.scene)
        d, place = problem.discretization, problem.placement
        mine = slice(0, d.n_owned_cells)
        weight = np.diff(problem.ends[mine], axis=1) * reference.node_weights(d.degree)
        axes = place.spin_axes.T @ problem.R_0[mine]
        rod = problem.rod[mine]
        j = (rhoI / rhoA.max() / place.length**2)[rod]
        J = np.einsum("ca,caij,cj,cakj->caik", weight, axes, j, axes)
        r, q = d.owned_nodes("r"), d.owned_nodes("q")
        first = d.dofs["r"][mine][:, :, 0], d.dofs["q"][mine][:, :, 0]

        def gathered(at: NDArray[np.int32], values: Array, nodes: NDArray[np.intp]) -> Array:
            local = np.zeros(len(problem.x))
            np.add.at(local, at, values)
            return summed(problem, local)[nodes[:, 0]]

        m = gathered(first[0], weight * (rhoA / rhoA.max())[rod][:, None], r)
        n_spin = J.shape[-1]
        entries = [[gathered(first[1], J[:, :, i, k], q) for k in range(n_spin)] for i in range(n_spin)]
        second = float(np.sqrt(rhoA.max() * place.length**4 / place.stiffness))
        J_nodes = np.moveaxis(np.array(entries), 2, 0)
        return cls(r, q, m, J_nodes, np.linalg.pinv(J_nodes, hermitian=True), second)


class NodeBlocks:
    """Where blocks of single nodes lie in a tangent, found once.

    Args:
        problem: Knows which dofs are held: their rows and columns are left out.
        places: Rows and columns of each kind of block, shapes (n, i) and (n, j).
    """

    def __init__(self, problem: Problem, places: list[tuple[NDArray[np.intp], NDArray[np.intp]]]) -> None:
        I = np.concatenate([np.repeat(rows, columns.shape[1], axis=1).ravel() for rows, columns in places])
        J = np.concatenate([np.tile(columns, (1, rows.shape[1])).ravel() for rows, columns in places])
        self._kept = np.flatnonzero(~(problem.excluded[I] | problem.excluded[J]))
        self._rows, self._columns = I[self._kept].astype(np.int32), J[self._kept].astype(np.int32)

    def add(self, A: PETSc.Mat, blocks: list[Array]) -> None:
        """Add blocks of each kind, shapes (n, i, j), row by row."""
        values = np.concatenate([block.ravel() for block in blocks])
        backend.add_entries(A, self._rows, self._columns, values[self._kept])


def summed(problem: Problem, local: Array) -> Array:
    """What all ranks have put on each dof, added up."""
    f = backend.function(problem.discretization.space)
    f.x.array[:] = local
    backend.sum_over_ranks(f)
    return np.asarray(f.x.array.copy())


def node_lengths(problem: Problem) -> Array:
    """Length of rod for which each node stands, at the first of its centreline dofs on this rank, in L."""
    d = problem.discretization
    mine = slice(0, d.n_owned_cells)
    local = np.zeros(len(problem.x))
    weight = np.diff(problem.ends[mine], axis=1) * reference.node_weights(d.degree)
    np.add.at(local, d.dofs["r"][mine][:, :, 0], weight)
    return summed(problem, local)
