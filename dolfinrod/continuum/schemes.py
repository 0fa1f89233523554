"""How a step in time weighs forces and inertia: backward Euler, and a midpoint rule that keeps momentum.

With c the turn of a section in a step, R₁ = R₀ cay(c), and μ = J c/h the momentum in stress-free directions:

* backward Euler, all forces at the end: π₁ = R₁ μ, (π₁ − π₀)/h = moment.
* midpoint: inertia from the discrete action h T(½(q₀ + q₁), (q₁ − q₀)/h) of centreline and quaternions; forces by the
  virtual strains of the mean state, 2 (R₀(μ + ½ c × μ + ¼ (c·μ) c) − π₀)/h = moment, and with −½ c × μ the same at R₁.
  Turning a rod as a whole changes neither side, so linear and angular momentum are kept to round-off. Resultants follow
  the mean of the strains at both ends of the step, which are none where the rod turns as a whole: strains of the mean
  state are, ⅛ (ω h)², and burst spinning rods of large EA. What the resultants do differs from what strains store by
  O(h³) a step, so the energy swings by O(h²).

Source: Marsden & West, Acta Numerica 10, 2001; Kobilarov & Marsden, IEEE Trans. Robotics 27, 2011 (Cayley map);
Simo, Tarnow & Doblare, Int. J. Numer. Methods Eng. 38, 1995 (mean strains).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.continuum.quaternion import cross, crossed

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.continuum.kinematics import Kinematics

    Array = NDArray[np.float64]

__all__ = ["EULER", "MIDPOINT", "Scheme", "momentum", "momentum_gradient"]


@dataclass(frozen=True)
class Scheme:
    """Weights of a step.

    Args:
        name: In words.
        level: Where the forces act, as part of the way from the state before to the one after.
        order: Of the error in the step.
        side: Of the moment of momentum that the balance holds: 0 before the step, 1 after it.
    """

    name: str
    level: float
    order: int
    side: int


EULER = Scheme("implicit Euler", 1.0, 1, 1)
MIDPOINT = Scheme("midpoint with mean strains", 0.5, 2, 0)


def momentum(kin: Kinematics, J: Array, q_0: Array, q_1: Array, h: float, bend: float) -> Array:
    """Momentum of turning sections in stress-free directions, μ + bend c × μ + bend² (c·μ) c.

    Args:
        kin: How sections turn.
        J: Rotary inertia, shape (n, n_spin, n_spin).
        q_0: Rotations before the step, shape (n, n_q).
        q_1: Rotations after it.
        h: The step.
        bend: ½ at the start of a midpoint step, −½ at its end, 0 for backward Euler.

    Returns:
        Shape (n, n_spin).
    """
    c = kin.cayley(q_0, q_1)
    μ = np.einsum("nij,nj->ni", J, c) / h
    if kin.n_spin == 1 or bend == 0.0:
        return np.asarray(μ)
    along = np.einsum("ni,ni->n", c, μ)[:, None]
    return np.asarray(μ + bend * cross(c, μ) + (bend**2 * along) * c)


def momentum_gradient(kin: Kinematics, J: Array, q_0: Array, q_1: Array, h: float, bend: float) -> Array:
    """∂/∂q₁ of the same, shape (n, n_spin, n_q)."""
    c, dc = kin.cayley(q_0, q_1), kin.cayley_gradient(q_0, q_1)
    dμ = J @ dc / h
    if kin.n_spin == 1 or bend == 0.0:
        return np.asarray(dμ)
    μ = np.einsum("nij,nj->ni", J, c) / h
    along = np.einsum("ni,ni->n", c, μ)
    d_along = np.einsum("nij,ni->nj", dc, μ) + np.einsum("ni,nij->nj", c, dμ)
    turned = bend * (crossed(c, dμ) - crossed(μ, dc))
    turned += bend**2 * (along[:, None, None] * dc + c[:, :, None] * d_along[:, None, :])
    return np.asarray(dμ + turned)
