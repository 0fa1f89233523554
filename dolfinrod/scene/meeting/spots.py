"""Points at which rods feel others: Gauss points of the intervals of contact, cut where the load has kinks."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.meeting.curves import Course
from dolfinrod.scene.meeting.intervals import intervals
from dolfinrod.scene.meeting.neighbours import Neighbours
from dolfinrod.scene.pressure import NormalLaw, SmoothPenalty

__all__ = ["GAUSS", "MOST_POINTS", "Points", "both", "marks", "points"]

Array = NDArray[np.float64]
Integers = NDArray[np.intp]

# The line load of a crossing is a parabola along a rod, but for its depth against the distance of the centrelines; four
# points integrate its square, the energy, with the first power of that, too.
GAUSS = tuple(0.5 * part for part in np.polynomial.legendre.leggauss(4))
# A law with one kink more than at its foot, in the mean of two loads.
MOST_POINTS = 7 * len(GAUSS[0])


def marks(course: Course, near: Neighbours, law: NormalLaw) -> Array:
    """Where on spans line loads on them begin and end, and where they have kinks.

    Args:
        course: The rods.
        near: Runs of spans near spans.
        law: Of the load.

    Returns:
        Beginnings and ends of what is within one reach after the other, equal where nothing is: shape (k, 2, n_runs).
    """
    reaches = [law.g_0, law.g_0 - law.foot] if isinstance(law, SmoothPenalty) else [law.g_0]
    return np.array([intervals(course, near, reach) for reach in reaches])


def both(marks: Array, others: Array) -> Array:
    """Marks of two loads whose mean acts; where there is but one of them, of that twice."""
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
    none = marks[:, 0] >= marks[:, 1]
    # Where nothing is within a smaller reach, its marks fall together with the first of all.
    first = np.where(none, 1.0, marks[:, 0]).min(axis=0)
    ends = np.sort(np.where(none[:, None], first, marks).reshape(2 * len(marks), marks.shape[2]), axis=0)
    long = np.diff(ends, axis=0).T
    count = len(GAUSS[0]) * long.shape[1]
    place = (ends[:-1].T[:, :, None] + long[:, :, None] * (0.5 + GAUSS[0])).reshape(len(long), count)
    weight = (long[:, :, None] * GAUSS[1]).reshape(len(long), count)
    run, index = np.nonzero(weight > 0.0)
    return Points(run, index, place[run, index], weight[run, index])
