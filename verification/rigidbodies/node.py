"""A node of the discrete model, alone: backward Euler with its inertia and its rotation vectors."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from discrete.momentum import Inertia, in_body
from discrete.rotation import exp, rate, skew, tangents
from verification.rigidbodies.top import State

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from verification.rigidbodies.top import Top

    Array = NDArray[np.float64]

__all__ = ["Node"]

# Last increment [rad].
ROUND_OFF, MOST_ITERATIONS = 1e-13, 30


@dataclass(frozen=True)
class Node:
    """Steps of one node.

    Args:
        added: Whether rotation vectors are added up, R = exp(Σ Δt ω), as `discrete.solve(rotation="added")` has it.
    """

    added: bool
    variational: bool = False
    keeps_momentum: bool = False

    @property
    def name(self) -> str:
        """Such as "discrete, rotations added"."""
        return "discrete, rotations added" if self.added else "discrete, implicit Euler"

    @property
    def order(self) -> int:
        """Of the error in the step: rotation vectors that are added up lead elsewhere."""
        return 0 if self.added else 1

    def states(self, top: Top, dt: float, steps: int) -> Iterator[State]:
        """States after each step.

        Raises:
            ArithmeticError: Newton's method found no solution.
        """
        inertia = Inertia(np.ones(1), top.J[None])
        R, Ω, ω, θ = np.eye(3)[None], top.start.w[None], top.start.w[None], np.zeros((1, 3))
        for _ in range(steps):
            base, before = (np.eye(3)[None], θ) if self.added else (R, np.zeros((1, 3)))
            R, Ω, ω = _taken(top, inertia, (base, before), (Ω, ω), dt)
            θ = before + dt * ω
            yield State(R[0], Ω[0])


def _taken(
    top: Top, inertia: Inertia, turned: tuple[Array, Array], spinning: tuple[Array, Array], dt: float
) -> tuple[Array, Array, Array]:
    """Frame and angular velocities, in section axes and in global ones, at the end of a step.

    Args:
        top: What turns.
        inertia: Of the node.
        turned: Frame that rotation vectors start from, and rotation vector before the step.
        spinning: Angular velocity before it, in section axes and in global ones.
        dt: Length of the step.
    """
    (base, before), (Ω_0, ω) = turned, spinning
    for _ in range(MOST_ITERATIONS):
        θ = before + dt * ω
        R = exp(θ) @ base
        Ω = in_body(R, ω)
        needed = inertia.moment(R, Ω, Ω - Ω_0, dt)
        Θ, _ = tangents(θ, np.zeros_like(θ))
        blocks = inertia.blocks(R, ω, Ω, needed, Θ, dt)[:, 3:, 3:]
        arm = R @ np.array(top.arm)
        # A spin φ changes the moment by (φ × arm) × weight.
        slope = skew(top.weight) @ skew(arm[0])
        φ = np.linalg.solve(blocks[0] - slope, (np.cross(arm, top.weight) - needed)[0])[None]
        ω = ω + rate(θ, φ) / dt
        if np.linalg.norm(φ) < ROUND_OFF:
            R = exp(before + dt * ω) @ base
            return R, in_body(R, ω), ω
    raise ArithmeticError(f"Newton's method did not settle in {MOST_ITERATIONS} iterations, step {dt} s")
