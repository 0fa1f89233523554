"""A few eigenvalues of an operator, multiple ones as often as they are due: Krylov spaces of a block of vectors.

A space grown from one vector meets one vector of each eigenspace, which is why ARPACK may miss one of the two planes
in which a round rod buckles. A block of b vectors finds up to b of each.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.linalg import qr

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["ACCURATE", "REAL", "clusters", "leading"]

# Accuracy of pairs unless less is asked for.
ACCURATE = 1e-13
MOST_CYCLES = 40
# Powers of the operator in the space.
DEPTH = 6
# A direction of a block that is this small a part of it adds nothing but round-off.
INDEPENDENT = 1e-12
# An imaginary part this small a part of the eigenvalue is round-off of a double real one.
REAL = 1e-6
# Eigenvalues this close, relative to their magnitude, are one.
TOGETHER = 1e-6


def leading(
    times: Callable[[Array], Array],
    free: NDArray[np.bool_],
    n: int,
    rank: Callable[[NDArray[np.complex128]], Array],
    accuracy: float = ACCURATE,
    least: float = 0.0,
) -> tuple[NDArray[np.complex128], NDArray[np.complex128], float]:
    """Eigenpairs that come first in a ranking.

    Args:
        times: The operator, on columns.
        free: Where vectors may differ from zero.
        n: How many are wanted; fewer are found where the operator has fewer.
        rank: The larger the sooner; must prefer an end of the spectrum.
        accuracy: Residual of a pair, over the largest eigenvalue, at which it is accepted.
        least: Part of the largest eigenvalue below which one is not worth waiting for.

    Returns:
        Values, shape (m,), vectors, shape (n_unknowns, m), m ≤ n, and the largest magnitude met.
    """
    width = n + 3
    block = np.random.default_rng(0).standard_normal((len(free), width)) * free[:, None]
    values, vectors, largest = np.zeros(0, dtype=complex), np.zeros((len(free), 0), dtype=complex), 0.0
    for _ in range(MOST_CYCLES):
        Q, AQ = _space(times, block)
        values, Y = np.linalg.eig(Q.T @ AQ)
        order = np.argsort(-rank(values), kind="stable")
        largest = float(np.abs(values).max(initial=0.0))
        values, Y = values[order][:n].astype(complex), Y[:, order]
        vectors = _combined(Q, Y[:, :n])
        error = np.linalg.norm(_combined(AQ, Y[:, :n]) - vectors * values, axis=0)[np.abs(values) >= least * largest]
        if error.max(initial=0.0) <= accuracy * largest or Q.shape[1] == int(free.sum()):
            break
        kept = Y[:, :width]
        block = Q @ np.concatenate([kept.real, kept.imag], axis=1)
        # Not kept beside the next ones: they are most of what there is.
        del Q, AQ
    return values, vectors, largest


def clusters(values: NDArray[np.complex128] | Array) -> NDArray[np.int64]:
    """How many of the values are equal to each, itself included."""
    gaps = np.abs(values[:, None] - values[None])
    return np.asarray((gaps <= TOGETHER * np.abs(values)[:, None]).sum(axis=1), dtype=np.int64)


def _combined(real: Array, Y: NDArray[np.complex128]) -> NDArray[np.complex128]:
    """Product of a large real matrix and a small complex one, without a complex copy of the first."""
    product = np.empty((len(real), Y.shape[1]), dtype=complex)
    product.real, product.imag = real @ Y.real, real @ Y.imag
    return product


def _space(times: Callable[[Array], Array], block: Array) -> tuple[Array, Array]:
    """Orthonormal basis of the Krylov space of a block, and the operator on it."""
    shape, n = (len(block), DEPTH * block.shape[1]), 0
    Q, images = np.empty(shape, order="F"), np.empty(shape, order="F")
    for _ in range(DEPTH):
        size = np.linalg.norm(block)
        for _ in range(2):
            block = block - Q[:, :n] @ (Q[:, :n].T @ block)
        W, R, _ = qr(block, overwrite_a=True, mode="economic", pivoting=True)
        new = W[:, np.abs(np.diag(R)) > INDEPENDENT * size]
        if not new.shape[1]:
            break
        block, before, n = times(new), n, n + new.shape[1]
        Q[:, before:n], images[:, before:n] = new, block
    return Q[:, :n], images[:, :n]
