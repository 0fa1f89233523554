"""Load stepping needs no hand: few steps, few iterations, the same end whatever the steps."""

from __future__ import annotations

from functools import partial

import numpy as np
import pytest

import discrete
import dolfinrod as dr
from tests.scenes import FLAT, KIRCHHOFF, SKEW, both_kinematics, cantilever

# Ibrahimbegović's helix, case E-SR-F50 of the references: tip at the full load.
HELIX_TIP = np.array([0.00480324964971212, 7.24968465382423e-05, -0.07644174175446661])


def helix(factor: float = 1.0, steps: int | None = None) -> dr.Scene:
    rod = dr.Rod.straight(length=10.0, section=dr.Section(EA=1e4, GA=1e4, GJ=100.0, EI=100.0))
    loads = [
        dr.PointForce((0.0, 0.0, 50.0 * factor), at="end"),
        dr.PointMoment((0.0, 0.0, 200.0 * np.pi * factor), at="end"),
    ]
    return dr.Scene([rod], [dr.Clamp("start")], loads, motion=dr.Static(steps=steps))


def rolled(turns: float) -> dr.Scene:
    return cantilever(FLAT.straight(KIRCHHOFF), dr.PointMoment((0.0, 0.0, 2.0 * np.pi * turns), at="end"))


@pytest.mark.slow
def test_ten_turns_of_helix_are_found_without_tuning():
    by_itself = dr.solve(helix(), elements=40, degree=4)
    assert by_itself.statistics.load_steps <= 40
    assert by_itself.statistics.newton_iterations <= 300
    np.testing.assert_allclose(by_itself.tip, HELIX_TIP, rtol=0, atol=1e-6)
    stepped = dr.solve(helix(steps=50), elements=40, degree=4)
    np.testing.assert_allclose(by_itself.rods[0].r[-1], stepped.rods[0].r[-1], rtol=0, atol=1e-9)


def test_a_lost_attempt_is_given_up_early():
    """At a tenth of the load the first attempts wander; each of them may cost a step's worth of iterations."""
    result = dr.solve(helix(0.1), elements=16, degree=3)
    attempts = sum(1 + step.cuts for step in result.log)
    assert attempts > result.statistics.load_steps
    assert result.statistics.newton_iterations <= 15 * attempts


@both_kinematics
@pytest.mark.parametrize("pose", [FLAT, SKEW], ids=["flat", "skew"])
def test_ten_turns_are_rolled_up_in_few_steps(pose, kinematics):
    moment = dr.PointMoment(pose.turned((0.0, 0.0, 20.0 * np.pi)), at="end")
    rod = pose.straight(KIRCHHOFF)
    result = dr.solve(cantilever(rod, moment), elements=80, degree=2, kinematics=kinematics)
    assert result.statistics.load_steps <= 3
    assert result.statistics.newton_iterations <= 60
    np.testing.assert_allclose(result.tip, rod.centerline(0.0), atol=2e-6)
    out_of_plane = (result.rods[0].r[-1] - rod.centerline(0.0)) @ pose.turned((0.0, 0.0, 1.0))
    assert np.abs(out_of_plane).max() <= 1e-14


@pytest.mark.parametrize("solve", [dr.solve, partial(discrete.solve, elements=80)], ids=["continuum", "discrete"])
@pytest.mark.parametrize("steps", [None, 3, 50])
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_strip_goes_the_way_it_is_pushed(side, steps, solve):
    """At 1.3 times its lateral buckling load, from where its mirror image is as good an equilibrium."""
    section = dr.Section(GJ=1.0, EI=(1.0, 20.0), rigid={"shear", "extension"})
    push = dr.PointForce((0.0, -5.557, 0.005557 * side), at="end")
    scene = cantilever(dr.Rod.straight(1.0, section), push, motion=dr.Static(steps=steps))
    result = solve(scene)
    assert result.log[-1].stable
    assert side * result.tip[2] == pytest.approx(0.373, abs=2e-3)


@both_kinematics
@pytest.mark.parametrize("degree", [2, 3])
def test_a_tip_load_of_5000_is_taken_at_once(kinematics, degree):
    scene = cantilever(FLAT.straight(KIRCHHOFF), dr.PointForce((0.0, 5000.0, 0.0), at="end"))
    result = dr.solve(scene, elements=16, degree=degree, kinematics=kinematics)
    assert result.statistics.load_steps == 1
    assert result.statistics.newton_iterations <= 8


@both_kinematics
def test_small_steps_are_extrapolated(kinematics):
    """From the second step on the last two states show where the next one is."""
    scene = cantilever(FLAT.straight(KIRCHHOFF), dr.PointForce((0.0, 10.0, 0.0), at="end"), motion=dr.Static(steps=20))
    result = dr.solve(scene, elements=8, kinematics=kinematics)
    early, late = result.log[0].iterations, [step.iterations for step in result.log[3:]]
    assert max(late) < early
    once = dr.solve(cantilever(*scene.rods, *scene.loads), elements=8, kinematics=kinematics)
    np.testing.assert_allclose(result.tip, once.tip, rtol=0, atol=1e-10)


@both_kinematics
def test_what_the_elements_cannot_tell_apart_is_refused(kinematics):
    with pytest.raises(dr.NotConverged, match=r"than the elements can tell apart.*more elements"):
        dr.solve(rolled(5.0), elements=4, degree=1, kinematics=kinematics)


def test_the_log_says_how_each_step_was_found():
    log = dr.solve(helix(0.1), elements=16, degree=3).log
    assert [step.t for step in log] == sorted({step.t for step in log})
    assert log[-1].t == 1.0
    assert log[0].cuts > 0
