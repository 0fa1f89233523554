"""How fibres wind about one another, pair by pair: the measure of twist that needs no axis."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.twist import gauss
from dolfinrod.twist.fibres import Fibres
from dolfinrod.twist.sweep import sweeps

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.float64]

__all__ = ["Pairs", "Winding", "pairs", "winding"]


@dataclass(frozen=True)
class Winding:
    """How two fibres wind about each other.

    Args:
        turns: Positive where they do so right-handed (Z twist).
        length: Of the stretch of X that both share [m].
        left_out: Of it, where they were too far apart to count [m].
        gauss: Whether one turns back along X, so that the turns are those of the Gauss integral of both, thought to go
            on straight along X for ever beyond their ends; nothing is left out of that.
    """

    turns: float
    length: float
    left_out: float = 0.0
    gauss: bool = False

    @property
    def T(self) -> float:
        """Twist, turns over length [turns/m]."""
        return self.turns / self.length


@dataclass(frozen=True, eq=False)
class Pairs:
    """How the fibres of a bundle wind about one another.

    Args:
        turns: Of each pair, w_kl = w_lk, with a zero diagonal, shape (N, N).
        length: Of the stretch of X that both share; NaN on the diagonal, shape (N, N) [m].
        left_out: Of it, where they were too far apart to count, shape (N, N) [m].
        gauss: Pairs of which one fibre turns back, as in `Winding`, shape (N, N).
    """

    turns: Array
    length: Array
    left_out: Array
    gauss: NDArray[np.bool_]

    @property
    def T(self) -> float:
        """Twist of the bundle, T = 2/(N (N − 1)) Σ_{k<l} w_kl/L_kl, that of a rigidly twisted one [turns/m]."""
        k, l = np.triu_indices(len(self.turns), 1)
        return float((self.turns[k, l] / self.length[k, l]).mean())


def winding(r_k: ArrayLike, r_l: ArrayLike, *, within: float | None = None) -> Winding:
    """Turns of two fibres about each other along X, w = (1/2π) [θ]_A^B with θ = atan2(z_l − z_k, y_l − y_k).

    Fibres are polylines, both taken at the same X; on them it is exact, with knots wherever either has one. Which
    way each is run through, and which is named first, does not matter.

    Args:
        r_k: Points of one fibre in order, shape (n, 3) [m].
        r_l: Of the other, shape (m, 3) [m].
        within: Distance in the plane across beyond which stretches do not count; None: all do [m].

    Returns:
        Turns and length.

    Raises:
        TooCoarse: Points are too far apart to tell how they turn.
        ValueError: The fibres meet, or share no stretch of X.
    """
    both = pairs((r_k, r_l), within=within)
    return Winding(
        float(both.turns[0, 1]), float(both.length[0, 1]), float(both.left_out[0, 1]), bool(both.gauss[0, 1])
    )


def pairs(fibres: Sequence[ArrayLike] | Array, *, within: float | None = None) -> Pairs:
    """Windings of all pairs of fibres.

    Args:
        fibres: Points of each in order, shapes (n_k, 3) [m].
        within: As in `winding` [m].

    Returns:
        Turns of each pair, and the twist of the bundle.

    Raises:
        ValueError: There are fewer than two fibres, or two of them are as `winding` does not take them.
    """
    all_of = Fibres.of(fibres)
    n = len(all_of)
    if n < 2:
        raise ValueError(f"windings need two or more fibres, got {n}")
    k, l = np.triu_indices(n, 1)
    both = all_of.monotone[k] & all_of.monotone[l]
    found = np.empty((3, len(k)))
    found[:, both] = np.concatenate(
        [np.empty((3, 0))]
        + [
            np.stack([s.angle.sum(axis=1) / (2.0 * np.pi), s.length, s.left_out])
            for s in sweeps(all_of, k[both], l[both], within=within)
        ],
        axis=1,
    )
    for p in np.flatnonzero(~both):
        turns = gauss.lengthened(all_of.polygon(int(k[p])), all_of.polygon(int(l[p])))
        found[:, p] = turns, all_of.shared(int(k[p]), int(l[p])), 0.0
    whole = np.zeros((4, n, n))
    whole[:, k, l] = whole[:, l, k] = np.concatenate([found, ~both[None]])
    np.fill_diagonal(whole[1], np.nan)
    return Pairs(whole[0], whole[1], whole[2], whole[3].astype(bool))
