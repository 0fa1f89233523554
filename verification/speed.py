"""Milliseconds of issue 2, warm and on one thread, beside those published for other people's solvers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from dolfinrod.scene import Planar, Spatial
from verification.cases import bend45, elastica
from verification.models import Continuum, Discrete
from verification.references import Peer, peers
from verification.workprecision import Record, measure

if TYPE_CHECKING:
    from collections.abc import Callable

    from verification.case import Case
    from verification.models import Model

__all__ = ["Speed", "speeds"]

# Meshes that may bring the bend to 1e-8, elements and degree; the quickest that does is shown.
BEND_MESHES = ((10, 3), (4, 4), (5, 4), (3, 5), (4, 5))
BEND_ERROR = 1e-8


@dataclass(frozen=True)
class Speed:
    """A speed figure.

    Args:
        title: What is solved.
        mesh: By what.
        record: How well and how long.
        limit: Milliseconds it should take, load stepping alone [ms].
        peers: Published figures for the same problem and kinematics.
    """

    title: str
    mesh: str
    record: Record
    limit: float
    peers: tuple[Peer, ...] = ()

    @property
    def holds(self) -> bool:
        """Whether the quickest repetition is within the limit; on a busy machine that says little."""
        return self.record.timing is not None and self.record.timing.solve_min <= self.limit


def speeds(repeats: int, note: Callable[[str], None] = lambda _: None) -> tuple[Speed, ...]:
    """The four figures of the issue.

    Args:
        repeats: Timed calls of each.
        note: Told what is being timed.

    Returns:
        Slender elastica in space and in the plane, 45° bend to 1e-8, 80 discrete elements.
    """
    ten = elastica.slender(10.0, 200.0)
    published = peers("elastica")
    rows = []
    for kinematics, limit in ((Spatial(), 8.0), (Planar(), 4.0)):
        model = Continuum(3, kinematics)
        note(f"speed: {model.name}")
        same = tuple(p for p in published if p.kinematics == model.kinematics_name)
        record = measure(ten, model, 8, repeats=repeats)
        rows.append(Speed("PL²/EI = 10, L/d = 200", f"{model.kinematics_name} 8 × P3", record, limit, same))
    note("speed: 45° bend to 1e-8")
    rows.append(quickest_bend(repeats))
    note("speed: 80 discrete elements")
    rows.append(discrete_cantilever(repeats))
    return tuple(rows)


def quickest_bend(repeats: int) -> Speed:
    """The 45° bend on the mesh that reaches 1e-8 soonest."""
    case = bend45.bend(600.0)
    tried = [(measure(case, Continuum(k), n, repeats=repeats), f"spatial {n} × P{k}") for n, k in BEND_MESHES]
    record, mesh = min(tried, key=lambda pair: (not pair[0].error <= BEND_ERROR, solve_ms(pair[0])))
    return Speed("45° bend, 600, to 10⁻⁸", mesh, record, 12.0, peers("bend"))


def discrete_cantilever(repeats: int) -> Speed:
    """80 discrete elements at L/d = 200, shear-rigid, held against its own reference."""
    case: Case = elastica.shear_rigid(10.0, 200.0)
    model: Model = Discrete()
    record = measure(case, model, 80, repeats=repeats)
    return Speed("PL²/EI = 10, L/d = 200, no shear", "discrete chord, 80", record, 15.0)


def solve_ms(record: Record) -> float:
    """Quickest load stepping, infinite where it failed [ms]."""
    return record.timing.solve_min if record.timing else float("inf")
