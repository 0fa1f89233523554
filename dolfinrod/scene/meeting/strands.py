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
# Rows: ξ (1 − ξ)² (1 − 6ξ + 7ξ²), whose slope is 1 at 0, and what mirrors it, with slope 1 at 1; columns: powers of ξ.
# Without mean and first moment: even loads, and those that grow evenly, go to the nodes as if they were not there.
BUMPS = np.array([[0.0, 1.0, -8.0, 20.0, -20.0, 7.0], [0.0, 0.0, -2.0, 10.0, -15.0, 7.0]])


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
        """Polynomials through the k + 1 nodes of each element, their kinks smoothed out, cut into k spans.

        x = Σ w_a x_a + h [(x'(0) − Σ w_a'(0) x_a) b_0(ξ) + (x'(1) − Σ w_a'(1) x_a) b_1(ξ)]: where two elements meet,
        both end with the tangent x' of the polynomial through the ⌈k/2⌉ nodes on either side and the one they share, so
        that curves of degree k remain what they are. Nodes inside are missed by as little as the elements are wrong.

        Args:
            rod: Of each element, shape (n_cells,).
            s: Arc lengths of the ends of the elements, shape (n_cells, 2) [m].
            nodes: Rows of the table of nodes, shape (n_cells, k + 1), in the order of `places`.
            places: Local coordinates of the nodes, from 0 to 1, shape (k + 1,).
            radius: Of each rod, shape (n_rods,) [m].

        Returns:
            Curves without kinks, each element with nodes of those beside it.
        """
        rod, s, nodes, k = np.asarray(rod), np.asarray(s), np.asarray(nodes), len(places) - 1
        beside = (k + 1) // 2
        left = np.flatnonzero(rod[1:] == rod[:-1])
        # At the ends of rods the last node is repeated, without weight.
        before, after = np.repeat(nodes[:, :1], beside, axis=1), np.repeat(nodes[:, -1:], beside, axis=1)
        before[left + 1], after[left] = nodes[left, k - beside : k], nodes[left + 1, 1 : beside + 1]
        every = np.concatenate([before, nodes, after], axis=1)
        own = np.linalg.inv(np.vander(places, increasing=True)).T
        shape = np.zeros((*every.shape, max(k + 1, BUMPS.shape[1])))
        shape[:, beside:-beside, : k + 1] = own
        shape[:, :, : BUMPS.shape[1]] += _turned(np.ptp(s, axis=1), left, places, own) @ BUMPS
        return cls(rod, s, every, shape, np.asarray(radius), k)


def _turned(long: Array, left: Integers, places: Array, own: Array) -> Array:
    """By how much ends of elements turn, weights of nodes in dx/dξ at 0 and at 1, shape (n_cells, m, 2).

    Args:
        long: Lengths of elements [m].
        left: Those on which another one follows.
        places: Local coordinates of their nodes.
        own: Coefficients of their polynomials.
    """
    k, right = len(places) - 1, left + 1
    beside = (k + 1) // 2
    turned = np.zeros((len(long), k + 1 + 2 * beside, 2))
    behind, ahead = places[k - beside : k] - 1.0, places[: beside + 1]
    slope = _slopes_at_zero(np.concatenate([long[left, None] * behind, long[right, None] * ahead], axis=1), beside)
    turned[right, : 2 * beside + 1, 0] = long[right, None] * slope
    turned[left, k:, 1] = long[left, None] * slope
    turned[right, beside:-beside, 0] -= own[:, 1]
    turned[left, beside:-beside, 1] -= own @ np.arange(k + 1)
    return turned


def _slopes_at_zero(t: Array, middle: int) -> Array:
    """Weights, in the slope of the polynomial through places t, of its values; the middle one is at 0; shape as t."""
    apart = t[:, :, None] - t[:, None] + np.eye(t.shape[1])
    part = 1.0 / apart.prod(axis=2)
    weights = np.asarray(-part / (part[:, middle, None] * (t + np.eye(t.shape[1])[middle])))
    weights[:, middle] = 0.0
    weights[:, middle] = -weights.sum(axis=1)
    return weights


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
