"""A cross-section cut at its re-entrant corners: parts that have one normal each wherever rods may be."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import inf, pi

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.errors import SceneError
from dolfinrod.scene.surfaces.polyline import ROUND_OFF, Points, corners, cross, dot

__all__ = ["parts", "reentrant"]

Array = NDArray[np.float64]
DOWN = np.array([0.0, -1.0])


def reentrant(polyline: Array) -> tuple[int, ...]:
    """Numbers of the points in which a cross-section turns to its left, the free side: its re-entrant corners."""
    points, numbers = corners(polyline)
    edges = np.diff(points, axis=0)
    return tuple(numbers[1:-1][cross(edges[:-1], edges[1:]) > 0.0].tolist())


def parts(polyline: Array, roller: float | None) -> tuple[Points, ...]:
    """Polylines from one re-entrant corner to the next, whose end flanks go on without end behind their neighbours.

    All of them stay within the wall. So what is free of every part is what is free of the whole, and the least of their
    distances there is its own. A flank that would come out of the wall again, or fall to the axis of a roller, goes at
    most half the way there and then down along y.

    Args:
        polyline: That of a groove, shape (n, 2) [m].
        roller: Radius of the roller; None: the groove is straight [m].

    Returns:
        The parts, from the left to the right.

    Raises:
        SceneError: A part that cannot be continued so.
    """
    outline, cut, points = Outline.of(polyline, roller), reentrant(polyline), _listed(polyline)
    found = []
    for a, b in pairwise((0, *cut, len(points) - 1)):
        part = points[a : b + 1]
        before = outline.behind(part[0], part[1], -1.0) if a in cut else ()
        beyond = outline.behind(part[-1], part[-2], 1.0) if b in cut else ()
        whole = None if before is None or beyond is None else (*reversed(before), *part, *beyond)
        if whole is None or not _bulges(whole):
            message = (
                f"must have faces that stay in the wall where they go on straight: that from point {a} to {b} does not."
                " Give it a fillet, or a Groove for each of its parts"
            )
            raise SceneError(message, field="Groove.profile")
        found.append(whole)
    return tuple(found)


@dataclass(frozen=True, eq=False)
class Outline:
    """All flanks of a cross-section, by the points they begin and end at.

    Args:
        start: First point of each, shape (m, 2) [m].
        along: Unit vectors, shape (m, 2).
        first: Arc length from there at which each begins, −∞ for the first flank, shape (m,) [m].
        last: Likewise where it ends, ∞ for the last.
        axis: y of the axis of the roller, −∞ where there is none [m].
        size: Largest distance of its points along z or y [m].
    """

    start: Array
    along: Array
    first: Array
    last: Array
    axis: float
    size: float

    @classmethod
    def of(cls, polyline: Array, roller: float | None) -> Outline:
        """The flanks between the corners of a polyline."""
        points, _ = corners(polyline)
        edges = np.diff(points, axis=0)
        last = np.hypot(edges[:, 0], edges[:, 1])
        along, first = edges / last[:, None], np.zeros(len(last))
        first[0], last[-1] = -inf, inf
        size = float(np.ptp(points, axis=0).max())
        return cls(points[:-1], along, first, last, -inf if roller is None else -roller, size)

    def behind(self, corner: tuple[float, float], beside: tuple[float, float], way: float) -> Points | None:
        """How a flank goes on behind a corner.

        Args:
            corner: Where it ends.
            beside: Its other end.
            way: Along the profile 1, against it −1.

        Returns:
            Points in which it bends, none where it goes on straight; None where it comes out of the wall in spite.
        """
        x = np.asarray(corner)
        u = (x - np.asarray(beside)) / np.hypot(*(x - np.asarray(beside)))
        # A flank that falls upright or leaning back is nearer to what is beside it than its mirror image is.
        falls = u[1] < 0.0 and way * u[0] > 0.0
        end = min(self._out(x, u), x[1] - self.axis if falls else inf)
        if end == inf:
            return ()
        knee = x + min(0.5 * end, self.size) * u
        room = knee[1] - self.axis
        if self._out(knee, DOWN) < room:
            return None
        foot = knee + min(0.5 * room, self.size) * DOWN
        return _listed(np.stack([knee, foot]))

    def _out(self, x: Array, u: Array) -> float:
        """Way from a place within the wall, or in a corner of it, in a direction until the wall ends there [m]."""
        apart, sine = self.start - x, cross(u, self.along)
        # Flanks that meet in the corner itself leave it to the free side.
        here = (apart == 0.0).all(axis=1)
        aslant = (np.abs(sine) > ROUND_OFF) & ~here & ~np.roll(here, -1)
        divisor = np.where(aslant, sine, 1.0)
        t, s = cross(apart, self.along) / divisor, cross(apart, u) / divisor
        slack = ROUND_OFF * np.abs(self.start).max()
        on = aslant & (s >= self.first - slack) & (s <= self.last + slack)
        # A flank along the way is met where it begins.
        level = np.abs(cross(u, apart)) <= slack
        ways = np.concatenate([t[on], dot(apart[level], u)])
        return float(min(ways[ways > 0.0], default=inf))


def _bulges(part: Points) -> bool:
    """Whether a part turns to its right only, by half a turn at most, so that its flanks never meet again."""
    edges = np.diff(np.asarray(part), axis=0)
    turn = np.arctan2(cross(edges[:-1], edges[1:]), dot(edges[:-1], edges[1:]))
    return bool((turn <= ROUND_OFF).all() and turn.sum() >= -pi * (1.0 + ROUND_OFF))


def _listed(polyline: Array) -> Points:
    """Its points as pairs of numbers."""
    return tuple((float(z), float(y)) for z, y in polyline)
