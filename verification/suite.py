"""Everything that is verified, as one record."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from dolfinrod.result import NotConverged
from dolfinrod.scene import Planar, Spatial
from verification.case import UPRIGHT
from verification.cases import CASES, bend45, elastica, follower, heavy, rollup
from verification.checks import Check, error_checks, order_checks
from verification.crosscheck import CrossCheck, crosschecks
from verification.machine import Machine, this_machine
from verification.models import Continuum, Discrete
from verification.onestep import OneStep, one_step
from verification.references import Reference
from verification.speed import Speed, speeds
from verification.workprecision import Study, study

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from verification.case import Array, Case, Vector
    from verification.models import Model

__all__ = ["STANDARD", "Report", "Shape", "run"]

BOTH = (Planar(), Spatial())
# Elements on which every case is shown; of the continuum model a turn.
STANDARD = {"continuum": 8, "discrete": 80}
# Families whose error is drawn over time.
TIMED = ("elastica", "bend45")


@dataclass(frozen=True)
class Shape:
    """A deformed centreline to draw.

    Args:
        case: Name of the case.
        family: Of the case.
        model: That found it, or "stress free".
        points: Shape (n, 3) [m].
        tip: Where its end should be [m].
    """

    case: str
    family: str
    model: str
    points: Array
    tip: Vector


@dataclass(frozen=True)
class Report:
    """All that was found.

    Args:
        machine: On which.
        quick: Whether few meshes, degrees and repetitions were asked for.
        checks: Errors and orders against limits.
        one_step: Whole loads at once.
        speeds: Times against limits.
        headlines: One case a family, every degree, many meshes.
        cases: Every case with degrees 3 and, unless quick, 4 and the discrete model, up to the standard mesh.
        crosschecks: Both models against each other.
        references: Provenance by title of the case.
        shapes: To draw.
    """

    machine: Machine
    quick: bool
    checks: tuple[Check, ...]
    one_step: tuple[OneStep, ...]
    speeds: tuple[Speed, ...]
    headlines: tuple[Study, ...]
    cases: tuple[Study, ...]
    crosschecks: tuple[CrossCheck, ...]
    references: dict[str, Reference]
    shapes: tuple[Shape, ...] = field(default=(), repr=False)

    def compile_ms(self, model: str) -> float | None:
        """What a model spent on making or loading its forms when it was first used [ms]."""
        timings = [r.timing for s in (*self.headlines, *self.cases) if s.model == model for r in s.records]
        return max((t.compile for t in timings if t is not None), default=None)

    @property
    def missed(self) -> tuple[Check | OneStep | CrossCheck, ...]:
        """Numbers beyond their limits, of those that do not depend on the machine."""
        missed: list[Check | OneStep | CrossCheck] = [row for row in self.checks if not row.holds]
        missed += [row for row in self.one_step if not row.holds]
        missed += [row for row in self.crosschecks if not row.holds]
        return tuple(missed)


def run(*, quick: bool = False, note: Callable[[str], None] = lambda _: None) -> Report:
    """Solve everything.

    Args:
        quick: Fewer meshes, degrees and repetitions; every limit is still checked.
        note: Told what is being solved.

    Returns:
        The report.
    """
    machine = this_machine()
    headlines = tuple(_headlines(quick, note))
    cases = tuple(_all_cases(quick, note))
    return Report(
        machine=machine,
        quick=quick,
        checks=(*error_checks(note), *order_checks(headlines)),
        one_step=one_step(note),
        speeds=speeds(5 if quick else 25, note),
        headlines=headlines,
        cases=cases,
        crosschecks=crosschecks(quick=quick, note=note),
        references={case.title: case.reference for case in CASES},
        shapes=tuple(_shapes(note)),
    )


def _headlines(quick: bool, note: Callable[[str], None]) -> Iterator[Study]:
    """One case a family, by every degree and both forms of the discrete model."""
    meshes = (4, 8, 16) if quick else (2, 4, 8, 16, 32)
    chain = (20, 40, 80) if quick else (10, 20, 40, 80, 160)
    repeats = 2 if quick else 5
    chosen = (
        elastica.inextensible(10.0),
        follower.inextensible(10.0),
        heavy.inextensible(10.0),
        rollup.rolled(0.5),
        bend45.bend(600.0, kirchhoff=True),
    )
    for case in chosen:
        for model in _applicable(case, range(1, 6), ("chord", "paper")):
            note(f"{case.title}: {model.name}")
            cells = chain if model.family == "discrete" else meshes
            yield study(case, model, cells, repeats=repeats if case.family in TIMED else 0)


def _all_cases(quick: bool, note: Callable[[str], None]) -> Iterator[Study]:
    """Every case on three meshes; a roll-up has as many elements a turn as another case has in all."""
    for case in CASES:
        note(f"every case: {case.title}")
        for model in _applicable(case, (3,) if quick else (3, 4), ("chord",)):
            coarse = 20 if model.family == "discrete" else 4 * case.turns
            standard = STANDARD[model.family] * (1 if model.family == "discrete" else case.turns)
            yield study(case, model, (coarse, 2 * coarse, 4 * coarse), repeats=1 if quick else 5, timed=(standard,))


def _applicable(case: Case, degrees: Iterable[int], axial: Iterable[str]) -> list[Model]:
    """Models that pose a case."""
    models: list[Model] = [Continuum(k, kinematics) for kinematics in BOTH for k in degrees]
    models += [Discrete(form) for form in axial]
    return [model for model in models if model.applies_to(case)]


def _shapes(note: Callable[[str], None]) -> Iterator[Shape]:
    """Deformed shapes by both models, and what they started from."""
    note("deformed shapes")
    drawn = [case for case in CASES if "discrete" in case.models]
    for case in drawn:
        yield from _shapes_of(case)


def _shapes_of(case: Case) -> Iterator[Shape]:
    kinematics = Planar() if case.planar else Spatial()
    for model, elements in ((Continuum(5, kinematics), 16), (Discrete(), 40)):
        try:
            rod = model.solve(case.scene(UPRIGHT), elements * case.turns).rods[0]
        except NotConverged:
            continue
        if model.family == "continuum":
            yield Shape(case.name, case.family, "stress free", rod.r[0], case.reference.value)
        yield Shape(case.name, case.family, model.family, rod.r[-1], case.reference.value)
