"""Rods in a plane: a centreline in ℝ² and one angle."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import ufl

from dolfinrod.continuum import quaternion
from dolfinrod.continuum.backend import discontinuous, lagrange
from dolfinrod.continuum.kinematics import Configuration

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from ufl.core.expr import Expr

    Array = NDArray[np.float64]

__all__ = ["PlanarRods"]


class PlanarRods:
    """Rods in a plane: r ∈ ℝ², the angle φ about the normal, force N and moment m."""

    name = "planar"
    dim = 2
    n_spin = 1
    fields: tuple[str, ...] = ("r", "q", "N", "m")

    def elements(self, degree: int) -> list[ufl.FiniteElementBase]:
        """P_k for r and φ; discontinuous P_{k−1} for N and m."""
        nodal, inner = (2, 1), (2, 1)
        return [*(lagrange(degree, d) for d in nodal), *(discontinuous(degree - 1, d) for d in inner)]

    def configuration(self, x: tuple[Expr, ...]) -> Configuration:
        """Strain-carrying quantities of (r, φ, N, m)."""
        r, φ, N, m = x
        c, s = ufl.cos(φ[0]), ufl.sin(φ[0])
        return Configuration(r_s=r.dx(0), R=ufl.as_matrix([[c, -s], [s, c]]), κ=φ.dx(0), N=N, m=m, gauge=None)

    def at_rest(self, n: int) -> Array:
        """n angles of no turn."""
        return np.zeros((n, 1))

    def increment(self, q: Array, dq: Array) -> Array:
        """The change of angle itself, (n, 1)."""
        return dq

    def angles(self, increment: Array) -> Array:
        """|δφ|, (n,)."""
        return np.abs(increment[:, 0])

    def turn(self, q: Array, increment: Array) -> Array:
        """φ + δφ."""
        return q + increment

    def compose(self, spins: list[Array]) -> Array:
        """Sum of the angles, shape (1,)."""
        return np.sum([np.zeros(1), *spins], axis=0)

    def rotate(self, q: Array, v: Array) -> Array:
        """R(φ) v, (n, 2)."""
        c, s = np.cos(q[:, 0]), np.sin(q[:, 0])
        return np.stack([c * v[:, 0] - s * v[:, 1], s * v[:, 0] + c * v[:, 1]], axis=1)

    def rotation(self, q: Array) -> Array:
        """R(φ), (n, 2, 2)."""
        c, s = np.cos(q[:, 0]), np.sin(q[:, 0])
        return np.stack([c, -s, s, c], axis=1).reshape(-1, 2, 2)

    def rotate_back(self, q: Array, v: Array) -> Array:
        """R(φ)ᵀ v, (n, 2)."""
        return self.rotate(-q, v)

    def rotate_gradient(self, q: Array, v: Array) -> Array:
        """∂(R v)/∂φ, (n, 2, 1)."""
        turned = self.rotate(q, v)
        return np.stack([-turned[:, 1], turned[:, 0]], axis=1)[:, :, None]

    def spin(self, q: Array) -> Array:
        """Spin about the normal, δφ, (n, 1, 1)."""
        return np.ones((len(q), 1, 1))

    def body_spin(self, q: Array) -> Array:
        """The same in the turned frame, (n, 1, 1)."""
        return np.ones((len(q), 1, 1))

    def turn_between(self, a: Array, b: Array) -> Array:
        """|φ_b − φ_a|."""
        return np.abs(b - a)[:, 0]

    def extrapolated(self, a: Array, b: Array, factor: float) -> Array:
        """φ_b + factor (φ_b − φ_a)."""
        return b + factor * (b - a)

    def rigid_motions(self, r: Array, q: Array) -> Array:
        """(e_i, 0), then (e_z × r, 1), shape (n, 3, 3)."""
        moved = np.tile(np.eye(3), (len(r), 1, 1))
        moved[:, 2, :2] = np.stack([-r[:, 1], r[:, 0]], axis=1)
        return moved

    def transport(self, q: Array, rate: Array) -> tuple[Array, Array]:
        """None: the normal is fixed, (n, 1, 1) twice."""
        return np.zeros((len(q), 1, 1)), np.zeros((len(q), 1, 1))

    def cayley(self, q_0: Array, q_1: Array) -> Array:
        """The angle between them, (n, 1): a turn about the normal is its own momentum's."""
        return q_1 - q_0

    def cayley_gradient(self, q_0: Array, q_1: Array) -> Array:
        """Its derivative, (n, 1, 1)."""
        return np.ones((len(q_0), 1, 1))

    def rotation_vector(self, q_0: Array, q_1: Array) -> Array:
        """The angle between them, (n, 1)."""
        return q_1 - q_0

    def rotation_vector_gradient(self, q_0: Array, q_1: Array) -> Array:
        """Its derivative, (n, 1, 1)."""
        return np.ones((len(q_0), 1, 1))

    def turned_spin(self, q: Array, v: Array) -> Array:
        """v itself: the normal is fixed, (n, 1)."""
        return v

    def turned_back(self, q: Array, v: Array) -> Array:
        """v itself, (n, 1)."""
        return v

    def turned_frames(self, q: Array, spin_axes: Array, frames: Array) -> Array:
        """Section frames R(φ) R₀ in space, shapes (t, s, 1), (3, 1), (s, 3, 3) → (t, s, 3, 3)."""
        p = quaternion.exponential(q * spin_axes[:, 0])
        columns = [quaternion.rotate(p, frames[None, :, :, j] + 0.0 * q) for j in range(3)]
        return np.stack(columns, axis=-1)
