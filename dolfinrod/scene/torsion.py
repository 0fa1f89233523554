"""Torsion of solid sections that warp."""

from __future__ import annotations

from math import pi, tanh

__all__ = ["st_venant_constant"]


def st_venant_constant(width: float, height: float) -> float:
    """Torsion constant of a rectangle with free warping.

    J = a b³ [1/3 − (64/π⁵)(b/a) Σ tanh(nπa/2b)/n⁵], n = 1, 3, …, with a ≥ b the sides
    (Timoshenko & Goodier, Theory of Elasticity, art. 109).

    Args:
        width: One side [m].
        height: The other side [m].

    Returns:
        J [m⁴], a square's being 0.1405770·b⁴.
    """
    a, b = max(width, height), min(width, height)
    # Terms fall as n⁻⁵: the remainder beyond n = 4001 is below 1/(8·4000⁴) = 5e-16.
    total = sum(tanh(n * pi * a / (2 * b)) / n**5 for n in range(4001, 0, -2))
    return a * b * b * b * (1 / 3 - 64 / pi**5 * b / a * total)
