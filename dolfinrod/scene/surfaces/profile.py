"""The cross-section of a groove: straight flanks that meet at lips and in corners, which may be rounded."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NoReturn

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.errors import SceneError
from dolfinrod.scene.surfaces.nearest import beside_profile
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
        return Nearest(*beside_profile(p, *self.pieces))

    @cached_property
    def pieces(self) -> tuple[Array, Array, Array, Array, Array, float]:
        """Start, directions, lengths of flanks, centres and radii of arcs, and how close to a centre is round-off."""
        close = float(ROUND_OFF * np.abs(self.start).max())
        return self.start, self.along, self.length, self.centre, self.radius, close


def _refuse_short(size: Array, taken: Array, numbers: NDArray[np.intp], fillet: float) -> NoReturn:
    """A flank between two others is too short for the arcs at its ends, which take so much of it by their radius.

    Raises:
        SceneError: Always.
    """
    most = size[1:-1] / np.maximum(taken[1:-1], ROUND_OFF)
    k = int(np.argmin(most))
    where = f"the flank from point {numbers[k + 1]} to {numbers[k + 2]} of the profile"
    raise SceneError(f"must be at most {most[k]:.6g} m for {where}, got {fillet!r} m", field="Groove.fillet")


def _left(a: Array) -> Array:
    """Vectors turned left by a right angle, shape (n, 2)."""
    return np.stack([-a[:, 1], a[:, 0]], axis=1)
