"""What rods feel of each other, and how that changes with where all their nodes are."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

__all__ = ["Coupling", "Felt", "Nodal", "Product", "gather", "sums"]

Array = NDArray[np.float64]
Integers = NDArray[np.intp]


def gather(nodes: Integers, values: Array, n_nodes: int) -> Array:
    """Sums at nodes, shape (n_nodes, 3), of values of shape (..., 3) given for nodes of shape (...)."""
    at, rows = nodes.ravel(), values.reshape(-1, 3)
    return np.stack([sums(at, rows[:, i], n_nodes) for i in range(3)], axis=1)


def sums(at: Integers, values: Array, n: int) -> Array:
    """Of values, shape (m,), at each of n places."""
    return np.bincount(at, values, n).astype(float, copy=False)


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
class Product:
    """Blocks of points as products of weights of nodes and matrices 3 × 3.

    Args:
        left: Weights by which what acts goes to nodes, shape (n, k, M).
        core: Shape (n, k, 3, 3 l).
        right: Weights by which nodes move what it depends on, shape (n, l, M).
    """

    left: Array
    core: Array
    right: Array

    def ordered(self, order: Integers) -> Product:
        """The points in another order."""
        return Product(self.left[order], self.core[order], self.right[order])

    @property
    def spread(self) -> Array:
        """Derivatives of what acts by the places of nodes, shape (n, k, 9 M)."""
        n, k, _, wide = self.core.shape
        core = self.core.reshape(n, k * 3, wide // 3, 3).transpose(0, 1, 3, 2).reshape(n, k * 9, wide // 3)
        return np.asarray((core @ self.right).reshape(n, k, 9 * self.right.shape[2]))


@dataclass(frozen=True, eq=False)
class Coupling:
    """Derivatives of forces and moments at nodes, summed over the points of each pair of cells.

    Args:
        nodes: Of the first cell, then of the second, shape (P, M).
        pair: To which pair of cells a point belongs, ascending, shape (n,).
        n_nodes: Of all rods.
        force_x: ∂f/∂x at points.
        force_turn: By the rotation vectors of the step; None where nothing rubs.
        moment_x: ∂m/∂x; likewise.
        moment_turn: Likewise.
    """

    nodes: Integers
    pair: Integers
    n_nodes: int
    force_x: Product
    force_turn: Product | None = None
    moment_x: Product | None = None
    moment_turn: Product | None = None

    def _blocks(self, product: Product) -> Array:
        """Shape (P, M, 3, M, 3), points of one pair side by side in one product."""
        n, k, M = product.left.shape
        spread = product.spread
        starts = np.flatnonzero(np.diff(self.pair, prepend=-1))
        counts = np.diff(np.append(starts, n))
        blocks = np.empty((len(starts), M, 9 * M))
        for count in np.unique(counts):
            of = np.flatnonzero(counts == count)
            points = starts[of][:, None] + np.arange(count)
            left = product.left[points].reshape(len(of), count * k, M).transpose(0, 2, 1)
            blocks[of] = left @ spread[points].reshape(len(of), count * k, 9 * M)
        return blocks.reshape(len(starts), M, 3, 3, M).transpose(0, 1, 2, 4, 3)

    @cached_property
    def f_x(self) -> Array:
        """∂f/∂x, shape (P, M, 3, M, 3) [N/m]."""
        return self._blocks(self.force_x)

    @cached_property
    def f_turn(self) -> Array | None:
        """∂f by rotation vectors, shape (P, M, 3, M, 3) [N]; None where nothing rubs."""
        return None if self.force_turn is None else self._blocks(self.force_turn)

    @cached_property
    def m_x(self) -> Array | None:
        """∂m/∂x, shape (P, M, 3, M, 3) [N]; None where nothing rubs."""
        return None if self.moment_x is None else self._blocks(self.moment_x)

    @cached_property
    def m_turn(self) -> Array | None:
        """∂m by rotation vectors, shape (P, M, 3, M, 3) [N m]; None where nothing rubs."""
        return None if self.moment_turn is None else self._blocks(self.moment_turn)

    def times(self, dx: Array, dturn: Array) -> tuple[Array, Array]:
        """Changes of forces and moments, without forming blocks.

        Args:
            dx: Of places of nodes, shape (n_nodes, 3) [m].
            dturn: Of rotation vectors, shape (n_nodes, 3) [rad].

        Returns:
            Of forces [N] and moments [N m], each of shape (n_nodes, 3).
        """
        force = self._times(self.force_x, dx) + self._times(self.force_turn, dturn)
        return force, self._times(self.moment_x, dx) + self._times(self.moment_turn, dturn)

    def _times(self, product: Product | None, change: Array) -> Array:
        if product is None or not len(self.pair):
            return np.zeros((self.n_nodes, 3))
        nodes = self.nodes[self.pair]
        n, k, _, wide = product.core.shape
        moved = (product.right @ change[nodes]).reshape(n, wide, 1)
        acts = (product.core.reshape(n, 3 * k, wide) @ moved).reshape(n, k, 3)
        return gather(nodes, product.left.transpose(0, 2, 1) @ acts, self.n_nodes)

    def nodal(self) -> Nodal:
        """Blocks that couple single nodes with themselves."""
        nodes, at = np.unique(self.nodes, return_inverse=True)
        parts = (self.force_x, self.force_turn, self.moment_x, self.moment_turn)
        return Nodal(nodes, *(None if part is None else self._nodal(part, at, len(nodes)) for part in parts))

    def _nodal(self, product: Product, at: Integers, n: int) -> Array:
        of = at.reshape(self.nodes.shape)[self.pair].ravel()
        count, k, M = product.left.shape
        weights = product.left[:, :, None, :] * product.right[:, None, :, :]
        l = product.right.shape[1]
        core = product.core.reshape(count, k, 3, l, 3).transpose(0, 1, 3, 2, 4).reshape(count, k * l, 9)
        blocks = (weights.reshape(count, k * l, M).transpose(0, 2, 1) @ core).reshape(-1, 9)
        return np.stack([sums(of, blocks[:, i], n) for i in range(9)], axis=1).reshape(-1, 3, 3)


@dataclass(frozen=True, eq=False)
class Nodal:
    """Derivatives of forces and moments at nodes by the places and turns of the same nodes.

    Args:
        nodes: Their numbers, ascending, shape (k,).
        f_x: Shape (k, 3, 3) [N/m].
        f_turn: Likewise [N]; None where nothing rubs.
        m_x: Likewise [N]; None where nothing rubs.
        m_turn: Likewise [N m]; None where nothing rubs.
    """

    nodes: Integers
    f_x: Array | None
    f_turn: Array | None
    m_x: Array | None
    m_turn: Array | None
