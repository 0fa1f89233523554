"""Twist of a solved bundle: smooth curves from what a model leaves, and all measures of a stored state at once."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol, TypeVar

import numpy as np

from dolfinrod.twist.axis import AxisWinding, axis_winding
from dolfinrod.twist.coarse import TooCoarse
from dolfinrod.twist.pairing import Pairs, pairs
from dolfinrod.twist.polygon import checked
from dolfinrod.twist.torsion import material_twist
from dolfinrod.twist.writhing import writhe

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from dolfinrod.deformation import RodHistory

    Array = NDArray[np.float64]

__all__ = ["PIECES", "Bundle", "Solved", "centrelines", "of", "refined", "smooth"]

Told = TypeVar("Told")

# Straight pieces between neighbouring nodes: of an arc they are off by a sixteenth of what its chord is.
PIECES = 4
# The same where fibres that touch turn about each other within less.
FINER = (PIECES, 4 * PIECES, 16 * PIECES)


class Solved(Protocol):
    """Whatever has rods at stored times, such as a `Result`."""

    @property
    def rods(self) -> tuple[RodHistory, ...]:
        """One history per rod."""


@dataclass(frozen=True, eq=False)
class Bundle:
    """Twist of the rods of a result at one stored time.

    Args:
        pairs: How they wind about one another; None for a single rod.
        axis: How they turn about the axis; None where one turns back along X, so that there is none.
        material: Own twist strain of each rod, (1/2π) ∫ κ₁ ds, shape (N,) [turns].
        writhe: Of each rod, shape (N,) [turns].
    """

    pairs: Pairs | None
    axis: AxisWinding | None
    material: Array
    writhe: Array

    @property
    def T_pair(self) -> float:
        """Twist of the bundle by its pairs; NaN for a single rod [turns/m]."""
        return np.nan if self.pairs is None else self.pairs.T

    @property
    def T_axis(self) -> float:
        """Twist of the bundle about its axis; NaN where a rod turns back [turns/m]."""
        return np.nan if self.axis is None else self.axis.T


def of(result: Solved, i: int = -1, *, rods: Sequence[int] | None = None, axis: ArrayLike | None = None) -> Bundle:
    """Twist of a solved bundle, such as `dr.twist.of(result).T_pair`.

    Args:
        result: Of either model.
        i: Stored time.
        rods: Which of them are the bundle; None: all.
        axis: As of `axis_winding`; None: the mean of the rods.

    Returns:
        All measures of that state, of curves as fine as it takes to tell how the rods turn.

    Raises:
        TooCoarse: No curve is.
        ValueError: Two rods meet, or share no stretch of X.
    """
    chosen = range(len(result.rods)) if rods is None else rods
    return refined(lambda pieces: _measured(result, i, chosen, axis, pieces))


def refined(measured: Callable[[int], Told]) -> Told:
    """What the coarsest curves tell that are fine enough to see how rods turn.

    Args:
        measured: Takes the number of straight pieces between neighbouring nodes.

    Returns:
        What it returns.

    Raises:
        TooCoarse: The finest curves are not.
    """
    for pieces in FINER[:-1]:
        try:
            return measured(pieces)
        except TooCoarse:
            continue
    return measured(FINER[-1])


def _measured(result: Solved, i: int, rods: Sequence[int], axis: ArrayLike | None, pieces: int) -> Bundle:
    """With so many pieces between neighbouring nodes."""
    curves = centrelines(result, i, rods=rods, pieces=pieces)
    histories = [result.rods[k] for k in rods]
    runs_on = all(bool(np.all(np.diff(r[:, 0]) > 0.0) or np.all(np.diff(r[:, 0]) < 0.0)) for r in curves)
    return Bundle(
        pairs=pairs(curves) if len(curves) > 1 else None,
        axis=axis_winding(curves, axis=axis) if runs_on and (len(curves) > 1 or axis is not None) else None,
        material=np.array([material_twist(h.s, h.kappa[i]) for h in histories]),
        writhe=np.array([writhe(r) for r in curves]),
    )


def centrelines(
    result: Solved, i: int = -1, *, rods: Sequence[int] | None = None, pieces: int = PIECES
) -> tuple[Array, ...]:
    """Centrelines of rods at a stored time as smooth curves, cubics whose slopes are r′ = R (e₁ + γ).

    Args:
        result: Of either model.
        i: Stored time.
        rods: Which; None: all.
        pieces: Straight ones between neighbouring nodes.

    Returns:
        Points of each, shapes (n_k, 3) [m].
    """
    chosen = range(len(result.rods)) if rods is None else rods
    curves = []
    for h in (result.rods[k] for k in chosen):
        slope = np.einsum("nij,nj->ni", h.frames[i], h.gamma[i] + np.array([1.0, 0.0, 0.0]))
        curves.append(smooth(h.r[i], h.s, slope, pieces=pieces))
    return tuple(curves)


def smooth(r: ArrayLike, s: ArrayLike | None = None, slope: ArrayLike | None = None, *, pieces: int = PIECES) -> Array:
    """Points of a smooth curve through given ones, for measures that take curves as straight between points.

    Args:
        r: Points in order, shape (n, 3) [m].
        s: A parameter that ascends along them, shape (n,); None: the length of the straight way [m].
        slope: dr/ds at each, shape (n, 3); None: of the parabola through neighbours.
        pieces: Straight ones between neighbouring points.

    Returns:
        Points on a cubic between each two, shape (pieces (n − 1) + 1, 3) [m].

    Raises:
        ValueError: The parameter does not ascend, or there is not a slope for every point.
    """
    points = checked(r)
    chord = np.diff(points, axis=0)
    along = np.r_[0.0, np.cumsum(np.linalg.norm(chord, axis=1))] if s is None else np.asarray(s, dtype=float)
    if along.shape != (len(points),) or np.any(np.diff(along) <= 0.0):
        raise ValueError(f"the parameter must ascend from point to point, got {along} for {len(points)} points")
    h = np.diff(along)[:, None]
    tangent = _slopes(chord / h, h) if slope is None else np.asarray(slope, dtype=float)
    if tangent.shape != points.shape:
        raise ValueError(f"there must be a slope at each of {len(points)} points, got shape {tangent.shape}")
    x = (np.arange(pieces) / pieces)[None, :, None]
    line = (1.0 + 2.0 * x) * (1.0 - x) ** 2 * points[:-1, None] + x**2 * (3.0 - 2.0 * x) * points[1:, None]
    bend = x * (1.0 - x) ** 2 * (h * tangent[:-1])[:, None] - x**2 * (1.0 - x) * (h * tangent[1:])[:, None]
    return np.concatenate([(line + bend).reshape(-1, 3), points[-1:]])


def _slopes(slope: Array, h: Array) -> Array:
    """At points, from those of the chords between them: of the parabola through three neighbours."""
    if len(slope) == 1:
        return np.repeat(slope, 2, axis=0)
    inner = (h[1:] * slope[:-1] + h[:-1] * slope[1:]) / (h[1:] + h[:-1])
    return np.concatenate([2.0 * slope[:1] - inner[:1], inner, 2.0 * slope[-1:] - inner[-1:]])
