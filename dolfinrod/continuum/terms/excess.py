"""Strains that the resultants of a step follow beside those of the state at which they act, in mixed form."""

from __future__ import annotations

from typing import TYPE_CHECKING

import ufl

if TYPE_CHECKING:
    from ufl.core.expr import Expr

    from dolfinrod.continuum.kinematics import Configuration

__all__ = ["excess_strains", "excess_work"]


def excess_strains(
    after: Configuration, before: Configuration, here: Configuration, weights: tuple[Expr, Expr, Expr]
) -> tuple[Expr, Expr]:
    """Strains of the ends of a step over those of the state between, which no rigid motion of the ends changes.

    g = a Γ₁ + b Γ₀ − c Γ with Γ = Rᵀr′, and k likewise with κ. Of a mean of the ends, a = b = ½ and c = 1; of the rates
    of sections that damp, a = −b = τ/h and c = 0.

    Args:
        after: Fields after the step.
        before: Fields before it.
        here: Fields at which the forces act.
        weights: a, b and c.

    Source: Simo, Tarnow & Doblare, Int. J. Numer. Methods Eng. 38, 1995 (mean strains keep spinning bodies stable);
    Linn, Lang & Tuganov, Mech. Sci. 4, 2013 (Kelvin-Voigt damping of Cosserat rods in rates of their strains).
    """
    a, b, c = weights
    g = a * after.R.T * after.r_s + b * before.R.T * before.r_s - c * here.R.T * here.r_s
    return g, a * after.κ + b * before.κ - c * here.κ


def excess_work(q: Configuration, g: Expr, k: Expr) -> Expr:
    """Π = ∫ N·R(p) g + m·k ds, to be varied with g and k held, beside the stored energy.

    Varied by N and m it makes C n = γ + g and C m = κ + k of the elastic C n = γ and C m = κ; varied by p it lets the
    sections turn under the moment of N about the strained rod, where the stored energy has only C n to know it by.

    Args:
        q: Fields of the rod where the forces act.
        g: Excess of stretch and shear in stress-free directions, shape (d,).
        k: That of curvature, shape (n_spin,) or a scalar in a plane.
    """
    return ufl.inner(q.N, q.R * g) + ufl.inner(q.m, k)
