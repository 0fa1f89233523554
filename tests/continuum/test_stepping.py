"""Load stepping needs no hand: few steps, few iterations, the same end whatever the steps."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import discrete
import dolfinrod as dr
from tests.scenes import FLAT, GENERAL, KIRCHHOFF, SKEW, both_kinematics, cantilever

if TYPE_CHECKING:
    from collections.abc import Callable

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


def column(over: float, across: float, steps: int | None = None) -> dr.Scene:
    """Clamped at the foot, under so many times its Euler load π²/4 EI/L², a part of it across."""
    load = over * np.pi**2 / 4.0
    push = dr.PointForce((-load, across * load, 0.0), at="end")
    return cantilever(FLAT.straight(KIRCHHOFF), push, motion=dr.Static(steps=steps))


def strip(over: float, aside: float, steps: int | None = None) -> dr.Scene:
    """Under so many times its lateral buckling load (dr.critical: 4.2748 EI/L²): it bends in its plane all the way."""
    section = dr.Section(GJ=1.0, EI=(1.0, 20.0), rigid={"shear", "extension"})
    load = over * 4.2748
    push = dr.PointForce((0.0, -load, aside * load), at="end")
    return cantilever(FLAT.straight(section), push, motion=dr.Static(steps=steps))


def askew(load: float, aside: float, steps: int | None = None) -> dr.Scene:
    """Pushed in a plane on a guide that slides in another one, from 5.8 on it leaves the plane; a part goes aside."""
    c = np.sqrt(0.5)
    up, across, off = np.eye(3)[1], np.array([c, 0.0, -c]), np.array([c, 0.0, c])
    direction, d2 = 0.6 * across + 0.8 * up, -0.8 * across + 0.6 * up
    supports = [dr.Clamp("start"), dr.Guide("end", free={"x", "z", "rx", "ry", "rz"})]
    push = dr.PointForce(tuple(load * (d2 - direction / 15.0 + aside * off)), at=0.5)
    rod = dr.Rod.straight(1.0, GENERAL, direction=direction, d2=d2)
    return dr.Scene([rod], supports, [push], motion=dr.Static(steps=steps))


# Parts of a load that go aside: what is far beyond round-off, and hardly changes what is found.
asides = st.builds(lambda exponent, side: side * 10.0**exponent, st.floats(-6.0, -2.0), st.sampled_from([-1.0, 1.0]))


def assert_found_as_in_small_steps(scene: Callable[[int | None], dr.Scene], kinematics: dr.Planar | dr.Spatial | None):
    """The state under the whole load is stable, and the one to which small steps lead through stable ones."""
    once, followed = (dr.solve(scene(steps), elements=8, kinematics=kinematics) for steps in (None, 20))
    assert once.log[-1].stable
    assert all(step.stable for step in followed.log)
    np.testing.assert_allclose(once.rods[0].r[-1], followed.rods[0].r[-1], rtol=0, atol=1e-7)
    assert once.statistics.load_steps <= 5
    assert once.statistics.newton_iterations < followed.statistics.newton_iterations


@both_kinematics
@given(over=st.floats(1.05, 8.0), across=asides)
@settings(max_examples=5)
def test_past_its_euler_load_a_column_is_found_where_small_steps_lead(over, across, kinematics):
    assert_found_as_in_small_steps(lambda steps: column(over, across, steps), kinematics)


@given(over=st.floats(1.02, 2.0), aside=asides)
@settings(max_examples=5)
def test_past_its_lateral_load_a_strip_is_found_where_small_steps_lead(over, aside):
    assert_found_as_in_small_steps(lambda steps: strip(over, aside, steps), dr.Spatial())


@given(load=st.floats(6.5, 20.0), aside=asides)
@settings(max_examples=5)
def test_a_rod_pushed_off_its_plane_is_found_where_small_steps_lead(load, aside):
    assert_found_as_in_small_steps(lambda steps: askew(load, aside, steps), dr.Spatial())


@given(load=st.floats(6.5, 20.0))
@settings(max_examples=3)
def test_a_rod_pushed_in_its_plane_stays_there(load):
    """As in small steps: nothing shows to which side it should leave."""
    result = dr.solve(askew(load, 0.0), elements=8, kinematics=dr.Spatial())
    assert not result.log[-1].stable
    np.testing.assert_allclose(result.rods[0].r[-1] @ [1.0, 0.0, 1.0], 0.0, rtol=0, atol=1e-12)


@both_kinematics
@pytest.mark.parametrize("across", [1e-2, 1e-3, -1e-5])
@pytest.mark.parametrize("over", [1.5, 4.0])
def test_past_its_euler_load_a_column_takes_one_step(over, across, kinematics):
    result = dr.solve(column(over, across), elements=8, kinematics=kinematics)
    assert result.statistics.load_steps == 1
    assert result.statistics.newton_iterations <= 12


@both_kinematics
def test_a_column_pushed_by_nothing_but_round_off_stays_straight(kinematics):
    result = dr.solve(column(1.5, 1e-14), elements=8, kinematics=kinematics)
    assert not result.log[-1].stable
    assert abs(result.tip[1]) <= 1e-12


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
