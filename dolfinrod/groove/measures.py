"""What a bundle looks like at one time: who winds about whom, how wide it is, what presses it, along X."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.twist import centrelines, crossings, exchanges, pairs, profile, refined

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from dolfinrod.groove.scenario import Scenario
    from dolfinrod.result import Result
    from dolfinrod.twist import Crossing, Exchange, Profile

    Array = NDArray[np.float64]

__all__ = ["CROSSED", "Along", "Measures", "measure"]

# Turns from which on two fibres count as wound about each other; half a turn is one crossing.
CROSSED = 0.4
STATIONS = 20


@dataclass(frozen=True, eq=False)
class Along:
    """A bundle along X, each value the mean over a stretch between stations.

    Args:
        X: Ends of the stretches, shape (n + 1,) [m].
        width: Extent of the fibres' surfaces along Z, shape (n,) [m].
        spread: Root mean square distance of the fibres' axes from their middle, shape (n,) [m].
        tension: Mean axial force of the fibres, shape (n,) [N].
        walls: Line load of groove and core on all fibres, shape (n,) [N/m].
        fibres: Line load of fibres on one another, each meeting counted once, shape (n,) [N/m].
    """

    X: Array
    width: Array
    spread: Array
    tension: Array
    walls: Array
    fibres: Array


@dataclass(frozen=True, eq=False)
class Measures:
    """A bundle at one stored time; what winding needs is None for a single fibre.

    Args:
        t: Time [s].
        winding: Turns of each pair of fibres about each other, Z positive, shape (N, N).
        T_pair: Twist of the bundle by its pairs [turns/m]. Part of it are the angles at the ends: fibres side by side
            at A that lie on a slope or on one another at B have turned by up to a quarter without winding at all, in
            a lateral groove all of them the same way.
        T_crossed: The same by crossings alone, half a turn each, which leaves that out [turns/m].
        T: Twist along X; None where a fibre turns back.
        crossings: Seen from above, X ascending; none where a fibre turns back.
        exchanges: Which fibre has crossed which, numbered as rods: from 0.
        along: Width, tension and contact along X; None where a fibre turns back.
    """

    t: float
    winding: Array
    T_pair: float
    T_crossed: float
    T: Profile | None
    crossings: tuple[Crossing, ...]
    exchanges: tuple[Exchange, ...]
    along: Along | None

    @property
    def wound(self) -> int:
        """Pairs that wind by 0.4 turns or more, either way."""
        return int((np.abs(np.triu(self.winding, 1)) >= CROSSED).sum())

    def crosses(self, a: int, b: int) -> bool:
        """Whether two fibres, numbered from 1 on, have changed places and wound about each other: "5 crosses 4"."""
        return any({a - 1, b - 1} == {found.k, found.l} for found in self.exchanges)


def measure(result: Result, scenario: Scenario, i: int = -1, *, stations: int = STATIONS) -> Measures:
    """Measure the bundle of a result.

    Args:
        result: Of the scenario, by either model.
        scenario: What was solved: its first rods are the fibres, a core is not measured.
        i: Stored time.
        stations: Stretches along X.

    Returns:
        All measures.

    Raises:
        ValueError: Fibres that meet or are given by too few points, as `dolfinrod.twist` says.
    """
    return refined(lambda pieces: _measured(result, scenario, i, stations, pieces))


def _measured(result: Result, scenario: Scenario, i: int, stations: int, pieces: int) -> Measures:
    """The same of curves with so many straight pieces between neighbouring nodes."""
    numbers = range(scenario.fibres)
    curves = tuple(scenario.unrolled(r) for r in centrelines(result, i, rods=numbers, pieces=pieces))
    several, onward = len(curves) > 1, all(bool((np.diff(r[:, 0]) > 0.0).all()) for r in curves)
    wound = pairs(curves) if several else None
    crossed = crossings(curves) if several and onward else ()
    halves = 0.0 if wound is None else 0.5 * sum(c.sign for c in crossed) / float(np.nansum(np.triu(wound.length, 1)))
    return Measures(
        t=float(result.t[i]),
        winding=np.zeros((1, 1)) if wound is None else wound.turns,
        T_pair=0.0 if wound is None else wound.T,
        T_crossed=halves if onward else np.nan,
        T=profile(curves, stations) if several and onward else None,
        crossings=crossed,
        exchanges=exchanges(curves) if several else (),
        along=_along(result, scenario, i, curves, stations) if onward else None,
    )


def _along(result: Result, scenario: Scenario, i: int, curves: Sequence[Array], stations: int) -> Along:
    """Means over stretches of the length that all fibres share."""
    low, high = max(0.0, *(r[0, 0] for r in curves)), min(r[-1, 0] for r in curves)
    X = np.linspace(low, high, stations + 1)
    # Some places within each stretch stand for it.
    inner = (X[:-1, None] + np.diff(X)[:, None] * (np.arange(8) + 0.5) / 8.0).ravel()
    yz = np.stack([[np.interp(inner, r[:, 0], r[:, c]) for c in (1, 2)] for r in curves])
    z, off = yz[:, 1], yz - yz.mean(axis=0)
    rods = result.rods[: scenario.fibres]
    pull = [np.interp(inner, scenario.unrolled(h.r[i])[:, 0], h.n[i, :, 0]) for h in rods]

    def means(values: Array) -> Array:
        return np.asarray(values.reshape(stations, -1).mean(axis=1))

    return Along(
        X=X,
        width=means(np.ptp(z, axis=0) + 2.0 * scenario.bundle.radius),
        spread=means(np.sqrt((off**2).sum(axis=1).mean(axis=0))),
        tension=means(np.mean(pull, axis=0)),
        walls=_walls(result, scenario, i, X),
        fibres=_meetings(result, scenario, i, X),
    )


def _walls(result: Result, scenario: Scenario, i: int, X: Array) -> Array:
    """Forces of walls on the fibres by stretch, over its length."""
    found = np.zeros(len(X) - 1)
    for history in result.contacts:
        for touching, rod in zip(history.rods[: scenario.fibres], result.rods, strict=False):
            if touching is not None:
                at = np.interp(touching.s, rod.s, scenario.unrolled(rod.r[i])[:, 0])
                found += np.histogram(at, X, weights=touching.pressure[i] * touching.share)[0]
    return np.asarray(found / np.diff(X))


def _meetings(result: Result, scenario: Scenario, i: int, X: Array) -> Array:
    """Normal forces between fibres by stretch, over its length."""
    found = np.zeros(len(X) - 1)
    for history in result.meetings:
        met = history.times[i]
        among = (met.rod_a < scenario.fibres) & (met.rod_b < scenario.fibres)
        pressed = np.einsum("ni,ni->n", met.force, met.normal)[among]
        found += np.histogram(scenario.unrolled(met.point[among])[:, 0], X, weights=pressed)[0]
    return np.asarray(found / np.diff(X))
