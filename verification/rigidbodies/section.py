"""A section of the continuum model, alone: its rotary inertia over steps in time, by unit quaternions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.continuum.schemes import EULER, MIDPOINT, Scheme
from dolfinrod.continuum.spatial import SpatialRods
from dolfinrod.continuum.turning import Turning
from verification.rigidbodies.top import State

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from verification.rigidbodies.top import Top

    Array = NDArray[np.float64]

__all__ = ["Section"]

KINEMATICS = SpatialRods()
# Last increment [rad]; of each increment is left what is squared, and of a weight's the part h² m g l/J.
ROUND_OFF, MOST_ITERATIONS = 1e-14, 30


@dataclass(frozen=True)
class Section:
    """Steps of one section.

    Args:
        scheme: How a step weighs inertia and moments.
        variational: Whether it follows from an action.
    """

    scheme: Scheme
    variational: bool
    keeps_momentum: bool = True

    @classmethod
    def euler(cls) -> Section:
        """Backward Euler."""
        return cls(EULER, variational=False)

    @classmethod
    def midpoint(cls) -> Section:
        """The variational midpoint rule."""
        return cls(MIDPOINT, variational=True)

    @property
    def name(self) -> str:
        """Such as "continuum, implicit Euler"."""
        return f"continuum, {self.scheme.name}"

    @property
    def order(self) -> int:
        """Of the error in the step."""
        return self.scheme.order

    def states(self, top: Top, dt: float, steps: int) -> Iterator[State]:
        """States after each step.

        Raises:
            ArithmeticError: Newton's method found no solution.
        """
        turning = Turning(KINEMATICS, self.scheme, np.diag(top.J)[None])
        p, π, w = KINEMATICS.at_rest(1), top.J * top.start.w[None], top.start.w[None]
        for _ in range(steps):
            before = p
            turning.begin(before, π, dt)
            p = self._turned(top, turning, before, w, dt)
            π = turning.mean(p) if self.scheme.side else turning.left(p, self._pull(top, before, p))
            w = KINEMATICS.turned_back(p, π) / top.J
            yield State(KINEMATICS.rotation(p)[0], w[0])

    def _turned(self, top: Top, turning: Turning, before: Array, w: Array, h: float) -> Array:
        """Quaternion after a step, by Newton's method from where the spin before it leads, shape (1, 4)."""
        kin, push = KINEMATICS, self.scheme.level * h
        p = kin.turn(before, _change(before, h * w))
        for _ in range(MOST_ITERATIONS):
            side = kin.body_spin(p if self.scheme.side else before)[0]
            lacking = -side @ (turning.residual(p) + push * self._pull(top, before, p))[0]
            slope = side @ turning.tangent(p)[0] @ kin.body_spin(p)[0].T / 4.0
            θ = np.linalg.solve(slope, lacking)[None]
            p = kin.turn(p, _change(p, θ))
            if np.linalg.norm(θ) < ROUND_OFF:
                return p
        raise ArithmeticError(f"Newton's method did not settle in {MOST_ITERATIONS} iterations, step {h} s")

    def _pull(self, top: Top, before: Array, p: Array) -> Array:
        """Gradient of the potential energy where the scheme has it, −spin(p̄)ᵀ M/|p̄|², shape (1, 4).

        As that of the strains in a rod, at the mean p̄ of the quaternions before and after a midpoint step.
        """
        if top.free:
            return np.zeros((1, 4))
        mean = self.scheme.level * p + (1.0 - self.scheme.level) * before
        arm = KINEMATICS.rotation(mean)[0] @ np.array(top.arm)
        M = np.cross(arm, top.weight)[None]
        return np.asarray(-np.einsum("nij,ni->nj", KINEMATICS.spin(mean), M) / (mean[0] @ mean[0]))


def _change(p: Array, θ: Array) -> Array:
    """Change of quaternions that turns θ about body axes stand for, ½ p θ, shape (n, 4)."""
    return np.asarray(np.einsum("nij,ni->nj", KINEMATICS.body_spin(p), θ) / 4.0)
