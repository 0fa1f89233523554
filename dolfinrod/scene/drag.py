"""Drag of a long cylinder in a flow of any Reynolds number: compiled loops over points."""

from __future__ import annotations

from math import exp, log, pi, sqrt

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.compiled import compiled

__all__ = ["CREEPING", "drag_coefficients", "linearized", "resistances", "resisting"]

Array = NDArray[np.float64]

# Reynolds numbers at which the formulas for c_n and c_t change.
SLOW, FAST = 0.1, 100.0
# Below this one the drag is linear in the velocity, w c(w) staying what it is here.
CREEPING = 1e-3
S_0 = 2.0022
# A speed below which there is no direction [m/s].
TINY = float(np.finfo(float).tiny)


def drag_coefficients(w: Array) -> tuple[Array, Array]:
    """Drag of a long cylinder across and along it.

    Slender-body theory for w < 0.1, a fit in log w up to 100, boundary layers beyond; w c(w) is constant below 1e-3.

    Args:
        w: Reynolds number of the velocity across, shape (n,), positive.

    Returns:
        c_n and c_t, shape (n,) each.

    Source: Marheineke & Wegener 2011, with S(w) = 2.0022 − ln w.
    """
    k_n, k_t, *_ = resistances(w)
    return k_n / w, k_t / w


@compiled
def resistances(w: Array) -> Array:
    """Force per velocity k(w) = w c(w), with which f = ρ_a ν (k_n v_n + k_t v_t), and its slope.

    Args:
        w: Reynolds number of the velocity across, shape (n,).

    Returns:
        Rows k_n, k_t, dk_n/dw, dk_t/dw, shape (4, n); the slopes vanish where the flow creeps.
    """
    k = np.empty((4, len(w)))
    for i in range(len(w)):
        k[0, i], k[1, i], k[2, i], k[3, i] = _resistance(w[i])
    return k


@compiled
def resisting(v: Array, tangent: Array, per_speed: Array, viscosity: float) -> Array:
    """Force per length k_n v_n + k_t v_t times the viscosity.

    Args:
        v: Velocity of the air against the rod, shape (n, 3) [m/s].
        tangent: Unit tangent of the rod, shape (n, 3).
        per_speed: Reynolds number per speed across, shape (n,) [s/m].
        viscosity: ρ_a ν [Pa s].

    Returns:
        Shape (n, 3) [N/m].
    """
    f = np.empty((len(v), 3))
    for i in range(len(v)):
        along, n_0, n_1, n_2 = _parts(v, tangent, i)
        k_n, k_t, _, _ = _resistance(per_speed[i] * sqrt(n_0 * n_0 + n_1 * n_1 + n_2 * n_2))
        k_n, k_t = viscosity * k_n, viscosity * k_t * along
        f[i, 0] = k_n * n_0 + k_t * tangent[i, 0]
        f[i, 1] = k_n * n_1 + k_t * tangent[i, 1]
        f[i, 2] = k_n * n_2 + k_t * tangent[i, 2]
    return f


@compiled
def linearized(v: Array, tangent: Array, per_speed: Array, viscosity: float) -> tuple[Array, Array, Array]:
    """The same with ∂f/∂v and ∂f/∂t, as `Air.linearized_drag` has them; arguments as `resisting`."""
    n = len(v)
    f, by_v, by_t = np.empty((n, 3)), np.empty((n, 3, 3)), np.empty((n, 3, 3))
    v_n = np.empty(3)
    for i in range(n):
        along, v_n[0], v_n[1], v_n[2] = _parts(v, tangent, i)
        speed = sqrt(v_n[0] * v_n[0] + v_n[1] * v_n[1] + v_n[2] * v_n[2])
        k_n, k_t, slope_n, slope_t = _resistance(per_speed[i] * speed)
        k_n, gap = viscosity * k_n, viscosity * (k_t - k_n)
        for a in range(3):
            t = tangent[i, a]
            f[i, a] = k_n * v_n[a] + viscosity * k_t * along * t
            rise = viscosity * (slope_n * v_n[a] + slope_t * along * t) * per_speed[i]
            for j in range(3):
                one = 1.0 if a == j else 0.0
                change = rise * (v_n[j] / max(speed, TINY))
                by_v[i, a, j] = k_n * one + gap * t * tangent[i, j] + change
                by_t[i, a, j] = gap * (t * v[i, j] + along * one) - along * change
    return f, by_v, by_t


@compiled
def _parts(v: Array, tangent: Array, i: int) -> tuple[float, float, float, float]:
    """v·t and v_n of a point."""
    t_0, t_1, t_2 = tangent[i, 0], tangent[i, 1], tangent[i, 2]
    along = v[i, 0] * t_0 + v[i, 1] * t_1 + v[i, 2] * t_2
    return along, v[i, 0] - along * t_0, v[i, 1] - along * t_1, v[i, 2] - along * t_2


@compiled
def _resistance(w: float) -> tuple[float, float, float, float]:
    """k_n, k_t, dk_n/dw, dk_t/dw at one Reynolds number."""
    if w <= CREEPING:
        k_n, k_t, _, _ = _slender(CREEPING)
        return k_n, k_t, 0.0, 0.0
    if w < SLOW:
        return _slender(w)
    return _fit(w) if w <= FAST else _layers(w)


@compiled
def _slender(w: float) -> tuple[float, float, float, float]:
    """k_n = 4π [1/S − w² P/32], P = 1 − 1/(2S) + 5/(16S²); k_t = 4π [1/Q − w² U/32], Q = 2S − 1, U = 1 + 1/Q²."""
    S = S_0 - log(w)
    Q = 2.0 * S - 1.0
    P, U = 1.0 - 1.0 / (2.0 * S) + 5.0 / (16.0 * S**2), 1.0 + 1.0 / Q**2
    k_n, k_t = 1.0 / S - w**2 * P / 32.0, 1.0 / Q - w**2 * U / 32.0
    slope_n = 1.0 / (w * S**2) - w / 32.0 * (2.0 * P - 1.0 / (2.0 * S**2) + 5.0 / (8.0 * S**3))
    slope_t = 2.0 / (w * Q**2) - w / 32.0 * (2.0 * U + 4.0 / Q**3)
    return 4.0 * pi * k_n, 4.0 * pi * k_t, 4.0 * pi * slope_n, 4.0 * pi * slope_t


@compiled
def _fit(w: float) -> tuple[float, float, float, float]:
    """k = w exp p(L) with a cubic p in L = ln w, and dk/dw = exp p (1 + p′)."""
    L = log(w)
    c_n = exp(1.6911 + L * (-0.67222 + L * (0.033287 + L * 0.0035015)))
    c_t = exp(1.1552 + L * (-0.68479 + L * (0.014884 + L * 0.00074966)))
    slope_n = c_n * (1.0 - 0.67222 + L * (2.0 * 0.033287 + L * 3.0 * 0.0035015))
    slope_t = c_t * (1.0 - 0.68479 + L * (2.0 * 0.014884 + L * 3.0 * 0.00074966))
    return w * c_n, w * c_t, slope_n, slope_t


@compiled
def _layers(w: float) -> tuple[float, float, float, float]:
    """k_n = 2√w + w/2, k_t = 2√w."""
    root = sqrt(w)
    return 2.0 * root + 0.5 * w, 2.0 * root, 1.0 / root + 0.5, 1.0 / root
