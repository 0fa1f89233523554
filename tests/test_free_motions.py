"""Rigid motions that no support resists: neutral ones get a phase condition, others are followed or refused."""

from __future__ import annotations

from functools import partial

import numpy as np
import pytest

import discrete
import dolfinrod as dr

MODELS = {
    "planar": partial(dr.solve, elements=8, kinematics=dr.Planar((0.0, 0.0, 1.0))),
    "spatial": partial(dr.solve, elements=8, kinematics=dr.Spatial()),
    "discrete": partial(discrete.solve, elements=40),
}
IN_SPACE = {name: MODELS[name] for name in ("spatial", "discrete")}
SOFT = dr.Section(EA=1e4, GA=5e3, GJ=0.8, EI=1.0)
SLIDING = dr.Guide("end", free={"x", "rx", "ry", "rz"})


def both(models):
    return pytest.mark.parametrize("solve", models.values(), ids=models)


def straight(direction=(1.0, 0.0, 0.0), section=SOFT):
    return dr.Rod.straight(length=1.0, section=section, direction=direction)


def couple(moment):
    return [dr.PointMoment(moment, at="end"), dr.PointMoment(tuple(-m for m in moment), at="start")]


def phase_conditions(result):
    return [note for note in result.formulation.notes if "phase condition" in note]


@both(IN_SPACE)
def test_greenhills_rod_twists_between_its_pins(solve):
    compressed = dr.PointForce((-2.0, 0.0, 0.0), at="end")
    result = solve(dr.Scene([straight()], [dr.Pin("start"), SLIDING], [*couple((3.0, 0.0, 0.0)), compressed]))
    assert phase_conditions(result) == ["rods[0] is free to turn about (1, 0, 0): balanced, held by a phase condition"]
    np.testing.assert_allclose(result.rods[0].m[-1], np.tile([3.0, 0.0, 0.0], (len(result.rods[0].s), 1)), atol=1e-9)
    np.testing.assert_allclose(result.tip, [1.0 - 2.0 / 1e4, 0.0, 0.0], atol=1e-12)
    first, last = result.rods[0].frames[-1][[0, -1]]
    twist = np.arctan2(last[2, 1], last[1, 1]) - np.arctan2(first[2, 1], first[1, 1])
    # Section frames know the twist M L/GJ but for full turns.
    assert abs(np.exp(1j * (twist - 3.0 / 0.8)) - 1.0) < 1e-9


@both(IN_SPACE)
@pytest.mark.parametrize("direction", [(1.0, 0.0, 0.0), (0.6, 0.0, 0.8)])
def test_a_beam_between_pins_sags_in_space_as_in_its_plane(solve, direction):
    scene = dr.Scene([straight(direction)], [dr.Pin("start"), dr.Pin("end")], [dr.LineForce((0.0, -30.0, 0.0))])
    in_space = solve(scene)
    in_plane = dr.solve(scene, elements=8)
    assert in_plane.formulation.kinematics == "planar"
    assert len(phase_conditions(in_space)) == 1
    assert not phase_conditions(in_plane)
    middle = [result.rods[0].at(0.5)[-1] for result in (in_space, in_plane)]
    assert middle[1][1] < -0.05
    np.testing.assert_allclose(*middle, atol=1e-9 if in_space.formulation.model == "continuum" else 3e-4)


@both(MODELS)
def test_a_rod_that_nothing_holds_bends_to_an_arc_under_a_couple(solve):
    result = solve(dr.Scene([straight()], [], couple((0.0, 0.0, 2.0))))
    chord = np.linalg.norm(result.rods[0].r[-1, -1] - result.rods[0].r[-1, 0])
    assert chord == pytest.approx(np.sin(1.0), abs=1e-9 if result.formulation.model == "continuum" else 1e-4)
    assert len(phase_conditions(result)) == (3 if result.formulation.kinematics == "planar" else 6)


@both(MODELS)
@pytest.mark.parametrize("direction", [(1.0, 0.0, 0.0), (0.8, 0.6, 0.0), (-0.6, -0.8, 0.0)])
def test_a_pendulum_hangs_wherever_it_starts(solve, direction):
    result = solve(dr.Scene([straight(direction)], [dr.Pin("start")], [dr.LineForce((0.0, -30.0, 0.0))]))
    np.testing.assert_allclose(result.tip, [0.0, -1.0 - 30.0 / 2e4, 0.0], atol=1e-9)


@both(IN_SPACE)
def test_a_pendulum_swings_out_of_every_plane(solve):
    scene = dr.Scene([straight((0.3, 0.2, 0.9))], [dr.Pin("start")], [dr.LineForce((0.0, -30.0, 0.0))])
    np.testing.assert_allclose(solve(scene).tip, [0.0, -1.0 - 30.0 / 2e4, 0.0], atol=1e-9)


@both(IN_SPACE)
def test_a_torque_that_nothing_balances_is_refused_in_words(solve):
    scene = dr.Scene([straight()], [dr.Pin("start"), SLIDING], [dr.FollowerMoment((1.0, 0.0, 0.0), at="end")])
    with pytest.raises(dr.NotConverged, match=r"push a rod along a motion.*free to turn about \(1, 0, 0\)"):
        solve(scene)


@both(MODELS)
def test_a_rod_that_is_held_needs_no_phase_condition(solve):
    scene = dr.Scene([straight()], [dr.Clamp("start")], [dr.PointForce((0.0, 1.0, 0.0), at="end")])
    assert not phase_conditions(solve(scene))


@both(IN_SPACE)
def test_each_rod_has_its_own_phase_condition(solve):
    rods = [straight(), dr.Rod.straight(length=0.5, section=SOFT, start=(0.0, 0.0, 1.0), direction=(0.0, 1.0, 0.0))]
    supports = [dr.Clamp("start", rod=0), dr.Pin("start", rod=1), dr.Pin("end", rod=1)]
    loads = [dr.PointForce((0.0, 1.0, 0.0), at="end", rod=0), dr.LineForce((0.0, 0.0, -5.0), rod=1)]
    together = solve(dr.Scene(rods, supports, loads))
    assert phase_conditions(together) == [
        "rods[1] is free to turn about (0, 1, 0): balanced, held by a phase condition"
    ]
    alone = solve(dr.Scene(rods[:1], [dr.Clamp("start")], loads[:1]))
    np.testing.assert_allclose(together.rods[0].r[-1], alone.rods[0].r[-1], atol=1e-12)
