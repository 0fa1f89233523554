"""End forces of elements along their chords, component by component: what a step in time asks for most often.

The law is that of `corotation.ChordElement`, which also has the derivative. Here every component of all elements is one
contiguous row and nothing is made of small matrices: three times as quick.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from discrete.corotation import ChordElement
from discrete.rotation import eta
from discrete.unknowns import AXIAL, N_ELEMENT, SPIN_I, SPIN_J, X_I, X_J

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
        behind: Moments taken off those of the stiffness, shape (n, 2, 3); None: none.
    """

    def __init__(self, elements: Elements, *, paper_strain: bool, behind: Array | None = None) -> None:
        super().__init__(elements, paper_strain=paper_strain)
        n = len(elements.l)
        self._k_rows = self._k.reshape(n, 2, 3, 2, 3).transpose(2, 1, 4, 3, 0).reshape(6, 6, n)
        self._behind = behind
        self._behind_rows = None if behind is None else behind.transpose(2, 1, 0).reshape(6, n)

    def measure(self, e: Array, E: Array, F_n: Array) -> tuple[Array, Array]:
        """End forces of the element and its strain energy; arguments and shapes as in `ChordElement.measure`."""
        force, length, energy = _end_forces(e, E, F_n, self._k_rows, self._behind_rows)
        reach = length if not self._paper_strain else np.einsum("ni,ni->n", E[:, 0, :, 0], e)
        stretch = self._compliance * F_n
        np.subtract(reach, self._l_0 + stretch, out=force[:, AXIAL])
        energy += 0.5 * stretch * F_n
        return force, energy

    def _bent(self, frame: ElementFrame) -> tuple[Array, Array]:
        θ, μ = super()._bent(frame)
        return θ, μ if self._behind is None else μ - self._behind


def _end_forces(e: Array, E: Array, F_n: Array, k: Array, behind: Array | None) -> tuple[Array, Array, Array]:
    """Forces and moments at both ends in global axes.

    θ_a = log(Tᵀ E_a), μ = k θ, m = Θᵀ μ and ρ = Σm₁/Σg₁ as in `corotation`, the moments at the ends being m_a − ρ g_a.

    Args:
        e: Chords, shape (n, 3).
        E: Triads attached to the ends, shape (n, 2, 3, 3).
        F_n: Axial forces, shape (n,).
        k: Stiffness of the rotations of the ends, component by component and for each both ends, shape (6, 6, n).
        behind: Moments taken off μ in that order, shape (6, n); None: none.

    Returns:
        Forces with the place of F_n empty, shape (n, 13), lengths of the chords and the bending energy θ·μ/2, (n,).
    """
    n = len(e)
    E_t = np.ascontiguousarray(E.transpose(1, 2, 3, 0))
    length, T = _axes(e, E_t)
    Λ = np.einsum("kin,akjn->ijan", T, E_t)
    θ = _rotation_vectors(Λ)
    μ = np.einsum("abn,bn->an", k, θ.reshape(6, n))
    if behind is not None:
        μ -= behind
    energy = 0.5 * np.einsum("an,an->n", μ, θ.reshape(6, n))
    m = _conjugate(θ, μ.reshape(3, 2, n))
    f = _in_element(Λ, m, F_n, length)
    turned = np.einsum("kin,fin->nfk", T, f)
    force = np.empty((n, N_ELEMENT))
    force[:, SPIN_I], force[:, X_J], force[:, SPIN_J] = turned[:, 0], turned[:, 1], turned[:, 2]
    force[:, X_I] = -turned[:, 1]
    force[:, AXIAL] = 0.0
    return force, length, energy


def _in_element(Λ: Array, m: Array, F_n: Array, length: Array) -> Array:
    """Moment at i, force of the chord, moment at j in element axes, shape (3, 3, n); m is overwritten."""
    # (c, −σ₂, −σ₃) = Σ g_a; what turns the frame comes off the moments.
    g = np.empty_like(m)
    np.add(Λ[1, 1], Λ[2, 2], out=g[0])
    np.negative(Λ[0, 1:], out=g[1:])
    total, c = m[:, 0] + m[:, 1], g[:, 0] + g[:, 1]
    share = total[0] / c[0]
    g *= share
    m -= g
    f = np.empty((3, 3, m.shape[-1]))
    f[0], f[2] = m[:, 0], m[:, 1]
    f[1, 0] = F_n
    f[1, 1] = (c[2] * share - total[2]) / length
    f[1, 2] = (total[1] - c[1] * share) / length
    return f


def _axes(e: Array, E: Array) -> tuple[Array, Array]:
    """Length, and axes u, v, w of the elements as `frames.element_frame` has them, T of shape (3, 3, n)."""
    length = np.sqrt(np.einsum("ni,ni->n", e, e))
    T = np.empty((3, 3, len(e)))
    u, v = T[:, 0], T[:, 1]
    np.divide(e.T, length, out=u)
    s, t = E[0, :, 1] + E[1, :, 1], E[0, :, 2] + E[1, :, 2]
    _cross(t, u, v)
    v += s
    v -= np.einsum("in,in->n", u, v) * u
    v /= np.sqrt(np.einsum("in,in->n", v, v))
    _cross(u, v, T[:, 2])
    return length, T


def _rotation_vectors(Λ: Array) -> Array:
    """Rotation vectors of both ends as `rotation.log` has them, shape (3, 2, n)."""
    θ = np.empty(Λ.shape[1:])
    np.subtract(Λ[2, 1], Λ[1, 2], out=θ[0])
    np.subtract(Λ[0, 2], Λ[2, 0], out=θ[1])
    np.subtract(Λ[1, 0], Λ[0, 1], out=θ[2])
    θ *= 0.5
    sine = np.sqrt(np.einsum("ian,ian->an", θ, θ))
    cosine = 0.5 * (Λ[0, 0] + Λ[1, 1] + Λ[2, 2] - 1.0)
    # φ/sin φ → 1 as φ → 0: the tiny number only keeps 0/0 out.
    θ *= (np.arctan2(sine, cosine) + 1e-300) / (sine + 1e-300)
    return θ


def _conjugate(θ: Array, μ: Array) -> Array:
    """Moments conjugate to spins, Θᵀμ = μ + ½ θ×μ + η (θ (θ·μ) − θ² μ), shape (3, 2, n)."""
    square = np.einsum("ian,ian->an", θ, θ)
    m = θ * np.einsum("ian,ian->an", θ, μ)
    m -= square * μ
    m *= eta(square)
    once = np.empty_like(μ)
    _cross(θ, μ, once)
    once *= 0.5
    m += once
    m += μ
    return m


def _cross(a: Array, b: Array, out: Array) -> None:
    """Cross products of components on the first axis."""
    for k, (i, j) in enumerate(((1, 2), (2, 0), (0, 1))):
        np.multiply(a[i], b[j], out=out[k])
        out[k] -= a[j] * b[i]
