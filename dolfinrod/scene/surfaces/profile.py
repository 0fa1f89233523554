"""The cross-section of a groove: straight flanks that meet at lips and in corners, which may be rounded."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NoReturn

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.errors import SceneError
from dolfinrod.scene.surfaces.polyline import ROUND_OFF, corners, cross, dot, refuse_crossings

__all__ = ["Nearest", "Profile"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Nearest:
    """What a profile is to points of its plane.

    Args:
        distance: Signed distance φ, shape (n,) [m].
        normal: ∂φ/∂(z, y), shape (n, 2).
        curvature: Second derivative of φ across the normal, shape (n,) [1/m]; along it there is none.
    """

    distance: Array
    normal: Array
    curvature: Array


@dataclass(frozen=True, eq=False)
class Profile:
    """A line through the plane (z, y), the free side on its left: straight flanks, each joined to the next by an arc.

    A point is nearest to a flank within the strip across it, to an arc within its wedge. Arcs of radius zero are lips,
    to which points of the free side are nearest, and sharp corners, to which only points behind the wall are.

    Args:
        start: First point of each flank, shape (m, 2) [m]; the first flank comes from infinity.
        along: Unit vectors, shape (m, 2).
        length: Shape (m,) [m]; the last flank goes on to infinity.
        centre: Of the arc behind each flank but the last, shape (m − 1, 2) [m].
        radius: Likewise [m]; where it is not zero, the centre is on the free side.
    """

    start: Array
    along: Array
    length: Array
    centre: Array
    radius: Array

    @classmethod
    def through(cls, points: Array, fillet: float) -> Profile:
        """The profile of a polyline.

        Args:
            points: Its points, shape (n, 2) [m].
            fillet: Radius of re-entrant corners [m].

        Returns:
            Flanks and arcs.

        Raises:
            SceneError: Points that coincide, a line that meets itself, a fillet that has no room.
        """
        points, numbers = corners(points)
        edges = np.diff(points, axis=0)
        size = np.hypot(edges[:, 0], edges[:, 1])
        along = edges / size[:, None]
        refuse_crossings(points[:-1], along, size, numbers)
        turn = np.arctan2(cross(along[:-1], along[1:]), dot(along[:-1], along[1:]))
        # Length that the arc in a corner takes from both flanks, by its radius.
        tangent = np.where(turn > 0.0, np.tan(0.5 * turn), 0.0)
        behind, before = np.append(0.0, tangent), np.append(tangent, 0.0)
        slack = ROUND_OFF * max(fillet, np.abs(points).max())
        length = size - fillet * (behind + before)
        if (length[1:-1] < -slack).any():
            _refuse_short(size, behind + before, numbers, fillet)
        # What arcs leave no more of than rounding would give the points above it no curvature.
        length[1:-1][length[1:-1] <= slack] = 0.0
        radius = np.where(turn > 0.0, fillet, 0.0)
        centre = points[1:-1] - fillet * tangent[:, None] * along[:-1] + radius[:, None] * _left(along[:-1])
        profile = cls(points[:-1] + fillet * behind[:, None] * along, along, length, centre, radius)
        (narrow,) = np.nonzero(profile.nearest(centre).distance < radius - slack)
        if len(narrow):
            message = f"must leave room at point {numbers[narrow[0] + 1]} of the profile, got {fillet!r} m"
            raise SceneError(message, field="Groove.fillet")
        return profile

    def nearest(self, p: Array) -> Nearest:
        """Signed distance of points: that of the nearest piece.

        Args:
            p: Shape (n, 2) [m].

        Returns:
            Distances, normals and curvatures.
        """
        left, n_arcs = _left(self.along), len(self.centre)
        upward = left[:-1] + left[1:]
        (d_z, d_y), (e_z, e_y) = _apart(p, self.start), _apart(p, self.centre)
        (t_z, t_y), (u_z, u_y) = self.along.T[:, :, None], upward.T[:, :, None]
        # Rows are pieces, columns points: loops over points are the long ones.
        s, h = t_z * d_z + t_y * d_y, t_z * d_y - t_y * d_z
        behind, beyond = s < 0.0, s > self.length[:, None]
        behind[0], beyond[-1], behind[1:-1][self.length[1:-1] == 0.0] = False, False, True
        # Strips and wedges ask the same s, so that no rounding leaves a point without a piece.
        elsewhere = np.vstack([(s[:-1] < self.length[:-1, None]) | (s[1:] > 0.0), behind | beyond])
        ρ, side = np.hypot(e_z, e_y), np.where(u_z * e_z + u_y * e_y < 0.0, -1.0, 1.0)
        φ = np.vstack([self.radius[:, None] + side * ρ, h])
        best, point = np.argmin(np.where(elsewhere, np.inf, np.abs(φ)), axis=0), np.arange(len(p))
        normal, curvature = left[np.maximum(best - n_arcs, 0)], np.zeros(len(p))
        (round_,) = np.nonzero(best < n_arcs)
        k, away = best[round_], (best[round_], round_)
        # Closer to a lip or a centre than rounding, every direction is as good.
        close = ρ[away] <= ROUND_OFF * np.abs(self.start).max()
        bend = np.where(close, 0.0, side[away] / np.where(close, 1.0, ρ[away]))
        middle = upward[k] / np.hypot(upward[k, 0], upward[k, 1])[:, None]
        outward = bend[:, None] * np.stack([e_z[away], e_y[away]], axis=1)
        normal[round_], curvature[round_] = np.where(close[:, None], middle, outward), bend
        return Nearest(φ[best, point], normal, curvature)


def _refuse_short(size: Array, taken: Array, numbers: NDArray[np.intp], fillet: float) -> NoReturn:
    """A flank between two others is too short for the arcs at its ends, which take so much of it by their radius.

    Raises:
        SceneError: Always.
    """
    most = size[1:-1] / np.maximum(taken[1:-1], ROUND_OFF)
    k = int(np.argmin(most))
    where = f"the flank from point {numbers[k + 1]} to {numbers[k + 2]} of the profile"
    raise SceneError(f"must be at most {most[k]:.6g} m for {where}, got {fillet!r} m", field="Groove.fillet")


def _apart(p: Array, q: Array) -> tuple[Array, Array]:
    """Components of p − q for each q (rows) and each p (columns)."""
    return p[:, 0] - q[:, :1], p[:, 1] - q[:, 1:]


def _left(a: Array) -> Array:
    """Vectors turned left by a right angle, shape (n, 2)."""
    return np.stack([-a[:, 1], a[:, 0]], axis=1)
