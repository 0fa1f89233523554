"""What no solver begins with: no scene, no result to start from, and loads that push a rod along a free translation."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import discrete
import dolfinrod as dr
from dolfinrod.scene import SceneError
from dolfinrod.scene.balance import pushed_away
from dolfinrod.scene.door import admit
from dolfinrod.scene.mechanism import turned_away
from tests.scenes import GENERAL, poses

ROD = dr.Rod.straight(2.0, dr.Section(EA=1.0, GA=1.0, GJ=1.0, EI=1.0, rhoA=0.5))
SLIDE = dr.Guide("start", free={"x"})
UP = (0.0, 3.0, 0.0)
DOWN = (0.0, -3.0, 0.0)
AWAY = "rods[0] is free to move along {}, and its loads push it there with {} N"
both = pytest.mark.parametrize("solve", [dr.solve, discrete.solve], ids=["continuum", "discrete"])

PUSHED = [
    ([], [dr.PointForce(UP, "end")], AWAY.format("(0, 1, 0)", 3)),
    ([], [dr.LineForce((0, 0, -4), (0.5, 1.0))], AWAY.format("(0, 0, -1)", 2)),
    ([], [dr.Gravity((0, 0, -10))], AWAY.format("(0, 0, -1)", 10)),
    ([], [dr.Gravity((0, 0, -10)), dr.PointForce((0, 0, 9), "start")], AWAY.format("(0, 0, -1)", 1)),
    ([SLIDE], [dr.PointForce((3, 4, 0), "end")], AWAY.format("(1, 0, 0)", 3)),
    ([dr.Guide("end", free={"x", "y"})], [dr.PointForce((3, 4, 5), "end")], AWAY.format("(0.6, 0.8, 0)", 5)),
    ([dr.Prescribed("end", (None, 1, 1))], [dr.PointForce((1, 1, 1), "end")], AWAY.format("(1, 0, 0)", 1)),
    ([], [dr.PointForce(UP, "end"), dr.FollowerForce((0, 0, 1), 1.0)], AWAY.format("(0, 1, 0)", 2)),
    (
        [],
        [dr.FollowerForce(UP, "end")],
        "rods[0] is free to move everywhere, and nothing balances its follower force of 3 N",
    ),
    (
        [],
        [dr.PointForce(UP, 1.0), dr.PointForce(DOWN, "end", history=[(0, 0), (0.5, 1), (1, 1)])],
        AWAY.format("(0, -1, 0)", 1.5) + " at t = 0.5",
    ),
]
BALANCED = [
    ([], []),
    ([], [dr.PointForce(UP, "start"), dr.PointForce(DOWN, "end")]),
    (
        [],
        [dr.PointForce((0, 0.1, 0), "end", history=dr.Steady())] * 3
        + [dr.PointForce((0, -0.3, 0), 1.0, history=dr.Steady())],
    ),
    ([], [dr.PointMoment(UP, "end"), dr.FollowerMoment(UP, "start")]),
    ([], [dr.FollowerForce(UP, "start"), dr.FollowerForce(UP, "end")]),
    ([], [dr.FollowerForce(UP, "start"), dr.PointForce(UP, "end")]),
    ([SLIDE], [dr.FollowerForce(UP, "end")]),
    ([SLIDE], [dr.PointForce(UP, "end")]),
    ([SLIDE, dr.Prescribed("end", (0.1, None, None))], [dr.PointForce((1, 0, 0), 1.0)]),
    ([dr.Pin(1.0)], [dr.PointForce(UP, "end")]),
    ([], [dr.PointForce((0, 1e300, 0), "end")] * 2 + [dr.PointForce((0, -1e300, 0), "end")] * 2),
]


@pytest.mark.parametrize(("supports", "loads", "sentence"), PUSHED)
def test_a_push_along_a_free_translation_is_named(supports, loads, sentence):
    assert pushed_away(dr.Scene([ROD], supports, loads)) == (sentence,)


@pytest.mark.parametrize(("supports", "loads"), BALANCED)
def test_what_may_be_balanced_is_left_to_the_solver(supports, loads):
    assert pushed_away(dr.Scene([ROD], supports, loads)) == ()


def test_each_rod_answers_for_itself():
    scene = dr.Scene(
        [ROD, ROD, ROD], [dr.Clamp("start", rod=1)], [dr.PointForce(UP, "end"), dr.PointForce(DOWN, 1.0, 2)]
    )
    assert pushed_away(scene) == (AWAY.format("(0, 1, 0)", 3),)


@given(pose=poses(), shares=st.lists(st.floats(0.1, 1e6), min_size=1, max_size=6))
def test_forces_that_sum_up_to_nothing_do_not_push_wherever_the_rod_lies(pose, shares):
    forces = [pose.turned((0, share, -share)) for share in shares]
    last = tuple(float(c) for c in -np.sum(forces, axis=0))
    loads = [dr.PointForce(force, "end") for force in forces]
    rod = pose.straight(GENERAL)
    assert pushed_away(dr.Scene([rod], [], [*loads, dr.PointForce(last, "start")])) == ()
    (sentence,) = pushed_away(dr.Scene([rod], [], loads))
    assert sentence.endswith(f"with {np.linalg.norm(last):.6g} N")


@both
def test_a_scene_without_equilibrium_is_refused_at_the_door(solve):
    scene = dr.Scene([ROD], [SLIDE], [dr.PointForce((3, 4, 0), "end")])
    words = f"supports must hold the rods, or loads balance: {AWAY.format('(1, 0, 0)', 3)}"
    with pytest.raises(SceneError, match=re.escape(words)):
        solve(scene, elements=4)


@pytest.mark.parametrize(
    ("supports", "loads"),
    [([], [dr.PointForce(UP, "end")]), ([SLIDE], [dr.Gravity((3, 4, 0))]), ([], [dr.PointMoment((0, 0, 2), "end")])],
)
def test_mass_resists_a_push_and_a_turn(supports, loads):
    resting = dr.Scene([ROD], supports, loads)
    with pytest.raises(SceneError, match="supports must hold the rods, or loads balance"):
        admit(resting, None, dr.Result)
    admit(replace(resting, motion=dr.Dynamic(1.0)), None, dr.Result)


@both
@pytest.mark.parametrize("thing", [None, "scene.toml", [ROD], dr.Scene, [10**5000]])
def test_what_is_no_scene_is_refused(solve, thing):
    with pytest.raises(SceneError, match=r"^scene must be a Scene, got "):
        solve(thing)


@both
@pytest.mark.parametrize("thing", ["result", 1.0, np.zeros(3), False])
def test_what_is_no_result_is_no_start(solve, thing):
    with pytest.raises(SceneError, match=r"^start must be a Result or None, got "):
        solve(dr.Scene([ROD], [dr.Clamp("start")]), elements=2, start=thing)


SLIDING = dr.Guide("end", free={"x", "rx", "ry", "rz"})
TURNED = "rods[0] is free to turn about {}, and its loads turn it with {} N m"


@pytest.mark.parametrize(
    ("supports", "loads", "sentence"),
    [
        ([], [dr.PointMoment((0, 0, 2), "end")], TURNED.format("(0, 0, 1)", 2)),
        ([dr.Pin("start")], [dr.PointMoment((3, 4, 0), "end")], TURNED.format("(0.6, 0.8, 0)", 5)),
        ([dr.Pin("start"), SLIDING], [dr.PointMoment((1, 7, 0), "end")], TURNED.format("(1, 0, 0)", 1)),
        (
            [dr.Pin("start"), SLIDING],
            [
                dr.PointMoment((1, 0, 0), "end"),
                dr.PointMoment((-1, 0, 0), "start", history=[(0, 0), (0.25, 1), (1, 1)]),
            ],
            TURNED.format("(1, 0, 0)", 0.75) + " at t = 0.25",
        ),
    ],
)
@both
def test_a_dead_moment_about_a_free_axis_is_named(solve, supports, loads, sentence):
    scene = dr.Scene([ROD], supports, loads)
    assert turned_away(scene) == (sentence,)
    with pytest.raises(SceneError, match=re.escape(sentence)):
        solve(scene, elements=4)


@pytest.mark.parametrize(
    ("supports", "loads"),
    [
        ([dr.Clamp("start")], [dr.PointMoment((1, 2, 3), "end")]),
        ([dr.Pin("start"), SLIDING], [dr.PointMoment((0, 2, 3), "end")]),
        ([dr.Pin("start"), SLIDING], [dr.PointMoment((1, 0, 0), "end"), dr.PointMoment((-1, 0, 0), "start")]),
        # A rod that sags has a lever arm for its weight.
        ([dr.Pin("start"), dr.Pin("end")], [dr.PointMoment((1, 0, 0), "end"), dr.Gravity((0, 0, -9.81))]),
        # A follower moment turns with its section.
        ([dr.Pin("start")], [dr.FollowerMoment((0, 0, 1), "end")]),
        # An end that slides across takes the line through both places along.
        ([dr.Pin("start"), dr.Guide("end", free={"y", "rx", "ry", "rz"})], [dr.PointMoment((1, 0, 0), "end")]),
    ],
)
def test_moments_that_may_be_balanced_are_left_to_the_solver(supports, loads):
    assert turned_away(dr.Scene([ROD], supports, loads)) == ()
