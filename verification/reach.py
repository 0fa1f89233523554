"""How soon an error is reached: the quickest run that was measured, never an interpolation."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from verification.workprecision import Record, Study

__all__ = ["TARGETS", "Reach", "reaches"]

TARGETS = (1e-3, 1e-5, 1e-8)


@dataclass(frozen=True)
class Reach:
    """The quickest run of a model that reaches an error.

    Args:
        case: Its name.
        model: "continuum planar", "continuum spatial" or "discrete".
        target: Relative error to be reached.
        seconds: Of its load stepping, warm, on one thread, least of the repetitions; None where no run reached it [s].
        mesh: Of that run, such as "8 × P3".
        error: Of that run; where none reached the target, the least error of any.
    """

    case: str
    model: str
    target: float
    seconds: float | None
    mesh: str
    error: float


def reaches(studies: Iterable[Study]) -> tuple[Reach, ...]:
    """Every case, model and target; of the discrete model its chord form.

    Args:
        studies: With timed records.

    Returns:
        Three rows for each case and model.
    """
    runs: dict[tuple[str, str], list[tuple[Record, str]]] = {}
    for s in studies:
        if s.model == "discrete paper":
            continue
        model = s.family if s.family == "discrete" else f"{s.family} {s.model.rpartition(' ')[2]}"
        runs.setdefault((s.case, model), []).extend((r, mesh(s, r)) for r in s.records)
    return tuple(reach(*key, target, found) for key, found in runs.items() for target in TARGETS)


def reach(case: str, model: str, target: float, runs: Iterable[tuple[Record, str]]) -> Reach:
    """The quickest of some runs, or the most accurate one."""
    known = [(r, m) for r, m in runs if np.isfinite(r.error)]
    there = [(r.timing.solve_min, r.error, m) for r, m in known if r.timing is not None and r.error <= target]
    if there:
        ms, error, m = min(there)
        return Reach(case, model, target, 1e-3 * ms, m, error)
    error, m = min(((r.error, m) for r, m in known), default=(np.nan, "none"))
    return Reach(case, model, target, None, m, error)


def mesh(study: Study, record: Record) -> str:
    """Such as "8 × P3", or a number of discrete elements."""
    return f"{record.elements} × P{study.degree}" if study.family == "continuum" else f"{record.elements}"
