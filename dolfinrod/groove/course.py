"""A bundle in the course of time: how it narrows, winds and presses."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.twist import centrelines, pairs

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.groove.scenario import Scenario
    from dolfinrod.result import Result

    Array = NDArray[np.float64]

__all__ = ["Course", "course"]


@dataclass(frozen=True, eq=False)
class Course:
    """A bundle over the stored times.

    Args:
        t: Shape (n_t,) [s].
        width: Mean over X of the extent of the fibres' surfaces along Z, shape (n_t,) [m].
        T_pair: Twist by pairs, shape (n_t,) [turns/m].
        wound: Mean magnitude of the windings of pairs, shape (n_t,) [turns].
        walls: Normal force of groove and core on all fibres, shape (n_t,) [N].
        fibres: Normal force of fibres on one another, each meeting counted once, shape (n_t,) [N].
        speed: Largest speed of a node since the time before, zero at first, shape (n_t,) [m/s].
    """

    t: Array
    width: Array
    T_pair: Array
    wound: Array
    walls: Array
    fibres: Array
    speed: Array


def course(result: Result, scenario: Scenario) -> Course:
    """The course of a result.

    Args:
        result: Of the scenario, by either model.
        scenario: What was solved.

    Returns:
        One value a stored time; not a number where the fibres tell none.
    """
    n, rods = len(result.t), result.rods[: scenario.fibres]
    moved = [np.linalg.norm(np.diff(h.r, axis=0), axis=2).max(axis=1) / np.diff(result.t) for h in rods]
    winding = np.array([_winding(result, scenario, i) for i in range(n)])
    return Course(
        t=result.t,
        width=np.array([_width(result, scenario, i) for i in range(n)]),
        T_pair=winding[:, 0],
        wound=winding[:, 1],
        walls=np.sum([_pressed(result, k) for k in range(scenario.fibres)], axis=0),
        fibres=np.array([_met(result, scenario, i) for i in range(n)]),
        speed=np.append(0.0, np.max(moved, axis=0)),
    )


def _winding(result: Result, scenario: Scenario, i: int) -> tuple[float, float]:
    """T by pairs and the mean magnitude of windings; not numbers where fibres meet or points are too few."""
    if scenario.fibres == 1:
        return 0.0, 0.0
    try:
        found = pairs([scenario.unrolled(r) for r in centrelines(result, i, rods=range(scenario.fibres))])
    except ValueError:
        return np.nan, np.nan
    return found.T, float(np.abs(found.turns[np.triu_indices(scenario.fibres, 1)]).mean())


def _width(result: Result, scenario: Scenario, i: int) -> float:
    """Mean over the nodes, fibre beside fibre, whose meshes are alike."""
    z = np.stack([h.r[i, h.s >= scenario.bundle.tail, 2] for h in result.rods[: scenario.fibres]])
    return float(np.ptp(z, axis=0).mean() + 2.0 * scenario.bundle.radius)


def _pressed(result: Result, rod: int) -> Array:
    """Normal force of all walls on a fibre over time."""
    felt = [touching for history in result.contacts if (touching := history.rods[rod]) is not None]
    return np.asarray(sum((each.pressure @ each.share for each in felt), np.zeros(len(result.t))))


def _met(result: Result, scenario: Scenario, i: int) -> float:
    """Normal force between fibres."""
    total = 0.0
    for history in result.meetings:
        met = history.times[i]
        among = (met.rod_a < scenario.fibres) & (met.rod_b < scenario.fibres)
        total += float(np.einsum("ni,ni->n", met.force, met.normal)[among].sum())
    return total
