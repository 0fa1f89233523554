"""What moves: fields, strains and rotations of a rod. Only the kinematics know the dimension.

Rods in space (spatial.py) and in a plane (planar.py) answer the same questions, so that terms, supports and solver
never ask which one they hold. The rotation unknown measures the turn from the stress-free frame, R = R(p) R₀(s), or
R(φ) R₀(s) in a plane.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np
import ufl

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from ufl.core.expr import Expr

    Array = NDArray[np.float64]

__all__ = ["Configuration", "Kinematics"]


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

    def rotation(self, q: Array) -> Array:
        """R, (n, dim, dim)."""
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

    def turn_between(self, a: Array, b: Array) -> Array:
        """Angle of the turn from a to b [rad], (n,)."""
        ...

    def extrapolated(self, a: Array, b: Array, factor: float) -> Array:
        """b turned on by `factor` times the turn from a to b, (..., n_q)."""
        ...

    def rigid_motions(self, r: Array, q: Array) -> Array:
        """How n nodes (r, q) move with their rod, along each working direction, then about each spin axis."""
        ...

    def transport(self, q: Array, rate: Array) -> tuple[Array, Array]:
        """Rates at which a change of q and a moment m have to change so that spin and moment stay fixed in space."""
        ...

    def turned_frames(self, q: Array, spin_axes: Array, frames: Array) -> Array:
        """Section frames in space of turned stress-free frames."""
        ...

    def cayley(self, q_0: Array, q_1: Array) -> Array:
        """Turn of a step in the turned frame by Cayley's map."""
        ...

    def cayley_gradient(self, q_0: Array, q_1: Array) -> Array:
        """∂/∂q₁ of that."""
        ...

    def rotation_vector(self, q_0: Array, q_1: Array) -> Array:
        """Turn from q₀ to q₁ as a rotation vector in working directions, (n, n_spin)."""
        ...

    def rotation_vector_gradient(self, q_0: Array, q_1: Array) -> Array:
        """∂/∂q₁ of that, (n, n_spin, n_q)."""
        ...

    def turned_spin(self, q: Array, v: Array) -> Array:
        """A spin or moment of the turned frame in working directions."""
        ...

    def turned_back(self, q: Array, v: Array) -> Array:
        """Back from there."""
        ...
