"""Cantilever under its own weight: Chebyshev collocation, independent of the tabulated shooting.

The cantilever lies on x ∈ [0, 1], clamped at 0, with EI = L = 1; the weight β per reference length acts along −y.
"""

from __future__ import annotations

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

__all__ = ["heavy"]

Array = NDArray[np.float64]

# Chebyshev coefficients of the curvature; at β = 50 the last ones are round-off.
TERMS = 48
MAX_ITERATIONS = 50


def heavy(beta: float, s: Array, *, EA: float = np.inf, GA: float = np.inf) -> Array:
    """Centreline of the planar Simo–Reissner cantilever.

    The section force is n = −w e_y with w = β(1 − s), so that, with c = 1/EA − 1/GA,

        θ″ = w cos θ (1 − c w sin θ),  θ(0) = θ′(1) = 0,
        x′ = cos θ (1 − c w sin θ),  y′ = sin θ − w (sin² θ/EA + cos² θ/GA).

    θ″ is a Chebyshev series, integrated from the tip and again from the clamp; Newton's method, the load in steps.

    Args:
        beta: Load w₀ L³/EI, positive.
        s: Arc lengths [L], shape (n,).
        EA: Axial stiffness [EI/L²]; infinite: inextensible.
        GA: Shear stiffness [EI/L²]; infinite: unshearable.

    Returns:
        x and y, shape (n, 2) [L].
    """
    nodes = 0.5 * (1.0 + chebyshev.chebpts1(TERMS))
    values = chebyshev.chebvander(2.0 * nodes - 1.0, TERMS - 1)
    twice = _integral(_integral(np.eye(TERMS), start=1.0), start=0.0)
    to_angle = chebyshev.chebvander(2.0 * nodes - 1.0, TERMS + 1) @ twice @ np.linalg.inv(values)
    c = 1.0 / EA - 1.0 / GA
    q = np.zeros(TERMS)
    for load in np.linspace(0.0, beta, 1 + int(np.ceil(beta / 5.0)))[1:]:
        q = _equilibrium(q, to_angle, load * (1.0 - nodes), c)
    θ, w = to_angle @ q, beta * (1.0 - nodes)
    slopes = np.stack(
        [np.cos(θ) * (1.0 - c * w * np.sin(θ)), np.sin(θ) - w * (np.sin(θ) ** 2 / EA + np.cos(θ) ** 2 / GA)]
    )
    series = _integral(np.linalg.solve(values, slopes.T), start=0.0)
    return np.asarray(chebyshev.chebval(2.0 * s - 1.0, series).T)


def _equilibrium(q: Array, to_angle: Array, w: Array, c: float) -> Array:
    """θ″ at the nodes by Newton's method from q, shape (TERMS,)."""
    for _ in range(MAX_ITERATIONS):
        θ = to_angle @ q
        residual = q - w * np.cos(θ) * (1.0 - c * w * np.sin(θ))
        tangent = np.eye(TERMS) + (w * np.sin(θ) + c * w**2 * np.cos(2.0 * θ))[:, None] * to_angle
        step = np.linalg.solve(tangent, residual)
        q = q - step
        if np.abs(step).max() < 1e-14 * (1.0 + np.abs(q).max()):
            break
    return q


def _integral(series: Array, *, start: float) -> Array:
    """Series, one a column, of the integrals over s from `start`."""
    return np.asarray(chebyshev.chebint(series, lbnd=2.0 * start - 1.0, scl=0.5, axis=0))
