"""Both models against each other: their difference is the discretisation error of the coarser one, and nothing else.

No reference enters. The error of the discrete model is estimated from its own refinement,
|u_n − u_2n|·4/3 for order 2, that of the continuum model from its own degrees.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.result import NotConverged
from verification.case import UPRIGHT
from verification.cases import bend45, elastica, follower, heavy, rollup
from verification.models import Continuum, Discrete

if TYPE_CHECKING:
    from collections.abc import Callable

    from verification.case import Array, Case
    from verification.models import Model

__all__ = ["CrossCheck", "compare", "crosschecks"]

# The discrete model has EA = 1e8·EI/L² where the scene says inextensible: up to P/EA of difference is its own.
STAND_IN = 1e-6
# By which the estimate may miss an error whose order is not yet 2.
SLACK = 1.25


@dataclass(frozen=True)
class CrossCheck:
    """A case solved by both models.

    Args:
        title: Of the case.
        elements: Of the discrete model.
        difference: Of the two tips, relative to the length.
        discrete_error: Estimated from refinement.
        continuum_error: Estimated from two degrees.
        failure: Which model did not converge, and why.
    """

    title: str
    elements: int
    difference: float
    discrete_error: float
    continuum_error: float
    failure: str | None = None

    @property
    def holds(self) -> bool:
        """Whether the difference is explained."""
        return self.difference <= SLACK * (self.discrete_error + self.continuum_error) + STAND_IN


def crosschecks(*, quick: bool = False, note: Callable[[str], None] = lambda _: None) -> tuple[CrossCheck, ...]:
    """The cases both models pose, on growing numbers of elements."""
    cases = (
        elastica.inextensible(1.0),
        elastica.inextensible(10.0),
        follower.inextensible(20.0),
        heavy.inextensible(20.0),
        rollup.rolled(0.5),
        rollup.rolled(2.0),
        bend45.bend(600.0, kirchhoff=True),
    )
    rows: list[CrossCheck] = []
    for case in cases:
        note(f"both models: {case.title}")
        rows += compare(case, (40, 80) if quick else (20, 40, 80, 160))
    return tuple(rows)


def compare(case: Case, meshes: tuple[int, ...]) -> list[CrossCheck]:
    """One case on meshes that double.

    Args:
        case: Posed by both models.
        meshes: Discrete elements, each twice the one before.

    Returns:
        One row for each mesh but the finest.
    """
    try:
        fine, finer = (tip(case, Continuum(k), 16) for k in (4, 5))
        tips = [tip(case, Discrete(), n) for n in meshes]
    except NotConverged as failed:
        return [CrossCheck(case.title, meshes[0], np.inf, 0.0, 0.0, failed.reason)]
    return [
        CrossCheck(
            title=case.title,
            elements=n,
            difference=distance(coarse, finer, case),
            discrete_error=4.0 / 3.0 * distance(coarse, halved, case),
            continuum_error=distance(fine, finer, case),
        )
        for n, coarse, halved in zip(meshes[:-1], tips[:-1], tips[1:], strict=True)
    ]


def tip(case: Case, model: Model, elements: int) -> Array:
    """Quantity of a case by a model."""
    return case.quantity(model.solve(case.scene(UPRIGHT), elements))


def distance(a: Array, b: Array, case: Case) -> float:
    """Relative to the length of the case."""
    return float(np.linalg.norm(a - b) / case.length)
