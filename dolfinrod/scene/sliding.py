"""What points that press on a wall slide and how that changes with where they are: compiled loops.

All vectors are in the axes of the wall, one row a point; `dolfinrod.scene.rubbing` says what they are.
"""

from __future__ import annotations

from math import sqrt

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.compiled import compiled

__all__ = ["lever_slopes", "mapped", "passed", "slip_slopes", "torn", "traction_slopes"]

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

# Of a traction, against its limit.
ROUND_OFF = 1e-12


@compiled
def passed(
    on: NDArray[np.intp],
    X: Array,
    X_0: Array,
    turned: Array,
    n: Array,
    radius: Array,
    u_0: Array,
    afar: Flags,
    gap: Array,
    gap_0: Array,
    g_0: float,
) -> tuple[Array, Array, Array]:
    """How far the rods' surface has gone past the wall in a step, w = X − X₀ − r Ψ × n.

    Args:
        on: Numbers of the points that touch, shape (m,).
        X: All points, shape (n, 3) [m].
        X_0: Where they began.
        turned: Turns of their sections Ψ, shape (n, 3) [rad].
        n: Normals of those that touch, shape (m, 3).
        radius: Their lever arms, shape (m,) [m].
        u_0: Displacement of all from their anchors where they began, shape (n, 3) [m].
        afar: Which of all were so far off then that they have touched only over the last part of the way, shape (n,).
        gap: Of all, shape (n,) [m].
        gap_0: Where they began.
        g_0: Gap at which contact begins [m].

    Returns:
        That part, 1 for others, w and the displacement from the anchors u₀ + part · w, shapes (m,), (m, 3), (m, 3).
    """
    share, w, v = np.ones(len(on)), np.empty((len(on), 3)), np.empty((len(on), 3))
    for k, i in enumerate(on):
        if afar[i]:
            share[k] = min(max((g_0 - gap[i]) / abs(gap_0[i] - gap[i]), 0.0), 1.0)
        for a in range(3):
            b, c = (a + 1) % 3, (a + 2) % 3
            w[k, a] = X[i, a] - X_0[i, a] - radius[k] * (turned[i, b] * n[k, c] - turned[i, c] * n[k, b])
            v[k, a] = u_0[i, a] + share[k] * w[k, a]
    return share, w, v


@compiled
def torn(stuck: Flags, X: Array, X_0: Array, turned: Array, n: Array, radius: Array, u_0: Array, reach: Array) -> Flags:
    """Which of the points that stuck, shape (n,), are now farther from their anchors than friction reaches there.

    Arguments as for `passed`, all of all points; reach, shape (n,) [m], is what the pressure of the last answer allows.
    """
    found, u = np.zeros_like(stuck), np.empty(3)
    for i in range(len(stuck)):
        if stuck[i]:
            off = 0.0
            for a in range(3):
                b, c = (a + 1) % 3, (a + 2) % 3
                rolled = turned[i, b] * n[i, c] - turned[i, c] * n[i, b]
                u[a] = u_0[i, a] + X[i, a] - X_0[i, a] - radius[i] * rolled
                off += u[a] * n[i, a]
            far = sqrt((u[0] - off * n[i, 0]) ** 2 + (u[1] - off * n[i, 1]) ** 2 + (u[2] - off * n[i, 2]) ** 2)
            found[i] = far > reach[i]
    return found


@compiled
def mapped(
    p: Array, n: Array, v: Array, μ: float, ε_T: float, clings: Flags, glides: Flags, slid: Array
) -> tuple[Array, Array, Array, Array, Flags, bool]:
    """Return mapping; arguments as `rubbed`.

    Returns:
        Tractions, displacements from the anchors, ways of these, displacements from where they were, which of them
        moved, and whether any was kept from it or made to.
    """
    m, forced = len(p), False
    traction, anchored, u = np.empty((m, 3)), np.empty((m, 3)), np.empty((m, 3))
    slipped, slides = np.zeros(m), np.zeros(m, dtype=np.bool_)
    for k in range(m):
        off = v[k, 0] * n[k, 0] + v[k, 1] * n[k, 1] + v[k, 2] * n[k, 2]
        for a in range(3):
            u[k, a] = v[k, a] - off * n[k, a]
        far = sqrt(u[k, 0] ** 2 + u[k, 1] ** 2 + u[k, 2] ** 2)
        reach = μ * p[k] / ε_T
        onward = u[k, 0] * slid[k, 0] + u[k, 1] * slid[k, 1] + u[k, 2] * slid[k, 2] >= 0.0
        slides[k] = (far > max(reach, 0.0) and not clings[k] and onward) or (glides[k] and far > 0.0)
        held = 1.0
        if slides[k]:
            held = reach / far
            forced = forced or far < reach * (1.0 - ROUND_OFF)
            slipped[k] = far - reach if p[k] > 0.0 else 0.0
        else:
            forced = forced or far > reach * (1.0 + ROUND_OFF)
        for a in range(3):
            anchored[k, a] = held * u[k, a]
            traction[k, a] = -ε_T * anchored[k, a]
    return traction, anchored, slipped, u, slides, forced


@compiled
def slip_slopes(
    turned: Array,
    n: Array,
    n_X: Array,
    radius: Array,
    p_X: Array,
    share: Array,
    w: Array,
    v: Array,
    gap: Array,
    start: Array,
    g_0: float,
) -> tuple[Array, Array]:
    """∂u/∂X and ∂u/∂Ψ of points that touch; arguments and formula as `slip_gradients`, each of the m points alone."""
    m = len(n)
    u_X, u_Ψ, v_X = np.empty((m, 3, 3)), np.empty((m, 3, 3)), np.empty((3, 3))
    for k in range(m):
        size, fading, off = sqrt(p_X[k, 0] ** 2 + p_X[k, 1] ** 2 + p_X[k, 2] ** 2), 0.0, 0.0
        if 0.0 < share[k] < 1.0 and size > 0.0:
            fading = (start[k] - g_0) / (start[k] - gap[k]) ** 2 / size
        for a in range(3):
            b, c = (a + 1) % 3, (a + 2) % 3
            off += n[k, a] * v[k, a]
            for j in range(3):
                rolled = turned[k, b] * n_X[k, c, j] - turned[k, c] * n_X[k, b, j]
                still = 1.0 if a == j else 0.0
                v_X[a, j] = share[k] * (still - radius[k] * rolled) + w[k, a] * fading * p_X[k, j]
        for j in range(3):
            along = 0.0
            for a in range(3):
                along += n[k, a] * v_X[a, j] + n_X[k, a, j] * v[k, a]
            for a in range(3):
                u_X[k, a, j] = v_X[a, j] - n[k, a] * along - off * n_X[k, a, j]
        # P (n × ·) is n × · itself.
        for a in range(3):
            b, c = (a + 1) % 3, (a + 2) % 3
            u_Ψ[k, a, a] = 0.0
            u_Ψ[k, a, b], u_Ψ[k, a, c] = -share[k] * radius[k] * n[k, c], share[k] * radius[k] * n[k, b]
    return u_X, u_Ψ


@compiled
def traction_slopes(p: Array, p_q: Array, u: Array, slides: Flags, u_q: Array, μ: float, ε_T: float) -> Array:
    """∂t/∂q; arguments as `traction_gradient`."""
    m, width = len(p), u_q.shape[2]
    t_q = np.empty((m, 3, width))
    for k in range(m):
        far = sqrt(u[k, 0] ** 2 + u[k, 1] ** 2 + u[k, 2] ** 2)
        if not slides[k] or far == 0.0:
            for a in range(3):
                for j in range(width):
                    t_q[k, a, j] = -ε_T * u_q[k, a, j]
            continue
        held = μ * p[k] / far
        for j in range(width):
            along = (u[k, 0] * u_q[k, 0, j] + u[k, 1] * u_q[k, 1, j] + u[k, 2] * u_q[k, 2, j]) / far
            for a in range(3):
                e = u[k, a] / far
                t_q[k, a, j] = -held * (u_q[k, a, j] - e * along) - μ * e * p_q[k, j]
    return t_q


@compiled
def lever_slopes(n: Array, n_q: Array, radius: Array, t: Array, t_q: Array) -> Array:
    """∂m/∂q of the moments m = −r n × t, shape (m, 3, 3)."""
    m_q = np.empty_like(t_q)
    for k in range(len(n)):
        for a in range(3):
            b, c = (a + 1) % 3, (a + 2) % 3
            for j in range(3):
                turned = n[k, b] * t_q[k, c, j] - n[k, c] * t_q[k, b, j]
                turned += n_q[k, b, j] * t[k, c] - n_q[k, c, j] * t[k, b]
                m_q[k, a, j] = -radius[k] * turned
    return m_q
