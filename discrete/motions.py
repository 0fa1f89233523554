"""Motions of an equilibrium that cost nothing: neither energy, nor the inertia of anything that moves."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from discrete.unknowns import AXIAL, N_NODE, X_I, X_J

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.nodes import Tangent

    Array = NDArray[np.float64]

__all__ = ["cost_nothing"]

# Sum of the energies of the elements, over that of their magnitudes, that the tolerance of the iteration leaves.
BALANCED = 1e-7
# Round-off of the energy of an element, over the sum of the magnitudes of all its terms.
ROUND_OFF = 1e-14


def cost_nothing(tangent: Tangent, motions: Array) -> NDArray[np.bool_]:
    """Whether motions neither store nor release energy, v·K v = 0 to the accuracy of an equilibrium.

    Summed up over the elements from what moves within each, w = (x_i, ω_i, F_n, x_j − x_i, ω_j): translations of an
    element drop out before anything is rounded. As products with the assembled matrix they would cost n⁴ ε EI/L³.

    Args:
        tangent: K.
        motions: As columns, shape (n_unknowns, m).

    Returns:
        Shape (m,).
    """
    node_i = tangent.system.node_i
    v = motions.reshape(-1, N_NODE, motions.shape[1])
    w = np.concatenate([v[node_i], v[node_i + 1, :AXIAL]], axis=1)
    w[:, X_J] -= w[:, X_I]
    K, touched = tangent.elements.copy(), tangent.touched
    if touched is not None:
        touched.enter(K, node_i, -1.0)
    # What a translation meets, of the columns nothing, of the rows the forces that follow a section.
    K[:, X_I] += K[:, X_J]
    K[:, :, X_I] = 0.0
    energy = np.einsum("nam,nam->nm", w, np.matmul(K, w))
    terms = np.einsum("nam,nam->m", np.abs(w), np.matmul(np.abs(K), np.abs(w)))
    if touched is not None:
        at, B = v[touched.nodes, :AXIAL], touched.blocks
        energy = np.concatenate([energy, np.einsum("nam,nam->nm", at, np.matmul(B, at))])
        terms += np.einsum("nam,nam->m", np.abs(at), np.matmul(np.abs(B), np.abs(at)))
    return np.asarray(np.abs(energy.sum(axis=0)) <= BALANCED * np.abs(energy).sum(axis=0) + ROUND_OFF * terms)
