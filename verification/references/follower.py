"""Cantilever under a follower tip force: an initial value problem from the tip, with a closed form.

The cantilever lies on x ∈ [0, 1], clamped at 0, with EI = L = 1; the force α acts along d2 of the tip section, +y at
first. With ψ = θ(1) − θ(s) and σ = 1 − s, the balance of moments reads ψ″ = α cos ψ (1 − α c sin ψ), c = 1/EA − 1/GA,
and the free tip asks for ψ = ψ′ = 0 at σ = 0: every α has exactly one equilibrium.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.special import ellipeinc, ellipj

__all__ = ["follower", "follower_tip"]

Array = NDArray[np.float64]


def follower(alpha: float, s: Array) -> Array:
    """Inextensible, unshearable centreline by Jacobi's functions of the lemniscatic modulus, m = ½.

    With τ = √α σ, φ = π/2 − ψ swings like a pendulum let go at a right angle, sin φ/2 = √½ cd τ, so that

        √α ∫ cos ψ dσ = sd τ,  √α ∫ sin ψ dσ = 2 E(am τ) − τ − sn τ cd τ.

    Args:
        alpha: Load P L²/EI, positive.
        s: Arc lengths [L], shape (n,).

    Returns:
        x and y, shape (n, 2) [L].
    """
    root = np.sqrt(alpha)
    # Measured from the tip; the clamp comes last.
    τ = root * (1.0 - np.append(s, 0.0))
    sn, cn, dn, am = ellipj(τ, 0.5)
    along = sn / dn / root
    across = (2.0 * ellipeinc(am, 0.5) - τ - sn * cn / dn) / root
    turn = 0.5 * np.pi - 2.0 * np.arcsin(np.sqrt(0.5) * cn[-1] / dn[-1])
    along, across = along[-1] - along[:-1], across[-1] - across[:-1]
    x = np.cos(turn) * along + np.sin(turn) * across
    y = np.sin(turn) * along - np.cos(turn) * across
    return np.column_stack([x, y])


def follower_tip(alpha: float, *, EA: float = np.inf, GA: float = np.inf) -> tuple[float, float]:
    """Tip of the planar Simo–Reissner cantilever, stepped from the tip to the clamp (DOP853, 1e-13).

    In the axes of the tip section the centreline has the slopes cos ψ − α c sin ψ cos ψ along d1 and
    −sin ψ + (α/EA) sin² ψ + (α/GA) cos² ψ along d2.

    Args:
        alpha: Load P L²/EI.
        EA: Axial stiffness [EI/L²]; infinite: inextensible.
        GA: Shear stiffness [EI/L²]; infinite: unshearable.

    Returns:
        x and y of the tip [L].
    """
    c = 1.0 / EA - 1.0 / GA

    def slope(_: float, state: Array) -> tuple[float, float, float, float]:
        sin, cos = np.sin(state[0]), np.cos(state[0])
        along = cos * (1.0 - alpha * c * sin)
        return state[1], alpha * along, along, -sin + alpha / EA * sin**2 + alpha / GA * cos**2

    turn, _, along, across = solve_ivp(slope, (0.0, 1.0), np.zeros(4), method="DOP853", rtol=1e-13, atol=1e-14).y[:, -1]
    x = np.cos(turn) * along - np.sin(turn) * across
    y = np.sin(turn) * along + np.cos(turn) * across
    return float(x), float(y)
