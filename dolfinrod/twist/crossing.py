"""Fibres that cross as seen from above the roller, with who is on top, and those that change places."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.twist.fibres import Fibres
from dolfinrod.twist.pairing import pairs
from dolfinrod.twist.sweep import sweeps

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.float64]

__all__ = ["CROSSES", "Crossing", "Exchange", "crossings", "exchanges"]

# Turns from which on two fibres that end up the other way round have crossed; half a turn is a full exchange.
CROSSES = 0.4


@dataclass(frozen=True)
class Crossing:
    """Two fibres that cross in the X–Z plane, seen along −Y.

    Args:
        k: One of them.
        l: The other, k < l.
        X: Where [m].
        over: Which of the two lies on top, with the larger Y.
        sign: 1 where they cross right-handed (half a turn of Z twist), −1 where left-handed.
        gap: Difference of their Y there [m].
    """

    k: int
    l: int
    X: float
    over: int
    sign: int
    gap: float


@dataclass(frozen=True)
class Exchange:
    """Fibre k has crossed fibre l: their order in Z at B is not that at A, and they wind by 0.4 turns or more.

    Args:
        k: The one of smaller Z at A.
        l: The other.
        turns: By which they wind about each other, or by how much more than before.
    """

    k: int
    l: int
    turns: float


def crossings(fibres: Sequence[ArrayLike] | Array) -> tuple[Crossing, ...]:
    """Every crossing of two fibres in the X–Z plane, along X.

    Signs add up to twice the winding of a pair but for what the angles at its ends leave, less than a half turn.

    Args:
        fibres: Points of each in order, none of which turns back along X, shapes (n_k, 3) [m].

    Returns:
        Crossings, X ascending.

    Raises:
        ValueError: A fibre turns back, two meet, or they are given by too few points.
    """
    all_of = Fibres.of(fibres)
    all_of.running_on("a list of crossings")
    found: list[Crossing] = []
    for s in sweeps(all_of, *np.triu_indices(len(all_of), 1)):
        y, z = s.d
        above = z >= 0.0
        pair, i = np.nonzero(s.shared & (above[:, 1:] != above[:, :-1]))
        part = z[pair, i] / (z[pair, i] - z[pair, i + 1])
        gap = y[pair, i] + part * (y[pair, i + 1] - y[pair, i])
        X = s.X[pair, i] + part * (s.X[pair, i + 1] - s.X[pair, i])
        sign = np.where((gap > 0.0) == above[pair, i + 1], 1, -1)
        k, l = s.k[pair], s.l[pair]
        over = np.where(gap > 0.0, l, k)
        columns = (k, l, X, over, sign, np.abs(gap))
        found += [Crossing(*row) for row in zip(*(c.tolist() for c in columns), strict=True)]
    return tuple(sorted(found, key=lambda c: (c.X, c.k, c.l)))


def exchanges(
    fibres: Sequence[ArrayLike] | Array, *, before: Sequence[ArrayLike] | Array | None = None
) -> tuple[Exchange, ...]:
    """Which fibres have crossed which.

    Args:
        fibres: Points of each in order, shapes (n_k, 3) [m].
        before: The same fibres in an earlier state, whose windings do not count; None: all that there is counts.

    Returns:
        Pairs that have changed places.

    Raises:
        ValueError: Two fibres meet, or are given by too few points.
    """
    all_of = Fibres.of(fibres)
    turns = pairs(fibres).turns
    if before is not None:
        turns = turns - pairs(before).turns
    ends = [np.array([r[i, 2] for r in all_of.points]) for i in (0, -1)]
    order = [np.sign(z[None, :] - z[:, None]) for z in ends]
    k, l = np.nonzero((order[0] > 0) & (order[1] < 0) & (np.abs(turns) >= CROSSES))
    return tuple(Exchange(int(a), int(b), float(turns[a, b])) for a, b in zip(k, l, strict=True))
