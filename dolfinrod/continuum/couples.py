"""Moments per length that turning sections, and friction, put on a rod, for the method of sections.

Where nothing else puts a moment on a node, what the elements put on it is what turns its sections, or friction; that of
a node between two elements is shared by their lengths. A support or a point moment puts its own there: next to one, the
moment per length is that of the polynomial through the other nodes of the element.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.continuum import backend, reference

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.continuum.problem import Problem

    Array = NDArray[np.float64]

__all__ = ["Couples"]


class Couples:
    """Moment per unit of ξ on the elements of a problem.

    Args:
        problem: Owner of the state.
    """

    def __init__(self, problem: Problem) -> None:
        self._problem, d = problem, problem.discretization
        self._q = d.dofs["q"]
        self._lengths = np.diff(problem.ends, axis=1) * reference.node_weights(d.degree)
        self._b = backend.function(d.space)
        at = self._q[:, :, 0]
        mine = slice(0, d.n_owned_cells)
        np.add.at(self._b.x.array, at[mine], self._lengths[mine])
        backend.sum_over_ranks(self._b)
        self._share = self._lengths / self._b.x.array[at]
        self._b.x.array[:] = 0.0
        for dofs in (problem.constraints.dofs, *problem.loaded_dofs()):
            self._b.x.array[dofs] = 1.0
        backend.sum_over_ranks(self._b)
        held = (self._b.x.array[self._q] > 0.0).any(axis=2)
        self._smoothed = _smoothed(d.nodes, held) / reference.node_weights(d.degree)

    def rates(self) -> Array:
        """Moments per ξ at the nodes of this rank's cells in working directions, shape (cells, k + 1, n_spin)."""
        problem, b = self._problem, self._b.x.array
        b[:] = 0.0
        problem.discretization.residual.add_vector(b)
        backend.sum_over_ranks(self._b)
        flat = self._q.reshape(-1, self._q.shape[2])
        spin = problem.kinematics.spin(problem.x[flat])
        put = np.einsum("nij,nj->ni", spin, b[flat]) / np.einsum("nij,nij->ni", spin, spin)
        shared = self._share[:, :, None] * put.reshape(*self._q.shape[:2], spin.shape[1])
        return np.asarray(self._smoothed @ shared)


def _smoothed(ξ: Array, held: NDArray[np.bool_]) -> Array:
    """What puts the values of the other nodes, extrapolated, in place of those of held ones, for each cell."""
    matrices = np.tile(np.eye(len(ξ)), (len(held), 1, 1))
    for pattern in np.unique(held, axis=0):
        free = np.flatnonzero(~pattern)
        powers = np.vander(ξ, len(free), increasing=True)
        matrix = np.zeros((len(ξ), len(ξ)))
        matrix[:, free] = powers @ np.linalg.inv(powers[free]) if len(free) else 0.0
        matrices[(held == pattern).all(axis=1)] = matrix
    return matrices
