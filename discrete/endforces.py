"""End forces of elements along their chords, component by component: what a step in time asks for most often.

The law is that of `corotation.ChordElement`, which also has the derivative. Here every component of all elements is one
contiguous row and nothing is made of small matrices: three times as quick.
"""

from __future__ import annotations

from copy import copy
from typing import TYPE_CHECKING

import numpy as np

from discrete.corotation import ChordElement
from discrete.rotation import eta
from discrete.rows import cross, dot, of_vectors
from discrete.unknowns import AXIAL, N_ELEMENT, SPIN_I, X_I, X_J

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.frames import ElementFrame
    from discrete.mesh import Elements

    Array = NDArray[np.float64]

__all__ = ["QuickElement"]


class QuickElement(ChordElement):
    """The element along the chord, its end forces quick.

    Args:
        elements: Natural lengths and stiffness of the elements.
        paper_strain: As for `ChordElement`.
    """

    def __init__(self, elements: Elements, *, paper_strain: bool) -> None:
        super().__init__(elements, paper_strain=paper_strain)
        n = len(elements.l)
        self._k_rows = self._k.reshape(n, 2, 3, 2, 3).transpose(2, 1, 4, 3, 0).reshape(6, 6, n)
        # Moments taken off those of the stiffness, shape (n, 2, 3), and the same by rows.
        self._behind: Array | None = None
        self._behind_rows: Array | None = None

    def measure(self, e: Array, E: Array, F_n: Array) -> tuple[Array, Array]:
        """End forces of the element and its strain energy; arguments and shapes as in `ChordElement.measure`."""
        force, length, energy = _end_forces(of_vectors(e), _by_rows(E), F_n, self._k_rows, self._behind_rows)
        stretch = self._compliance * F_n
        defect = force[AXIAL]
        np.subtract(self._reach_of(length, e, E), self._l_0, out=defect)
        defect -= stretch
        stretch *= F_n
        stretch += energy
        stretch *= 0.5
        return force.T, stretch

    def strains(self, e: Array, E: Array) -> tuple[Array, Array]:
        """Rotations of the ends relative to the element, shape (n, 2, 3), and elongations; arguments as `measure`."""
        triads = _by_rows(E)
        length, T = _axes(of_vectors(e), triads)
        θ, _ = _rotation_vectors(np.einsum("kin,kjan->ijan", T, triads))
        return θ.transpose(2, 1, 0), self._reach_of(length, e, E) - self._l_0

    def moments(self, θ: Array) -> Array:
        """Moments k θ that go with rotations of the ends, shape (n, 2, 3)."""
        n = len(θ)
        μ = np.einsum("abn,bn->an", self._k_rows, θ.transpose(2, 1, 0).reshape(6, n))
        return μ.reshape(3, 2, n).transpose(2, 1, 0)

    def changed(self, stiffness: Array, l_0: Array, behind: Array) -> QuickElement:
        """The element with another law.

        Args:
            stiffness: What all its stiffness is multiplied by, shape (n,).
            l_0: Natural lengths of the chords, shape (n,).
            behind: Moments taken off those of the stiffness, shape (n, 2, 3).
        """
        other = copy(self)
        other._k, other._k_rows = self._k * stiffness[:, None, None], self._k_rows * stiffness
        other._compliance, other._l_0 = self._compliance / stiffness, l_0
        other._behind, other._behind_rows = behind, behind.transpose(2, 1, 0).reshape(6, -1)
        return other

    def _reach_of(self, length: Array, e: Array, E: Array) -> Array:
        """Length that the elongation is measured from, shape (n,)."""
        return length if not self._paper_strain else np.einsum("ni,ni->n", E[:, 0, :, 0], e)

    def _bent(self, frame: ElementFrame) -> tuple[Array, Array]:
        θ, μ = super()._bent(frame)
        return θ, μ if self._behind is None else μ - self._behind


def _by_rows(E: Array) -> Array:
    """Triads of shape (n, 2, 3, 3) → (3, 3, 2, n); the same memory where it is by rows already."""
    return np.ascontiguousarray(E.transpose(2, 3, 1, 0))


def _end_forces(e: Array, E: Array, F_n: Array, k: Array, behind: Array | None) -> tuple[Array, Array, Array]:
    """Forces and moments at both ends in global axes.

    θ_a = log(Tᵀ E_a), μ = k θ, m = Θᵀ μ and ρ = Σm₁/Σg₁ as in `corotation`, the moments at the ends being m_a − ρ g_a.

    Args:
        e: Chords, shape (3, n).
        E: Triads attached to the ends, shape (3, 3, 2, n).
        F_n: Axial forces, shape (n,).
        k: Stiffness of the rotations of the ends, component by component and for each both ends, shape (6, 6, n).
        behind: Moments taken off μ in that order, shape (6, n); None: none.

    Returns:
        Forces with the place of F_n empty, shape (13, n), lengths of the chords and twice the bending energy θ·μ, (n,).
    """
    n = len(F_n)
    length, T = _axes(e, E)
    Λ = np.einsum("kin,kjan->ijan", T, E)
    θ, square = _rotation_vectors(Λ)
    μ = np.einsum("abn,bn->an", k, θ.reshape(6, n))
    if behind is not None:
        μ -= behind
    energy = np.einsum("an,an->n", μ, θ.reshape(6, n))
    turned = np.einsum("kin,ain->akn", T, _in_element(Λ, _conjugate(θ, square, μ.reshape(3, 2, n)), F_n, length))
    force = np.empty((N_ELEMENT, n))
    np.negative(turned[1], out=force[X_I])
    force[SPIN_I] = turned[0]
    force[X_J.start :] = turned[1:].reshape(6, n)
    return force, length, energy


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


def _conjugate(θ: Array, square: Array, μ: Array) -> Array:
    """Moments conjugate to spins, Θᵀμ = μ + θ × (½ μ + η θ×μ) with θ×(θ×μ) = θ (θ·μ) − θ² μ, shape (3, 2, n)."""
    inner = cross(θ, μ)
    inner *= eta(square)
    inner += 0.5 * μ
    m = cross(θ, inner)
    m += μ
    return m


def _in_element(Λ: Array, m: Array, F_n: Array, length: Array) -> Array:
    """Moment at i, force of the chord, moment at j in element axes, shape (3, 3, n)."""
    # (c, −σ₂, −σ₃) = Σ g_a; what turns the frame comes off the moments.
    g = np.empty_like(m)
    np.add(Λ[1, 1], Λ[2, 2], out=g[0])
    np.negative(Λ[0, 1:], out=g[1:])
    total, c = m[:, 0] + m[:, 1], g[:, 0] + g[:, 1]
    share = total[0] / c[0]
    g *= share
    c *= share
    c -= total
    c /= length
    f = np.empty((3, 3, len(length)))
    np.subtract(m[:, 0], g[:, 0], out=f[0])
    np.subtract(m[:, 1], g[:, 1], out=f[2])
    f[1, 0] = F_n
    f[1, 1] = c[2]
    np.negative(c[1], out=f[1, 2])
    return f
