"""Lateral against intermediate: the yarns as measured, and what simulated bundles say beside them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import sqrt

import numpy as np

from dolfinrod.groove.statistics import (
    Interval,
    Test,
    bootstrapped,
    mann_whitney,
    of_mean,
    paired,
    student,
    variances,
    welch,
)
from dolfinrod.groove.table1 import INTERMEDIATE, LATERAL, NOMINAL

__all__ = ["Comparison", "Measured", "Verdict", "compare", "difference", "measured", "verdict"]


@dataclass(frozen=True)
class Comparison:
    """Two samples of independent values and their difference, first minus second.

    Args:
        first: Mean and interval of the first.
        second: Of the second.
        welch: The test that fits independent samples; its difference is the one to quote.
        student: The same under equal variances.
        mann_whitney: Of ranks.
        variances: Whether the scatter differs.
        bootstrap: Of the difference, without any assumption on distributions.
        effect: Cohen's d: the difference in standard deviations.
        hedges: The same, less its bias in small samples.
    """

    first: Interval
    second: Interval
    welch: Test
    student: Test
    mann_whitney: Test
    variances: Test
    bootstrap: Interval
    effect: float
    hedges: float

    @property
    def difference(self) -> Interval:
        """Of the means, by Welch's test."""
        assert self.welch.difference is not None
        return self.welch.difference


@dataclass(frozen=True)
class Measured:
    """Table 1 of the paper.

    Args:
        comparison: Lateral less intermediate.
        paired: The test of the paper, for which nothing pairs the specimens.
        correlation: Of the pairs.
        lost: Share of the nominal twist that each yarn lacks, lateral first.
    """

    comparison: Comparison
    paired: Test
    correlation: float
    lost: tuple[float, float]


@dataclass(frozen=True)
class Verdict:
    """Simulated bundles beside measured yarns.

    Bundles of a few fibres in a few milliseconds are no yarns: agreement of the sign is all that can be hoped for.

    Args:
        simulated: Lateral less intermediate [turns/m].
        measured: The same of Table 1 [turns/m].
    """

    simulated: Comparison
    measured: Interval

    @property
    def agrees(self) -> bool:
        """Whether both differences may be the same: their intervals meet, and that simulated is not zero."""
        return self.simulated.difference.meets(self.measured) and not self.simulated.difference.holds(0.0)

    @property
    def leans(self) -> bool:
        """Whether at least the sign is that of the yarns: lateral above zero, intermediate not to be told from it."""
        return self.simulated.first.low > 0.0 and self.simulated.second.holds(0.0)


def compare(first: Sequence[float], second: Sequence[float]) -> Comparison:
    """Two samples of independent values.

    Args:
        first: At least two, such as the twist of each simulated bundle [turns/m].
        second: Likewise.

    Returns:
        Means, tests and intervals.

    Raises:
        SceneError: Fewer values, or one that is not finite.
    """
    a, b = of_mean(first), of_mean(second)
    n, m = len(first), len(second)
    pooled = sqrt(((n - 1) * np.var(first, ddof=1) + (m - 1) * np.var(second, ddof=1)) / (n + m - 2))
    d = float((a.value - b.value) / pooled)
    return Comparison(
        first=a,
        second=b,
        welch=welch(first, second),
        student=student(first, second),
        mann_whitney=mann_whitney(first, second),
        variances=variances(first, second),
        bootstrap=bootstrapped(first, second),
        effect=d,
        # Hedges & Olkin, Statistical Methods for Meta-Analysis, 1985.
        hedges=d * (1.0 - 3.0 / (4.0 * (n + m) - 9.0)),
    )


def difference(first: Sequence[float], second: Sequence[float]) -> Interval:
    """Difference of means by Welch's test, also of samples without any scatter, whose interval has no width.

    Args:
        first: At least two values.
        second: Likewise.

    Returns:
        First minus second.

    Raises:
        SceneError: Fewer values, or one that is not finite.
    """
    if np.ptp(first) == 0.0 == np.ptp(second):
        apart = of_mean(first).value - of_mean(second).value
        return Interval(apart, apart, apart)
    found = welch(first, second).difference
    assert found is not None
    return found


def measured() -> Measured:
    """What Table 1 says."""
    a, b = LATERAL.twist, INTERMEDIATE.twist
    found = compare(a, b)
    lost = 1.0 - found.first.value / NOMINAL, 1.0 - found.second.value / NOMINAL
    return Measured(found, paired(a, b), float(np.corrcoef(a, b)[0, 1]), lost)


def verdict(lateral: Sequence[float], intermediate: Sequence[float]) -> Verdict:
    """Twists of simulated bundles beside Table 1; nothing is fitted.

    Args:
        lateral: Of each run [turns/m].
        intermediate: Likewise.

    Returns:
        Both differences with their intervals.

    Raises:
        SceneError: Fewer than two runs of either.
    """
    return Verdict(compare(lateral, intermediate), measured().comparison.difference)
