"""Critical loads and natural frequencies against references, and flags that change sign at a critical load."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.result import NotConverged
from dolfinrod.scene import SceneError
from verification.eigencases import CASES
from verification.eigenmodels import EigenContinuum, EigenDiscrete
from verification.order import Order, order

if TYPE_CHECKING:
    from verification.eigencase import Eigencase, EigenModel, Found

__all__ = ["LIMIT", "MODELS", "Bracket", "EigenStudy", "bracket", "eigenstudy", "pairs"]

# Largest relative error of the continuum model on its finest mesh.
LIMIT = 1e-6
# Relative errors below this are round-off of eigenvalue problems and what a search along a path leaves open.
FLOOR = 2e-10
# Error of any mesh beyond which another value was found, a later critical point or one that is none.
ANOTHER = 5e-2
# How far below and above a critical load its bracket lies, relative to it.
BRACKET = 5e-3
# How far an observed order may fall short of theory.
SLACK = 0.5


MODELS: tuple[EigenModel, ...] = (EigenContinuum(), EigenDiscrete())


@dataclass(frozen=True)
class EigenStudy:
    """A critical load or frequency by one model on meshes from coarse to fine.

    Args:
        case: Its name.
        title: For people.
        family: Of the case.
        quantity: What the values are.
        model: Name of the model.
        reference: What the values should be.
        provenance: Where that comes from.
        meshes: Numbers of elements.
        found: Values, NaN where none was found.
        errors: Relative ones.
        order: Of the values.
        multiplicity: On the finest mesh.
        expected: What it should be.
        limit: Largest error allowed on the finest mesh; None where only the order is asked for.
        ms: Time of the finest mesh [ms].
        failure: Why a mesh has no value.
        note: Of the case.
    """

    case: str
    title: str
    family: str
    quantity: str
    model: str
    reference: float
    provenance: str
    meshes: tuple[int, ...]
    found: tuple[float, ...]
    errors: tuple[float, ...]
    order: Order
    multiplicity: int
    expected: int
    limit: float | None
    ms: float
    failure: str | None
    note: str

    @property
    def holds(self) -> bool:
        """Right value, right multiplicity, and the order of theory wherever round-off shows one."""
        if self.failure is not None or self.multiplicity != self.expected or max(self.errors) > ANOTHER:
            return False
        if self.limit is not None:
            return self.errors[-1] <= self.limit
        return self.order.observed is None or self.order.observed >= self.order.theory - SLACK


def pairs() -> tuple[tuple[Eigencase, EigenModel], ...]:
    """Every case with every model that poses it."""
    return tuple((case, model) for case in CASES for model in MODELS if model.family in case.models)


def eigenstudy(case: Eigencase, model: EigenModel, meshes: tuple[int, ...] | None = None) -> EigenStudy:
    """Find a value on one mesh after the other.

    Args:
        case: With its reference.
        model: That poses it.
        meshes: Numbers of elements; None: the model's own, finer where the case asks for it.

    Returns:
        The record, also of what was not found.
    """
    cells = meshes or tuple(round(case.finer * n) for n in model.meshes)
    found, multiplicity, failure, ms = [], 0, None, np.nan
    for n in cells:
        started = time.perf_counter()
        one, reason = _found(case, model, n)
        ms = 1e3 * (time.perf_counter() - started)
        found.append(np.nan if one is None else one.value)
        multiplicity = multiplicity if one is None else one.multiplicity
        failure = reason or failure
    errors = [abs(value / case.reference.value - 1.0) for value in found]
    return EigenStudy(
        case=case.name,
        title=case.title,
        family=case.family,
        quantity=case.quantity,
        model=model.name,
        reference=case.reference.value,
        provenance=f"{case.reference.id}; {case.reference.method}; {case.reference.source}",
        meshes=cells,
        found=tuple(found),
        errors=tuple(errors),
        order=order(errors, cells, model.order, FLOOR),
        multiplicity=multiplicity,
        expected=case.multiplicity,
        limit=LIMIT if model.family == "continuum" else None,
        ms=ms,
        failure=failure,
        note=case.note,
    )


def _found(case: Eigencase, model: EigenModel, n: int) -> tuple[Found | None, str | None]:
    """What one mesh gives, and why it gives nothing."""
    try:
        one = case.analysis.find(model, case, n)
    except (NotConverged, SceneError) as refused:
        return None, f"{n} elements: {refused}"
    return one, None if np.isfinite(one.value) else f"{n} elements: no critical point found"


@dataclass(frozen=True)
class Bracket:
    """Verdicts just below and just above a critical load.

    Args:
        case: Its name.
        title: For people.
        model: Name of the model.
        below: Load of the first, relative to the critical one.
        above: Of the second.
        stable: Verdicts at the two; None where not judged.
        directions: Unstable directions at the two; None where not counted.
        expected: Directions lost at the critical load.
        failure: Why a load has no verdict.
    """

    case: str
    title: str
    model: str
    below: float
    above: float
    stable: tuple[bool | None, bool | None]
    directions: tuple[int | None, int | None]
    expected: int
    failure: str | None

    @property
    def holds(self) -> bool:
        """Stable below, unstable above, in as many directions as the critical load has modes."""
        counted = self.directions[1] in (None, self.expected)
        return self.failure is None and self.stable == (True, False) and counted


def bracket(case: Eigencase, model: EigenModel) -> Bracket:
    """Law: a critical load lies between a stable and an unstable equilibrium.

    Args:
        case: With a critical load.
        model: That poses it.

    Returns:
        The verdicts on the middle one of the model's meshes.
    """
    stable: list[bool | None] = []
    directions: list[int | None] = []
    failure = None
    for side in (-1.0, 1.0):
        try:
            log = model.solve(
                case.scene((1.0 + side * BRACKET) * case.reference.value), round(case.finer * model.meshes[1])
            ).log
        except (NotConverged, SceneError) as refused:
            failure = str(refused)
            stable.append(None)
            directions.append(None)
        else:
            stable.append(log[-1].stable)
            directions.append(log[-1].unstable_directions)
    return Bracket(
        case=case.name,
        title=case.title,
        model=model.name,
        below=1.0 - BRACKET,
        above=1.0 + BRACKET,
        stable=(stable[0], stable[1]),
        directions=(directions[0], directions[1]),
        expected=case.multiplicity,
        failure=failure,
    )
