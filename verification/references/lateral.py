"""Lateral buckling of an inextensible strip with its deflection before: shooting along the linearised rod equations.

The cantilever lies in the plane of x and y under a dead force −P along y, θ its slope and M its bending moment,
EI₃ θ′ = M, M′ = P cos θ. A small rotation φ out of the plane leaves the force as it is, so with the spatial change μ of
the moment, μ′ = −φ × t × n and μ = 0 at the free end, where μ_y vanishes throughout. Bent about d2 and twisted by
stiffnesses EI₂ and GJ, it turns by φ′ = C⁻¹ (μ − φ × M e_z), C = GJ t tᵀ + EI₂ d₂ d₂ᵀ.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

__all__ = ["lateral"]


def lateral(EI_3: float, *, GJ: float = 1.0, EI_2: float = 1.0) -> float:
    """Lowest load that holds the strip in equilibrium beside its plane.

    Args:
        EI_3: Stiffness in the plane [N m²].
        GJ: Against twist [N m²].
        EI_2: Against bending out of the plane [N m²].

    Returns:
        P L²/√(EI₂ GJ), for a strip of length 1.
    """
    scale = float(np.sqrt(EI_2 * GJ))
    # Prandtl's 4.01 of a strip that does not deflect before, to half as much again.
    return float(brentq(lambda c: _remaining(c * scale, EI_3, GJ, EI_2), 3.0, 6.0, xtol=1e-13, rtol=1e-14))


def _remaining(P: float, EI_3: float, GJ: float, EI_2: float) -> float:
    """μ_x at the free end for μ_x = 1 at the clamp; zero at a critical load."""
    root = brentq(lambda M: _end(P, M, EI_3, GJ, EI_2)[1], -1.5 * P, -0.3 * P, xtol=1e-14, rtol=1e-14)
    return float(_end(P, root, EI_3, GJ, EI_2)[4])


def _end(P: float, M: float, EI_3: float, GJ: float, EI_2: float) -> NDArray[np.float64]:
    """θ, M, φ_x, φ_y and μ_x at the free end, from a moment M at the clamp."""

    def slope(_: float, state: NDArray[np.float64]) -> tuple[float, ...]:
        θ, M, φx, φy, μ = state
        c, s = np.cos(θ), np.sin(θ)
        # Moments in the section frame, each over its stiffness, and back in space.
        ax, ay = μ - φy * M, φx * M
        twist, bend = (c * ax + s * ay) / GJ, (c * ay - s * ax) / EI_2
        return M / EI_3, P * c, c * twist - s * bend, s * twist + c * bend, P * (φy * c - φx * s)

    found = solve_ivp(slope, (0.0, 1.0), (0.0, M, 0.0, 0.0, 1.0), method="DOP853", rtol=1e-13, atol=1e-15)
    return np.asarray(found.y[:, -1])
