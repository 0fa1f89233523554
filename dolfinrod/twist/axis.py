"""How a bundle turns about an axis, and where along it: T(X), and what is delivered at B."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.twist.angle import swept
from dolfinrod.twist.coarse import TooCoarse
from dolfinrod.twist.fibres import Fibres
from dolfinrod.twist.sweep import sweeps

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.float64]

__all__ = ["AxisWinding", "Profile", "axis_winding", "delivered", "profile"]


@dataclass(frozen=True)
class AxisWinding:
    """How a bundle turns about an axis.

    Args:
        turns: From A to B, positive where right-handed (Z twist).
        length: Of the stretch of X that all fibres share [m].
    """

    turns: float
    length: float

    @property
    def T(self) -> float:
        """Twist, turns over length [turns/m]."""
        return self.turns / self.length


@dataclass(frozen=True, eq=False)
class Profile:
    """Twist along a bundle, each value the mean of a stretch.

    Args:
        X: Ends of the stretches, ascending, shape (n + 1,) [m].
        axis: About the axis, shape (n,) [turns/m].
        pairs: Of the pairs of fibres; NaN for a single fibre, shape (n,) [turns/m].
    """

    X: Array
    axis: Array
    pairs: Array


def axis_winding(fibres: Sequence[ArrayLike] | Array, *, axis: ArrayLike | None = None) -> AxisWinding:
    """Turns of a bundle about its axis, ∫ T dX with T = Σ r_k² dθ_k/dX / (2π Σ r_k²).

    Between neighbouring knots T is that of the turn Δθ = atan2(Σ y z′ − z y′, Σ y y′ + z z′), which
    carries one section best onto the next (least squares) and tends to the formula; it is exact for a rigid turn.

    Args:
        fibres: Points of each in order, none of which turns back along X, shapes (n_k, 3) [m].
        axis: Points of a core that runs along X, shape (n, 3) [m], or its (y, z) where it is straight along X; None:
            the mean of the fibres at each X.

    Returns:
        Turns and length.

    Raises:
        TooCoarse: The bundle turns by a right angle or more from one knot to the next.
        ValueError: A fibre turns back, the fibres share no stretch of X, or all of them lie on the axis.
    """
    all_of = Fibres.of(fibres)
    low, high = all_of.common
    found = _about_axis(all_of, np.array([low, high]), axis)
    return AxisWinding(float(found[0]) * (high - low), high - low)


def profile(
    fibres: Sequence[ArrayLike] | Array, stations: ArrayLike | int = 20, *, axis: ArrayLike | None = None
) -> Profile:
    """Twist along a bundle, about its axis and of its pairs.

    Args:
        fibres: As of `axis_winding` [m].
        stations: Ends of the stretches over which to take the mean, ascending, shape (n + 1,) [m], or how many equal
            ones there shall be.
        axis: As of `axis_winding`.

    Returns:
        T(X).

    Raises:
        ValueError: As of `axis_winding` and `winding`; stations that do not ascend or lie off the fibres.
    """
    all_of = Fibres.of(fibres)
    low, high = all_of.common
    X = np.asarray(stations, dtype=float) if np.ndim(stations) else np.linspace(low, high, int(np.max(stations)) + 1)
    if len(X) < 2 or np.any(np.diff(X) <= 0.0) or X[0] < low or X[-1] > high:
        raise ValueError(f"stations must ascend within X = {low} to {high} m, which all fibres share, got {X} m")
    return Profile(X, _about_axis(all_of, X, axis), _of_pairs(all_of, X))


def delivered(fibres: Sequence[ArrayLike] | Array, *, length: float = 0.01, axis: ArrayLike | None = None) -> Profile:
    """Twist of the last stretch before B, where the fibres first end: a profile of that one stretch.

    Args:
        fibres: As of `axis_winding` [m].
        length: Of the stretch [m].
        axis: As of `axis_winding`.

    Returns:
        T about the axis and of the pairs, shapes (1,).
    """
    _, end = Fibres.of(fibres).common
    return profile(fibres, np.array([end - length, end]), axis=axis)


def _about_axis(fibres: Fibres, stations: Array, axis: ArrayLike | None) -> Array:
    """T of each stretch about the axis, shape (n,) [turns/m]."""
    fibres.running_on("twist along X")
    X = np.unique(np.concatenate([*(r[:, 0] for r in fibres.points), stations]))
    X = X[(X >= stations[0]) & (X <= stations[-1])]
    place = fibres.at(X)
    d = place - (place.mean(axis=1, keepdims=True) if axis is None else _core(axis, X))
    if not np.any(d):
        raise ValueError("all fibres lie on the axis: they do not turn about it")
    # The turn of all of them together: their cross and inner products in one.
    (y, z), (y_next, z_next) = d[:, :, :-1], d[:, :, 1:]
    together = np.stack([np.sum(y * y_next + z * z_next, axis=0), np.sum(y * z_next - z * y_next, axis=0)])
    angle = swept(np.array([1.0, 0.0]), together)
    _small(angle, X)
    return _means(angle, X, stations)


def _core(axis: ArrayLike, X: Array) -> Array:
    """Places of an axis, shape (2, 1, n) or (2, 1, 1) [m]."""
    core = np.asarray(axis, dtype=float)
    if core.shape == (2,):
        return core[:, None, None]
    along = Fibres.of([core])
    along.running_on("an axis")
    if along.start[0] > X[0] or along.end[0] < X[-1]:
        raise ValueError(f"the axis must reach from X = {X[0]} to {X[-1]} m, got {along.start[0]} to {along.end[0]} m")
    return along.at(X)


def _small(angle: Array, X: Array) -> None:
    """Complain where a section turns by a right angle or more from knot to knot."""
    if np.abs(angle).max() >= 0.5 * np.pi:
        i = int(np.abs(angle).argmax())
        raise TooCoarse(
            f"the bundle turns by {np.degrees(angle[i]):.0f} degrees between X = {X[i]:.6g} and {X[i + 1]:.6g} m, too "
            "far to tell which way: give points closer together, such as those of `dolfinrod.twist.smooth`"
        )


def _of_pairs(fibres: Fibres, stations: Array) -> Array:
    """T of each stretch, the mean of all pairs, shape (n,) [turns/m]."""
    n = len(fibres)
    k, l = np.triu_indices(n, 1)
    total = np.zeros(len(stations) - 1)
    for s in sweeps(fibres, k, l, stations=stations):
        middle = 0.5 * (s.X[:, 1:] + s.X[:, :-1])
        cell = np.searchsorted(stations, middle) - 1
        counts = (cell >= 0) & (cell < len(total))
        total += np.bincount(cell[counts], weights=s.angle[counts], minlength=len(total))
    number = len(k) if n > 1 else np.nan
    return np.asarray(total / (2.0 * np.pi * number * np.diff(stations)))


def _means(angle: Array, X: Array, stations: Array) -> Array:
    """Turns per metre of each stretch from angles from knot to knot."""
    turned = np.concatenate([[0.0], np.cumsum(angle)])
    return np.asarray(np.diff(turned[np.searchsorted(X, stations)]) / (2.0 * np.pi * np.diff(stations)))
