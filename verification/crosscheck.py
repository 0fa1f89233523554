"""Both models against each other: their difference is the discretisation error of the coarser one, and nothing else.

No reference enters. Each model's error is estimated from its own refinement by Richardson's extrapolation: of order p,
the error of the coarser of two meshes is |u_n − u_2n| / (1 − 2^−p), that of the finer |u_n − u_2n| / (2^p − 1).
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from verification.workprecision import Record, Study

__all__ = ["BAND", "CrossCheck", "compare", "crosschecks"]

# What the difference may be of the estimate.
BAND = (0.9, 1.1)
# Relative difference that round-off leaves on meshes of hundreds of elements.
ROUND_OFF = 1e-9


@dataclass(frozen=True)
class CrossCheck:
    """A case solved by both models.

    Args:
        case: Its name.
        title: Its title.
        elements: Of the discrete model.
        difference: Of the two quantities, relative to the length.
        discrete_error: Estimated from its refinement, relative.
        continuum_error: Estimated from its refinement, relative.
        elongation: What the discrete model stretches rods that are rigid in extension, relative.
        failure: Which model did not converge, and why.
    """

    case: str
    title: str
    elements: int
    difference: float
    discrete_error: float
    continuum_error: float
    elongation: float = 0.0
    failure: str | None = None

    @property
    def estimate(self) -> float:
        """By how much the models should differ."""
        return self.discrete_error + self.continuum_error

    @property
    def tolerance(self) -> float:
        """What else may enter: the elongation, and round-off."""
        return self.elongation + ROUND_OFF

    @property
    def holds(self) -> bool:
        """Whether the difference is explained, and the estimate by the difference."""
        low, high = (factor * self.estimate for factor in BAND)
        return self.failure is None and low - self.tolerance <= self.difference <= high + self.tolerance


def crosschecks(studies: Iterable[Study], lengths: dict[str, float]) -> tuple[CrossCheck, ...]:
    """Every case that both models have solved.

    Args:
        studies: Of any case, by any model.
        lengths: Of the cases by name [m].

    Returns:
        Rows of `compare`.
    """
    of_case: dict[str, dict[str, list[Study]]] = {}
    for s in studies:
        if s.model != "discrete paper":
            of_case.setdefault(s.case, {}).setdefault(s.family, []).append(s)
    rows: list[CrossCheck] = []
    for case, families in of_case.items():
        if len(families) == 2:
            # The first of the highest degree is in the smallest kinematics that holds the case.
            best = max(families["continuum"], key=lambda s: s.degree)
            rows += compare(best, families["discrete"][0], lengths[case])
    return tuple(rows)


def compare(continuum: Study, discrete: Study, length: float) -> tuple[CrossCheck, ...]:
    """One case on discrete meshes that double, against the finest of the continuum model's.

    Args:
        continuum: On meshes of which the last is twice the one before.
        discrete: On three meshes or more, each twice the one before.
        length: Of the case [m].

    Returns:
        One row for each discrete mesh but the coarsest, whose error may not yet be of order 2, and the finest.
    """
    failed = next((r for s in (continuum, discrete) for r in s.records if r.failure is not None), None)
    if failed is not None:
        why = f"{failed.model} on {failed.elements} elements: {failed.failure}"
        elements = discrete.records[0].elements
        return (CrossCheck(discrete.case, discrete.title, elements, np.inf, 0.0, 0.0, failure=why),)
    fine, finer = continuum.records[-2:]
    left = distance(fine, finer, length) / (2.0**continuum.tip.theory - 1.0)
    return tuple(
        CrossCheck(
            case=discrete.case,
            title=discrete.title,
            elements=coarse.elements,
            difference=distance(coarse, finer, length),
            discrete_error=distance(coarse, halved, length) / (1.0 - 2.0**-discrete.tip.theory),
            continuum_error=left,
            elongation=coarse.elongation,
        )
        for coarse, halved in pairwise(discrete.records[1:])
    )


def distance(a: Record, b: Record, length: float) -> float:
    """Of the quantities, relative to the length of the case."""
    if a.found is None or b.found is None:
        return float("inf")
    return float(np.linalg.norm(np.subtract(a.found, b.found)) / length)
