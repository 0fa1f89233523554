"""How rods slide past each other, and how they resist it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.compiled import compiled
from dolfinrod.scene.friction import Coulomb
from dolfinrod.scene.meeting.pressed import Pressed
from dolfinrod.scene.meeting.vectors import crossed, rotated, row
from dolfinrod.scene.rubbing import Pressed as Limits
from dolfinrod.scene.rubbing import Rubbing, rubbed

__all__ = ["Slip", "Ways", "slide"]

Array = NDArray[np.float64]
Integers = NDArray[np.intp]


class Ways(NamedTuple):
    """Ways of points in contact in a step, w = Δx_A − Δx_B − Θ × n with Θ = a_A Ψ_A + a_B Ψ_B.

    Args:
        lever: a of the rod, times weights of its nodes, shape (n, M) [m].
        whole: Weights of nodes in places of either rod, shape (n, M).
        vectors: Θ [m], Ψ_A + Ψ_B [rad] and its derivative by the coordinate v on the second rod, w [m], and the
            derivative of Δx_A − Δx_B by v with the sign changed, shape (n, 5, 3).
    """

    lever: Array
    whole: Array
    vectors: Array

    @property
    def both(self) -> Array:
        """Ψ_A + Ψ_B, shape (n, 3) [rad]."""
        return self.vectors[:, 1]

    @property
    def w(self) -> Array:
        """Shape (n, 3) [m]."""
        return self.vectors[:, 3]


@dataclass(frozen=True, eq=False)
class Slip:
    """The way of the surface of one rod past that of another, at points in contact.

    Lever arms a = radius + g/2 add up to the distance of the centrelines: so the couples −a n × t that friction has
    about them leave no moment on the two together. At centrelines it has none.

    Args:
        ways: In the step.
        arm: a of the second rod, shape (n,) [m].
        start: Displacement from the anchors at the start, shape (n, 3) [m].
        share: Part of the step in which they touch, shape (n,).
        share_gap: Its derivative by the gap at the end [1/m].
        v: Displacement from the anchors, its part along the normal included, shape (n, 3) [m].
        rubbing: What comes of it.
    """

    ways: Ways
    arm: Array
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
    pressed: Pressed, moved: Array, turn: Array, anchors: Array, slid: Array, friction: Coulomb, ε_T: float, g_0: float
) -> Slip:
    """Return mapping at points in contact.

    Args:
        pressed: The points.
        moved: Ways of the nodes in the step, shape (n_nodes, 3) [m].
        turn: Rotation vectors of the sections at the nodes, shape (n_nodes, 3) [rad].
        anchors: Displacements from the anchors at the start, shape (n, 3) [m].
        slid: As for `rubbed`, shape (n, 3) [m].
        friction: Its coefficient, and where it acts.
        ε_T: Stiffness of the anchors [N/m²].
        g_0: Gap at which contact begins [m].

    Returns:
        The slip.
    """
    facing, n = pressed.facing, pressed.facing.normal
    half = 0.5 * (facing.distance - pressed.radius_a - pressed.radius_b)
    arm_a, arm_b = (friction.arm(radius + half) for radius in (pressed.radius_a, pressed.radius_b))
    ways = Ways(*_ways(facing.nodes, facing.h, facing.h_v, n, arm_a, arm_b, moved, turn))
    share, share_gap = _shares(pressed.gap_0, pressed.gap, g_0)
    v = rotated(0.5 * ways.both, anchors) + share[:, None] * ways.w
    limits = Limits(pressed.p, np.zeros_like(n), n, np.zeros((len(n), 3, 3)), pressed.radius_a, pressed.p)
    none = np.zeros(len(n), dtype=bool)
    rubbing = rubbed(limits, v, friction.mu, ε_T, none, none, slid)
    return Slip(ways, arm_b, anchors, share, share_gap, v, rubbing)


@compiled
def _ways(
    nodes: Integers, h: Array, h_v: Array, n: Array, arm_a: Array, arm_b: Array, moved: Array, turn: Array
) -> tuple[Array, Array, Array]:
    """As `Ways`, of nodes that moved and turned, each shape (n_nodes, 3)."""
    count, M = h.shape
    lever, whole, vectors = np.empty((count, M)), np.empty((count, M)), np.zeros((count, 5, 3))
    for i in range(count):
        for k in range(M):
            whole[i, k] = h[i, k] if k < M // 2 else -h[i, k]
            lever[i, k] = whole[i, k] * (arm_a[i] if k < M // 2 else arm_b[i])
            for j in range(3):
                ψ, way = turn[nodes[i, k], j], moved[nodes[i, k], j]
                vectors[i, 0, j] += lever[i, k] * ψ
                vectors[i, 1, j] += whole[i, k] * ψ
                vectors[i, 2, j] += h_v[i, k] * ψ
                vectors[i, 3, j] += h[i, k] * way
                vectors[i, 4, j] += h_v[i, k] * way
        rolled = crossed(row(vectors[i], 0), row(n, i))
        for j in range(3):
            vectors[i, 3, j] -= rolled[j]
    return lever, whole, vectors


@compiled
def _shares(gap_0: Array, gap: Array, g_0: float) -> tuple[Array, Array]:
    """Parts of the step in which points are in contact, and their derivatives by the gap at its end.

    What comes from afar touches over the last part of its way only.
    """
    share, share_gap = np.ones(len(gap)), np.zeros(len(gap))
    for i in range(len(gap)):
        if gap_0[i] > g_0 and gap[i] < g_0:
            way = gap_0[i] - gap[i]
            share[i], share_gap[i] = (g_0 - gap[i]) / way, (g_0 - gap_0[i]) / (way * way)
    return share, share_gap
