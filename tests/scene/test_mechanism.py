"""What nothing holds is named: rigid motions that supports leave free, and the failures they lead to."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

import discrete
import dolfinrod as dr
from dolfinrod.scene.advice import Findings, advice
from dolfinrod.scene.door import admit
from dolfinrod.scene.mechanism import free_motions, overheld
from tests.scenes import both_kinematics

SECTION = dr.Section(EA=1e4, GA=1e4, GJ=1.0, EI=1.0)
ROD = dr.Rod.straight(length=1.0, section=SECTION)
ARC = dr.Rod.arc(radius=1.0, angle=1.0, section=SECTION)


def turn(*axes: str) -> tuple[str, ...]:
    """Sentences for free turns of the first rod."""
    return tuple(f"rods[0] is free to turn about {axis}" for axis in axes)


TABLE = [
    ((), ("rods[0] is held nowhere",)),
    ((dr.Clamp("start"),), ()),
    ((dr.Pin("start"),), turn("(1, 0, 0)", "(0, 1, 0)", "(0, 0, 1)")),
    ((dr.Pin("start"), dr.Pin("end")), turn("(1, 0, 0)")),
    ((dr.Guide("start", free={"rz"}),), turn("(0, 0, 1)")),
    ((dr.Guide("start", free={"x"}),), ("rods[0] is free to move along (1, 0, 0)",)),
    ((dr.Pin("start"), dr.Guide("end", free={"x", "ry", "rz"})), ()),
    ((dr.Prescribed("start", displacement=(0, 0, 0), rotation=(0, 0, 1)),), ()),
]


@pytest.mark.parametrize(("supports", "sentences"), TABLE)
def test_free_motions_are_named(supports, sentences):
    assert free_motions(dr.Scene([ROD], supports)) == sentences


def test_each_rod_answers_for_itself():
    scene = dr.Scene([ROD, ARC], [dr.Clamp("start", rod=0), dr.Pin("start", rod=1), dr.Pin("end", rod=1)])
    chord = np.asarray(ARC.centerline(ARC.length)) / np.linalg.norm(ARC.centerline(ARC.length))
    assert free_motions(scene) == (f"rods[1] is free to turn about ({chord[0]:.6g}, {chord[1]:.6g}, 0)",)


@given(seed=st.integers(0, 1000))
def test_a_rod_between_pins_turns_about_its_chord_wherever_it_lies(seed):
    turned = Rotation.random(random_state=seed).as_matrix()
    rod = dr.Rod.straight(length=2.0, section=SECTION, start=turned[:, 1], direction=turned[:, 0])
    (sentence,) = free_motions(dr.Scene([rod], [dr.Pin("start"), dr.Pin("end")]))
    axis = np.array([float(c) for c in sentence.split("(")[1].rstrip(")").split(",")])
    assert abs(axis @ turned[:, 0]) == pytest.approx(1.0, abs=1e-5)


@pytest.mark.parametrize("solve", [dr.solve, discrete.solve], ids=["continuum", "discrete"])
def test_a_failure_says_what_nothing_holds(solve):
    scene = dr.Scene([ROD], [], [dr.FollowerMoment((0, 1, 0), "end")])
    with pytest.raises(dr.NotConverged, match=r"Nothing holds the rods completely: rods\[0\] is held nowhere\. Try"):
        solve(scene, elements=4)


@pytest.mark.parametrize("load", [dr.Gravity((0, 0, -1)), dr.PointMoment((1, 0, 0), "end")])
def test_a_rod_that_may_touch_something_is_let_in_and_others_are_not(load):
    loose = dr.Scene([TOUCHING, TOUCHING], loads=[load])
    with pytest.raises(
        dr.SceneError, match=r"^supports must hold the rods, or loads balance: rods\[0\] is free to .*rods\[1\]"
    ):
        admit(loose, None, dr.Result)
    beside = replace(loose, contacts=[replace(FLOOR, rod=0)])
    with pytest.raises(dr.SceneError, match=r"^supports must hold the rods, or loads balance: rods\[1\] is free to "):
        admit(beside, None, dr.Result)
    admit(replace(loose, contacts=[FLOOR]), None, dr.Result)


RIGID = dr.Rod.straight(length=1.0, section=dr.Section(GJ=1.0, EI=1.0, rigid={"shear", "extension"}))


@both_kinematics
def test_a_rod_that_cannot_stretch_and_is_held_along_itself_twice_is_told(kinematics):
    """Its axial force is anything; let go along itself, or given an EA, it is solved."""
    scene = dr.Scene([RIGID], [dr.Clamp("start"), dr.Pin("end")], [dr.LineForce((0.0, -1.0, 0.0))])
    told = (
        "Likely an axial force that may be anything: rods[0] is straight, cannot stretch and is held along itself at 2 "
        "places. Try a section with its EA, not rigid"
    )
    with pytest.raises(dr.NotConverged, match=re.escape(told)):
        dr.solve(scene, elements=4, kinematics=kinematics)
    guided = replace(scene, supports=[dr.Clamp("start"), dr.Guide("end", free=("x", "ry", "rz"))])
    stretching = replace(
        scene, rods=[dr.Rod.straight(length=1.0, section=dr.Section(EA=1e4, GJ=1.0, EI=1.0, rigid={"shear"}))]
    )
    bent = replace(scene, rods=[dr.Rod.arc(radius=1.0, angle=1.0, section=RIGID.section)])
    for sound in (guided, stretching):
        assert dr.solve(sound, elements=4, kinematics=kinematics).converged
    for other in (guided, stretching, bent):
        assert overheld(other) == ()


FLOOR = dr.Contact(dr.Plane())
TOUCHING = dr.Rod.straight(length=1.0, section=dr.Section(EA=1e4, GA=1e4, GJ=1.0, EI=1.0, rhoA=1.0, radius=0.01))


def words(motion: dr.Static | dr.Dynamic, *contacts: dr.Contact, t: float = 0.5, clamped: bool = True) -> str:
    supports = [dr.Clamp("start")] if clamped else []
    return advice(dr.Scene([TOUCHING], supports, contacts=contacts, motion=motion), Findings(t=t))


def test_where_rods_touch_softer_contact_is_advised() -> None:
    softer = "contact that is softer (a smaller eps_N) or begins smoothly (SmoothPenalty)"
    for motion in (dr.Static(), dr.Dynamic(1.0)):
        assert softer in words(motion, FLOOR)
        assert softer not in words(motion)
    told = words(dr.Static(steps=5), FLOOR)
    assert all(way in told for way in ("Static(steps=10)", "Dynamic motion", "more elements"))
    assert words(dr.Static(steps=5)).startswith("The iteration did not settle. Try Static(steps=10), more elements, or")


def test_a_rod_that_nothing_holds_may_be_begun_where_it_touches() -> None:
    loose = words(dr.Static(), FLOOR, t=0.0, clamped=False)
    assert (
        "Likely a mechanism. Nothing holds the rods completely: rods[0] is held nowhere. Try more supports, to" in loose
    )
    assert "to begin where rods touch what holds them" in loose
    assert words(dr.Static(), t=0.0, clamped=False).endswith("Try more supports")
