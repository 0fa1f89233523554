"""Drag of a long cylinder in a flow of any Reynolds number."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["CREEPING", "drag_coefficients", "resistances"]

Array = NDArray[np.float64]

# Reynolds numbers at which the formulas for c_n and c_t change.
SLOW, FAST = 0.1, 100.0
# Below this one the drag is linear in the velocity, w c(w) staying what it is here.
CREEPING = 1e-3
S_0 = 2.0022


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


def resistances(w: Array) -> Array:
    """Force per velocity k(w) = w c(w), with which f = ρ_a ν (k_n v_n + k_t v_t), and its slope.

    Args:
        w: Reynolds number of the velocity across, shape (n,).

    Returns:
        Rows k_n, k_t, dk_n/dw, dk_t/dw, shape (4, n); the slopes vanish where the flow creeps.
    """
    k = np.full((4, len(w)), np.nan)
    for within, law in ((w < SLOW, _slender), ((w >= SLOW) & (w <= FAST), _fit), (w > FAST, _layers)):
        if within.any():
            k[:, within] = law(np.maximum(w[within], CREEPING))
    k[2:, w <= CREEPING] = 0.0
    return k


def _slender(w: Array) -> Array:
    """k_n = 4π [1/S − w² P/32], P = 1 − 1/(2S) + 5/(16S²); k_t = 4π [1/Q − w² U/32], Q = 2S − 1, U = 1 + 1/Q²."""
    S = S_0 - np.log(w)
    Q = 2.0 * S - 1.0
    P, U = 1.0 - 1.0 / (2.0 * S) + 5.0 / (16.0 * S**2), 1.0 + 1.0 / Q**2
    slope_n = 1.0 / (w * S**2) - w / 32.0 * (2.0 * P - 1.0 / (2.0 * S**2) + 5.0 / (8.0 * S**3))
    slope_t = 2.0 / (w * Q**2) - w / 32.0 * (2.0 * U + 4.0 / Q**3)
    return 4.0 * np.pi * np.stack([1.0 / S - w**2 * P / 32.0, 1.0 / Q - w**2 * U / 32.0, slope_n, slope_t])


def _fit(w: Array) -> Array:
    """k = w exp p(L) with a cubic p in L = ln w, and dk/dw = exp p (1 + p′)."""
    L = np.log(w)
    c_n = np.exp(1.6911 + L * (-0.67222 + L * (0.033287 + L * 0.0035015)))
    c_t = np.exp(1.1552 + L * (-0.68479 + L * (0.014884 + L * 0.00074966)))
    slope_n = c_n * (1.0 - 0.67222 + L * (2.0 * 0.033287 + L * 3.0 * 0.0035015))
    slope_t = c_t * (1.0 - 0.68479 + L * (2.0 * 0.014884 + L * 3.0 * 0.00074966))
    return np.stack([w * c_n, w * c_t, slope_n, slope_t])


def _layers(w: Array) -> Array:
    """k_n = 2√w + w/2, k_t = 2√w."""
    root = np.sqrt(w)
    return np.stack([2.0 * root + 0.5 * w, 2.0 * root, 1.0 / root + 0.5, 1.0 / root])
