"""Axes that turn with the rods as a path goes on, so that tangents change along it as little as the rods deform.

What a rigid turn by μ ω makes of an element's tangent goes on for ever in powers of μ. Cut off behind the first, it
leaves −12 EI/l (μ ω)² to motions in which elements only turn, more the shorter these are, and critical points are
found where there are none. With δe = Λ_e δe′ of chords and φ = Λ φ′ of spins the tangent in (δe′, φ′) stays what it is.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from discrete.unknowns import N_NODE, SPIN, X

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.mesh import Mesh
    from discrete.nodes import Tangent
    from discrete.state import State

    Array = NDArray[np.float64]

__all__ = ["Corotating"]


class Corotating:
    """W of motions v = (1 + μ W) v′, the first node of each rod being where it is.

    Args:
        mesh: Nodes and elements.
        tangent: Says in which axes spins stand; those that stand in axes of their own turn with these.
        state: An equilibrium.
        rate: Where the path leads from it, shape (n_nodes · 7,).
    """

    def __init__(self, mesh: Mesh, tangent: Tangent, state: State, rate: Array) -> None:
        i, rate = mesh.elements.node_i, rate.reshape(-1, N_NODE)
        e = state.x[i + 1] - state.x[i]
        # Not about their axes: a round rod's tangent knows nothing of that, and others' go on without it.
        turn = np.cross(e, rate[i + 1, X] - rate[i, X]) / np.einsum("ni,ni->n", e, e)[:, None]
        spins, beside = np.zeros((len(state.x), 3)), np.zeros(len(state.x))
        for end in (i, i + 1):
            np.add.at(spins, end, turn)
            np.add.at(beside, end, 1.0)
        spins /= beside[:, None]
        spins[tangent.guided] = 0.0
        self._chords, self._spins = turn[:, :, None], spins[:, :, None]
        self._node_i = i
        self._rods = [slice(a, b) for a, b in zip(mesh.first[:-1], mesh.first[1:], strict=True)]

    def times(self, v: Array) -> Array:
        """W v of columns, shape (n_unknowns, m)."""
        v = v.reshape(len(v) // N_NODE, N_NODE, v.shape[1])
        turned, i = np.zeros_like(v), self._node_i
        turned[:, SPIN] = np.cross(self._spins, v[:, SPIN], axis=1)
        turned[i + 1, X] = np.cross(self._chords, v[i + 1, X] - v[i, X], axis=1)
        for rod in self._rods:
            turned[rod, X] = np.cumsum(turned[rod, X], axis=0)
        return turned.reshape(N_NODE * len(v), v.shape[2])

    def transposed(self, f: Array) -> Array:
        """Wᵀ f of columns, shape (n_unknowns, m)."""
        f = f.reshape(len(f) // N_NODE, N_NODE, f.shape[1])
        felt, beyond, i = np.zeros_like(f), np.zeros_like(f[:, X]), self._node_i
        felt[:, SPIN] = np.cross(f[:, SPIN], self._spins, axis=1)
        for rod in self._rods:
            beyond[rod] = np.cumsum(f[rod, X][::-1], axis=0)[::-1]
        pull = np.cross(beyond[i + 1], self._chords, axis=1)
        felt[i + 1, X] += pull
        felt[i, X] -= pull
        return felt.reshape(N_NODE * len(f), f.shape[2])
