"""Closed forms of planar cantilevers, by SciPy: independent of both models and of the tabulated references.

The cantilever lies on x ∈ [0, 1], clamped at 0, with EI = L = 1; a dead force α acts along +y at its tip.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq
from scipy.special import ellipeinc, ellipj, ellipk, ellipkinc

__all__ = ["cantilever_tip", "circle", "elastica"]

Array = NDArray[np.float64]

# Roots to the last digit.
ROOT = {"xtol": 1e-16, "rtol": 4 * np.finfo(float).eps}


def cantilever_tip(alpha: float, *, EA: float = np.inf, GA: float = np.inf) -> tuple[float, float]:
    """Tip of the planar Simo–Reissner cantilever, exact for any load and any stiffness.

    The first integral M²/2 = (sin θ_L − sin θ)·α·g with g = 1 + ½αc·(sin θ_L + sin θ), c = 1/EA − 1/GA, turns the
    arc length into an integral over θ. With 1 + sin θ = 2k² sin² φ, 1 + sin θ_L = 2k² and tan φ = sinh t,

        √α·s = ∫ dt / √(g (1 + k′² sinh² t)),  k′² = 1 − k²,

    smooth, and without cancellation when θ_L comes within 1e-30 of π/2. Then α x = M(0) and
    y = ∫ sin θ + (α/EA) sin² θ + (α/GA) cos² θ ds.

    Args:
        alpha: Load P L²/EI, positive.
        EA: Axial stiffness [EI/L²]; infinite: inextensible.
        GA: Shear stiffness [EI/L²]; infinite: unshearable.

    Returns:
        x and y of the tip [L].
    """
    lowest, highest = -1.5 * np.sqrt(alpha) - 40.0, 0.5 * np.log(0.5) - 1e-15
    log_k1 = brentq(lambda v: _path(v, alpha, EA, GA)[0].sum() - 1.0, lowest, highest, **ROOT)
    ds, sin, sin_tip = _path(log_k1, alpha, EA, GA)
    c = 1.0 / EA - 1.0 / GA
    x = np.sqrt(2.0 * sin_tip * (alpha + 0.5 * alpha**2 * c * sin_tip)) / alpha
    y = ds @ (sin + alpha / EA * sin**2 + alpha / GA * (1.0 - sin**2))
    return float(x), float(y)


def _path(log_k1: float, alpha: float, EA: float, GA: float) -> tuple[Array, Array, float]:
    """Weights ds and sin θ at Gauss points along the rod, and sin θ at the tip, for k′ = exp(log_k1)."""
    k1 = np.exp(log_k1)
    k2 = 1.0 - k1**2
    start = np.arcsinh(np.sqrt(1.0 / (2.0 * k2 - 1.0)))
    # Beyond its turning point at k′ sinh t = 1 the integrand falls like exp(−t): 40 units reach 1e-17.
    end = max(start, np.log(2.0) - log_k1) + 40.0
    ξ, w = np.polynomial.legendre.leggauss(12)
    edges = np.linspace(start, end, 121)
    half = 0.5 * np.diff(edges)[:, None]
    t = (0.5 * (edges[1:] + edges[:-1])[:, None] + half * ξ).ravel()
    dt = (half * w).ravel()
    # sin θ = 2k² tanh² t − 1, written so that 1 − sin θ keeps its digits.
    sin = 1.0 - 2.0 * (1.0 / np.cosh(t) ** 2 + k1**2 * np.tanh(t) ** 2)
    sin_tip = 1.0 - 2.0 * k1**2
    g = 1.0 + 0.5 * alpha * (1.0 / EA - 1.0 / GA) * (sin_tip + sin)
    ds = dt / np.sqrt(alpha * g * (1.0 + (k1 * np.sinh(t)) ** 2))
    return ds, sin, sin_tip


def elastica(alpha: float, s: Array) -> Array:
    """Centreline of the inextensible cantilever by Jacobi's functions.

    χ = θ + π/2 swings as a pendulum, sin(χ/2) = k sn u with u = K − √α (1 − s), so that
    x = (2k/√α)·[cn u₀ − cn u] and y = (2/√α)·[u − E(am u)] − s, the bracket taken from u₀ to u.

    Args:
        alpha: Load P L²/EI, at most 100 (beyond, k rounds to 1).
        s: Arc length, shape (n,) [L].

    Returns:
        Points, shape (n, 2) [L].
    """
    ω = np.sqrt(alpha)
    # χ = π/2 at the clamp: sin(π/4) = k sn(K − ω).
    m = brentq(lambda m: ellipkinc(np.arcsin(np.sqrt(0.5 / m)), m) - ellipk(m) + ω, 0.5 + 1e-15, 1.0 - 1e-15, **ROOT)
    u = ellipk(m) - ω * (1.0 - np.asarray(s))
    u_0 = ellipk(m) - ω
    _, cn, _, _ = ellipj(u, m)
    _, cn_0, _, _ = ellipj(u_0, m)
    x = 2.0 * np.sqrt(m) / ω * (cn_0 - cn)
    y = 2.0 / ω * (u - u_0 - _second_kind(u, m) + _second_kind(u_0, m)) - s
    return np.stack([x, y], axis=1)


def _second_kind(u: Array | float, m: float) -> Array:
    """E(am u | m)."""
    return np.asarray(ellipeinc(ellipj(u, m)[3], m))


def circle(moment: float, s: Array) -> Array:
    """Centreline under an end moment, a circle of curvature M/EI for any EA and GA.

    Args:
        moment: M L/EI.
        s: Arc length, shape (n,) [L].

    Returns:
        Points, shape (n, 2) [L].
    """
    s = np.asarray(s)
    # 1 − cos φ = 2 sin² (φ/2) keeps its digits where the circle closes.
    return np.stack([np.sin(moment * s), 2.0 * np.sin(0.5 * moment * s) ** 2], axis=1) / moment
