"""How the unknowns of nodes of rods that touch one another depend on each other: blocks of the tangent."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.scene.meeting import Coupling

    Array = NDArray[np.float64]
    Integers = NDArray[np.int64]

__all__ = ["Frames", "Links", "linked"]


@dataclass(frozen=True, eq=False)
class Frames:
    """How the unknowns of nodes move and turn them, and what forces and moments on nodes do to the balance of these.

    Args:
        moves: Change of position and rotation vector in space by the unknowns, shape (n_nodes or 1, 3 or 6, n).
        feels: Part of a force and a moment in space in the balance, shape (n_nodes or 1, n, 3 or 6).
        free: Whether an unknown is not held, shape (n_nodes, n).
    """

    moves: Array
    feels: Array
    free: NDArray[np.bool_]

    def at(self, nodes: Integers) -> tuple[Array, Array]:
        """`moves` and `feels` of some nodes."""
        if len(self.moves) == 1:
            return self.moves, self.feels
        return self.moves[nodes], self.feels[nodes]


@dataclass(frozen=True, eq=False)
class Links:
    """Blocks of the tangent, those of single nodes apart.

    Args:
        nodes: Numbers of the nodes of each block, shape (m, M).
        blocks: Entries among their unknowns, zero where a node meets itself, shape (m, M, n, M, n).
        nodal: Entries of single nodes, shape (n_nodes, n, n).
    """

    nodes: Integers
    blocks: Array
    nodal: Array


def linked(coupling: Coupling, frames: Frames) -> Links:
    """Tangent of the balance of nodes by what rods do to one another.

    Args:
        coupling: Gradient of forces and moments in space by positions and turns.
        frames: Of all nodes.

    Returns:
        The balance is that of what acts, so its tangent has the other sign than the gradient.
    """
    nodes, n = coupling.nodes, frames.free.shape[1]
    if not len(nodes):
        none = np.zeros((0, nodes.shape[1], n, nodes.shape[1], n))
        return Links(nodes, none, np.zeros((len(frames.free), n, n)))
    K = _whole(coupling)
    moves, feels = frames.at(nodes)
    P, M, m = K.shape[:3]
    rows = (feels @ K.reshape(P, M, m, M * m)).reshape(P, M * n, M, m)
    blocks = np.swapaxes(np.swapaxes(rows, 1, 2) @ moves, 1, 2).reshape(P, M, n, M, n)
    free = frames.free[nodes]
    blocks *= np.where(free[:, :, :, None, None] & free[:, None, None], -1.0, 0.0)
    p, a, b = np.nonzero(nodes[:, :, None] == nodes[:, None, :])
    nodal = np.zeros((len(frames.free), n, n))
    np.add.at(nodal, nodes[p, a], blocks[p, a, :, b])
    blocks[p, a, :, b] = 0.0
    return Links(nodes, blocks, nodal)


def _whole(coupling: Coupling) -> Array:
    """Gradient of force, and moment where anything rubs, by position and turn, shape (m, M, 3 or 6, M, 3 or 6)."""
    if coupling.f_turn is None:
        return coupling.f_x
    above = np.concatenate([coupling.f_x, coupling.f_turn], axis=4)
    return np.concatenate([above, np.concatenate([coupling.m_x, coupling.m_turn], axis=4)], axis=2)
