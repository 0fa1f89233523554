"""Laws that hold whatever the numbers are, asked of both models."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from verification.lawscenes import MIRRORED, MOVED
from verification.models import BOTH, Continuum, Discrete
from verification.violations import (
    energy,
    forces,
    in_space,
    kinematics,
    moments,
    moved_by,
    plane,
    rest,
    steps,
    units,
    unloading,
)

if TYPE_CHECKING:
    from verification.models import Model

__all__ = ["LAWS", "MODELS", "Law", "LawRow", "measured"]

# Asserts every row; more inputs are tried on the continuum model elsewhere.
TEST = "verification/test_laws.py::test_every_law_holds"
MODELS: tuple[Model, ...] = (*(Continuum(3, kinematics) for kinematics in BOTH), Discrete())


@dataclass(frozen=True)
class Law:
    """What must hold.

    Args:
        name: Short, unique.
        title: In words.
        statement: What is compared.
        bound: Largest violation allowed, relative.
        test: File below `tests` and test that assert it of the continuum model, on more inputs where it is not `TEST`.
        violation: Of a model.
        holds_for: Whether a model can be asked.
    """

    name: str
    title: str
    statement: str
    bound: float
    test: str
    violation: Callable[[Model], float]
    holds_for: Callable[[Model], bool] = lambda _: True


@dataclass(frozen=True)
class LawRow:
    """A law asked of a model.

    Args:
        name: Of the law.
        title: Of the law.
        statement: What is compared.
        test: File below `tests` and test that assert it.
        model: Its name.
        found: Largest violation.
        bound: What it must not exceed.
    """

    name: str
    title: str
    statement: str
    test: str
    model: str
    found: float
    bound: float

    @property
    def holds(self) -> bool:
        """Whether the violation is within its bound; NaN is not."""
        return self.found <= self.bound


def measured(law: Law, model: Model) -> LawRow:
    """Ask a model.

    Args:
        law: Which holds for it.
        model: That solves.

    Returns:
        The row.
    """
    test = law.test if model.family == "continuum" else TEST
    return LawRow(law.name, law.title, law.statement, test, model.name, law.violation(model), law.bound)


INVARIANCE = "continuum/test_invariance.py::test_"
LAWS = (
    Law(
        "objectivity",
        "Objectivity",
        "the answer of a scene turned and shifted in space against the turned and shifted answer",
        1e-10,
        f"{INVARIANCE}rigid_motion_of_a_spatial_scene_moves_the_answer",
        moved_by(MOVED),
    ),
    Law(
        "mirror",
        "Mirror symmetry",
        "the answer of a scene mirrored at a skew plane, moments as axial vectors, against the mirrored answer",
        1e-10,
        TEST,
        moved_by(MIRRORED),
    ),
    Law(
        "steps",
        "Path independence",
        steps.__doc__ or "",
        1e-10,
        f"{INVARIANCE}number_of_load_steps_does_not_matter",
        steps,
    ),
    Law(
        "unloading",
        "Reversibility",
        unloading.__doc__ or "",
        1e-10,
        f"{INVARIANCE}unloading_leads_back_to_the_start",
        unloading,
    ),
    Law(
        "forces",
        "Balance of forces",
        forces.__doc__ or "",
        1e-10,
        "continuum/test_balance.py::test_forces_balance",
        forces,
    ),
    Law(
        "moments",
        "Balance of moments",
        moments.__doc__ or "",
        1e-10,
        "continuum/test_balance.py::test_moments_balance",
        moments,
    ),
    Law(
        "kinematics",
        "Planar = spatial",
        kinematics.__doc__ or "",
        1e-10,
        "continuum/test_planar_spatial.py::test_difference_falls_at_the_order_of_the_element",
        kinematics,
        lambda model: model.family == "continuum" and in_space(model),
    ),
    Law(
        "plane",
        "Planes are kept",
        plane.__doc__ or "",
        1e-12,
        TEST,
        plane,
        in_space,
    ),
    Law("rest", "Stress free at rest", rest.__doc__ or "", 1e-11, f"{INVARIANCE}zero_load_does_not_drift", rest),
    Law(
        "energy",
        "Energy = work",
        energy.__doc__ or "",
        1e-7,
        "continuum/test_balance.py::test_strain_energy_is_the_work_of_a_dead_load",
        energy,
    ),
    Law("units", "Units do not matter", units.__doc__ or "", 1e-10, f"{INVARIANCE}units_do_not_matter", units),
)
