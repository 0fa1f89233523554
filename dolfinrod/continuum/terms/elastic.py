"""Stored energy of an elastic rod in mixed form: stretch, shear, bending and twist."""

from __future__ import annotations

from math import isqrt
from typing import TYPE_CHECKING

import ufl

if TYPE_CHECKING:
    from ufl.core.expr import Expr

    from dolfinrod.continuum.kinematics import Configuration

__all__ = ["stored_energy", "symmetric"]


def stored_energy(q: Configuration, C_n: Expr, C_m: Expr, r_0: Expr) -> Expr:
    """Hellinger-Reissner energy of the strains R(p)ᵀr′ − r₀′ and κ(p).

    Π = ∫ N·(r′ − R(p) r₀′) − ½ n·C_n n + m·κ(p) − ½ m·C_m m ds,  n = R(p)ᵀ N

    All strains are taken in stress-free directions fixed in space, where C = R₀ diag(1/EA, 1/GA₂, 1/GA₃) R₀ᵀ (and
    likewise for moments): a stress-free shape of any curvature and pretwist stores nothing, to round-off, on any
    mesh. A zero compliance turns its resultant into the multiplier of a rigid strain. N is in space because dead
    loads leave it constant however the sections turn, which is what lets Newton take them in one step.

    Args:
        q: Fields of the rod.
        C_n: Compliance of stretch and shear, shape (d, d) [1/N].
        C_m: Compliance of twist and bending, shape (n_spin, n_spin) [1/(N m²)].
        r_0: Stress-free centreline, interpolated like r.

    Returns:
        The integrand, energy per length [N].

    Source: Simo & Vu-Quoc 1986 (strains); Herrmann et al., arXiv 2507.01552 (mixed form).
    """
    n = q.R.T * q.N
    γ = q.r_s - q.R * r_0.dx(0)
    forces = ufl.inner(q.N, γ) - ufl.inner(n, C_n * n) / 2
    moments = ufl.inner(q.m, q.κ) - ufl.inner(q.m, C_m * q.m) / 2
    return forces + moments


def symmetric(c: Expr) -> Expr:
    """The symmetric matrix whose upper triangle is listed row by row in the vector `c`."""
    n = (isqrt(8 * c.ufl_shape[0] + 1) - 1) // 2
    place = {pair: k for k, pair in enumerate((i, j) for i in range(n) for j in range(i, n))}
    return ufl.as_matrix([[c[place[min(i, j), max(i, j)]] for j in range(n)] for i in range(n)])
