"""Forces and couples of points in contact, and their derivatives by what nodes do.

All that acts at a point depends on a few numbers: on X = Σ h x over its nodes; on the coordinate v opposite, which
follows X and V = Σ h_v x; on the gap at the end of a step, which follows E = Σ h x with the weights there; and on the
rotation vectors ψ of the sections by Θ = Σ ℓ ψ and Ψ = Σ |h| ψ. Forces and couples go back to nodes by weights h and ℓ.
"""

from __future__ import annotations

from math import sqrt

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.compiled import compiled
from dolfinrod.scene.meeting.changes import Changes
from dolfinrod.scene.meeting.pressed import Pressed
from dolfinrod.scene.meeting.slipping import Slip
from dolfinrod.scene.meeting.slopes import RUBBING, WAYS, pressing, rubbing
from dolfinrod.scene.meeting.vectors import crossed, row

__all__ = ["derivatives", "forces"]

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]


def forces(pressed: Pressed, slip: Slip | None) -> tuple[Array, Array]:
    """On the first rod; and n × t times length, which turns both rods by −a n × t; shape (n, 3) [N] each."""
    normal = pressed.facing.normal
    traction = np.zeros_like(normal) if slip is None else slip.traction
    return _forces(normal, pressed.p, traction, pressed.length)


@compiled
def _forces(n: Array, p: Array, t: Array, length: Array) -> tuple[Array, Array]:
    force, couple = np.empty((len(p), 3)), np.empty((len(p), 3))
    for i in range(len(p)):
        c = crossed(row(n, i), row(t, i))
        for j in range(3):
            force[i, j], couple[i, j] = length[i] * (p[i] * n[i, j] + t[i, j]), length[i] * c[j]
    return force, couple


def derivatives(pressed: Pressed, slip: Slip | None, friction: tuple[float, float], *, turns: bool) -> Changes:
    """Derivatives of forces and couples.

    Args:
        pressed: Points in contact.
        slip: How they slide; None where nothing rubs.
        friction: Coefficient and stiffness of the anchors.
        turns: Whether friction has a lever arm.

    Returns:
        What they change with.
    """
    facing, level, end, seen = pressed.facing, pressed.level, pressed.end, pressed.facing.opposite
    n, p, slope, length = facing.normal, pressed.p, pressed.slope, pressed.length
    at, D, arm = np.stack([n, seen.t], axis=1), facing.distance, np.zeros(len(p))
    columns = pressing(at, D, p, slope, length, level, RUBBING if turns else WAYS)
    (force, couple), follow = forces(pressed, slip), (level * seen.follow)[:, None]
    weights, vectors = [facing.h, facing.h_v, end.h], [follow * seen.t, follow * seen.d, end.normal, force]
    if slip is not None:
        arm, rubs = slip.arm, slip.rubbing
        numbers = np.stack([slope, length, arm, slip.share, slip.share_gap], axis=1)
        resists = _resists(rubs.u, rubs.slides, p, *friction)
        by = np.stack([slip.start, slip.v, rubs.traction], axis=1)
        rubbing(at, D, slip.ways.vectors, by, numbers, resists, level, columns)
        if turns:
            weights += [slip.ways.lever, slip.ways.whole]
            vectors += [couple, 0.5 * level * n]
    return Changes(np.stack(weights, axis=1), np.stack(vectors, axis=1), columns, arm)


@compiled
def _resists(u: Array, slides: Flags, p: Array, μ: float, ε_T: float) -> Array:
    """Derivatives of the traction by the displacement from the anchors and by the line load, shape (n, 3, 4)."""
    resists = np.zeros((len(p), 3, 4))
    for i in range(len(p)):
        far, held = sqrt(u[i, 0] ** 2 + u[i, 1] ** 2 + u[i, 2] ** 2), -ε_T
        if slides[i]:
            held = -μ * p[i] / far
        for j in range(3):
            resists[i, j, j] = held
            if slides[i]:
                for k in range(3):
                    resists[i, j, k] -= held * (u[i, j] / far) * (u[i, k] / far)
                resists[i, j, 3] = -μ * u[i, j] / far
    return resists
