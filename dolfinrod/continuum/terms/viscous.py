"""Damping of the sections in mixed form: resultants that exceed those of the strains by those of their rates."""

from __future__ import annotations

from typing import TYPE_CHECKING

import ufl

if TYPE_CHECKING:
    from ufl.core.expr import Expr

    from dolfinrod.continuum.kinematics import Configuration

__all__ = ["viscous_strains", "viscous_work"]


def viscous_strains(after: Configuration, before: Configuration, ratio: Expr) -> tuple[Expr, Expr]:
    """τ γ̇ and τ κ̇ of a step, as exact differences of strains that no rigid motion changes, however far it goes.

    g = (τ/h) (R₁ᵀr₁′ − R₀ᵀr₀′),  k = (τ/h) (κ(p₁) − κ(p₀))

    Args:
        after: Fields after the step.
        before: Fields before it.
        ratio: τ/h, retardation time over step.

    Source: Linn, Lang & Tuganov, Mech. Sci. 4, 2013 (Kelvin-Voigt damping of Cosserat rods in rates of their strains).
    """
    return ratio * (after.R.T * after.r_s - before.R.T * before.r_s), ratio * (after.κ - before.κ)


def viscous_work(q: Configuration, g: Expr, k: Expr) -> Expr:
    """Π = ∫ N·R(p) g + m·k ds, to be varied with g and k held, beside the stored energy.

    Varied by N and m it makes C n = γ + g and C m = κ + k of the elastic C n = γ and C m = κ; varied by p it lets the
    sections turn under the moment of N about the strained rod, where the stored energy has only C n to know it by.

    Args:
        q: Fields of the rod where the forces act.
        g: τ γ̇ in stress-free directions, shape (d,).
        k: τ κ̇, shape (n_spin,) or a scalar in a plane.
    """
    return ufl.inner(q.N, q.R * g) + ufl.inner(q.m, k)
