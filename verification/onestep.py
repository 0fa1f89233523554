"""The whole load in one step: Newton iterations, failed attempts included, against the limits of issue 2."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from verification.case import SKEW
from verification.cases import bend45, elastica, follower, rollup
from verification.models import BOTH, Continuum
from verification.workprecision import measure

if TYPE_CHECKING:
    from verification.case import Case

__all__ = ["OneStep", "one_step", "problems"]


@dataclass(frozen=True)
class OneStep:
    """A load taken at once.

    Args:
        case: Its name.
        title: What is loaded, and how much.
        kinematics: "planar" or "spatial"; planar problems lie in a skew plane for both.
        mesh: Such as "8 × P3".
        iterations: Newton iterations in total.
        limit: Most that are allowed.
        steps: Load steps taken: 1, or more where the whole load failed.
        error: Relative error of the tip.
        failure: Why it did not converge.
    """

    case: str
    title: str
    kinematics: str
    mesh: str
    iterations: int
    limit: int
    steps: int
    error: float
    failure: str | None

    @property
    def holds(self) -> bool:
        """One step, few iterations, and the right equilibrium."""
        return self.failure is None and self.steps == 1 and self.iterations <= self.limit and self.error < 1e-2


def problems() -> tuple[tuple[Case, int, int], ...]:
    """Case, elements of degree 3, most iterations."""
    by_slenderness = [(elastica.slender(10.0, r), 8, 8) for r in (20.0, 200.0, 2000.0)]
    heavy = [
        (case, n, 12)
        for alpha, n in ((100.0, 8), (500.0, 8), (5000.0, 16))
        for case in (elastica.slender(alpha, 200.0), elastica.inextensible(alpha))
    ]
    turns = [(rollup.rolled(t), int(8 * t), limit) for t, limit in ((1.0, 12), (2.0, 20), (5.0, 30))]
    return (
        *by_slenderness,
        (elastica.inextensible(10.0), 8, 8),
        *heavy,
        *turns,
        *((follower.inextensible(alpha), 8, 25) for alpha in (10.0, 20.0)),
        (bend45.bend(600.0), 8, 10),
    )


def one_step(case: Case, elements: int, limit: int) -> tuple[OneStep, ...]:
    """The whole load at once, with every kinematics that holds the case.

    Args:
        case: What is loaded.
        elements: Of degree 3.
        limit: Most Newton iterations.

    Returns:
        One row a solve.
    """
    rows = []
    for model in (Continuum(3, kinematics) for kinematics in BOTH):
        if not model.applies_to(case):
            continue
        record = measure(case, model, elements, pose=SKEW)
        rows.append(
            OneStep(
                case=case.name,
                title=case.title,
                kinematics=model.kinematics_name,
                mesh=f"{elements} × P3",
                iterations=record.iterations,
                limit=limit,
                steps=record.steps,
                error=record.error,
                failure=record.failure,
            )
        )
    return tuple(rows)
