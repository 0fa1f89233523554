"""Products of what changes at points of contact with what nodes do, and blocks of nodes.

Kernels are given the arrays of a record one by one: to look at the type of a record costs Numba more than they do.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.compiled import compiled
from dolfinrod.scene.meeting.slopes import GAP, OPPOSITE, TURNS, WAYS
from dolfinrod.scene.meeting.vectors import Point, added, dotted, row, scaled

__all__ = ["Changes", "applied", "diagonal", "summed"]

Array = NDArray[np.float64]
Integers = NDArray[np.intp]


# Rows of `Changes.weights`, and of `Changes.vectors`.
H, H_V, H_END, LEVER, WHOLE = range(5)
V_X, V_V, GAP_E, FORCE, COUPLE, LONGER = range(6)


class Changes(NamedTuple):
    """Derivatives of forces and couples of points, and weights by which they depend on nodes and act on them.

    Args:
        weights: h and h_v as `Facing`, where the load acts; h at the end of the step; where friction has a moment,
            lever and whole as `Ways`; shape (n, 3 or 5, M).
        vectors: Change of the coordinate opposite by X and by V [1/m]; of the gap at the end of the step by E; the
            force [N]; where friction has a moment, n × t times length [N] and the change of a lever arm by X; shape
            (n, 4 or 6, 3).
        columns: As `slopes` has them.
        arm: Lever arm of the second rod [m].
    """

    weights: Array
    vectors: Array
    columns: Array
    arm: Array


@compiled
def _sum(weights: Array, nodes: Integers, change: Array) -> Point:
    """Of changes of nodes, by their weights."""
    x = y = z = 0.0
    for a in range(len(nodes)):
        x += weights[a] * change[nodes[a], 0]
        y += weights[a] * change[nodes[a], 1]
        z += weights[a] * change[nodes[a], 2]
    return x, y, z


@compiled
def _add(felt: Array, a: int, f: Point) -> None:
    felt[a, 0] += f[0]
    felt[a, 1] += f[1]
    felt[a, 2] += f[2]


@compiled
def _by(columns: Array, q: int, z: Point) -> Point:
    """Three columns from number q on, times a vector."""
    c = columns
    return (
        c[0, q] * z[0] + c[0, q + 1] * z[1] + c[0, q + 2] * z[2],
        c[1, q] * z[0] + c[1, q + 1] * z[1] + c[1, q + 2] * z[2],
        c[2, q] * z[0] + c[2, q + 1] * z[1] + c[2, q + 2] * z[2],
    )


@compiled
def _column(columns: Array, q: int) -> Point:
    return columns[0, q], columns[1, q], columns[2, q]


@compiled
def _changed(columns: Array, X: Point, δv: float, δg: float) -> Point:
    """Of force or couple, by places."""
    return added(added(_by(columns, 0, X), δv, _column(columns, OPPOSITE)), δg, _column(columns, GAP))


@compiled
def applied(
    nodes: Integers,
    pair: Integers,
    weights: Array,
    vectors: Array,
    columns: Array,
    arms: Array,
    dx: Array,
    dturn: Array,
) -> tuple[Array, Array]:
    """What acts on nodes as they change: forces and moments, each of shape (n_nodes, 3) like `dx` and `dturn`."""
    force, moment, turned = np.zeros(dx.shape), np.zeros(dx.shape), weights.shape[1] > 3
    for i in range(len(pair)):
        at, w, v, c, arm = nodes[pair[i]], weights[i], vectors[i], columns[i], arms[i]
        X = _sum(w[H], at, dx)
        δv = dotted(row(v, V_X), X) + dotted(row(v, V_V), _sum(w[H_V], at, dx))
        δg = dotted(row(v, GAP_E), _sum(w[H_END], at, dx))
        f, F = _changed(c[0], X, δv, δg), scaled(δv, row(v, FORCE))
        if turned:
            Θ, Ψ, C = _sum(w[LEVER], at, dturn), _sum(w[WHOLE], at, dturn), row(v, COUPLE)
            f = added(added(f, 1.0, _by(c[0], WAYS, Θ)), 1.0, _by(c[0], TURNS, Ψ))
            m = _changed(c[1], X, δv, δg)
            m = added(added(m, 1.0, _by(c[1], WAYS, Θ)), 1.0, _by(c[1], TURNS, Ψ))
            longer = dotted(row(v, LONGER), X)
            for a in range(len(at)):
                by_arms = w[WHOLE, a] * longer + w[H_V, a] * arm * δv
                _add(moment, at[a], added(scaled(-w[LEVER, a], m), -by_arms, C))
        for a in range(len(at)):
            _add(force, at[a], added(scaled(w[H, a], f), -w[H_V, a], F))
    return force, moment


@compiled
def _outer(matrix: Array, a: Point, b: Point) -> None:
    for j in range(3):
        for q in range(3):
            matrix[3 * j + q] = a[j] * b[q]


@compiled
def _by_places(K: Array, k: int, columns: Array, vectors: Array) -> None:
    """Matrices by which h, h_v and h_end of a node that moves count, from number k on."""
    _outer(K[k], _column(columns, OPPOSITE), row(vectors, V_X))
    _outer(K[k + 1], _column(columns, OPPOSITE), row(vectors, V_V))
    _outer(K[k + 2], _column(columns, GAP), row(vectors, GAP_E))
    for j in range(3):
        for q in range(3):
            K[k, 3 * j + q] += columns[j, q]


@compiled
def _matrices(columns: Array, vectors: Array, K: Array) -> None:
    """Of what the blocks of nodes at a point are sums, shape (15, 9): of forces by places, by turns; of couples."""
    _by_places(K, 0, columns[0], vectors)
    _outer(K[3], row(vectors, FORCE), row(vectors, V_X))
    _outer(K[4], row(vectors, FORCE), row(vectors, V_V))
    if len(columns) > 1:
        _by_places(K, 7, columns[1], vectors)
        _outer(K[10], row(vectors, COUPLE), row(vectors, LONGER))
        _outer(K[11], row(vectors, COUPLE), row(vectors, V_X))
        _outer(K[12], row(vectors, COUPLE), row(vectors, V_V))
        for j in range(3):
            for q in range(3):
                K[5, 3 * j + q], K[6, 3 * j + q] = columns[0, j, WAYS + q], columns[0, j, TURNS + q]
                K[13, 3 * j + q], K[14, 3 * j + q] = columns[1, j, WAYS + q], columns[1, j, TURNS + q]


@compiled
def _by_node(w: Array, arm: float, b: int, K: Array, by: Array, at: int) -> None:
    """What node b does to all nodes of a point by its place and its turn, before weights of these are put to it.

    Args:
        w: Weights of its nodes.
        arm: Of the second rod.
        b: Number of a node.
        K: Its matrices.
        by: Of forces by the place, felt by h and h_v of the others; of forces by the turn, felt by h; of couples by the
            place, felt by lever, whole and h_v; of couples by the turn, felt by lever; shape (2 or 7, m).
        at: The first of nine columns of these.
    """
    h, h_v, e = w[H, b], w[H_V, b], w[H_END, b]
    for q in range(9):
        by[0, at + q] = h * K[0, q] + h_v * K[1, q] + e * K[2, q]
        by[1, at + q] = h * K[3, q] + h_v * K[4, q]
    if len(by) > 2:
        lever, whole = w[LEVER, b], w[WHOLE, b]
        for q in range(9):
            by[2, at + q] = lever * K[5, q] + whole * K[6, q]
            by[3, at + q] = h * K[7, q] + h_v * K[8, q] + e * K[9, q]
            by[4, at + q] = h * K[10, q]
            by[5, at + q] = arm * (h * K[11, q] + h_v * K[12, q])
            by[6, at + q] = lever * K[13, q] + whole * K[14, q]


@compiled
def _add_blocks(w: Array, a: int, by: Array, blocks: Array, k: int) -> None:
    """Add what node a feels of that: f_x, f_turn, m_x, m_turn.

    Args:
        w: Weights of the nodes.
        a: Number of a node.
        by: As `_by_node` has it; long rows, of which the machine adds several numbers at once.
        blocks: Shape (n, 1 or 4, m).
        k: To which of them.
    """
    h, h_v = w[H, a], w[H_V, a]
    for q in range(by.shape[1]):
        blocks[k, 0, q] += h * by[0, q] - h_v * by[1, q]
    if len(by) > 2:
        lever, whole = w[LEVER, a], w[WHOLE, a]
        for q in range(by.shape[1]):
            blocks[k, 1, q] += h * by[2, q]
        for q in range(by.shape[1]):
            blocks[k, 2, q] -= lever * by[3, q] + whole * by[4, q] + h_v * by[5, q]
        for q in range(by.shape[1]):
            blocks[k, 3, q] -= lever * by[6, q]


@compiled
def summed(pair: Integers, weights: Array, vectors: Array, columns: Array, arms: Array, n_pairs: int) -> Array:
    """Blocks of pairs of cells: f_x, and f_turn, m_x, m_turn where anything turns; shape (n_pairs, M, 1 or 4, M, 9)."""
    M, turned, K = weights.shape[2], weights.shape[1] > 3, np.empty((15, 9))
    blocks, by = np.zeros((n_pairs * M, 4 if turned else 1, 9 * M)), np.empty((7 if turned else 2, 9 * M))
    for i in range(len(pair)):
        w = weights[i]
        _matrices(columns[i], vectors[i], K)
        for b in range(M):
            _by_node(w, arms[i], b, K, by, 9 * b)
        for a in range(M):
            _add_blocks(w, a, by, blocks, pair[i] * M + a)
    return blocks.reshape(n_pairs, M, blocks.shape[1], M, 9)


@compiled
def diagonal(
    nodes: Integers, pair: Integers, weights: Array, vectors: Array, columns: Array, arms: Array, n_nodes: int
) -> Array:
    """Those of single nodes, shape (n_nodes, 1 or 4, 9); nodes by pairs of cells, shape (P, M)."""
    turned, K = weights.shape[1] > 3, np.empty((15, 9))
    blocks, by = np.zeros((n_nodes, 4 if turned else 1, 9)), np.empty((7 if turned else 2, 9))
    for i in range(len(pair)):
        w = weights[i]
        _matrices(columns[i], vectors[i], K)
        for a in range(weights.shape[2]):
            _by_node(w, arms[i], a, K, by, 0)
            _add_blocks(w, a, by, blocks, nodes[pair[i], a])
    return blocks
