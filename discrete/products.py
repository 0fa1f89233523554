"""Derivatives at points of contact, products of weights of nodes and small matrices, applied to many changes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.scene.meeting import Coupling
    from dolfinrod.scene.meeting.coupling import Product

    Array = NDArray[np.float64]

__all__ = ["Applied"]


class Applied:
    """What acts on all nodes as they change: weights · matrices · weights, the weights as sparse matrices.

    Args:
        coupling: Whose points these are.
        product: Of them.
    """

    def __init__(self, coupling: Coupling, product: Product) -> None:
        from scipy.sparse import csr_matrix

        nodes = coupling.nodes[coupling.pair]

        def sparse(weights: Array) -> csr_matrix:
            n, k, m = weights.shape
            columns = np.repeat(nodes[:, None], k, axis=1).reshape(-1)
            ends = np.arange(0, columns.size + 1, m)
            return csr_matrix((weights.reshape(-1), columns, ends), shape=(n * k, coupling.n_nodes))

        n, k, _, wide = product.core.shape
        self._core = product.core.reshape(n, 3 * k, wide)
        self._right, self._left = sparse(product.right), sparse(product.left).T

    def __call__(self, change: Array) -> Array:
        """Shape (n_nodes, 3) both."""
        moved = (self._right @ change).reshape(len(self._core), -1)
        return np.asarray(self._left @ np.einsum("nij,nj->ni", self._core, moved).reshape(-1, 3))
