"""Motion in time: steps, stored times and schemes, and what a load without history then does."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import inf, nan

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import dolfinrod as dr
from dolfinrod.scene import SceneError, factor, in_time
from dolfinrod.scene.advice import Findings, advice
from tests.scenes import GENERAL

ROD = dr.Rod.straight(1.0, dr.Section(EA=1.0, GA=1.0, GJ=1.0, EI=1.0, rhoA=1.0))
UP = (0.0, 0.0, 1.0)
finite = st.floats(-1e6, 1e6)
histories = st.sampled_from([None, dr.Steady(), ((0.0, 1.0), (0.5, 0.0)), np.sin])


def test_a_motion_says_what_it_was_given() -> None:
    assert dr.Dynamic(2) == dr.Dynamic(t_end=2.0, dt=None, scheme=dr.ImplicitEuler(), tol=None, output=None)
    assert dr.Dynamic(2, dt=1, output=[0, 1, 2]).output == (0.0, 1.0, 2.0)
    assert dr.Dynamic(2, output=np.linspace(0, 1, 3)).output == (0.0, 0.5, 1.0)
    assert dr.Dynamic(2, output=np.float32(0.5)).output == 0.5
    assert dr.Dynamic(2, scheme=dr.Midpoint()) != dr.Dynamic(2)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: dr.Dynamic(0.0), r"^Dynamic\.t_end must be positive, got 0\.0 s$"),
        (lambda: dr.Dynamic(inf), r"Dynamic\.t_end must be a finite number \[s\], got inf s"),
        (lambda: dr.Dynamic(1e-200), r"Dynamic\.t_end must lie between 1e-100 and 1e\+100, got 1e-200"),
        (lambda: dr.Dynamic(1.0, dt=-1.0), r"Dynamic\.dt must be positive, got -1\.0 s"),
        (lambda: dr.Dynamic(1.0, dt=1e-9), r"Dynamic\.dt must be at least t_end/1000000 = 1e-06 s, got 1e-09 s"),
        (lambda: dr.Dynamic(1.0, dt=5e-324), r"Dynamic\.dt must be at least t_end/1000000"),
        (lambda: dr.Dynamic(1.0, dt=0.1, tol=1e-3), r"Dynamic\.tol must be left out where dt is given, got 0\.001"),
        (lambda: dr.Dynamic(1.0, tol=0), r"Dynamic\.tol must be positive, got 0\.0"),
        (lambda: dr.Dynamic(1.0, tol=1.0), r"Dynamic\.tol must be below 1, got 1\.0"),
        (lambda: dr.Dynamic(1.0, scheme="midpoint"), r"Dynamic\.scheme must be ImplicitEuler\(\) or Midpoint\(\), got"),
        (
            lambda: dr.Dynamic(1.0, scheme=dr.Midpoint),
            r"Dynamic\.scheme must be ImplicitEuler\(\) or Midpoint\(\), got",
        ),
        (lambda: dr.Dynamic(1.0, output=0.0), r"Dynamic\.output must be positive, got 0\.0 s"),
        (
            lambda: dr.Dynamic(1.0, output=1e-9),
            r"Dynamic\.output must be at least t_end/1000000 = 1e-06 s, got 1e-09 s",
        ),
        (lambda: dr.Dynamic(1.0, output=[]), r"Dynamic\.output must be a time or times \[s\], got \[\]"),
        (lambda: dr.Dynamic(1.0, output="all"), r"Dynamic\.output must be a time or times \[s\], got 'all'"),
        (lambda: dr.Dynamic(1.0, output=True), r"Dynamic\.output must be a time or times \[s\], got True"),
        (lambda: dr.Dynamic(1.0, output=[0.5, 0.5]), r"Dynamic\.output must ascend between 0 and t_end = 1\.0 s, got"),
        (lambda: dr.Dynamic(1.0, output=[0.5, 1.5]), r"Dynamic\.output must ascend between 0 and t_end = 1\.0 s, got"),
        (lambda: dr.Dynamic(1.0, output=[-0.5]), r"Dynamic\.output must ascend between 0 and t_end = 1\.0 s, got"),
        (lambda: dr.Dynamic(1.0, output=[0, nan]), r"Dynamic\.output\[1\] must be a finite number \[s\], got nan s"),
    ],
)
def test_what_cannot_be_is_refused_in_words(make: Callable[[], object], message: str) -> None:
    with pytest.raises(SceneError, match=message):
        make()


def test_what_moves_has_a_mass_and_only_what_moves_starts_moving_or_is_dragged() -> None:
    moving, air = dr.Dynamic(1.0), dr.Air()
    with pytest.raises(SceneError, match=r"rods\[0\]\.section\.rhoA must be given \[kg/m\], since motion is Dynamic"):
        dr.Scene([dr.Rod.straight(1.0, GENERAL)], motion=moving)
    with pytest.raises(SceneError, match=r"velocities\[0\] must be left out, since motion is Static"):
        dr.Scene([ROD], velocities=[dr.Velocity()])
    with pytest.raises(SceneError, match=r"velocities\[0\]\.rod must be below 1, the number of rods, got 1"):
        dr.Scene([ROD], motion=moving, velocities=[dr.Velocity(rod=1)])
    with pytest.raises(SceneError, match=r"velocities\[0\] must be one of Velocity, got Gravity"):
        dr.Scene([ROD], motion=moving, velocities=[dr.Gravity(UP)])
    with pytest.raises(SceneError, match=r"air must be left out, since motion is Static"):
        dr.Scene([dr.Rod.straight(1.0, dr.Section.ramie())], air=air)
    with pytest.raises(SceneError, match=r"rods\[0\]\.section\.radius must be given \[m\], since air drags the rod"):
        dr.Scene([ROD], motion=moving, air=air)
    with pytest.raises(SceneError, match=r"^air must be Air or None, got 'wind'"):
        dr.Scene([ROD], motion=moving, air="wind")


@given(history=histories, t=st.floats(0.0, 2.0), t_end=st.floats(0.5, 2.0))
def test_a_load_without_history_is_steady_in_time_and_everything_else_is_as_it_was(
    history: object, t: float, t_end: float
) -> None:
    every = {"at": "end", "history": history}
    loads = [
        dr.PointForce(UP, **every),
        dr.PointMoment(UP, **every),
        dr.FollowerForce(UP, **every),
        dr.FollowerMoment(UP, **every),
        dr.LineForce(UP, history=history),
        dr.Gravity(UP, history=history),
    ]
    turned = dr.Prescribed("start", (0, 0, 1), history=history)
    scene = dr.Scene([ROD], [turned], loads, motion=dr.Dynamic(t_end))
    timed = in_time(scene)
    for load, before in zip(timed.loads, loads, strict=True):
        expected = 1.0 if history is None else factor(history, t, t_end)
        assert factor(load.history, t, t_end) == expected
        assert replace(load, history=history) == before
    assert factor(timed.supports[0].history, t, t_end) == factor(history, t, t_end)
    assert replace(timed, loads=loads) == scene
    assert in_time(timed) == timed


def test_a_resting_scene_keeps_its_proportional_loads() -> None:
    scene = dr.Scene([ROD], [dr.Clamp("start")], [dr.PointForce(UP, "end")])
    assert in_time(scene) is scene


@pytest.mark.parametrize(
    ("motion", "words"),
    [
        (dr.Dynamic(1.0, dt=0.01), "Try Dynamic(dt=0.005), more elements, or look at `.result`"),
        (dr.Dynamic(1.0), "Try a smaller Dynamic(tol=…), more elements, or look at `.result`"),
    ],
)
def test_advice_is_about_steps_in_time_and_not_about_what_nothing_holds(motion: dr.Dynamic, words: str) -> None:
    assert advice(dr.Scene([ROD], motion=motion), Findings(t=0.0)).startswith(words)
