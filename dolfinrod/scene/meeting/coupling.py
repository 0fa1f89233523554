"""What rods feel of each other, and how that changes with where all their nodes are."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.compiled import compiled
from dolfinrod.scene.meeting.changes import Changes, applied, diagonal, summed

__all__ = ["Coupling", "Felt", "Nodal", "dealt", "paired"]

Array = NDArray[np.float64]
Integers = NDArray[np.intp]


@compiled
def dealt(nodes: Integers, h: Array, lever: Array, forces: Array, couples: Array, n_nodes: int) -> tuple[Array, Array]:
    """What points have nodes feel.

    Args:
        nodes: Of the points, shape (n, M).
        h: Weights by which they feel forces, shape (n, M).
        lever: By which they feel couples, with the sign changed, shape (n, M), or (n, 0) for none.
        forces: At the points, shape (n, 3) [N].
        couples: Likewise.
        n_nodes: How many there are.

    Returns:
        Forces and moments at nodes, shape (n_nodes, 3) each.
    """
    felt, turned = np.zeros((n_nodes, 3)), np.zeros((n_nodes, 3))
    for i in range(h.shape[0]):
        for a in range(h.shape[1]):
            for j in range(3):
                felt[nodes[i, a], j] += h[i, a] * forces[i, j]
        for a in range(lever.shape[1]):
            for j in range(3):
                turned[nodes[i, a], j] -= lever[i, a] * couples[i, j]
    return felt, turned


def paired(cells: Integers) -> tuple[Integers, Integers]:
    """First points of each run of points that lie on one pair of cells, and the number of its run for each point."""
    other = np.diff(cells, prepend=-1) != 0
    return np.flatnonzero(other), np.cumsum(other) - 1


@dataclass(frozen=True, eq=False)
class Felt:
    """What acts on nodes.

    Args:
        force: Shape (n_nodes, 3) [N].
        moment: Shape (n_nodes, 3) [N m].
    """

    force: Array
    moment: Array


@dataclass(frozen=True, eq=False)
class Coupling:
    """Derivatives of forces and moments at nodes, summed over the points of each pair of cells.

    Args:
        nodes: Of the first cell, then of the second, shape (P, M).
        pair: To which pair of cells a point belongs, shape (n,).
        n_nodes: Of all rods.
        changes: At the points.
        turns: Whether there are moments, and forces that depend on turns.
    """

    nodes: Integers
    pair: Integers
    n_nodes: int
    changes: Changes
    turns: bool

    @cached_property
    def _blocks(self) -> list[Array]:
        """By places and turns, of forces, then of moments where anything turns, shape (P, M, 3, M, 3) each."""
        blocks = summed(self.pair, *self.changes, len(self.nodes))
        return [part.transpose(0, 1, 3, 2, 4) for part in _matrices(np.moveaxis(blocks, 2, 0))]

    @property
    def f_x(self) -> Array:
        """∂f/∂x, shape (P, M, 3, M, 3) [N/m]."""
        return self._blocks[0]

    @property
    def f_turn(self) -> Array | None:
        """∂f by rotation vectors, shape (P, M, 3, M, 3) [N]; None where nothing turns."""
        return self._blocks[1] if self.turns else None

    @property
    def m_x(self) -> Array | None:
        """∂m/∂x, shape (P, M, 3, M, 3) [N]; None where nothing turns."""
        return self._blocks[2] if self.turns else None

    @property
    def m_turn(self) -> Array | None:
        """∂m by rotation vectors, shape (P, M, 3, M, 3) [N m]; None where nothing turns."""
        return self._blocks[3] if self.turns else None

    def times(self, dx: Array, dturn: Array) -> tuple[Array, Array]:
        """Changes of forces and moments, without forming blocks.

        Args:
            dx: Of places of nodes, shape (n_nodes, 3) [m].
            dturn: Of rotation vectors, shape (n_nodes, 3) [rad].

        Returns:
            Of forces [N] and moments [N m], each of shape (n_nodes, 3).
        """
        return applied(self.nodes, self.pair, *self.changes, dx, dturn)

    def nodal(self) -> Nodal:
        """Blocks that couple single nodes with themselves."""
        touched = np.zeros(self.n_nodes, dtype=bool)
        touched[self.nodes] = True
        nodes, at = np.flatnonzero(touched), (np.cumsum(touched) - 1)[self.nodes]
        blocks = _matrices(np.swapaxes(diagonal(at, self.pair, *self.changes, len(nodes)), 0, 1))
        return Nodal(nodes, blocks[0], *(blocks[1:] if self.turns else (None, None, None)))


def _matrices(parts: Array) -> list[Array]:
    """Those that lie in rows of nine, 3 × 3, of one part after the other."""
    return [part.reshape(*part.shape[:-1], 3, 3) for part in parts]


@dataclass(frozen=True, eq=False)
class Nodal:
    """Derivatives of forces and moments at nodes by the places and turns of the same nodes.

    Args:
        nodes: Their numbers, ascending, shape (k,).
        f_x: Shape (k, 3, 3) [N/m].
        f_turn: Likewise [N]; None where nothing turns.
        m_x: Likewise [N]; None where nothing turns.
        m_turn: Likewise [N m]; None where nothing turns.
    """

    nodes: Integers
    f_x: Array | None
    f_turn: Array | None
    m_x: Array | None
    m_turn: Array | None
