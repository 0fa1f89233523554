"""Milliseconds of issue 2, warm and on one thread, beside those published for other people's solvers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from dolfinrod.scene import Planar, Spatial
from verification.cases import bend45, elastica
from verification.models import Continuum, Discrete
from verification.references import Peer, peers
from verification.workprecision import Record, measure

if TYPE_CHECKING:
    from verification.case import Case

__all__ = ["SPEEDS", "Speed"]

TEN, SHEAR_RIGID, BEND = elastica.slender(10.0, 200.0), elastica.shear_rigid(10.0, 200.0), bend45.bend(600.0)

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


def slender(kinematics: Planar | Spatial, limit: float, repeats: int) -> Speed:
    """The elastica PL²/EI = 10 at L/d = 200 on 8 cubic elements."""
    model = Continuum(3, kinematics)
    record = measure(TEN, model, 8, repeats=repeats)
    same = tuple(p for p in peers("elastica") if p.kinematics == model.kinematics_name)
    return Speed("PL²/EI = 10, L/d = 200", f"{model.kinematics_name} 8 × P3", record, limit, same)


def quickest_bend(repeats: int) -> Speed:
    """The 45° bend on the mesh that reaches 1e-8 soonest."""
    tried = [(measure(BEND, Continuum(k), n, repeats=repeats), f"spatial {n} × P{k}") for n, k in BEND_MESHES]
    record, mesh = min(tried, key=lambda pair: (not pair[0].error <= BEND_ERROR, solve_ms(pair[0])))
    return Speed("45° bend, 600, to 10⁻⁸", mesh, record, 12.0, peers("bend"))


def discrete_cantilever(repeats: int) -> Speed:
    """80 discrete elements at L/d = 200, shear-rigid, held against its own reference."""
    record = measure(SHEAR_RIGID, Discrete(), 80, repeats=repeats)
    return Speed("PL²/EI = 10, L/d = 200, no shear", "discrete chord, 80", record, 15.0)


# What is timed: the case, what it is called, and the measurement for a number of repeats.
SPEEDS: tuple[tuple[Case, str, Callable[[int], Speed]], ...] = (
    (TEN, "in space", lambda repeats: slender(Spatial(), 8.0, repeats)),
    (TEN, "in the plane", lambda repeats: slender(Planar(), 4.0, repeats)),
    (BEND, "to 1e-8", quickest_bend),
    (SHEAR_RIGID, "80 discrete elements", discrete_cantilever),
)


def solve_ms(record: Record) -> float:
    """Quickest load stepping, infinite where it failed [ms]."""
    return record.timing.solve_min if record.timing else float("inf")
