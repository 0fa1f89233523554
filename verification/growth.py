"""What an iteration costs on ever finer meshes: time and memory must grow no faster than the elements."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import log

import numpy as np

from verification.cold import Cold
from verification.limit import Limit, told

__all__ = ["FROM", "POWER", "Cost", "Growth", "GrowthStudy", "grown"]

# Spans of the beam: they keep n⁴ of an element's matrix in double precision, which 10⁵ elements of a cantilever exceed.
SPANS = 10
# Power of the number of elements with which an iteration may grow; from so many elements on.
POWER, FROM = 1.1, 1000


@dataclass(frozen=True)
class Growth:
    """An iteration on one mesh.

    Args:
        elements: Of the rod.
        unknowns: Of the system.
        iterations: Of the solve.
        ms: Of an iteration, on the processor [ms].
        memory: Largest at any time of the solve, less what the program had before [MB].
        failure: Why there is none; empty: there is.
    """

    elements: int
    unknowns: int
    iterations: int
    ms: float
    memory: float
    failure: str = ""


@dataclass(frozen=True)
class GrowthStudy:
    """One model on finer and finer meshes.

    Args:
        model: "planar", "spatial" or "discrete".
        degree: Of the elements; the discrete model has none.
        rows: By number of elements, ascending.
    """

    model: str
    degree: int
    rows: tuple[Growth, ...]

    def slope(self, quantity: str) -> float | None:
        """Power of the number of elements with which a property of the rows grows on fine meshes; None: no such."""
        rows = [row for row in self.rows if row.elements >= FROM and not row.failure]
        if len(rows) < 2:
            return None
        first, last = (float(getattr(row, quantity)) for row in (rows[0], rows[-1]))
        return log(last / first) / log(rows[-1].elements / rows[0].elements)

    @property
    def words(self) -> str:
        """What did not run to its end, or how they grow."""
        failed = [f"{row.elements} elements: {row.failure}" for row in self.rows if row.failure]
        powers = [self.slope(name) for name in ("ms", "memory")]
        grown = " and ".join("–" if power is None else f"{power:.2f}" for power in powers)
        growth = f"time and memory grow with the powers {grown} of the elements, at most {POWER:g}"
        return f"Finer meshes, {self.model}: {'; '.join(failed) or growth}"

    @property
    def holds(self) -> bool:
        """All ran to their ends, and memory grows as it may: time never decides."""
        growth = self.slope("memory")
        return not any(row.failure for row in self.rows) and (growth is None or growth <= POWER)

    @property
    def within(self) -> bool:
        """Time on the processor grows as it may, too; on a busy machine that says little."""
        growth = self.slope("ms")
        return self.holds and (growth is None or growth <= POWER)


# What iterations and processes cost.
Cost = Cold | GrowthStudy | Limit


def grown(model: str, degree: int, elements: Sequence[int]) -> GrowthStudy:
    """A beam over ten supports on so many elements, each mesh in a process of its own; arguments as for `limit`."""
    return GrowthStudy(model, degree, tuple(_row(model, degree, n) for n in elements))


def _row(model: str, degree: int, n: int) -> Growth:
    found = told("limitrun", model, n, degree, 1, SPANS)
    if "failure" in found:
        return Growth(n, 0, 0, np.nan, np.nan, found["failure"])
    ms = sum(found[name] for name in ("assembly", "factors", "petsc", "python"))
    return Growth(n, found["unknowns"], found["iterations"], ms, found["memory"])
