"""Which points a wall pushes, and how hard: compiled loops."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.compiled import compiled

__all__ = ["BLURRED", "GRAZING", "followed", "gathered", "touching"]

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

# Distance from touching, in radii, that is round-off.
GRAZING = 1e-9
# Part of what a number was before a step that is round-off of what it is after it.
BLURRED = 1e-13


@compiled
def followed(p: Array, torn: Flags, X: Array, was: Flags, X_0: Array, p_0: Array, p_X: Array) -> tuple[Flags, Array]:
    """What stays pressed after a linear step from X_0, and under which pressure its normals turn.

    That is p₀ + ∂p/∂X (X − X₀) for what was pressed, which stays as long as that is not below zero, but for round-off
    of p₀, or it is torn; the rest is pressed where its gap makes p positive.
    """
    pressed, expected = p > 0.0, np.zeros(len(p))
    for i in range(len(p)):
        if was[i]:
            hoped = p_0[i]
            for j in range(3):
                hoped += p_X[i, j] * (X[i, j] - X_0[i, j])
            pressed[i], expected[i] = hoped >= -BLURRED * abs(p_0[i]) or torn[i], max(hoped, 0.0)
    return pressed, expected


@compiled
def touching(
    p: Array, slope: Array, pressed: Flags, gap: Array, g_0: Array, eps_N: float, radius: Array
) -> tuple[Array, Array, Flags]:
    """Pressures and slopes of what is pressed or just touches, zero for the rest, and which points these are."""
    n = len(p)
    acting, slopes, touch = np.zeros(n), np.zeros(n), pressed.copy()
    for i in range(n):
        if pressed[i]:
            acting[i], slopes[i] = p[i], slope[i]
        elif abs(gap[i] - g_0[i]) <= GRAZING * radius[i]:
            slopes[i], touch[i] = -eps_N, True
    return acting, slopes, touch


@compiled
def gathered(
    touch: Flags,
    p: Array,
    slope: Array,
    at_end: Array,
    normal: Array,
    curvature: Array,
    level: float,
    arm: Array,
    expected: Array,
) -> tuple[Array, NDArray[np.intp], Array, Array, Array, Array, Array, Array]:
    """The points that touch, out of all.

    Args:
        touch: Which do, shape (n,).
        p: Line loads, shape (n,) [N/m].
        slope: Their slopes by the gap at the end of the step, shape (n,) [N/m²].
        at_end: Normals there, shape (n, 3).
        normal: Normals along which the wall pushes, shape (n, 3).
        curvature: There, shape (n, 3, 3) [1/m].
        level: How far they follow the end of the step.
        arm: Lever arms of tractions, shape (n,) [m].
        expected: Line loads under which normals turn, shape (n,) [N/m].

    Returns:
        ∂p/∂X of all, then the numbers of those that touch and what `Pressed` takes of them.
    """
    p_X, on = slope.reshape(-1, 1) * at_end, np.flatnonzero(touch)
    m = len(on)
    few_p, few_p_X, few_n, few_n_X = np.empty(m), np.empty((m, 3)), np.empty((m, 3)), np.empty((m, 3, 3))
    few_arm, few_expected = np.empty(m), np.empty(m)
    for k, i in enumerate(on):
        few_p[k], few_arm[k], few_expected[k] = p[i], arm[i], expected[i]
        for j in range(3):
            few_p_X[k, j], few_n[k, j] = p_X[i, j], normal[i, j]
            for a in range(3):
                few_n_X[k, j, a] = level * curvature[i, j, a]
    return p_X, on, few_p, few_p_X, few_n, few_n_X, few_arm, few_expected
