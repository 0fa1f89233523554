"""One vector of increments or forces after the other: solved for, turned, answered; compiled loops.

Where rods touch one another a step asks for this dozens of times, and for so little that every call counts.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from discrete.unknowns import N_ELEMENT
from dolfinrod.scene.compiled import compiled

__all__ = ["resisted", "solved", "turned_back", "turned_blocks", "turned_on"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

# Sub- and superdiagonals of an element's unknowns, and superdiagonals after lines have been exchanged.
REACH, BEFORE = N_ELEMENT - 1, 2 * (N_ELEMENT - 1)


@compiled
def solved(band: Array, pivots: NDArray[np.signedinteger[Any]], left: Array, right: Array, b: Array) -> Array:
    """Solution of one system by the factors of a band.

    Args:
        band: L and U as LAPACK leaves them, its columns as rows, shape (n, 3 · REACH + 1).
        pivots: Exchanged lines, shape (n,).
        left: Scale of the right-hand side, shape (n,).
        right: Scale of the solution, shape (n,).
        b: Right-hand side, shape (n,).

    Returns:
        Shape (n,).
    """
    # With room at both ends all loops are of one length, which compilers unroll.
    n, x = len(b), np.zeros(len(b) + BEFORE + REACH)
    for j in range(n):
        x[BEFORE + j] = left[j] * b[j]
    for j in range(n):
        at, other = BEFORE + j, BEFORE + pivots[j]
        one = x[other]
        x[other], x[at] = x[at], one
        below, L = x[at + 1 : at + 1 + REACH], band[j, BEFORE + 1 :]
        for i in range(REACH):
            below[i] -= one * L[i]
    for j in range(n - 1, -1, -1):
        one = x[BEFORE + j] * (1.0 / band[j, BEFORE])
        x[BEFORE + j] = one
        above, U = x[j : j + BEFORE], band[j]
        for i in range(BEFORE):
            above[i] -= one * U[i]
    return x[BEFORE : BEFORE + n] * right


@compiled
def turned_back(Q: Array, d: Array) -> Array:
    """Vectors of all nodes, Qᵀ v, those along elements as they are.

    Args:
        Q: Shape (3, 3, n_nodes).
        d: Shape (n_nodes, 7).

    Returns:
        Shape (n_nodes, 7).
    """
    back = np.empty(d.shape)
    for n in range(len(d)):
        for k in range(0, 6, 3):
            for j in range(3):
                back[n, k + j] = Q[0, j, n] * d[n, k] + Q[1, j, n] * d[n, k + 1] + Q[2, j, n] * d[n, k + 2]
        back[n, 6] = d[n, 6]
    return back


@compiled
def turned_on(Q: Array, d: Array) -> Array:
    """The same with Q v."""
    on = np.empty(d.shape)
    for n in range(len(d)):
        for k in range(0, 6, 3):
            for j in range(3):
                on[n, k + j] = Q[j, 0, n] * d[n, k] + Q[j, 1, n] * d[n, k + 1] + Q[j, 2, n] * d[n, k + 2]
        on[n, 6] = d[n, 6]
    return on


@compiled
def resisted(nodes: Indices, blocks: Array, d: Array, change: Array) -> None:
    """Take what single nodes resist off a change of forces.

    Args:
        nodes: Shape (m,).
        blocks: Of these, shape (m, 6, 6).
        d: Increments of all nodes, shape (n_nodes, 7).
        change: Likewise; changes.
    """
    for k in range(len(nodes)):
        at = nodes[k]
        for i in range(6):
            for j in range(6):
                change[at, i] -= blocks[k, i, j] * d[at, j]


@compiled
def turned_blocks(Q: Array, nodes: Indices, blocks: Array) -> Array:
    """Resistance of single nodes turned with them, Q B Qᵀ for each 3 × 3 block B.

    Args:
        Q: Shape (3, 3, n_nodes).
        nodes: Shape (m,).
        blocks: Of these, shape (m, 6, 6).

    Returns:
        Shape (m, 6, 6).
    """
    to, half = np.zeros(blocks.shape), np.empty((3, 6))
    for k in range(len(nodes)):
        n = nodes[k]
        for a in range(0, 6, 3):
            for i in range(3):
                for j in range(6):
                    half[i, j] = 0.0
                    for q in range(3):
                        half[i, j] += Q[i, q, n] * blocks[k, a + q, j]
            for i in range(3):
                for b in range(0, 6, 3):
                    for j in range(3):
                        for q in range(3):
                            to[k, a + i, b + j] += half[i, b + q] * Q[j, q, n]
    return to
