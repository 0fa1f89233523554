"""How rods slide past each other, and how they resist it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.meeting.curves import dot
from dolfinrod.scene.meeting.pressed import Pressed
from dolfinrod.scene.rubbing import Pressed as Limits
from dolfinrod.scene.rubbing import Rubbing, cross, rubbed, skew

__all__ = ["Slip", "rotated", "rotated_turn", "slide", "whole"]

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Slip:
    """The way of the surface of one rod past that of another, at points in contact.

    w = Δx_A − Δx_B − Θ × n, Θ = a_A Ψ_A + a_B Ψ_B with lever arms a = radius + g/2, which add up to the distance of the
    centrelines: so the couples −a n × t that friction has about them leave no moment on the two together.

    Args:
        lever: a of the rod, times weights of its nodes, shape (n, M) [m].
        arm: a of the second rod, shape (n,) [m].
        turned: Θ, shape (n, 3) [m].
        both: Ψ_A + Ψ_B, shape (n, 3) [rad].
        both_v: Its derivative by the coordinate on the second rod.
        w_v: That of Δx_A − Δx_B, with the sign changed, shape (n, 3) [m].
        w: Shape (n, 3) [m].
        start: Displacement from the anchors at the start, shape (n, 3) [m].
        share: Part of the step in which they touch, shape (n,).
        share_gap: Its derivative by the gap at the end [1/m].
        v: Displacement from the anchors, its part along the normal included, shape (n, 3) [m].
        rubbing: What comes of it.
    """

    lever: Array
    arm: Array
    turned: Array
    both: Array
    both_v: Array
    w_v: Array
    w: Array
    start: Array
    share: Array
    share_gap: Array
    v: Array
    rubbing: Rubbing

    @property
    def traction(self) -> Array:
        """On the first rod, shape (n, 3) [N/m]."""
        return self.rubbing.traction


def slide(
    pressed: Pressed, moved: Array, turn: Array, anchors: Array, slid: Array, friction: tuple[float, float], g_0: float
) -> Slip:
    """Return mapping at points in contact.

    Args:
        pressed: The points.
        moved: Ways of the nodes in the step, shape (n_nodes, 3) [m].
        turn: Rotation vectors of the sections at the nodes, shape (n_nodes, 3) [rad].
        anchors: Displacements from the anchors at the start, shape (n, 3) [m].
        slid: As for `rubbed`, shape (n, 3) [m].
        friction: Coefficient, and stiffness of the anchors [N/m²].
        g_0: Gap at which contact begins [m].

    Returns:
        The slip.
    """
    facing, nodes = pressed.facing, pressed.facing.nodes
    h, h_v, n, M = facing.h, facing.h_v, facing.normal, facing.h.shape[1] // 2
    half = 0.5 * (facing.distance - pressed.radius_a - pressed.radius_b)
    arms = np.stack([pressed.radius_a + half, pressed.radius_b + half], axis=1)
    lever = np.repeat(arms, M, axis=1) * whole(h)
    ways, turns = moved[nodes], turn[nodes]
    turned, both = np.einsum("nm,nmi->ni", lever, turns), np.einsum("nm,nmi->ni", whole(h), turns)
    w = np.einsum("nm,nmi->ni", h, ways) - cross(turned, n)
    share, share_gap = _shares(pressed, g_0)
    v = rotated(0.5 * both, anchors) + share[:, None] * w
    limits = Limits(pressed.p, np.zeros_like(n), n, np.zeros((len(n), 3, 3)), pressed.radius_a, pressed.p)
    none = np.zeros(len(n), dtype=bool)
    rubbing = rubbed(limits, v, *friction, none, none, slid)
    both_v, w_v = np.einsum("nm,nmi->ni", h_v, turns), np.einsum("nm,nmi->ni", h_v, ways)
    return Slip(lever, arms[:, 1], turned, both, both_v, w_v, w, anchors, share, share_gap, v, rubbing)


def whole(h: Array) -> Array:
    """Weights of nodes in places of either rod, of which the second come with the sign changed, shape (n, M)."""
    M = h.shape[1] // 2
    return np.concatenate([h[:, :M], -h[:, M:]], axis=1)


def _shares(pressed: Pressed, g_0: float) -> tuple[Array, Array]:
    """Parts of the step in which points are in contact, and their derivatives by the gap at its end.

    What comes from afar touches over the last part of its way only.
    """
    far = (pressed.gap_0 > g_0) & (pressed.gap < g_0)
    way = np.where(far, pressed.gap_0 - pressed.gap, 1.0)
    share = np.where(far, (g_0 - pressed.gap) / way, 1.0)
    return share, np.where(far, (g_0 - pressed.gap_0) / way**2, 0.0)


def rotated(turn: Array, u: Array) -> Array:
    """Vectors turned by rotation vectors, shape (n, 3)."""
    θ = np.sqrt(dot(turn, turn))[:, None]
    once = cross(turn, u)
    return np.asarray(u + np.sinc(θ / np.pi) * once + 0.5 * np.sinc(0.5 * θ / np.pi) ** 2 * cross(turn, once))


def rotated_turn(turn: Array, u: Array) -> Array:
    """Derivatives of `rotated` by the rotation vectors, shape (n, 3, 3)."""
    θ = np.sqrt(dot(turn, turn))[:, None, None]
    sine, K = np.sinc(θ / np.pi), skew(turn)
    small = θ < np.finfo(float).eps ** 0.25
    rest = np.where(small, 1.0 / 6.0, (1.0 - sine) / np.where(small, 1.0, θ) ** 2)
    T = np.eye(3) + 0.5 * np.sinc(0.5 * θ / np.pi) ** 2 * K + rest * (K @ K)
    return np.asarray(-skew(rotated(turn, u)) @ T)
