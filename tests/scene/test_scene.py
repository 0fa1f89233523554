"""Scenes: parts that fit together, places along rods, and what cannot be."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import FrozenInstanceError, replace

import pytest

import dolfinrod as dr
from dolfinrod.scene import SceneError

LIGHT = dr.Section(EA=1.0, GA=1.0, GJ=1.0, EI=1.0)
HEAVY = dr.Section(EA=1.0, GA=1.0, GJ=1.0, EI=1.0, rhoA=1.0)
SHORT, LONG = dr.Rod.straight(1.0, HEAVY), dr.Rod.straight(2.0, LIGHT)
UP = dr.PointForce((0, 0, 1), at="end")


def test_lists_are_stored_as_tuples_and_scenes_compare() -> None:
    scene = dr.Scene([SHORT], [dr.Clamp("start")], [UP])
    assert scene == dr.Scene((SHORT,), (dr.Clamp("start"),), (UP,))
    assert hash(scene) == hash(dr.Scene((SHORT,), (dr.Clamp("start"),), (UP,)))
    assert isinstance(scene.rods, tuple)
    assert scene.motion == dr.Static()


def test_a_scene_is_changed_by_making_another() -> None:
    scene = dr.Scene([SHORT])
    with pytest.raises(FrozenInstanceError):
        scene.rods = ()
    assert replace(scene, loads=[UP]).loads == (UP,)
    assert scene.loads == ()


def test_places_are_found_on_one_rod_or_on_every_rod() -> None:
    scene = dr.Scene([SHORT, LONG])
    assert scene.location("start", None) == [(0, 0.0), (1, 0.0)]
    assert scene.location("end", None) == [(0, 1.0), (1, 2.0)]
    assert scene.location("end", 1) == [(1, 2.0)]
    assert scene.location(0.5, None) == [(0, 0.5), (1, 0.5)]


def test_nodes_must_lie_where_something_is_held_or_acts() -> None:
    scene = dr.Scene(
        [SHORT, LONG],
        supports=[dr.Clamp("start"), dr.Pin(1.5, rod=1)],
        loads=[
            UP,
            dr.PointMoment((0, 0, 1), at=0.25),
            dr.LineForce((0, 0, 1), between=(0.5, 0.75), rod=0),
            dr.LineForce((0, 0, 1), rod=1),
        ],
    )
    assert scene.marks(0) == (0.0, 0.25, 0.5, 0.75, 1.0)
    assert scene.marks(1) == (0.0, 0.25, 1.5, 2.0)
    assert dr.Scene([SHORT], loads=[dr.LineForce((0, 0, 1))]).marks(0) == (0.0, 1.0)
    assert dr.Scene([HELIX], loads=[UP]).marks(0) == (HELIX.length,)


HELIX = dr.Rod.through([(1, 0, 0), (0, 1, 1), (-1, 0, 2), (0, -1, 3)], HEAVY)


def test_one_place_is_one_node_in_spite_of_round_off() -> None:
    places = (0.3, 0.1 + 0.2, 1e-17, 1.0 + 1e-15)
    scene = dr.Scene([SHORT], loads=[dr.PointForce((0, 0, 1), at=s) for s in places])
    assert scene.marks(0) == (0.0, 0.3, 1.0)


def test_prescribed_motions_at_one_place_compose() -> None:
    turns = [dr.Prescribed("end", rotation=(1, 0, 0)), dr.Prescribed("end", rotation=(0, 1, 0))]
    assert dr.Scene([SHORT], supports=turns).supports == tuple(turns)


def test_different_components_may_be_held_at_one_place() -> None:
    supports = (dr.Pin("end"), dr.Prescribed("end", rotation=(0, 0, 1)), dr.Clamp("start"))
    assert dr.Scene([SHORT, LONG], supports).supports == supports
    assert dr.Scene([SHORT, LONG], [dr.Clamp("end", rod=0), dr.Pin("end", rod=1)]).marks(1) == (2.0,)
    with pytest.raises(SceneError, match=r"supports\[3\] must not hold rx, ry, rz again at s = 2\.0 m of rod 1"):
        dr.Scene([SHORT, LONG], [*supports, dr.Guide("end", free={"x", "y", "z"}, rod=1)])


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: dr.Scene([]), r"rods must hold at least one rod, got none"),
        (lambda: dr.Scene(SHORT), r"rods must be a tuple, got Rod\("),
        (lambda: dr.Scene(["rod"]), r"rods\[0\] must be one of Rod, got 'rod'"),
        (
            lambda: dr.Scene([SHORT], [UP]),
            r"supports\[0\] must be one of Clamp, Pin, Guide, Prescribed, got PointForce",
        ),
        (lambda: dr.Scene([SHORT], loads=[dr.Clamp("end")]), r"loads\[0\] must be one of PointForce, .*, got Clamp"),
        (
            lambda: dr.Scene([SHORT], contacts=["floor"]),
            r"contacts\[0\] must be one of Contact, RodContact, got 'floor'",
        ),
        (lambda: dr.Scene([SHORT], air="still"), r"air must be Air or None, got 'still'"),
        (lambda: dr.Scene([SHORT], motion=None), r"motion must be Static or Dynamic, got None"),
        (
            lambda: dr.Scene([SHORT], loads=[UP, dr.PointForce((0, 0, 1), at=1.5)]),
            r"loads\[1\]\.at must lie on rod 0, between 0 and 1\.0 m, got 1\.5 m",
        ),
        (
            lambda: dr.Scene([LONG, SHORT], [dr.Pin(1.5)]),
            r"supports\[0\]\.at must lie on rod 1, between 0 and 1\.0 m, got 1\.5 m",
        ),
        (
            lambda: dr.Scene([SHORT], loads=[dr.LineForce((0, 0, 1), between=(0.5, 1.25))]),
            r"loads\[0\]\.between\[1\] must lie on rod 0, between 0 and 1\.0 m, got 1\.25 m",
        ),
        (
            lambda: dr.Scene([SHORT], loads=[dr.PointForce((0, 0, 1), at="end", rod=1)]),
            r"loads\[0\]\.rod must be below 1, the number of rods, got 1",
        ),
        (
            lambda: dr.Scene([SHORT, LONG], loads=[UP, dr.Gravity((0, 0, -9.81))]),
            r"rods\[1\]\.section\.rhoA must be given \[kg/m\], since loads\[1\] is Gravity, got None",
        ),
        (
            lambda: dr.Scene([SHORT], [dr.Clamp("start"), dr.Guide(0.0, free={"x", "rz"})]),
            r"supports\[1\] must not hold rx, ry, y, z again at s = 0\.0 m of rod 0: supports\[0\] does already",
        ),
        (
            lambda: dr.Scene([SHORT], [dr.Prescribed("end", (0, 1, 0)), dr.Pin("end")]),
            r"supports\[1\] must not hold x, y, z again at s = 1\.0 m of rod 0",
        ),
    ],
)
def test_what_cannot_be_is_refused_in_words(make: Callable[[], dr.Scene], message: str) -> None:
    with pytest.raises(SceneError, match=message):
        make()
