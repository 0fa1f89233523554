"""Inertia of rigid nodes under backward Euler, Eq. 1–10: m a and J α + ω × J ω at the end of a step.

Eq. 10, J = Aᵀ J* A with A = Rᵀ, is used "wholly in the body frame": with Ω = Rᵀω the moment is
R [J* (Ω₁ − Ω₀)/Δt + Ω₁ × J* Ω₁] in global axes. Its work in the turn Δt ω₁ is ΔT + ½ ΔΩ·J* ΔΩ, so that a step never
adds rotary energy; with the difference of the ω taken in global axes it may.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from discrete.rotation import skew
from discrete.rows import cross, of_vectors, turn

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["Inertia", "in_body"]


def in_body(R: Array, ω: Array) -> Array:
    """Angular velocities in section axes, Ω = Rᵀ ω, shape (n, 3)."""
    return np.einsum("nji,nj->ni", R, ω)


@dataclass(frozen=True, eq=False)
class Inertia:
    """Rigid nodes.

    Args:
        m: Masses, shape (n,).
        J_star: Inertia about the section axes d1, d2, d3, shape (n, 3).
    """

    m: Array
    J_star: Array

    def force(self, Δv: Array, dt: float) -> Array:
        """Force that a change of velocity takes, m (v₁ − v₀)/Δt, shape (n, 3)."""
        return (self.m / dt)[:, None] * Δv

    def moment(self, R: Array, Ω: Array, ΔΩ: Array, dt: float) -> Array:
        """Moment that a change of spin takes, R [J* ΔΩ/Δt + Ω₁ × J* Ω₁].

        Args:
            R: Section frames at the end of the step, shape (n, 3, 3).
            Ω: Angular velocities there, section axes, shape (n, 3).
            ΔΩ: Their change over the step, each in its own section axes, shape (n, 3).
            dt: Length of the step.

        Returns:
            In global axes, shape (n, 3).
        """
        own = cross(Ω.T, self._J * Ω.T)
        own += (self._J / dt) * ΔΩ.T
        return turn(R.transpose(1, 2, 0), own[None])[0].T

    def blocks(self, R: Array, ω: Array, Ω: Array, moment: Array, Θ: Array, dt: float) -> Array:
        """Derivative of force and moment with displacement and spin of the node at the end of the step.

        A spin φ turns the moment, φ × M, and changes Ω by Rᵀ (δω + ω × φ) with δω = Θ φ/Δt.

        Args:
            R: Section frames, shape (n, 3, 3).
            ω: Angular velocities, global axes, shape (n, 3).
            Ω: The same in section axes, shape (n, 3).
            moment: What `moment` gave, shape (n, 3).
            Θ: Change of the rotation vector Δt ω per spin, shape (n, 3, 3).
            dt: Length of the step.

        Returns:
            Shape (n, 6, 6).
        """
        blocks = np.zeros((len(self.m), 6, 6))
        blocks[:, range(3), range(3)] = (self.m / dt**2)[:, None]
        slope = skew(Ω) * self.J_star[:, None] - skew(self.J_star * Ω)
        slope[:, range(3), range(3)] += self.J_star / dt
        change = Θ / dt + skew(ω)
        blocks[:, 3:, 3:] = R @ slope @ np.swapaxes(R, 1, 2) @ change - skew(moment)
        return blocks

    def kinetic(self, v: Array, Ω: Array) -> float:
        """Energy ½ m v² + ½ Ω·J* Ω; of changes Δv and ΔΩ it is what a step loses."""
        return 0.5 * float(np.vdot(self.m * v.T, v.T) + np.vdot(self._J * Ω.T, Ω.T))

    @cached_property
    def _J(self) -> Array:
        """J* by rows."""
        return of_vectors(self.J_star)
