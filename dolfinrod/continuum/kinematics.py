"""What moves: fields, strains and rotations of a rod in space or in a plane. Only this module knows the dimension.

Both classes answer the same questions, so that terms, supports and solver never ask which one they hold.
The rotation unknown measures the turn from the stress-free frame, R = R(p) R₀(s), or R(φ) R₀(s) in a plane.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np
import ufl

from dolfinrod.continuum import quaternion
from dolfinrod.continuum.backend import discontinuous, lagrange

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from ufl.core.expr import Expr

    Array = NDArray[np.float64]

__all__ = ["Configuration", "Kinematics", "PlanarRods", "SpatialRods"]


@dataclass(frozen=True)
class Configuration:
    """The fields of a rod and their derivatives as UFL expressions.

    Args:
        r_s: Derivative of the centreline.
        R: Turn of the section from its stress-free frame.
        κ: Curvature of that turn, in the stress-free frame.
        N: Force resultant in space (mixed unknown).
        m: Moment resultant in the stress-free frame, turned along (mixed unknown).
        gauge: Integrand that holds the rotation unknown on its manifold at the nodes, or None.
    """

    r_s: Expr
    R: Expr
    κ: Expr
    N: Expr
    m: Expr
    gauge: Expr | None


class Kinematics(Protocol):
    """Contract between the dimension and everything else.

    1. `fields` names the sub-fields in the order of `elements`; "r", "q", "N", "m" are always there.
    2. Rotation arrays hold one row a node: quaternions (n, 4) or angles (n, 1).
    3. Spins have `n_spin` components: 3 in space, 1 in a plane.
    """

    name: str
    dim: int
    n_spin: int
    fields: tuple[str, ...]

    def elements(self, degree: int) -> list[ufl.FiniteElementBase]:
        """Element of each field."""
        ...

    def configuration(self, x: tuple[Expr, ...]) -> Configuration:
        """What the terms see of the fields."""
        ...

    def at_rest(self, n: int) -> Array:
        """n rotations of no turn."""
        ...

    def increment(self, q: Array, dq: Array) -> Array:
        """The part of a change of q that is a turn."""
        ...

    def angles(self, increment: Array) -> Array:
        """Angle of each such turn [rad], (n,)."""
        ...

    def turn(self, q: Array, increment: Array) -> Array:
        """q after such a turn."""
        ...

    def compose(self, spins: list[Array]) -> Array:
        """One rotation of spins applied one after the other."""
        ...

    def rotate(self, q: Array, v: Array) -> Array:
        """R v."""
        ...

    def rotate_back(self, q: Array, v: Array) -> Array:
        """Rᵀ v, also between the nodes."""
        ...

    def rotate_gradient(self, q: Array, v: Array) -> Array:
        """∂(R v)/∂q."""
        ...

    def spin(self, q: Array) -> Array:
        """∂δθ/∂δq in space, linear in q."""
        ...

    def body_spin(self, q: Array) -> Array:
        """∂δθ/∂δq in the turned frame, linear in q."""
        ...

    def turned_frames(self, q: Array, spin_axes: Array, frames: Array) -> Array:
        """Section frames in space of turned stress-free frames."""
        ...


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
        half = 0.5 * self.angles(increment)
        turned = np.cos(half)[:, None] * q + np.sinc(half / np.pi)[:, None] * increment
        return turned / np.sqrt(np.einsum("ni,ni->n", turned, turned))[:, None]

    def compose(self, spins: list[Array]) -> Array:
        """Rotation unknown of rotation vectors applied one after the other, in space, shape (4,)."""
        q = np.array([1.0, 0.0, 0.0, 0.0])
        for theta in spins:
            q = quaternion.multiply(quaternion.exponential(theta), q)
        return q

    def rotate(self, q: Array, v: Array) -> Array:
        """R(p) v, (n, 3)."""
        return quaternion.rotate(q, v)

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

    def turned_frames(self, q: Array, spin_axes: Array, frames: Array) -> Array:
        """Section frames R(p) R₀ in space, shapes (t, s, 4), (3, 3), (s, 3, 3) → (t, s, 3, 3)."""
        columns = [quaternion.rotate(q, frames[None, :, :, j] + 0.0 * q[..., :1]) for j in range(3)]
        return np.stack(columns, axis=-1)


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

    def turned_frames(self, q: Array, spin_axes: Array, frames: Array) -> Array:
        """Section frames R(φ) R₀ in space, shapes (t, s, 1), (3, 1), (s, 3, 3) → (t, s, 3, 3)."""
        p = quaternion.exponential(q * spin_axes[:, 0])
        columns = [quaternion.rotate(p, frames[None, :, :, j] + 0.0 * q) for j in range(3)]
        return np.stack(columns, axis=-1)
