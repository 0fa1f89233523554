"""Centrelines of rods between their nodes, as either model describes them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["Strands"]

Array = NDArray[np.float64]
Integers = NDArray[np.intp]

# Rows: powers of ξ; columns: value at 0, slope at 0, value at 1, slope at 1.
HERMITE = np.array([[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [-3.0, -2.0, 3.0, -1.0], [2.0, 1.0, -2.0, 1.0]])


@dataclass(frozen=True, eq=False)
class Strands:
    """Centrelines between nodes: x(ξ) = Σ w_a(ξ) x_a for ξ from 0 to 1 on each cell, w_a polynomials that sum to 1.

    Nodes of all rods are one table. A force at a point of a cell, dealt out to its nodes by w_a, keeps its moment.

    Args:
        rod: Of each cell, shape (n_cells,); cells one rod after the other, ascending along it.
        s: Arc lengths of the ends of the cells, shape (n_cells, 2) [m].
        nodes: Rows of the table, shape (n_cells, m); one may come twice if it then has no weight.
        shape: Coefficients of ξ^q in w_a, shape (n_cells, m, p + 1).
        radius: Of each rod; nan for those that touch nothing, shape (n_rods,) [m].
        spans: Pieces per cell, each about as straight as the nodes can tell.
    """

    rod: Integers
    s: Array
    nodes: Integers
    shape: Array
    radius: Array
    spans: int = 1

    @classmethod
    def smooth(cls, s: Sequence[Array], radius: Array) -> Strands:
        """Cubics between neighbouring nodes whose tangents are those of the parabola through three of them.

        Args:
            s: Arc lengths of the nodes of each rod, ascending [m].
            radius: Of each rod, shape (n_rods,) [m].

        Returns:
            Curves without kinks, one rod after the other, each rod's nodes in order.
        """
        starts = np.cumsum([0, *(len(one) for one in s)])
        parts = [_smooth(np.asarray(one, dtype=float)) for one in s]
        return cls(
            np.repeat(np.arange(len(s)), [len(one) - 1 for one in s]),
            np.concatenate([np.stack([one[:-1], one[1:]], axis=1) for one in s]),
            np.concatenate([nodes + start for (nodes, _), start in zip(parts, starts[:-1], strict=True)]),
            np.concatenate([shape for _, shape in parts]),
            np.asarray(radius, dtype=float),
        )

    @classmethod
    def lagrange(cls, rod: Integers, s: Array, nodes: Integers, places: Array, radius: Array) -> Strands:
        """Polynomials through the m nodes of each element, cut into m − 1 spans.

        Args:
            rod: Of each element, shape (n_cells,).
            s: Arc lengths of the ends of the elements, shape (n_cells, 2) [m].
            nodes: Rows of the table of nodes, shape (n_cells, m), in the order of `places`.
            places: Local coordinates of the nodes, from 0 to 1, shape (m,).
            radius: Of each rod, shape (n_rods,) [m].

        Returns:
            Curves through the nodes, continuous from element to element.
        """
        shape = np.linalg.inv(np.vander(places, increasing=True)).T
        every = np.broadcast_to(shape, (len(nodes), *shape.shape))
        return cls(np.asarray(rod), np.asarray(s), np.asarray(nodes), every, np.asarray(radius), len(places) - 1)


def _smooth(s: Array) -> tuple[Integers, Array]:
    """Nodes and coefficients of the cells of one rod, shapes (n − 1, 4) and (n − 1, 4, 4)."""
    n, h = len(s), np.diff(s)
    around = np.clip(np.arange(-1, n - 2)[:, None] + np.arange(4), 0, n - 1)
    slope = _tangents(s)
    cells, ends = np.arange(n - 1), np.zeros((n - 1, 4, 4))
    # What is clipped repeats the node beside it, without weight.
    counts = np.stack([cells > 0, cells >= 0, cells >= 0, cells < n - 2], axis=1)
    ends[:, 1, 0] = ends[:, 2, 2] = 1.0
    ends[:, :, 1] = np.where(counts, slope[cells[:, None], around], 0.0) * h[:, None]
    ends[:, :, 3] = np.where(counts, slope[cells[:, None] + 1, around], 0.0) * h[:, None]
    return around, ends @ HERMITE.T


def _tangents(s: Array) -> Array:
    """Weights of nodal positions in dx/ds at the nodes, shape (n, n)."""
    n, h = len(s), np.diff(s)
    D = np.zeros((n, n))
    if n == 2:
        D[:, 0], D[:, 1] = -1.0 / h[0], 1.0 / h[0]
        return D
    i = np.arange(1, n - 1)
    a, b = h[:-1], h[1:]
    D[i, i - 1], D[i, i], D[i, i + 1] = -b / (a * (a + b)), (b - a) / (a * b), a / (b * (a + b))
    # The parabola through the three nodes at an end has there twice the slope of its chord less that at its middle.
    D[0], D[-1] = -D[1], -D[-2]
    D[0, :2] += np.array([-2.0, 2.0]) / h[0]
    D[-1, -2:] += np.array([-2.0, 2.0]) / h[-1]
    return D
