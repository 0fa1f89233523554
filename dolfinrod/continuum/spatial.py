"""Rods in space: a centreline in ℝ³ and a unit quaternion at every node."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import ufl

from dolfinrod.continuum import quaternion
from dolfinrod.continuum.backend import discontinuous, lagrange
from dolfinrod.continuum.kinematics import Configuration
from dolfinrod.continuum.placement import exact_zeros

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from ufl.core.expr import Expr

    Array = NDArray[np.float64]

__all__ = ["SpatialRods"]


class SpatialRods:
    """Rods in space: r ∈ ℝ³, a quaternion p, unit at the nodes by a multiplier λ, force N and moment m.

    The condition ½ λ (p·p − 1) stands on the nodes of p alone (Gauss-Lobatto rule), so it is met exactly there,
    no weight has to be chosen and the tangent stays symmetric.
    """

    name = "spatial"
    dim = 3
    n_spin = 3
    fields: tuple[str, ...] = ("r", "q", "multiplier", "N", "m")

    def elements(self, degree: int) -> list[ufl.FiniteElementBase]:
        """P_k for r, p and λ; discontinuous P_{k−1} for N and m."""
        nodal, inner = (3, 4, 1), (3, 3)
        return [*(lagrange(degree, d) for d in nodal), *(discontinuous(degree - 1, d) for d in inner)]

    def configuration(self, x: tuple[Expr, ...]) -> Configuration:
        """Strain-carrying quantities of (r, p, λ, N, m)."""
        r, p, λ, N, m = x
        return Configuration(
            r_s=r.dx(0),
            R=quaternion.rotation(p),
            κ=quaternion.curvature(p, p.dx(0)),
            N=N,
            m=m,
            gauge=λ[0] * (ufl.inner(p, p) - 1) / 2,
        )

    def at_rest(self, n: int) -> Array:
        """n quaternions of no turn."""
        return np.tile([1.0, 0.0, 0.0, 0.0], (n, 1))

    def increment(self, q: Array, dq: Array) -> Array:
        """δp − (p·δp) p, tangent to the unit sphere; the spin is 2 Im(δp p̄), (n, 4)."""
        return dq - np.einsum("ni,ni->n", q, dq)[:, None] * q

    def angles(self, increment: Array) -> Array:
        """2 |δp|, (n,)."""
        return 2.0 * np.sqrt(np.einsum("ni,ni->n", increment, increment))

    def turn(self, q: Array, increment: Array) -> Array:
        """Along the great circle, cos |δp| p + sin |δp| δp/|δp|, which is exp(½ θ) p; unit to round-off, (n, 4)."""
        # sin x/x → 1 as x → 0: the tiny number only keeps 0/0 out.
        half = 0.5 * self.angles(increment) + 1e-300
        turned = np.cos(half)[:, None] * q
        turned += (np.sin(half) / half)[:, None] * increment
        turned /= np.sqrt(np.einsum("ni,ni->n", turned, turned))[:, None]
        return turned

    def compose(self, spins: list[Array]) -> Array:
        """Rotation unknown of rotation vectors applied one after the other, in space, shape (4,)."""
        q = np.array([1.0, 0.0, 0.0, 0.0])
        for theta in spins:
            q = quaternion.multiply(quaternion.exponential(theta), q)
        return q

    def rotate(self, q: Array, v: Array) -> Array:
        """R(p) v, (n, 3)."""
        return quaternion.rotate(q, v)

    def rotation(self, q: Array) -> Array:
        """R(p) of quaternions of any norm, v ↦ Im(p v p̄)/|p|², (n, 3, 3)."""
        turned = quaternion.left(q) @ np.swapaxes(quaternion.right(q), 1, 2)
        return np.asarray(turned / np.einsum("ni,ni->n", q, q)[:, None, None])

    def rotate_back(self, q: Array, v: Array) -> Array:
        """R(p)ᵀ v for quaternions of any norm, (n, 3)."""
        p = q / np.linalg.norm(q, axis=1, keepdims=True)
        return quaternion.rotate(p * [1.0, -1.0, -1.0, -1.0], v)

    def rotate_gradient(self, q: Array, v: Array) -> Array:
        """∂(R v)/∂p on the unit sphere, (n, 3, 4)."""
        return quaternion.rotate_gradient(q, v)

    def spin(self, q: Array) -> Array:
        """Spatial spin a change of p stands for, δθ = 2 Im(δp p̄), linear in p, (n, 3, 4)."""
        return 2.0 * quaternion.left(q)

    def body_spin(self, q: Array) -> Array:
        """Spin in the turned frame, 2 Im(p̄ δp), linear in p, (n, 3, 4)."""
        return 2.0 * quaternion.right(q)

    def turn_between(self, a: Array, b: Array) -> Array:
        """2 arccos(a·b), beyond π where the quaternions point away from each other."""
        return 2.0 * np.arccos(np.clip(np.einsum("ni,ni->n", a, b), -1.0, 1.0))

    def extrapolated(self, a: Array, b: Array, factor: float) -> Array:
        """Along the great circle through a and b."""
        half = np.arccos(np.clip(np.sum(a * b, axis=-1, keepdims=True), -1.0, 1.0))
        ratio = factor * np.sinc(factor * half / np.pi) / np.sinc(half / np.pi)
        return np.asarray((np.cos(factor * half) + np.cos(half) * ratio) * b - ratio * a)

    def rigid_motions(self, r: Array, q: Array) -> Array:
        """(e_i, 0), then (e_i × r, ½ e_i p), shape (n, 6, 7)."""
        moved = np.tile(np.eye(6, 7), (len(r), 1, 1))
        moved[:, 3:, :3] = quaternion.cross(np.eye(3), r[:, None])
        moved[:, 3:, 3:] = 0.25 * self.spin(q)
        return moved

    def transport(self, q: Array, rate: Array) -> tuple[Array, Array]:
        """δp ↦ δp (p̄ p′) and m ↦ −ω × m with ω = 2 Im(p̄ p′), as matrices (n, 4, 4) and (n, 3, 3)."""
        half = np.einsum("nij,nj,n->ni", quaternion.right(q), rate, 1.0 / np.einsum("ni,ni->n", q, q))
        spinning = np.concatenate([np.zeros((len(q), 1)), half], axis=1)
        changes = quaternion.multiply(np.eye(4)[None], spinning[:, None, :])
        moments = quaternion.cross(np.eye(3)[None], 2.0 * half[:, None, :])
        return np.swapaxes(changes, 1, 2), np.swapaxes(moments, 1, 2)

    def cayley(self, q_0: Array, q_1: Array) -> Array:
        """c = 2 Im(p̄₀ p₁)/(p₀·p₁) with R₁ = R₀ cay(c), (n, 3)."""
        turn = np.einsum("nij,nj->ni", quaternion.divided(q_0), q_1)
        return np.asarray(turn[:, 1:] * (2.0 / turn[:, :1]))

    def cayley_gradient(self, q_0: Array, q_1: Array) -> Array:
        """∂c/∂p₁, (n, 3, 4)."""
        cosine = np.einsum("ni,ni->n", q_0, q_1)[:, None, None]
        c = self.cayley(q_0, q_1)
        return np.asarray((2.0 * quaternion.right(q_0) - c[:, :, None] * q_0[:, None, :]) / cosine)

    def rotation_vector(self, q_0: Array, q_1: Array) -> Array:
        """θ with R₁ = exp(θ) R₀, |θ| ≤ π, (n, 3)."""
        return quaternion.logarithm(quaternion.multiply(q_1, q_0 * [1.0, -1.0, -1.0, -1.0]))

    def rotation_vector_gradient(self, q_0: Array, q_1: Array) -> Array:
        """∂θ/∂p₁ on the unit sphere, (n, 3, 4)."""
        return quaternion.spin_to_rate(self.rotation_vector(q_0, q_1)) @ self.spin(q_1)

    def turned_spin(self, q: Array, v: Array) -> Array:
        """R(p) v, (n, 3)."""
        return quaternion.rotate(q, v)

    def turned_back(self, q: Array, v: Array) -> Array:
        """R(p)ᵀ v of unit quaternions, (n, 3)."""
        return quaternion.rotate(q * [1.0, -1.0, -1.0, -1.0], v)

    def turned_frames(self, q: Array, spin_axes: Array, frames: Array) -> Array:
        """Section frames R(p) R₀ in space, shapes (t, s, 4), (3, 3), (s, 3, 3) → (t, s, 3, 3)."""
        at_rest = exact_zeros(spin_axes.T @ frames)
        columns = [quaternion.rotate(q, at_rest[None, :, :, j] + 0.0 * q[..., :1]) for j in range(3)]
        return spin_axes @ np.stack(columns, axis=-1)
