"""Points at which rods feel others: Gauss points of the intervals of contact, cut where the load has kinks."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.compiled import compiled
from dolfinrod.scene.meeting.curves import Course
from dolfinrod.scene.meeting.intervals import MOST, intervals
from dolfinrod.scene.meeting.neighbours import Neighbours
from dolfinrod.scene.normallaw import NormalLaw
from dolfinrod.scene.pressure import SmoothPenalty

__all__ = ["GAUSS", "MOST_POINTS", "Points", "both", "marks", "points"]

Array = NDArray[np.float64]
Integers = NDArray[np.intp]

# The line load of a crossing is a parabola along a rod, but for its depth against the distance of the centrelines; four
# points integrate its square, the energy, with the first power of that, too.
GAUSS = 0.5 + 0.5 * np.polynomial.legendre.leggauss(4)[0], 0.5 * np.polynomial.legendre.leggauss(4)[1]
# As many intervals of a law with one kink more than at its foot, in the mean of two loads.
MOST_POINTS = (2 * 2 * 2 * 2 * MOST - 1) * len(GAUSS[0])


def marks(course: Course, near: Neighbours, law: NormalLaw) -> Array:
    """Where on spans line loads on them begin and end, and where they have kinks.

    Args:
        course: The rods.
        near: Runs of spans near spans.
        law: Of the load.

    Returns:
        Beginnings and ends of what is within one reach after the other, equal where nothing is: shape
        (k, 2, n_runs).
    """
    reaches = [law.g_0, law.g_0 - law.foot] if isinstance(law, SmoothPenalty) else [law.g_0]
    return np.concatenate([np.stack(intervals(course, near, reach), axis=1) for reach in reaches])


def both(marks: Array, others: Array) -> Array:
    """Marks of two loads whose mean acts; where there is but one of an interval, of that twice."""
    one, two = marks[:, 0] < marks[:, 1], others[:, 0] < others[:, 1]
    return np.concatenate([np.where(one[:, None], marks, others), np.where(two[:, None], others, marks)])


@dataclass(frozen=True, eq=False)
class Points:
    """Gauss points of intervals.

    Args:
        run: Whose, shape (n,).
        index: Number of the point in its spot.
        u: Place on the span.
        weight: Part of the span for which it stands.
    """

    run: Integers
    index: Integers
    u: Array
    weight: Array


def points(marks: Array) -> Points:
    """Gauss points between each two neighbouring marks.

    Args:
        marks: As `marks` and `both` give them, shape (k, 2, n_runs).

    Returns:
        Those with weight, run by run.
    """
    return Points(*_points(marks, *GAUSS))


@compiled
def _points(marks: Array, places: Array, weights: Array) -> tuple[Integers, Integers, Array, Array]:
    """As `Points`, with places and weights from 0 to 1."""
    kinds, n_runs = len(marks), marks.shape[2]
    most = n_runs * (2 * kinds - 1) * len(places)
    run, index, u, weight = np.empty(most, np.intp), np.empty(most, np.intp), np.empty(most), np.empty(most)
    n, ends = 0, np.empty(2 * kinds)
    for r in range(n_runs):
        first, some = 1.0, 0
        for k in range(kinds):
            if marks[k, 0, r] < marks[k, 1, r]:
                first, some = min(first, marks[k, 0, r]), some + 1
        # Where nothing is within a smaller reach, its marks fall together with the first of all.
        ends[:] = first
        for k in range(kinds):
            if marks[k, 0, r] < marks[k, 1, r]:
                ends[2 * k], ends[2 * k + 1] = marks[k, 0, r], marks[k, 1, r]
        if some > 1:
            ends.sort()
        for k in range(2 * kinds - 1):
            long = ends[k + 1] - ends[k]
            for g in range(len(places)):
                if long * weights[g] > 0.0:
                    run[n], index[n] = r, k * len(places) + g
                    u[n], weight[n] = ends[k] + long * places[g], long * weights[g]
                    n += 1
    return run[:n], index[:n], u[:n], weight[:n]
