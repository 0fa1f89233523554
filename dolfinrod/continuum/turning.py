"""Rotary inertia of the nodes over one step in time."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.continuum.quaternion import crossed
from dolfinrod.continuum.schemes import momentum, momentum_gradient

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.continuum.kinematics import Kinematics
    from dolfinrod.continuum.schemes import Scheme

    Array = NDArray[np.float64]

__all__ = ["NoTurning", "Turning"]


class Turning:
    """Moment of momentum that turning sections gain in a step, in stress-free directions.

    The balance along a change δq of the rotation, whose spin in the section is E δq, is Eᵀ (Π − R^T π₀) with R and E
    on the side of the step that the scheme weighs, and Π as in `schemes`.

    Args:
        kin: How sections turn.
        scheme: How the step weighs.
        J: Rotary inertia of the nodes, shape (n, n_spin, n_spin).
    """

    def __init__(self, kin: Kinematics, scheme: Scheme, J: Array) -> None:
        self._kin, self._scheme, self._J = kin, scheme, J
        self._bend = 0.0 if scheme.side else 0.5
        n_q = len(kin.at_rest(1)[0])
        # The spin in a section is linear in a quaternion: what each component of it contributes.
        self._units = kin.body_spin(np.eye(n_q))

    def begin(self, q: Array, π: Array, h: float) -> None:
        """Start a step of length h from rotations q (n, n_q) and momenta π (n, n_spin) in working directions."""
        self._q_0, self._π_0, self._h = q, π, h
        self._spin_0, self._held_0 = self._kin.body_spin(q), self._kin.turned_back(q, π)

    def residual(self, q: Array) -> Array:
        """Gain per step along the rotations, for rotations q after it, shape (n, n_q)."""
        spin = self._kin.body_spin(q) if self._scheme.side else self._spin_0
        return np.asarray(np.einsum("nij,ni->nj", spin, self._gained(q)))

    def tangent(self, q: Array) -> Array:
        """∂/∂q of that along the unit sphere, shape (n, n_q, n_q)."""
        gradient = momentum_gradient(self._kin, self._J, self._q_0, q, self._h, self._bend)
        if not self._scheme.side:
            return np.swapaxes(self._spin_0, 1, 2) @ gradient
        spin = self._kin.body_spin(q)
        if self._kin.n_spin == 1:
            return np.swapaxes(spin, 1, 2) @ gradient
        gradient -= crossed(self._kin.turned_back(q, self._π_0), spin)
        blocks = np.einsum("kij,ni->njk", self._units, self._gained(q))
        return np.asarray(blocks + np.swapaxes(spin, 1, 2) @ gradient)

    def mean(self, q: Array) -> Array:
        """Mean momentum of the step, at its end, in working directions, shape (n, n_spin)."""
        return self._kin.turned_spin(q, self._momentum(q, 0.0))

    def left(self, q: Array, b: Array) -> Array:
        """Momentum that a midpoint step leaves free sections with, in working directions, shape (n, n_spin).

        Args:
            q: Rotations after the step.
            b: Residual of everything but inertia, shape (n, n_q).
        """
        # Half of a change of q after the step moves the state between: a quarter of the spin for a quaternion.
        share = 0.125 if self._kin.n_spin == 3 else 0.5
        pushed = self._h * share * np.einsum("nij,nj->ni", self._kin.body_spin(q), b)
        return self._kin.turned_spin(q, self._momentum(q, -self._bend) - pushed)

    def _gained(self, q: Array) -> Array:
        held = self._kin.turned_back(q, self._π_0) if self._scheme.side else self._held_0
        return self._momentum(q, self._bend) - held

    def _momentum(self, q: Array, bend: float) -> Array:
        return momentum(self._kin, self._J, self._q_0, q, self._h, bend)


class NoTurning(Turning):
    """Sections without rotary inertia: nothing to gain."""

    def begin(self, q: Array, π: Array, h: float) -> None:
        """Nothing to remember."""

    def residual(self, q: Array) -> Array:
        """None."""
        return np.zeros_like(q)

    def tangent(self, q: Array) -> Array:
        """None."""
        return np.zeros((*q.shape, q.shape[1]))

    def mean(self, q: Array) -> Array:
        """None."""
        return np.zeros((len(q), self._kin.n_spin))

    def left(self, q: Array, b: Array) -> Array:
        """None."""
        return self.mean(q)
