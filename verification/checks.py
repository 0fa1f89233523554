"""Numbers that must hold on any machine: errors, orders and digits. Times are never among them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from verification.cases import CASES, bend45, elastica, rollup
from verification.models import BOTH, Continuum
from verification.workprecision import measure

if TYPE_CHECKING:
    from verification.case import Case
    from verification.order import Order
    from verification.workprecision import Study

__all__ = ["DIGITS", "ORDER_SLACK", "Check", "digit_checks", "error_checks", "limits", "order_checks"]

# What an observed order may fall short of theory on meshes of 4 to 32 elements.
ORDER_SLACK = 0.3
# Relative error that every case shall reach, or show the order that leads there.
DIGITS = 1e-8


@dataclass(frozen=True)
class Check:
    """A number and its limit.

    Args:
        case: Its name.
        title: Of the case.
        model: That found it.
        mesh: Such as "8 × P3".
        quantity: What the number is.
        found: The number; None where it could not be found.
        limit: What it must not exceed, or, for an order, not fall short of.
        holds: Whether it does.
        why: What explains a number beyond its limit, if the case says so; such a check is no miss.
    """

    case: str
    title: str
    model: str
    mesh: str
    quantity: str
    found: float | None
    limit: float
    holds: bool
    why: str = ""

    @property
    def missed(self) -> bool:
        """Whether it neither holds nor is explained."""
        return not (self.holds or self.why)


def limits() -> tuple[tuple[Case, int, int, float], ...]:
    """Case, elements, degree, largest relative error of the tip."""
    tens = (elastica.inextensible(10.0), elastica.isotropic(10.0), elastica.shearable(10.0))
    turns = ((rollup.rolled(t), int(8 * t)) for t in (0.5, 1.0, 2.0, 5.0))
    return (
        *((case, n, k, e) for case in tens for n, k, e in ((8, 3, 2e-7), (4, 5, 1e-8), (8, 4, 1e-8))),
        *((case, n, 3, 1e-7) for case, n in turns),
        *((case, 8, k, e) for case in bend45.CASES if "600" in case.name for k, e in ((3, 3e-8), (4, 1e-10))),
    )


def error_checks(case: Case, elements: int, degree: int, limit: float) -> tuple[Check, ...]:
    """An error against its limit, with every kinematics that holds the case.

    Args:
        case: What is solved.
        elements: Of the rod.
        degree: Of the elements.
        limit: Of the relative error.

    Returns:
        One check a solve.
    """
    checks = []
    for model in (Continuum(degree, kinematics) for kinematics in BOTH):
        if model.applies_to(case):
            error = measure(case, model, elements).error
            mesh = f"{elements} × P{degree}"
            checks.append(
                Check(case.name, case.title, model.name, mesh, "error of the tip", error, limit, error <= limit)
            )
    return tuple(checks)


def order_checks(studies: Iterable[Study]) -> tuple[Check, ...]:
    """Orders of degrees 1 to 4 and of the discrete chord form against theory.

    Args:
        studies: On three meshes or more.

    Returns:
        One check an order; those that round-off hides on every mesh are left out.
    """
    checks = []
    for s in studies:
        if s.degree > 4 or s.model == "discrete paper":
            continue
        for name, order in (("order of the tip", s.tip), ("order of r in L2", s.centreline)):
            if order is not None and order.observed is not None:
                checks.append(_order_check(s, name, order))
    return tuple(checks)


def _order_check(study: Study, name: str, order: Order) -> Check:
    limit = order.theory - ORDER_SLACK
    found = order.observed
    mesh = " → ".join(str(n) for n in order.meshes or ())
    holds = found is not None and found >= limit
    return Check(
        study.case, study.title, study.model, mesh, name, found, limit, holds, "" if holds else noted(study.case)
    )


def digit_checks(studies: Iterable[Study]) -> tuple[Check, ...]:
    """Every case to 1e-8 by the continuum model's best mesh, or on the way there with the order of theory.

    A reference of fewer digits asks for those.

    Args:
        studies: Of the continuum model and any case.

    Returns:
        One check for each case and kinematics.
    """
    groups: dict[tuple[str, str], list[Study]] = {}
    for s in studies:
        if s.family == "continuum":
            groups.setdefault((s.case, s.model.rpartition(" ")[2]), []).append(s)
    return tuple(_digit_check(kinematics, group) for (_, kinematics), group in groups.items())


def _digit_check(kinematics: str, group: list[Study]) -> Check:
    best = min(group, key=lambda s: s.smallest)
    limit = max(DIGITS, best.floor)
    order = best.tip.observed
    arriving = order is not None and order >= best.tip.theory - ORDER_SLACK
    holds = best.smallest <= limit or (arriving and best.smallest < 1.0)
    mesh = next((f"{r.elements} × P{best.degree}" for r in best.records if r.error == best.smallest), "none")
    model, why = f"continuum {kinematics}", "" if holds else noted(best.case)
    return Check(best.case, best.title, model, mesh, "digits", best.smallest, limit, holds, why)


def noted(name: str) -> str:
    """What a case says about deviations from theory."""
    return next((case.note for case in CASES if case.name == name), "")
