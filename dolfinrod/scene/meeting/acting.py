"""Forces and couples of points in contact, and their derivatives by what nodes do.

All that acts at a point depends on a few vectors, sums over its nodes: X = Σ h x, V = Σ h_v x and, where a mean load
acts in the middle of a step, E = Σ h x with the weights at its end; and of the rotation vectors ψ of the sections,
Θ = Σ ℓ ψ and Ψ = Σ |h| ψ. Forces and couples go back to nodes by the same weights. So blocks of nodes are products of
weights and of matrices 3 × 3.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.meeting.coupling import Product
from dolfinrod.scene.meeting.curves import dot
from dolfinrod.scene.meeting.pressed import Pressed
from dolfinrod.scene.meeting.slipping import Slip, rotated_turn, whole
from dolfinrod.scene.rubbing import Pressed as Limits
from dolfinrod.scene.rubbing import cross, skew, traction_gradient

__all__ = ["Derivatives", "couples", "forces"]

Array = NDArray[np.float64]


def forces(pressed: Pressed, slip: Slip | None) -> Array:
    """On the first rod, shape (n, 3) [N]."""
    line = pressed.p[:, None] * pressed.facing.normal
    return np.asarray(pressed.length[:, None] * (line if slip is None else line + slip.traction))


def couples(pressed: Pressed, slip: Slip) -> Array:
    """n × t, which turns both rods by −a n × t, shape (n, 3) [N]."""
    return np.asarray(pressed.length[:, None] * cross(pressed.facing.normal, slip.traction))


class Derivatives:
    """Derivatives of forces and couples.

    Args:
        pressed: Points in contact.
        slip: How they slide; None where nothing rubs.
        friction: Coefficient and stiffness of the anchors.
    """

    def __init__(self, pressed: Pressed, slip: Slip | None, friction: tuple[float, float]) -> None:
        self._pressed, self._slip, self._friction = pressed, slip, friction
        facing, level = pressed.facing, pressed.level
        at_end = level == 1.0
        self._basis = np.stack([facing.h, facing.h_v, *([] if at_end else [pressed.end.h])], axis=1)
        self._wide = 3 * self._basis.shape[1]
        n, D = facing.normal, facing.distance
        self._n, count = n, len(n)
        self._v = np.zeros((count, self._wide))
        self._v[:, :3], self._v[:, 3:6] = level * facing.follow[:, None] * np.stack([facing.t, facing.d])
        across = (np.eye(3) - n[:, :, None] * n[:, None, :]) / np.where(D > 0.0, D, np.inf)[:, None, None]
        self._n_q = -(across @ facing.t[:, :, None]) * self._v[:, None, :]
        self._n_q[:, :, :3] += level * across
        self._gap = np.zeros((count, self._wide))
        last = slice(0, 3) if at_end else slice(6, 9)
        self._gap[:, last] = pressed.end.normal

    def force_x(self) -> Product:
        """∂f/∂x."""
        pressed, W = self._pressed, self._pressed.length[:, None, None]
        F_q = self._n[:, :, None] * (pressed.slope[:, None] * self._gap)[:, None, :]
        F_q += pressed.p[:, None, None] * self._n_q
        if self._slip is not None:
            self._t_q = self._traction(self._slid_by_places(self._slip), pressed.slope[:, None] * self._gap)
            F_q += self._t_q
        F = forces(pressed, self._slip)
        core = np.stack([W * F_q, -F[:, :, None] * self._v[:, None, :]], axis=1)
        return Product(self._basis[:, :2], core, self._basis)

    def rubbing(self) -> tuple[Product, Product, Product]:
        """∂f by turns, ∂m/∂x and ∂m by turns; after `force_x`."""
        pressed, slip, facing = self._pressed, self._slip, self._pressed.facing
        assert slip is not None
        W, both = pressed.length[:, None, None], whole(facing.h)
        turns = np.stack([slip.lever, both], axis=1)
        t_turn = self._traction(self._slid_by_turns(slip), np.zeros((len(both), 6)))
        c, N, level = couples(pressed, slip), skew(self._n), pressed.level
        c_q = W * (N @ self._t_q - skew(slip.traction) @ self._n_q)
        D_q = np.zeros((len(c), self._wide))
        D_q[:, :3] = level * self._n
        rows = (
            c_q,
            0.5 * c[:, :, None] * D_q[:, None, :],
            slip.arm[:, None, None] * c[:, :, None] * self._v[:, None, :],
        )
        levers = np.stack([slip.lever, both, facing.h_v], axis=1)
        force_turn = Product(facing.h[:, None], (W * t_turn)[:, None], turns)
        moment_x = Product(levers, -np.stack(rows, axis=1), self._basis)
        return force_turn, moment_x, Product(slip.lever[:, None], -(W * (N @ t_turn))[:, None], turns)

    def _traction(self, u_q: Array, p_q: Array) -> Array:
        """∂t, shape (n, 3, q)."""
        slip, p, n = self._slip, self._pressed.p, self._n
        assert slip is not None
        limits = Limits(p, p_q, n, np.zeros((len(n), 3, 3)), p, p)
        return traction_gradient(limits, slip.rubbing, u_q, *self._friction)

    def _slid_by_places(self, slip: Slip) -> Array:
        """∂u of the displacement from the anchors, shape (n, 3, q)."""
        n, n_q, v_q = self._n, self._n_q, self._v[:, None, :]
        D_q = np.zeros_like(v_q)
        D_q[:, 0, :3] = self._pressed.level * n
        Θ_q = 0.5 * slip.both[:, :, None] * D_q + slip.arm[:, None, None] * slip.both_v[:, :, None] * v_q
        w_q = skew(n) @ Θ_q - skew(slip.turned) @ n_q - slip.w_v[:, :, None] * v_q
        w_q[:, :, :3] += np.eye(3)
        self._back = 0.5 * rotated_turn(0.5 * slip.both, slip.start)
        back = self._back @ slip.both_v[:, :, None] * v_q
        v = slip.share[:, None, None] * w_q + back
        v += slip.w[:, :, None] * (slip.share_gap[:, None] * self._gap)[:, None, :]
        u_q = v - dot(n, slip.v)[:, None, None] * n_q
        along = np.einsum("ni,niq->nq", n, v) + np.einsum("ni,niq->nq", slip.v, n_q)
        return np.asarray(u_q - n[:, :, None] * along[:, None, :])

    def _slid_by_turns(self, slip: Slip) -> Array:
        """The same by Θ and Ψ, shape (n, 3, 6); after `_slid_by_places`."""
        n, back = self._n[:, :, None], self._back
        turned = back - n * (self._n[:, None, :] @ back)
        return np.concatenate([slip.share[:, None, None] * skew(self._n), turned], axis=2)
