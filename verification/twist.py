"""Measures of twist against references, by polygons of more and more points: exact, or with the order of theory."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import pairwise
from typing import TYPE_CHECKING

from verification.order import Order, order

if TYPE_CHECKING:
    from verification.references.moving import Moving

__all__ = ["EXACT", "TwistCase", "TwistStudy", "twiststudy"]

# What sums of some hundred thousand doubles leave of a measure that points do not change.
EXACT = 1e-12
# By how much an order may fall short of theory between the two finest levels.
SHORT = 0.1


@dataclass(frozen=True)
class TwistCase:
    """A curve, or several, whose measure is known.

    Args:
        name: Short, unique.
        title: For people: what is measured, of what.
        measure: Function of `dolfinrod.twist` that does.
        reference: What it should be.
        read: The measure, by so many points.
        levels: How many points, ascending, each twice the one before.
        theory: Power of the distance of points with which errors fall; None: polygons have the very value.
        unit: Of the value.
        points: What the levels count.
    """

    name: str
    title: str
    measure: str
    reference: Moving
    read: Callable[[int], float] = field(repr=False)
    levels: tuple[int, ...] = (50, 100, 200, 400)
    theory: int | None = None
    unit: str = "turns"
    points: str = "points"


@dataclass(frozen=True)
class TwistStudy:
    """A measure on its levels.

    Args:
        case: Its name.
        title: For people.
        measure: Function that measures.
        provenance: Of the reference.
        reference: What it should be.
        unit: Of it.
        points: What the levels count.
        levels: Numbers of points.
        found: On each.
        errors: Over the size of the reference, or absolute where that is below one.
        order: Between the two finest levels; None where polygons have the very value.
        extrapolated: Error of what is left where the even powers of the distance are taken out; None likewise.
        limit: Of the error on every level where polygons are exact, else of the extrapolated one.
    """

    case: str
    title: str
    measure: str
    provenance: str
    reference: float
    unit: str
    points: str
    levels: tuple[int, ...]
    found: tuple[float, ...]
    errors: tuple[float, ...]
    order: Order | None
    extrapolated: float | None
    limit: float

    @property
    def holds(self) -> bool:
        """Exact on every level; or with the order of theory, and right to the digits trusted when extrapolated."""
        if self.order is None or self.extrapolated is None:
            return max(self.errors) <= self.limit
        enough = self.order.observed is not None and self.order.observed >= self.order.theory - SHORT
        return enough and self.extrapolated <= self.limit


def twiststudy(case: TwistCase) -> TwistStudy:
    """Measure on every level.

    Args:
        case: With its reference.

    Returns:
        The record.
    """
    (value,) = case.reference.value
    size = max(abs(value), 1.0)
    found = tuple(float(case.read(n)) for n in case.levels)
    errors = tuple(abs(v - value) / size for v in found)
    return TwistStudy(
        case=case.name,
        title=case.title,
        measure=case.measure,
        provenance=f"{case.reference.id}: {case.reference.method}; {case.reference.source}",
        reference=value,
        unit=case.unit,
        points=case.points,
        levels=case.levels,
        found=found,
        errors=errors,
        order=None if case.theory is None else order(errors, case.levels, case.theory),
        extrapolated=None if case.theory is None else abs(extrapolated(found) - value) / size,
        limit=EXACT if case.theory is None else max(10.0**-case.reference.digits_trusted, EXACT),
    )


def extrapolated(found: tuple[float, ...]) -> float:
    """The value for points without distance, where errors are even powers of it: Romberg's scheme.

    Args:
        found: On levels, each with twice the points of the one before.

    Returns:
        The value.
    """
    row, factor = list(found), 1.0
    while len(row) > 1:
        factor *= 4.0
        row = [fine + (fine - coarse) / (factor - 1.0) for coarse, fine in pairwise(row)]
    return row[0]
