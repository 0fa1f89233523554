"""Into the axes of a wall, and what it does to points and how that changes back into space: compiled loops."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.compiled import compiled
from dolfinrod.scene.reply import OPEN, SLIDES, STICKS

__all__ = ["felt", "into_space", "onto_wall"]

Array = NDArray[np.float64]
Numbers = NDArray[np.intp]
Flags = NDArray[np.bool_]
States = NDArray[np.int8]


@compiled
def onto_wall(x: Array, turn: Array, Q: Array, c: Array, wall_turn: Array) -> tuple[Array, Array]:
    """Points and turns of sections in axes of a wall, Qᵀ (x − c) and Qᵀ ψ less the turn of the wall itself.

    Args:
        x: In space, shape (n, 3) [m].
        turn: Rotation vectors in space, shape (n, 3) [rad].
        Q: Axes of the wall as columns, shape (3, 3).
        c: Where its origin is, shape (3,) [m].
        wall_turn: In these axes, shape (3,) [rad].

    Returns:
        Both, shape (n, 3) each.
    """
    X, turned = np.empty((len(x), 3)), np.empty((len(x), 3))
    for i in range(len(x)):
        a, b, d = x[i, 0] - c[0], x[i, 1] - c[1], x[i, 2] - c[2]
        for j in range(3):
            X[i, j] = a * Q[0, j] + b * Q[1, j] + d * Q[2, j]
            turned[i, j] = turn[i, 0] * Q[0, j] + turn[i, 1] * Q[1, j] + turn[i, 2] * Q[2, j] - wall_turn[j]
    return X, turned


@compiled
def felt(
    before: States, on: Numbers, p: Array, normal: Array, radius: Array, traction: Array, slides: Flags, Q: Array
) -> tuple[Array, Array, Array, Array, States, Flags, bool]:
    """What all points feel in space.

    Args:
        before: States of all points in the answer before, shape (n,).
        on: Numbers of those that touch, shape (m,).
        p: Their line loads, shape (m,) [N/m].
        normal: In axes of the wall, shape (m, 3).
        radius: Lever arms of their tractions, shape (m,) [m].
        traction: In axes of the wall, shape (m, 3) [N/m].
        slides: Which do not stick, shape (m,).
        Q: These axes as columns, shape (3, 3).

    Returns:
        Pressures, normals, tractions, their moments −r n × t, and states, as `Reply`; which stick under pressure;
        whether any state is another than before.
    """
    n = len(before)
    pressure, state, sticks = np.zeros(n), np.full(n, OPEN, dtype=np.int8), np.zeros(n, dtype=np.bool_)
    normals, tractions, moments = np.zeros((n, 3)), np.zeros((n, 3)), np.zeros((n, 3))
    for k, i in enumerate(on):
        pressure[i] = p[k]
        if p[k] != 0.0:
            state[i] = SLIDES if slides[k] else STICKS
            sticks[i] = p[k] > 0.0 and not slides[k]
        for a in range(3):
            b, c = (a + 1) % 3, (a + 2) % 3
            moment = -radius[k] * (normal[k, b] * traction[k, c] - normal[k, c] * traction[k, b])
            for j in range(3):
                normals[i, j] += Q[j, a] * normal[k, a]
                tractions[i, j] += Q[j, a] * traction[k, a]
                moments[i, j] += Q[j, a] * moment
    return pressure, normals, tractions, moments, state, sticks, bool(np.any(state != before))


@compiled
def into_space(Q: Array, blocks: Array, E: Array) -> Array:
    """Q B Eᵀ of blocks B, shape (m, 3, 3): vectors in axes Q that change with vectors in axes E."""
    out, half = np.empty_like(blocks), np.empty((3, 3))
    for k in range(len(blocks)):
        for a in range(3):
            for j in range(3):
                half[a, j] = Q[a, 0] * blocks[k, 0, j] + Q[a, 1] * blocks[k, 1, j] + Q[a, 2] * blocks[k, 2, j]
        for a in range(3):
            for j in range(3):
                out[k, a, j] = half[a, 0] * E[j, 0] + half[a, 1] * E[j, 1] + half[a, 2] * E[j, 2]
    return out
