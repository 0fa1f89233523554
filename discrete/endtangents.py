"""How the end forces of `endforces` change as the ends of the elements move, component by component as well."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from discrete.endforces import sway
from discrete.rotation import coefficients
from discrete.rows import cross, dot
from discrete.unknowns import N_ELEMENT

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.endforces import Deformed

    Array = NDArray[np.float64]

__all__ = ["end_tangents"]

# What moves an element: (φ_i, δe, φ_j) in global axes and F_n. All unknowns in these, δe = x_j − x_i.
_I, _E, _J, _F = slice(0, 3), slice(3, 6), slice(6, 9), 9
_WHICH = np.array([3, 4, 5, 0, 1, 2, 9, 3, 4, 5, 6, 7, 8])
_SIGN = np.array([-1.0] * 3 + [1.0] * 10)
_ENTRIES = (10 * _WHICH[:, None] + _WHICH).ravel()
_SIGNS = (_SIGN[:, None] * _SIGN).ravel()


def end_tangents(d: Deformed, μ: Array, m: Array, f: Array, k: Array, elongation: tuple[Array, Array, Array]) -> Array:
    """Derivative of the end forces by the unknowns of the elements.

    Xᵀ C X − [f]× G − (Q/L) uᵀ with G the spin of the frame, X those of the ends relative to it and Q the shear force.
    C = Θᵀ k Θ + ∂(Θᵀμ)/∂θ Θ − ρ Γ: stiffness, change of the conjugate moments, change of the mean frame.

    Args:
        d: The elements.
        μ: Moments that go with the rotations of the ends, shape (3, 2, n).
        m: Moments conjugate to the spin, Θᵀμ, shape (3, 2, n).
        f: Forces in element axes, shape (3, 3, n).
        k: Stiffness of these rotations, shape (6, 6, n), component by component and for each both ends.
        elongation: Its derivatives by δe and by φ_i, shapes (3, n), and minus that by F_n, shape (n,).

    Returns:
        Shape (n, 13, 13).
    """
    n = len(d.length)
    T_t = d.axes.transpose(1, 0, 2)
    G = _spin(d)
    # Columns are φ_i, δe, φ_j; products of two rows below each other add up to the derivative.
    rows, change = np.zeros((10, 9, n)), np.zeros((n, 10, 9))
    X = rows[:6].reshape(3, 2, 9, n)
    np.negative(G[:, None], out=X)
    X[:, 0, _I] += T_t
    X[:, 1, _J] += T_t
    rows[6:9] = cross(f.transpose(1, 0, 2)[:, :, None], T_t[:, None]).reshape(3, 9, n)
    rows[9, _E] = dot(f[1, 1:, None], T_t[1:]) / -d.length
    rows = _by_elements(rows)
    np.matmul(_by_elements(_curvature(d, μ, m, k).reshape(6, 6, n)), rows[:, :6], out=change[:, :6])
    change[:, 6:9] = G.transpose(2, 0, 1)
    change[:, 9, _E] = T_t[0].T
    K = np.zeros((n, 10, 10))
    np.matmul(rows.transpose(0, 2, 1), change, out=K[:, :9, :9])
    K[:, _E, _F] = T_t[0].T
    K[:, _F, _E], K[:, _F, _I], K[:, _F, _F] = elongation[0].T, elongation[1].T, -elongation[2]
    return _expanded(K)


def _expanded(K: Array) -> Array:
    """From what moves an element to all its unknowns, shape (n, 10, 10) → (n, 13, 13)."""
    entries = K.reshape(-1, 100).take(_ENTRIES, axis=1)
    entries *= _SIGNS
    return entries.reshape(-1, N_ELEMENT, N_ELEMENT)


def _by_elements(rows: Array) -> Array:
    """Matrices one after the other, shape (a, b, n) → (n, a, b): products of them are quickest there."""
    return np.ascontiguousarray(rows.transpose(2, 0, 1))


def _spin(d: Deformed) -> Array:
    """Spin of the frame in its axes per (φ_i, δe, φ_j) in global axes, see `sway`, shape (3, 9, n)."""
    T, g = d.axes, sway(d)
    total = g[:, 0] + g[:, 1]
    g /= total[0]
    total /= -total[0]
    G = np.zeros((3, 9, len(d.length)))
    chord = G[:, _E]
    np.divide(T[:, 1:].transpose(1, 0, 2)[::-1], d.length, out=chord[1:])
    np.negative(chord[1], out=chord[1])
    chord[0] = dot(total[1:, None], chord[1:])
    mean = np.einsum("kan,ikn->ain", g, T)
    G[0, _I], G[0, _J] = mean
    return G


def _curvature(d: Deformed, μ: Array, m: Array, k: Array) -> Array:
    """C by components and ends twice, shape (3, 2, 3, 2, n); arguments as for `end_tangents`."""
    Θ, geometric = _tangent_maps(d, μ)
    geometric = np.einsum("acin,cbin->abin", geometric, Θ)
    geometric -= _curving(d, m)
    of_ends = np.einsum("aicjn,cbjn->aibjn", k.reshape(3, 2, 3, 2, -1), Θ)
    C = np.einsum("cain,cibjn->aibjn", Θ, of_ends)
    C[:, 0, :, 0] += geometric[:, :, 0]
    C[:, 1, :, 1] += geometric[:, :, 1]
    return C


def _tangent_maps(d: Deformed, μ: Array) -> tuple[Array, Array]:
    """Θ and ∂(Θᵀμ)/∂θ of `rotation.tangents`, shapes (3, 3, 2, n)."""
    θ, (η, slope) = d.θ, coefficients(d.square)
    along, scaled = dot(θ, μ), η * d.θ
    swing = along * θ
    swing -= d.square * μ
    swing *= slope
    η *= -2.0
    swing += η * μ
    maps = np.empty((3, 3, 2, *d.square.shape))
    Θ, change = maps[:, :, 0], maps[:, :, 1]
    np.multiply(scaled[:, None], θ, out=Θ)
    np.multiply(swing[:, None], θ, out=change)
    change += scaled[:, None] * μ
    half = 0.5 * np.stack([θ, μ], axis=1)
    diagonal = -0.5 * η * np.stack([-d.square, along])
    diagonal[0] += 1.0
    for i, j, l in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        maps[i, i] += diagonal
        maps[i, j] += half[l]
        maps[j, i] -= half[l]
    return Θ, change


def _curving(d: Deformed, m: Array) -> Array:
    """ρ Γ with Γ_a the derivative of g_a by the spin of end a relative to the frame and ρ = Σm₁/c; (3, 3, 2, n)."""
    Λ = d.turned
    Γ = np.empty_like(Λ)
    np.subtract(Λ[1, 2], Λ[2, 1], out=Γ[0, 0])
    np.negative(Λ[0, 2], out=Γ[0, 1])
    Γ[0, 2] = Λ[0, 1]
    Γ[1:, 0] = 0.0
    np.negative(Λ[2, 1:], out=Γ[1:, 1])
    Γ[1:, 2] = Λ[1, 1:]
    c = Λ[1, 1] + Λ[2, 2]
    Γ *= (m[0, 0] + m[0, 1]) / (c[0] + c[1])
    return Γ
