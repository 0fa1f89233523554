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
def _add_block(w: Array, arm: float, a: int, b: int, K: Array, block: Array) -> None:
    """Add the change of force and moment of node a of a point by the place and the turn of b: f_x, f_turn, m_x, m_turn.

    Args:
        w: Weights of its nodes.
        arm: Of the second rod.
        a: Number of a node.
        b: Likewise.
        K: Its matrices.
        block: Shape (9,), or (36,) where anything turns.
    """
    h_a, h_b, v_a, v_b, e = w[H, a], w[H, b], w[H_V, a], w[H_V, b], w[H_END, b]
    for q in range(9):
        moved = h_b * K[0, q] + v_b * K[1, q] + e * K[2, q]
        block[q] += h_a * moved - v_a * (h_b * K[3, q] + v_b * K[4, q])
    if len(block) > 9:
        l_a, l_b, w_b, longer, arm_v = w[LEVER, a], w[LEVER, b], w[WHOLE, b], w[WHOLE, a] * h_b, arm * v_a
        for q in range(9):
            moved = h_b * K[7, q] + v_b * K[8, q] + e * K[9, q]
            block[9 + q] += h_a * (l_b * K[5, q] + w_b * K[6, q])
            block[18 + q] -= l_a * moved + longer * K[10, q] + arm_v * (h_b * K[11, q] + v_b * K[12, q])
            block[27 + q] -= l_a * (l_b * K[13, q] + w_b * K[14, q])


@compiled
def summed(pair: Integers, weights: Array, vectors: Array, columns: Array, arms: Array, n_pairs: int) -> Array:
    """Blocks of pairs of cells, as `_add_block` has them, shape (n_pairs, M, M, 9 or 36)."""
    M, K = weights.shape[2], np.empty((15, 9))
    blocks = np.zeros((n_pairs, M, M, 36 if weights.shape[1] > 3 else 9))
    for i in range(len(pair)):
        w, arm, block = weights[i], arms[i], blocks[pair[i]]
        _matrices(columns[i], vectors[i], K)
        for a in range(M):
            for b in range(M):
                _add_block(w, arm, a, b, K, block[a, b])
    return blocks


@compiled
def diagonal(
    nodes: Integers, pair: Integers, weights: Array, vectors: Array, columns: Array, arms: Array, n_nodes: int
) -> Array:
    """Those of single nodes, shape (n_nodes, 9 or 36); nodes by pairs of cells, shape (P, M)."""
    blocks, K = np.zeros((n_nodes, 36 if weights.shape[1] > 3 else 9)), np.empty((15, 9))
    for i in range(len(pair)):
        w, arm = weights[i], arms[i]
        _matrices(columns[i], vectors[i], K)
        for a in range(weights.shape[2]):
            _add_block(w, arm, a, a, K, blocks[nodes[pair[i], a]])
    return blocks
