"""What twists of specimens or of simulated runs say about a difference of means, and how surely."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import sqrt

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene import SceneError

__all__ = ["Interval", "Test", "bootstrapped", "mann_whitney", "of_mean", "paired", "student", "variances", "welch"]

Array = NDArray[np.float64]

CONFIDENCE = 0.95
# Resamples of a bootstrap, whose ends then vary by about a hundredth of the interval, and the seed of all of them.
RESAMPLES, SEED = 10_000, 0


@dataclass(frozen=True)
class Interval:
    """An estimate and the interval that holds the true value with 95 % confidence.

    Args:
        value: The estimate.
        low: Lower end.
        high: Upper end.
    """

    value: float
    low: float
    high: float

    def holds(self, value: float) -> bool:
        """Whether a value lies within."""
        return self.low <= value <= self.high

    def meets(self, other: Interval) -> bool:
        """Whether two intervals have a value in common."""
        return self.low <= other.high and other.low <= self.high


@dataclass(frozen=True)
class Test:
    """A test of the hypothesis that two samples are alike.

    Args:
        name: Of the test.
        statistic: t, U or F.
        p: Probability of a statistic at least so far off if they are, both sides counted.
        df: Degrees of freedom; None where the test has none, or two of them.
        difference: Of the means, first minus second, where the test is about these.
    """

    # What pytest would collect for its name.
    __test__ = False

    name: str
    statistic: float
    p: float
    df: float | None = None
    difference: Interval | None = None

    @property
    def printed_p(self) -> str:
        """p as it may be printed: never zero."""
        return "p < 0.001" if self.p < 0.001 else f"p = {self.p:.3f}"


def of_mean(sample: Sequence[float]) -> Interval:
    """Mean of a sample with its interval by Student's t.

    Args:
        sample: At least two values.

    Returns:
        The interval.

    Raises:
        SceneError: Fewer values, or one that is not finite.
    """
    x = _values(sample)
    return _interval(float(x.mean()), x.std(ddof=1) / sqrt(len(x)), len(x) - 1)


def bootstrapped(sample: Sequence[float], other: Sequence[float] = (0.0, 0.0)) -> Interval:
    """Mean of a sample, less that of another, with the interval between the percentiles of resampled ones.

    Assumes no distribution, but ends too early for small samples: with ten values by some 10 %.

    Args:
        sample: At least two values.
        other: Likewise.

    Returns:
        The interval.

    Source: Efron & Tibshirani, An Introduction to the Bootstrap, 1993, 13.3.
    """
    rng, x, y = np.random.default_rng(SEED), _values(sample), _values(other)
    means = [rng.choice(values, (RESAMPLES, len(values))).mean(axis=1) for values in (x, y)]
    low, high = np.quantile(means[0] - means[1], [0.5 - 0.5 * CONFIDENCE, 0.5 + 0.5 * CONFIDENCE])
    return Interval(float(x.mean() - y.mean()), float(low), float(high))


def paired(a: Sequence[float], b: Sequence[float]) -> Test:
    """t test of the differences of pairs, as the paper does; its specimens make no pairs, each is of its own yarn."""
    from scipy.stats import ttest_rel

    x, y = _values(a), _values(b)
    if len(x) != len(y):
        raise SceneError(f"must be pairs, got {len(x)} and {len(y)} values", field="samples")
    found = ttest_rel(x, y)
    return Test("paired t", float(found.statistic), float(found.pvalue), len(x) - 1.0, of_mean((x - y).tolist()))


def student(a: Sequence[float], b: Sequence[float]) -> Test:
    """t test of independent samples of the same variance."""
    from scipy.stats import ttest_ind

    x, y = _values(a), _values(b)
    found, df = ttest_ind(x, y), len(x) + len(y) - 2.0
    pooled = ((len(x) - 1) * x.var(ddof=1) + (len(y) - 1) * y.var(ddof=1)) / df
    error = sqrt(pooled * (1 / len(x) + 1 / len(y)))
    return Test("Student t", float(found.statistic), float(found.pvalue), df, _interval(x.mean() - y.mean(), error, df))


def welch(a: Sequence[float], b: Sequence[float]) -> Test:
    """t test of independent samples whose variances may differ.

    Source: Welch, Biometrika 34, 1947, DOI 10.1093/biomet/34.1-2.28.
    """
    from scipy.stats import ttest_ind

    x, y = _values(a), _values(b)
    found = ttest_ind(x, y, equal_var=False)
    v, w = x.var(ddof=1) / len(x), y.var(ddof=1) / len(y)
    df = (v + w) ** 2 / (v**2 / (len(x) - 1) + w**2 / (len(y) - 1)) if v + w > 0.0 else float(len(x) + len(y) - 2)
    difference = _interval(x.mean() - y.mean(), sqrt(v + w), df)
    return Test("Welch t", float(found.statistic), float(found.pvalue), float(df), difference)


def mann_whitney(a: Sequence[float], b: Sequence[float]) -> Test:
    """Rank test: of how many pairs is the first the larger; assumes no distribution."""
    from scipy.stats import mannwhitneyu

    found = mannwhitneyu(_values(a), _values(b))
    return Test("Mann-Whitney U", float(found.statistic), float(found.pvalue))


def variances(a: Sequence[float], b: Sequence[float]) -> Test:
    """F test of the ratio of variances, the larger over the smaller."""
    from scipy.stats import f

    x, y = sorted((_values(a), _values(b)), key=np.var)
    F = float(y.var(ddof=1) / x.var(ddof=1))
    return Test("F", F, min(1.0, 2.0 * float(f.sf(F, len(y) - 1, len(x) - 1))))


def _interval(value: float, error: float, df: float) -> Interval:
    """By Student's t, from the standard error of a value."""
    from scipy.stats import t

    reach = float(t.ppf(0.5 + 0.5 * CONFIDENCE, df)) * error
    return Interval(float(value), float(value - reach), float(value + reach))


def _values(sample: Sequence[float]) -> Array:
    """A sample as an array of two or more finite numbers."""
    x = np.asarray(sample, dtype=float)
    if x.ndim != 1 or len(x) < 2 or not np.isfinite(x).all():
        raise SceneError(f"must be at least two finite numbers, got {sample!r}", field="sample")
    return x
