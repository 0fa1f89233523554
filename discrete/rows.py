"""Vectors and turns of many sections, component by component: a row holds one component of all of them.

A step in time asks for little at a time but often. Rows are contiguous, so that NumPy is quickest with them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from discrete.unknowns import AXIAL

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["BLOCK", "cross", "dot", "of_frames", "of_vectors", "rotated", "turn", "turn_back", "turned"]

# Elements at once, of which what comes in between stays in the processor's memory.
BLOCK = 1024
# With the first two components repeated behind the last, every component finds its next two behind it.
_AROUND = np.array([0, 1, 2, 0, 1])


def of_vectors(vectors: Array) -> Array:
    """Rows of vectors, shape (n, k) → (k, n); the same memory where it is by rows already."""
    return np.ascontiguousarray(vectors.T)


def of_frames(frames: Array) -> Array:
    """Rows of frames, shape (n, 3, 3) → (3, 3, n); the same memory where it is by rows already."""
    return np.ascontiguousarray(frames.transpose(1, 2, 0))


def dot(a: Array, b: Array) -> Array:
    """Products a·b, shapes (3, ...) → (...)."""
    total: Array = np.add.reduce(a * b)
    return total


def cross(a: Array, b: Array) -> Array:
    """Products a × b, shapes (3, ...)."""
    a, b = a.take(_AROUND, axis=0), b.take(_AROUND, axis=0)
    product = a[1:4] * b[2:]
    product -= a[2:] * b[1:4]
    return product


def turn(R: Array, vectors: Array) -> Array:
    """Vectors R v, frames of shape (3, 3, n), vectors (k, 3, n)."""
    return np.einsum("ijn,ajn->ain", R, vectors)


def turn_back(R: Array, vectors: Array) -> Array:
    """Vectors Rᵀ v, shapes as for `turn`."""
    return np.einsum("jin,ajn->ain", R, vectors)


def rotated(way: Callable[[Array, Array], Array], Q: Array, rows: Array) -> Array:
    """Forces or increments of all nodes, shape (7, n_nodes), by `turn` or `turn_back`; those along elements stay."""
    n, new = rows.shape[1], np.empty_like(rows)
    new[:AXIAL] = way(Q, rows[:AXIAL].reshape(2, 3, n)).reshape(AXIAL, n)
    new[AXIAL] = rows[AXIAL]
    return new


def turned(R: Array, θ: Array) -> Array:
    """Frames exp(θ) R = R + θ × (a R + b θ×R), a = sin φ/φ, b = (1 − cos φ)/φ², φ = |θ|.

    Args:
        R: Frames, shape (3, 3, n).
        θ: Rotation vectors, shape (3, n) [rad].

    Returns:
        Shape (3, 3, n).
    """
    half = np.sqrt(dot(θ, θ))
    half *= 0.5
    # sin x/x → 1 as x → 0: the tiny number only keeps 0/0 out.
    half += 1e-300
    sinc = np.sin(half)
    sinc /= half
    change = cross(θ[:, None], R)
    change *= 0.5 * sinc * sinc
    change += (sinc * np.cos(half)) * R
    change = cross(θ[:, None], change)
    change += R
    return change
