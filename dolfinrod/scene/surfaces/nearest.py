"""Signed distances from cylinders and grooves, point by point: compiled loops."""

from __future__ import annotations

from math import hypot, inf, sqrt

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.compiled import compiled
from dolfinrod.scene.surfaces.polyline import ROUND_OFF

__all__ = ["beside_axis", "beside_groove", "beside_profile"]

Array = NDArray[np.float64]
Near = tuple[Array, Array, Array]


@compiled
def beside_axis(x: Array, point: Array, axis: Array, across: Array, radius: float, sign: float, close: float) -> Near:
    """What a cylinder is to points.

    Args:
        x: Shape (n, 3) [m].
        point: Of its axis [m].
        axis: Unit vector along it.
        across: Unit vector, normal where points are on the axis.
        radius: [m].
        sign: 1 where the free side is outside, −1 inside.
        close: Distance from the axis that is round-off [m].

    Returns:
        As `Closest`.
    """
    n = len(x)
    φ, normal, curvature = np.empty(n), np.empty((n, 3)), np.zeros((n, 3, 3))
    for i in range(n):
        a, b, c = x[i, 0] - point[0], x[i, 1] - point[1], x[i, 2] - point[2]
        # Twice, for the digits the first projection loses far along the axis.
        for _ in range(2):
            along = a * axis[0] + b * axis[1] + c * axis[2]
            a, b, c = a - along * axis[0], b - along * axis[1], c - along * axis[2]
        ρ = sqrt(a * a + b * b + c * c)
        φ[i] = sign * (ρ - radius)
        if ρ <= close:
            normal[i] = sign * across
            continue
        normal[i, 0], normal[i, 1], normal[i, 2] = sign * (a / ρ), sign * (b / ρ), sign * (c / ρ)
        for j in range(3):
            for k in range(3):
                around = (1.0 if j == k else 0.0) - axis[j] * axis[k] - normal[i, j] * normal[i, k]
                curvature[i, j, k] = sign / ρ * around
    return φ, normal, curvature


@compiled
def _side(along: Array, k: int, e_z: float, e_y: float) -> float:
    """1 on the left of the arc behind flank k, −1 on its right; e is from its centre."""
    u_z, u_y = -along[k, 1] - along[k + 1, 1], along[k, 0] + along[k + 1, 0]
    return -1.0 if u_z * e_z + u_y * e_y < 0.0 else 1.0


@compiled
def _nearest(
    z: float, y: float, start: Array, along: Array, length: Array, centre: Array, radius: Array
) -> tuple[int, float]:
    """Number of the piece that a point is nearest to, arcs before flanks, and its signed distance."""
    best, φ, least, last = 0, np.nan, inf, len(start) - 1
    s = along[0, 0] * (z - start[0, 0]) + along[0, 1] * (y - start[0, 1])
    for k in range(last):
        before, d_z, d_y = s, z - start[k + 1, 0], y - start[k + 1, 1]
        s = along[k + 1, 0] * d_z + along[k + 1, 1] * d_y
        # Strips and wedges ask the same s, so that no rounding leaves a point without a piece.
        if before < length[k] or s > 0.0:
            continue
        e_z, e_y = z - centre[k, 0], y - centre[k, 1]
        away = radius[k] + _side(along, k, e_z, e_y) * hypot(e_z, e_y)
        if abs(away) < least:
            best, φ, least = k, away, abs(away)
    for i in range(last + 1):
        d_z, d_y = z - start[i, 0], y - start[i, 1]
        s, h = along[i, 0] * d_z + along[i, 1] * d_y, along[i, 0] * d_y - along[i, 1] * d_z
        behind = i > 0 and (s < 0.0 or (i < last and length[i] == 0.0))
        beyond = i < last and s > length[i]
        if not behind and not beyond and abs(h) < least:
            best, φ, least = last + i, h, abs(h)
    return best, φ


@compiled
def _normal(best: int, z: float, y: float, along: Array, centre: Array, close: float) -> tuple[float, float, float]:
    """Normal (n_z, n_y) and curvature at the nearest piece."""
    k, n_arcs = best, len(centre)
    if k >= n_arcs:
        return -along[k - n_arcs, 1], along[k - n_arcs, 0], 0.0
    e_z, e_y = z - centre[k, 0], y - centre[k, 1]
    ρ = hypot(e_z, e_y)
    # Closer to a lip or a centre than rounding, every direction is as good.
    if ρ <= close:
        u_z, u_y = -along[k, 1] - along[k + 1, 1], along[k, 0] + along[k + 1, 0]
        size = hypot(u_z, u_y)
        return u_z / size, u_y / size, 0.0
    bend = _side(along, k, e_z, e_y) / ρ
    return bend * e_z, bend * e_y, bend


@compiled
def beside_profile(
    p: Array, start: Array, along: Array, length: Array, centre: Array, radius: Array, close: float
) -> Near:
    """What a profile is to points of its plane.

    Args:
        p: Points (z, y), shape (n, 2) [m].
        start: Of its flanks; this and what follows as `Profile`.
        along: Likewise.
        length: Likewise.
        centre: Of its arcs.
        radius: Likewise.
        close: Distance from the centre of an arc that is round-off [m].

    Returns:
        As `Nearest`.
    """
    n = len(p)
    φ, normal, curvature = np.empty(n), np.empty((n, 2)), np.empty(n)
    for i in range(n):
        best, φ[i] = _nearest(p[i, 0], p[i, 1], start, along, length, centre, radius)
        normal[i, 0], normal[i, 1], curvature[i] = _normal(best, p[i, 0], p[i, 1], along, centre, close)
    return φ, normal, curvature


@compiled
def beside_groove(
    x: Array,
    point: Array,
    axes: Array,
    roller: float,
    start: Array,
    along: Array,
    length: Array,
    centre: Array,
    radius: Array,
    close: float,
) -> Near:
    """What a groove is to points; around a roller the nearest place lies in the plane through its axis.

    Args:
        x: Shape (n, 3) [m].
        point: Where (0, 0) of its section is [m].
        axes: Along the groove, to the right and up, as rows.
        roller: Radius of the roller, or ∞ [m].
        start: Of its section; this and what follows as `beside_profile`.
        along: Likewise.
        length: Likewise.
        centre: Likewise.
        radius: Likewise.
        close: Likewise.

    Returns:
        As `Closest`.
    """
    φ, normal, curvature = np.empty(len(x)), np.empty((len(x), 3)), np.zeros((len(x), 3, 3))
    for i in range(len(x)):
        z, y, forth, back, turn = _section(x, i, point, axes, roller)
        best, φ[i] = _nearest(z, y, start, along, length, centre, radius)
        n_z, n_y, bend = _normal(best, z, y, along, centre, close)
        for j in range(3):
            normal[i, j] = n_z * axes[1, j] + n_y * (forth * axes[2, j] + back * axes[0, j])
        _add_square(curvature, i, bend, axes, -n_y, n_z * forth, n_z * back)
        _add_square(curvature, i, n_y * turn, axes, 0.0, -back, forth)
    return φ, normal, curvature


@compiled
def _section(x: Array, i: int, point: Array, axes: Array, roller: float) -> tuple[float, float, float, float, float]:
    """Where point i is in the section, (z, y); the direction out of the roller there, by up and along; and 1/ρ.

    On the axis of the roller the curvature around it is taken as zero.
    """
    d_0, d_1, d_2 = x[i, 0] - point[0], x[i, 1] - point[1], x[i, 2] - point[2]
    z = d_0 * axes[1, 0] + d_1 * axes[1, 1] + d_2 * axes[1, 2]
    y = d_0 * axes[2, 0] + d_1 * axes[2, 1] + d_2 * axes[2, 2]
    if roller == inf:
        return z, y, 1.0, 0.0, 0.0
    forward, height = d_0 * axes[0, 0] + d_1 * axes[0, 1] + d_2 * axes[0, 2], y + roller
    ρ = hypot(forward, height)
    if ρ <= ROUND_OFF * roller:
        return z, ρ - roller, 1.0, 0.0, 0.0
    return z, ρ - roller, height / ρ, forward / ρ, 1.0 / ρ


@compiled
def _add_square(curvature: Array, i: int, size: float, axes: Array, right: float, up: float, along: float) -> None:
    """Add size a⊗a with a vector a by its components."""
    if size == 0.0:
        return
    for j in range(3):
        a_j = right * axes[1, j] + up * axes[2, j] + along * axes[0, j]
        for k in range(3):
            a_k = right * axes[1, k] + up * axes[2, k] + along * axes[0, k]
            curvature[i, j, k] += size * a_j * a_k
