"""Measures of bundles whose twist, width and forces are known."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from dolfinrod.groove import Scenario, course, measure
from dolfinrod.result import Formulation, Result, RodHistory, Statistics

pytestmark = pytest.mark.serial

LENGTH, RADIUS = 0.04, 50e-6
PULL = 2e-4


def helix(phase: float, T: float, X: np.ndarray) -> np.ndarray:
    """A fibre on a cylinder of twist T [turns/m], shape (n, 3)."""
    θ = phase + 2.0 * np.pi * T * X
    return np.stack([X, RADIUS * np.cos(θ), RADIUS * np.sin(θ)], axis=1)


def twisted(T: float, fibres: int, phase: float = 0.0) -> tuple[Result, Scenario]:
    """A bundle that twists rigidly, as a result of two times: straight, and twisted."""
    scenario = Scenario(fibres=fibres)
    s = np.linspace(0.0, LENGTH, 81)
    rods = []
    for k in range(fibres):
        r = np.stack([helix(phase + 2.0 * np.pi * k / fibres, t, s) for t in (0.0, T)])
        frames, none = np.empty((2, 81, 3, 3)), np.zeros((2, 81, 3))
        for i in range(2):
            slope = np.gradient(r[i], s, axis=0)
            d1 = slope / np.linalg.norm(slope, axis=1)[:, None]
            d2 = np.cross([0.0, 0.0, 1.0], d1)
            d2 /= np.linalg.norm(d2, axis=1)[:, None]
            frames[i] = np.stack([d1, d2, np.cross(d1, d2)], axis=2)
        n = none + np.array([PULL, 0.0, 0.0])
        rods.append(RodHistory(s=s, r=r, frames=frames, gamma=none, kappa=none, n=n, m=none))
    formulation, statistics = Formulation("discrete", "spatial", {}, ()), Statistics(0, 0, 0, 0)
    result = Result(
        scenario.scene(), np.array([0.0, 1e-3]), tuple(rods), True, (), {}, statistics, formulation, contacts=()
    )
    return result, scenario


@pytest.mark.parametrize("T", [55.0, -55.0, 12.5])
def test_a_rigidly_twisted_bundle_has_its_twist(T):
    result, scenario = twisted(T, 5)
    found = measure(result, scenario)
    # Of fibres given by 80 elements, half a turn long each at most.
    assert found.T_pair == pytest.approx(T, rel=1e-6)
    assert found.T.pairs == pytest.approx(np.full(20, T), rel=1e-2)
    assert found.winding[np.triu_indices(5, 1)] == pytest.approx(np.full(10, T * LENGTH), rel=1e-6)
    assert found.wound == 10
    # Every pair is short of its turns by less than the half turn that is not yet a crossing.
    assert abs(found.T_crossed - T) < 0.5 / LENGTH
    assert {c.sign for c in found.crossings} == {int(np.sign(T))}
    assert found.along.tension == pytest.approx(np.full(20, PULL))
    assert found.along.spread == pytest.approx(np.full(20, RADIUS), rel=1e-3)


def test_a_bundle_that_turns_by_half_has_crossed():
    result, scenario = twisted(0.5 / LENGTH, 2)
    found = measure(result, scenario)
    assert found.crosses(2, 1)
    assert not measure(result, scenario, 0).crosses(2, 1)
    assert measure(result, scenario, 0).wound == 0


def test_an_angle_at_an_end_is_no_crossing():
    # Side by side at A, as in the ribbon.
    result, scenario = twisted(0.2 / LENGTH, 2, phase=0.5 * np.pi)
    turned = measure(result, scenario)
    assert turned.T_pair == pytest.approx(0.2 / LENGTH, rel=1e-6)
    assert turned.T_crossed == 0.0
    assert turned.wound == 0


def test_a_single_fibre_does_not_wind():
    result, scenario = twisted(10.0, 1)
    found = measure(result, scenario)
    assert (found.T_pair, found.wound, found.crossings, found.exchanges) == (0.0, 0, (), ())
    assert found.along.width == pytest.approx(np.full(20, 2.0 * scenario.bundle.radius), rel=1e-9)


def test_the_course_tells_the_same_over_time():
    result, scenario = twisted(25.0, 3)
    over = course(result, scenario)
    assert over.T_pair == pytest.approx([0.0, 25.0], rel=1e-6, abs=1e-9)
    assert over.wound == pytest.approx([0.0, 1.0], rel=1e-6, abs=1e-9)
    assert over.speed[0] == 0.0
    assert over.speed[1] == pytest.approx(2.0 * RADIUS / 1e-3, rel=1e-3)
    assert not over.walls.any()
    assert not over.fibres.any()


def test_fibres_that_tell_no_winding_leave_a_gap_in_the_course():
    result, scenario = twisted(10.0, 2)
    same = replace(result, rods=(result.rods[0], result.rods[0]))
    assert np.isnan(course(same, scenario).T_pair).all()
