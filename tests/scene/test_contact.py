"""Contacts of a scene: laws and friction belong to a surface, rods that touch are round, corners of all histories."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import dolfinrod as dr
from dolfinrod.scene import SceneError, corners, kinks

ROUND = dr.Section.circle(diameter=0.01, E=1e9, G=4e8, density=1e3)
BARE = dr.Section(EA=1.0, GA=1.0, GJ=1.0, EI=1.0, rhoA=1.0)
ROD, SQUARE = dr.Rod.straight(1.0, ROUND), dr.Rod.straight(1.0, BARE)
FLOOR = dr.Contact(dr.Plane())


def test_a_contact_is_tight_and_without_friction_unless_told() -> None:
    assert (FLOOR.law, FLOOR.friction, FLOOR.rod) == (dr.Penalty.tight(), None, None)
    assert FLOOR.history is None
    table = ((0.0, 0.0), (0.5, 1.0))
    moved = dr.Contact(dr.Plane(motion=dr.WallMotion((0, 0, 1), history=table)))
    assert moved.history == table


def test_a_rod_may_touch_what_concerns_it() -> None:
    scene = dr.Scene([ROD, SQUARE], contacts=[dr.Contact(dr.Plane(), rod=0)])
    assert [scene.may_touch(k) for k in range(2)] == [True, False]
    assert replace(scene, rods=[ROD, ROD], contacts=[FLOOR]).may_touch(1)
    assert not replace(scene, contacts=[]).may_touch(0)


tables = st.lists(st.floats(0.0, 9.0), min_size=1, max_size=3, unique=True).map(lambda ts: [(t, t) for t in sorted(ts)])


@given(load=tables, support=tables, wall=tables)
def test_corners_are_those_of_every_history(load: object, support: object, wall: object) -> None:
    scene = dr.Scene(
        [ROD],
        [dr.Clamp("start"), dr.Prescribed("end", (0, 1, 0), history=support)],
        [dr.PointForce((0, 1, 0), 0.5, history=load), dr.Gravity((0, 0, 1), history=np.sin)],
        [FLOOR, dr.Contact(dr.Plane(motion=dr.WallMotion(velocity=(1, 0, 0), history=wall)))],
    )
    parts = (scene.loads[0], scene.supports[1], scene.contacts[1])
    assert corners(scene) == tuple(sorted(set().union(*(kinks(part.history) for part in parts))))
    assert corners(replace(scene, supports=[], loads=[], contacts=[FLOOR])) == ()


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: dr.Contact("floor"), r"^Contact\.surface must be one of Plane, .*, got 'floor'$"),
        (
            lambda: dr.Contact(dr.Plane(), law="paper"),
            r"^Contact\.law must be one of Penalty, SmoothPenalty, AugmentedLagrangian, got 'paper'$",
        ),
        (
            lambda: dr.Contact(dr.Plane(), friction=0.64),
            r"^Contact\.friction must be one of Coulomb, CreepingCoulomb or None, got 0\.64$",
        ),
        (lambda: dr.Contact(dr.Plane(), rod=-1), r"^Contact\.rod must be the number of a rod .*, got -1$"),
        (lambda: dr.Scene([ROD], contacts=FLOOR), r"^contacts must be a tuple, got Contact\("),
        (
            lambda: dr.Scene([ROD], contacts=[dr.Plane()]),
            r"^contacts\[0\] must be one of Contact, RodContact, got Plane\(",
        ),
        (
            lambda: dr.Scene([ROD], contacts=[FLOOR, replace(FLOOR, rod=1)]),
            r"^contacts\[1\]\.rod must be below 1, the number of rods, got 1$",
        ),
        (
            lambda: dr.Scene([ROD, SQUARE], contacts=[FLOOR]),
            r"^rods\[1\]\.section\.radius must be given \[m\], since the rod may touch contacts\[0\], got None$",
        ),
        (
            lambda: dr.Scene([ROD], contacts=[replace(FLOOR, friction=dr.CreepingCoulomb(0.1, 0.1))]),
            r"^contacts\[0\]\.friction must not be CreepingCoulomb, since motion is Static: it acts against",
        ),
    ],
)
def test_what_cannot_be_is_refused_in_words(make: Callable[[], object], message: str) -> None:
    with pytest.raises(SceneError, match=message):
        make()


def test_rods_that_touch_nothing_need_no_radius_and_motions_may_creep() -> None:
    creeping = replace(FLOOR, rod=0, friction=dr.CreepingCoulomb(0.1, 0.1))
    scene = dr.Scene([ROD, SQUARE], contacts=[creeping], motion=dr.Dynamic(1.0))
    assert scene.contacts == (creeping,)
