"""Numbers that must hold on any machine: errors and orders of issue 2. Times are never among them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from dolfinrod.scene import Planar, Spatial
from verification.cases import bend45, elastica, rollup
from verification.models import Continuum
from verification.workprecision import measure

if TYPE_CHECKING:
    from collections.abc import Callable

    from verification.case import Case
    from verification.order import Order
    from verification.workprecision import Study

__all__ = ["ORDER_SLACK", "Check", "error_checks", "order_checks"]

# What an observed order may fall short of theory on meshes of 4 to 32 elements.
ORDER_SLACK = 0.3
BOTH = (Planar(), Spatial())


@dataclass(frozen=True)
class Check:
    """A number and its limit.

    Args:
        title: Of the case.
        model: That found it.
        mesh: Such as "8 × P3".
        quantity: What the number is.
        found: The number; None where it could not be found.
        limit: What it must not exceed, or, for an order, not fall short of.
        holds: Whether it does.
    """

    title: str
    model: str
    mesh: str
    quantity: str
    found: float | None
    limit: float
    holds: bool


def limits() -> tuple[tuple[Case, int, int, float], ...]:
    """Case, elements, degree, largest relative error of the tip."""
    tens = (elastica.inextensible(10.0), elastica.isotropic(10.0), elastica.shearable(10.0))
    turns = ((rollup.rolled(t), int(8 * t)) for t in (0.5, 1.0, 2.0, 5.0))
    return (
        *((case, n, k, e) for case in tens for n, k, e in ((8, 3, 2e-7), (4, 5, 1e-8), (8, 4, 1e-8))),
        *((case, n, 3, 1e-7) for case, n in turns),
        *((case, 8, k, e) for case in bend45.CASES if "600" in case.name for k, e in ((3, 3e-8), (4, 1e-10))),
    )


def error_checks(note: Callable[[str], None] = lambda _: None) -> tuple[Check, ...]:
    """Errors against their limits, with every kinematics that holds the case.

    Args:
        note: Told what is being solved.

    Returns:
        One check a solve.
    """
    checks = []
    for case, elements, degree, limit in limits():
        note(f"error limits: {case.title}")
        for model in (Continuum(degree, kinematics) for kinematics in BOTH):
            if model.applies_to(case):
                error = measure(case, model, elements).error
                mesh = f"{elements} × P{degree}"
                checks.append(Check(case.title, model.name, mesh, "error of the tip", error, limit, error <= limit))
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
    return Check(study.title, study.model, mesh, name, found, limit, found is not None and found >= limit)
