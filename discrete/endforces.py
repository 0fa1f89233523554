"""End forces of elements along their chords, component by component.

Every component of all elements is one contiguous row and nothing is made of small matrices, which takes many times as
long. How the forces change with the ends is in `endtangents`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from discrete.rotation import eta
from discrete.rows import cross, dot
from discrete.unknowns import N_ELEMENT, SPIN_I, X_I, X_J

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["Deformed", "conjugate", "deformed", "in_element", "in_space", "sway"]


@dataclass(frozen=True, eq=False)
class Deformed:
    """Elements and their ends, seen along the chords.

    Args:
        length: Distance of the nodes L, shape (n,).
        axes: T = [u v w] of `frames.element_frame`, shape (3, 3, n).
        turned: End triads in these axes, Λ_a = Tᵀ E_a, shape (3, 3, 2, n).
        θ: Their rotation vectors, log Λ_a, shape (3, 2, n).
        square: θ·θ, shape (2, n).
    """

    length: Array
    axes: Array
    turned: Array
    θ: Array
    square: Array


def deformed(e: Array, E: Array) -> Deformed:
    """Elements of given chords and ends.

    Args:
        e: Chords, shape (3, n).
        E: Triads attached to the ends, shape (3, 3, 2, n).
    """
    length, T = _axes(e, E)
    Λ = np.einsum("kin,kjan->ijan", T, E)
    θ, square = _rotation_vectors(Λ)
    return Deformed(length, T, Λ, θ, square)


def _axes(e: Array, E: Array) -> tuple[Array, Array]:
    """Length, and axes u, v, w of the elements as `frames.element_frame` has them, T of shape (3, 3, n)."""
    length = np.sqrt(dot(e, e))
    T = np.empty((3, 3, len(length)))
    u, v = T[:, 0], T[:, 1]
    np.divide(e, length, out=u)
    both = E[:, 1:, 0] + E[:, 1:, 1]
    s, t = both[:, 0], both[:, 1]
    np.subtract(s, cross(u, t), out=v)
    v -= dot(u, v) * u
    v /= np.sqrt(dot(v, v))
    T[:, 2] = cross(u, v)
    return length, T


def _rotation_vectors(Λ: Array) -> tuple[Array, Array]:
    """Rotation vectors of both ends as `rotation.log` has them, shape (3, 2, n), and their squares."""
    θ = np.empty(Λ.shape[1:])
    np.subtract(Λ[2, 1], Λ[1, 2], out=θ[0])
    np.subtract(Λ[0, 2], Λ[2, 0], out=θ[1])
    np.subtract(Λ[1, 0], Λ[0, 1], out=θ[2])
    # Twice sine and cosine.
    sine = np.sqrt(dot(θ, θ))
    cosine = Λ[0, 0] + Λ[1, 1]
    cosine += Λ[2, 2]
    cosine -= 1.0
    # φ/sin φ → 1 as φ → 0: the tiny number only keeps 0/0 out.
    sine += 1e-300
    φ = np.arctan2(sine, cosine)
    θ *= φ / sine
    φ *= φ
    return θ, φ


def conjugate(d: Deformed, μ: Array) -> Array:
    """Moments conjugate to spins, Θᵀμ = μ + θ × (½ μ + η θ×μ) with Θ of `rotation.tangents`, shapes (3, 2, n)."""
    inner = cross(d.θ, μ)
    inner *= eta(d.square)
    inner += 0.5 * μ
    m = cross(d.θ, inner)
    m += μ
    return m


def sway(d: Deformed) -> Array:
    """How spins of the ends turn v and w, which follow their mean: g_a = (Λ₂₂ + Λ₃₃, −Λ₁₂, −Λ₁₃)_a, shape (3, 2, n).

    Under a change δe of the chord and spins φ_a of the ends, all in element axes, the frame has the spin ω₂ = −δe₃/L,
    ω₃ = δe₂/L and ω₁ = (σ₂ ω₂ + σ₃ ω₃ + Σ g_a·φ_a)/c with (c, −σ₂, −σ₃) = Σ g_a.
    """
    g = np.empty_like(d.θ)
    np.add(d.turned[1, 1], d.turned[2, 2], out=g[0])
    np.negative(d.turned[0, 1:], out=g[1:])
    return g


def in_element(d: Deformed, m: Array, F_n: Array) -> Array:
    """Forces whose virtual work is F_n δL + Σ m_a·(φ_a − ω), ω the spin of the frame.

    Args:
        d: The elements.
        m: Moments at the ends conjugate to the spin, shape (3, 2, n).
        F_n: Axial forces, shape (n,).

    Returns:
        Moment at i, force of the chord, moment at j in element axes, shape (3, 3, n).
    """
    g = sway(d)
    total, c = m[:, 0] + m[:, 1], g[:, 0] + g[:, 1]
    share = total[0] / c[0]
    # What turns the frame comes off the moments.
    g *= share
    c *= share
    c -= total
    c /= d.length
    f = np.empty((3, 3, len(F_n)))
    np.subtract(m[:, 0], g[:, 0], out=f[0])
    np.subtract(m[:, 1], g[:, 1], out=f[2])
    f[1, 0] = F_n
    f[1, 1] = c[2]
    np.negative(c[1], out=f[1, 2])
    return f


def in_space(d: Deformed, f: Array) -> Array:
    """These forces at the ends, in global axes; the place of F_n is left empty, shape (13, n)."""
    turned = np.einsum("kin,ain->akn", d.axes, f)
    force = np.empty((N_ELEMENT, len(d.length)))
    np.negative(turned[1], out=force[X_I])
    force[SPIN_I] = turned[0]
    force[X_J.start :] = turned[1:].reshape(6, -1)
    return force
