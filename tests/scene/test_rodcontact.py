"""Rods that touch rods: who may meet whom, what is refused, in which plane they stay, and the same from a file."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import discrete
import dolfinrod as dr
from dolfinrod.scene import SceneError, corners, detect, obstacle
from dolfinrod.scene.advice import Findings, advice
from dolfinrod.scene.door import admit
from dolfinrod.scene.toml import dumps, loads

ROUND = dr.Section.circle(diameter=0.01, E=1e9, G=4e8, density=1e3)
BARE = dr.Section(EA=1.0, GA=1.0, GJ=1.0, EI=1.0, rhoA=1.0)
ROD, SQUARE = dr.Rod.straight(1.0, ROUND), dr.Rod.straight(1.0, BARE)
ABOVE = dr.Rod.straight(1.0, ROUND, start=(0.0, 0.02, 0.0))
FLOOR, EACH_OTHER = dr.Contact(dr.Plane((0, -0.1, 0), (0, 1, 0))), dr.RodContact()


def test_contact_among_rods_is_tight_without_friction_and_of_all_unless_told() -> None:
    assert (EACH_OTHER.law, EACH_OTHER.friction, EACH_OTHER.rods) == (dr.Penalty.tight(), None, None)
    assert EACH_OTHER.among(3) == (0, 1, 2)
    assert dr.RodContact(rods=[2, 0]).among(3) == (0, 2)
    assert dr.RodContact(rods=[2, 0]) == dr.RodContact(rods=(0, 2))


kinds = st.lists(st.sampled_from([FLOOR, EACH_OTHER, replace(FLOOR, rod=0), dr.RodContact(rods=[1])]), max_size=6)


@given(kinds)
def test_walls_and_meetings_are_the_contacts_in_their_order(touched: list[dr.Contact | dr.RodContact]) -> None:
    scene = dr.Scene([ROD, ABOVE], contacts=touched)
    assert scene.contacts == tuple(touched)
    assert scene.walls == tuple(part for part in touched if isinstance(part, dr.Contact))
    assert scene.meetings == tuple(part for part in touched if isinstance(part, dr.RodContact))


def test_a_rod_may_touch_others_but_is_not_held_by_itself() -> None:
    scene = dr.Scene([ROD, ABOVE, SQUARE], contacts=[dr.RodContact(rods=[0, 1])])
    assert [scene.may_touch(k) for k in range(3)] == [True, True, False]
    assert not dr.Scene([ROD], contacts=[EACH_OTHER]).may_touch(0)
    assert not replace(scene, contacts=[dr.RodContact(rods=[0])]).may_touch(0)


def test_only_rods_that_others_may_hold_are_let_in_without_supports() -> None:
    pushed = [dr.PointForce((0, -1, 0), 0.5, rod=0)]
    held = dr.Scene([ABOVE, ROD], [dr.Clamp("start", rod=1)], pushed, [EACH_OTHER])
    admit(held, None, dr.Result)
    for nothing in ([], [dr.RodContact(rods=[0])]):
        with pytest.raises(SceneError, match=r"rods\[0\] is free to move along \(0, -1, 0\)"):
            admit(replace(held, contacts=nothing), None, dr.Result)


@pytest.mark.parametrize("motion", [dr.Static(), dr.Dynamic(1.0)])
def test_a_stiffer_law_is_advised_where_rods_go_through_one_another(motion: dr.Static | dr.Dynamic) -> None:
    scene = dr.Scene([ROD, ABOVE], [dr.Clamp("start")], contacts=[EACH_OTHER], motion=motion)
    told = advice(scene, Findings(0.5))
    assert "a stiffer RodContact.law" in told
    assert "contact that is softer" not in told
    assert "contact that is softer" not in advice(replace(scene, contacts=[]), Findings(0.5))


@pytest.mark.parametrize("solve", [partial(dr.solve, elements=2, degree=2), partial(discrete.solve, elements=4)])
def test_a_law_too_soft_for_what_is_thrown_is_told_as_such(solve: Callable[..., dr.Result]) -> None:
    fibre = dr.Section.ramie()
    held = dr.Rod.straight(2e-3, fibre, start=(0.0, 0.0, -1e-3), direction=(0, 0, 1))
    thrown = dr.Rod.straight(2e-3, fibre, start=(-1e-3, 2.2e-5, 0.0))
    scene = dr.Scene(
        [held, thrown],
        [dr.Clamp("start"), dr.Clamp("end")],
        contacts=[dr.RodContact(dr.Penalty(1e4))],
        velocities=[dr.Velocity((0.0, -3.0, 0.0), rod=1)],
        motion=dr.Dynamic(1e-5, 1e-6),
    )
    with pytest.raises(dr.NotConverged, match=r"half-way into one another, so RodContact\.law needs a larger eps_N"):
        solve(scene)
    assert solve(replace(scene, contacts=[dr.RodContact(dr.Penalty(1e7))])).t[-1] == pytest.approx(1e-5)


@pytest.mark.parametrize(
    ("motion", "apart"),
    [(dr.Static(), 0.0), (dr.Dynamic(1e-5, 1e-6), 0.0), (dr.Dynamic(1e-5, 1e-6), 3e-6)],
    ids=["one in the other", "one in the other, in motion", "across, in motion"],
)
@pytest.mark.parametrize("solve", [partial(dr.solve, elements=2, degree=2), partial(discrete.solve, elements=4)])
def test_rods_placed_in_one_another_are_told_as_such(solve: Callable[..., dr.Result], apart: float, motion) -> None:
    fibre = dr.Section.ramie()
    one = dr.Rod.straight(2e-3, fibre)
    other = dr.Rod.straight(2e-3, fibre, start=(0.0, apart, -1e2 * apart), direction=(1, 0, 3e5 * apart))
    load = dr.LineForce((0.0, -1e-3, 0.0), rod=1)
    scene = dr.Scene([one, other], [dr.Clamp("start")], [load], contacts=[dr.RodContact()], motion=motion)
    with pytest.raises(dr.NotConverged, match="rods begin half-way within one another: place them apart"):
        solve(scene)


@given(table=st.lists(st.floats(0.0, 9.0), min_size=1, max_size=3, unique=True).map(sorted))
def test_contact_among_rods_adds_no_corners(table: list[float]) -> None:
    load = dr.PointForce((0, 1, 0), "end", history=[(t, t) for t in table])
    assert corners(dr.Scene([ROD], [dr.Clamp("start")], [load], [EACH_OTHER])) == tuple(table)


def test_rods_in_one_plane_push_each_other_along_it() -> None:
    plane = dr.Scene([ROD, ABOVE], [dr.Clamp("start")], contacts=[EACH_OTHER, FLOOR])
    found = detect(plane)
    assert isinstance(found, dr.Planar)
    assert found.normal == (0.0, 0.0, 1.0)
    across = dr.Rod.straight(1.0, ROUND, start=(0.5, 0.02, -0.5), direction=(0, 0, 1))
    beside = dr.Rod.straight(1.0, ROUND, start=(0.0, 0.02, 1e-3))
    for other in (across, beside):
        crossed = replace(plane, rods=[ROD, other])
        assert detect(crossed) == dr.Spatial()
        assert obstacle(crossed, found) == "rods[1] does not lie in the plane with a principal axis along its normal"


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (
            lambda: dr.RodContact(dr.AugmentedLagrangian(1e5, 1e-9)),
            r"^RodContact\.law must be one of Penalty, SmoothPenalty, got AugmentedLagrangian\(",
        ),
        (lambda: dr.RodContact("tight"), r"^RodContact\.law must be one of Penalty, SmoothPenalty, got 'tight'$"),
        (
            lambda: dr.RodContact(friction=dr.CreepingCoulomb(0.3, 0.1)),
            r"^RodContact\.friction must be Coulomb or None, got CreepingCoulomb\(",
        ),
        (lambda: dr.RodContact(friction=0.3), r"^RodContact\.friction must be Coulomb or None, got 0\.3$"),
        (lambda: dr.RodContact(rods=0), r"^RodContact\.rods must be numbers of rods \(0, 1, …\) or None for all"),
        (lambda: dr.RodContact(rods=[]), r"^RodContact\.rods must be numbers of rods \(0, 1, …\) or None for all"),
        (lambda: dr.RodContact(rods=[0, 1, 0]), r"^RodContact\.rods must be numbers of rods, each named once, got"),
        (lambda: dr.RodContact(rods=[0, None]), r"^RodContact\.rods must be numbers of rods, each named once, got"),
        (lambda: dr.RodContact(rods=[0, -1]), r"^RodContact\.rods\[1\] must be the number of a rod .*, got -1$"),
        (
            lambda: dr.Scene([ROD, ABOVE], contacts=[FLOOR, dr.RodContact(rods=[1, 2])]),
            r"^contacts\[1\]\.rods\[1\] must be below 2, the number of rods, got 2$",
        ),
        (
            lambda: dr.Scene([ROD, SQUARE], contacts=[EACH_OTHER]),
            r"^rods\[1\]\.section\.radius must be given \[m\], since the rod may touch contacts\[0\], got None$",
        ),
        (lambda: dr.Scene([ROD], contacts=EACH_OTHER), r"^contacts must be a tuple, got RodContact\("),
    ],
)
def test_what_cannot_be_is_refused_in_words(make: Callable[[], object], message: str) -> None:
    with pytest.raises(SceneError, match=message):
        make()


def test_rods_that_are_left_out_need_no_radius_and_one_rod_may_touch_itself() -> None:
    assert dr.Scene([ROD, SQUARE], contacts=[dr.RodContact(rods=[0])]).meetings == (dr.RodContact(rods=[0]),)
    assert dr.Scene([ROD], contacts=[EACH_OTHER]).meetings == (EACH_OTHER,)


positive = st.floats(1e-9, 1e9)
laws = st.builds(dr.Penalty, positive, st.floats(-1.0, 1.0)) | st.builds(dr.SmoothPenalty, positive, positive)
frictions = st.none() | st.builds(dr.Coulomb, st.floats(0.0, 9.0), st.none() | positive)
among = st.none() | st.lists(st.integers(0, 2), min_size=1, unique=True)


@settings(max_examples=50)
@given(st.lists(st.builds(dr.RodContact, laws, frictions, among) | st.just(FLOOR), max_size=3))
def test_every_contact_among_rods_comes_back_equal(touched: list[dr.Contact | dr.RodContact]) -> None:
    scene = dr.Scene([ROD, ABOVE, ROD], contacts=touched)
    assert loads(dumps(scene)) == (scene, {})


FIBRES = """
[section.fibre.ramie]

[[rods]]
straight = { length = "40 mm" }
section = "fibre"

[[rods]]
straight = { length = "40 mm", start = [0, "30 um", 0] }
section = "fibre"

[[contacts]]
plane = { point = [0, "-1 mm", 0], normal = [0, 1, 0] }

[[contacts]]
rods = { law = "tight", friction.coulomb = { mu = 0.3, eps_T = "2e5 Pa" }, rods = [0, 1] }

[[contacts]]
[contacts.rods]
law.smooth_penalty = { eps_N = "20 kPa", foot = "10 um" }

[[contacts]]
rods = {}
"""


def test_contacts_among_rods_read_as_in_python() -> None:
    scene, _ = loads(FIBRES)
    assert scene.meetings == (
        dr.RodContact(dr.Penalty.tight(), dr.Coulomb(0.3, 2e5), (0, 1)),
        dr.RodContact(dr.SmoothPenalty(2e4, 1e-5)),
        dr.RodContact(),
    )
    assert scene.walls == (dr.Contact(dr.Plane((0, -1e-3, 0), (0, 1, 0))),)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("rods = {}", "rods = 1", r"^contacts\[3\]\.rods must be a table, got 1$"),
        (
            "rods = {}",
            "rods = {}\nlaw = 'paper'",
            r"^contacts\[3\]\.law must be left out here, and may stand in the table rods$",
        ),
        ("rods = {}", "rods = {}\nplane = {}", r"^contacts\[3\] must be one of plane, .*, rods, got plane, rods$"),
        ("rods = {}", "rodds = {}", r"^contacts\[3\]\.rodds is unknown; .*; did you mean rods\?$"),
        ('law = "tight"', 'law = "tigth"', r'^contacts\[1\]\.rods\.law must be "paper" or "tight", or .*mean tight\?$'),
        (
            'law = "tight"',
            "lay = 0",
            r"^contacts\[1\]\.rods\.lay is unknown; known are law, friction, rods; did you me",
        ),
        (
            'law = "tight"',
            "law.augmented_lagrangian = { eps_N = 1, tolerance = 1 }",
            r"^contacts\[1\]\.rods\.law\.augmented_lagrangian is unknown; known are penalty, smooth_penalty$",
        ),
        ("mu = 0.3", "mu = -0.3", r"^contacts\[1\]\.rods\.friction\.coulomb\.mu must not be negative, got -0\.3$"),
        ("[0, 1]", "[0, 2]", r"^contacts\[1\]\.rods\[1\] must be below 2, the number of rods, got 2$"),
        ("[0, 1]", "[0, 0]", r"^contacts\[1\]\.rods\.rods must be numbers of rods, each named once, got \[0, 0\]$"),
        ('"20 kPa"', '"20 kN"', r"^contacts\[2\]\.rods\.law\.smooth_penalty\.eps_N must be a quantity in N/m\*\*2"),
    ],
)
def test_a_table_that_cannot_be_is_refused_by_field(old: str, new: str, message: str) -> None:
    assert old in FIBRES
    with pytest.raises(SceneError, match=message):
        loads(FIBRES.replace(old, new))
