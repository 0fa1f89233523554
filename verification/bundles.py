"""Bundles of more and more fibres: what a step costs, in time and memory, and where the time goes."""

from __future__ import annotations

from dataclasses import dataclass
from math import log
from typing import TYPE_CHECKING, Any

import numpy as np

from verification.bundlescene import LENGTH
from verification.processes import said

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

__all__ = [
    "FEW",
    "GROWTH",
    "MOST",
    "SAME",
    "Bundle",
    "BundleCost",
    "BundleRanks",
    "BundleStudy",
    "compared",
    "measured",
    "on_ranks",
]

# Power of the number of fibres with which time and memory may grow; from so many fibres on, up to so many.
GROWTH, FEW, MOST = 1.3, 5, 57
# Of positions by one rank and by two, over the length; sums of forces in another order are all that differs.
SAME = 1e-10
RUN = "verification.bundlerun"


@dataclass(frozen=True)
class Bundle:
    """Who moves a bundle, and how finely.

    Args:
        model: "continuum" or "discrete".
        elements: Of each fibre.
        degree: Of the elements; the discrete model has none.
    """

    model: str
    elements: int
    degree: int = 1

    @property
    def mesh(self) -> str:
        """In words."""
        return f"{self.elements} × P{self.degree}" if self.model == "continuum" else f"{self.elements}"


@dataclass(frozen=True)
class BundleCost:
    """What a bundle took.

    Args:
        fibres: How many.
        steps: Taken.
        cuts: Steps that were tried in vain.
        iterations: Of Newton's method.
        factorizations: Of the tangent.
        spots: Of contact at the end.
        seconds: On the processor, of a whole solve [s].
        law: Part of them in what rods do to each other [s].
        solver: Part of them in factors and solutions [s].
        memory: Largest at any time, less what the program had before the solve [MB].
        failure: Why it ended early; empty: it did not.
    """

    fibres: int
    steps: int
    cuts: int
    iterations: int
    factorizations: int
    spots: int
    seconds: float
    law: float
    solver: float
    memory: float
    failure: str = ""

    @property
    def ms(self) -> float:
        """Of a step [ms]."""
        return 1e3 * self.seconds / max(self.steps, 1)


@dataclass(frozen=True)
class BundleStudy:
    """One model on more and more fibres.

    Args:
        model: "continuum" or "discrete".
        mesh: In words.
        rows: By number of fibres, ascending.
    """

    model: str
    mesh: str
    rows: tuple[BundleCost, ...]

    def slope(self, quantity: str) -> float | None:
        """Power of the number of fibres with which a property of the rows grows from five on; None: no such rows."""
        rows = [row for row in self.rows if row.fibres >= FEW and not row.failure]
        if len(rows) < 2:
            return None
        first, last = (float(getattr(row, quantity)) for row in (rows[0], rows[-1]))
        return log(last / first) / log(rows[-1].fibres / rows[0].fibres)

    @property
    def words(self) -> str:
        """What did not run to its end, or how they grow."""
        failed = [f"{row.fibres} fibres: {row.failure}" for row in self.rows if row.failure]
        powers = [self.slope(name) for name in ("ms", "memory")]
        grown = " and ".join("–" if power is None else f"{power:.2f}" for power in powers)
        growth = f"time and memory grow with the powers {grown} of the fibres, at most {GROWTH:g}"
        return f"Bundles by the {self.model} model: {'; '.join(failed) or growth}"

    @property
    def holds(self) -> bool:
        """All ran to their ends, and time on the processor and memory grow as they may."""
        growths = [self.slope(name) for name in ("ms", "memory")]
        return not any(row.failure for row in self.rows) and all(g is None or g <= GROWTH for g in growths)


@dataclass(frozen=True)
class BundleRanks:
    """One bundle on one rank and on two.

    Args:
        fibres: How many.
        mesh: In words.
        steps: Taken by one.
        apart: Largest difference of positions, over the length.
        seconds: Of the solves, by the clock [s].
        failure: Why one ended early; empty: none did.
    """

    fibres: int
    mesh: str
    steps: int
    apart: float
    seconds: tuple[float, float]
    failure: str = ""

    @property
    def words(self) -> str:
        """How far they are apart."""
        apart = f"positions differ by {self.apart:.1e} of the length, at most {SAME:g}"
        return f"Bundle of {self.fibres} on two ranks: {self.failure or apart}"

    @property
    def holds(self) -> bool:
        """The same answer."""
        return not self.failure and self.apart <= SAME


def measured(who: Bundle, fibres: Sequence[int], steps: int) -> BundleStudy:
    """Bundles of so many fibres, each in a process of its own."""
    return BundleStudy(who.model, who.mesh, tuple(cost(who, n, steps) for n in fibres))


def cost(who: Bundle, n: int, steps: int) -> BundleCost:
    """One bundle."""
    found = said(RUN, (who.model, who.elements, who.degree, n, steps))
    if "failure" in found:
        return BundleCost(n, 0, 0, 0, 0, 0, np.nan, np.nan, np.nan, np.nan, found["failure"])
    return BundleCost(fibres=n, **{name: value for name, value in found.items() if name not in ("x", "clock")})


def on_ranks(who: Bundle, n: int, steps: int) -> BundleRanks:
    """One bundle on one rank and on two."""
    words = (who.model, who.elements, who.degree, n, steps)
    one, two = (said(RUN, words, ranks) for ranks in (1, 2))
    return compared(who, n, one, two, "clock")


def compared(who: Bundle, n: int, one: Mapping[str, Any], two: Mapping[str, Any], clock: str) -> BundleRanks:
    """What a program said of one bundle on one rank and on two; seconds by the clock under a name."""
    if failure := one.get("failure", "") or two.get("failure", ""):
        return BundleRanks(n, who.mesh, 0, np.nan, (np.nan, np.nan), failure)
    apart = float(np.abs(np.array(one["x"]) - np.array(two["x"])).max() / LENGTH)
    return BundleRanks(n, who.mesh, one["steps"], apart, (one[clock], two[clock]))
