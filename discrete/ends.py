"""Ends of the elements: what stands at nodes, by rows, as elements see it, and back."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from discrete.rows import turn
from discrete.unknowns import AXIAL, N_ELEMENT, N_NODE

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.mesh import Elements

    Array = NDArray[np.float64]

__all__ = ["Ends"]


class Ends:
    """Where the elements of all rods begin and end.

    Args:
        elements: The elements.
        n_nodes: Number of nodes.
    """

    def __init__(self, elements: Elements, n_nodes: int) -> None:
        nodes = np.arange(n_nodes)
        self._node_i, self._node_j = elements.node_i, elements.node_i + 1
        self._first, self._last = np.setdiff1d(nodes, self._node_j), np.setdiff1d(nodes, self._node_i)
        # The element that begins, and the one that ends, at each node: any where there is none.
        self._begun = np.searchsorted(self._node_i, nodes).clip(0, len(self._node_i) - 1)
        self._ended = np.searchsorted(self._node_j, nodes).clip(0, len(self._node_i) - 1)
        self._both = np.concatenate([self._node_i, self._node_j])
        self._attached = np.ascontiguousarray(elements.attached.transpose(2, 3, 1, 0))

    def chords(self, x: Array) -> Array:
        """From node i to node j, positions of shape (3, n_nodes) → (3, n)."""
        return x.take(self._node_j, axis=1) - x.take(self._node_i, axis=1)

    def triads(self, R: Array) -> Array:
        """Triads that are parallel to the element where it is stress free.

        Args:
            R: Section frames, shape (3, 3, n_nodes).

        Returns:
            E, shape (3, 3, 2, n).
        """
        at_ends = R.take(self._both, axis=2).reshape(self._attached.shape)
        return np.einsum("ijan,jkan->ikan", at_ends, self._attached)

    def gather(self, unknowns: Array) -> Array:
        """Unknowns of each element, shape (7, n_nodes) → (13, n)."""
        return np.concatenate((unknowns.take(self._node_i, axis=1), unknowns[:AXIAL].take(self._node_j, axis=1)))

    def scatter(self, force: Array) -> Array:
        """Sum of what elements contribute to their unknowns, Eq. 25, shape (13, n) → (7, n_nodes)."""
        total = force[:N_NODE].take(self._begun, axis=1)
        total[:, self._last] = 0.0
        ended = force[N_NODE:].take(self._ended, axis=1)
        ended[:, self._first] = 0.0
        total[:AXIAL] += ended
        return total

    def turned(self, Q: Array, force: Array) -> Array:
        """End forces turned with the nodes at which they act, shapes (3, 3, n_nodes) and (13, n)."""
        n = len(self._node_i)
        result = force.copy()
        for at, nodes in ((slice(0, AXIAL), self._node_i), (slice(N_NODE, N_ELEMENT), self._node_j)):
            result[at] = turn(Q.take(nodes, axis=2), force[at].reshape(2, 3, n)).reshape(AXIAL, n)
        return result
