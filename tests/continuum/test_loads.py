"""Loads of every kind against closed forms, their histories, and rods beside each other."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import dolfinrod as dr
from tests.scenes import GENERAL, KIRCHHOFF, SKEW, Pose, both_kinematics, cantilever, differences, tip_loaded

MESH = {"elements": 8, "degree": 3}
SHEARED = dr.Section(EA=900.0, GA=(40.0, 30.0), GJ=0.7, EI=2.0)
inside = st.floats(0.08, 0.95)


def tip_deflection(*loads: object, kinematics: object, section: dr.Section = SHEARED) -> float:
    """Transverse displacement of the tip of a cantilever."""
    result = dr.solve(cantilever(SKEW.straight(section), *loads), kinematics=kinematics, **MESH)
    return float(SKEW.back(result.tip)[1])


@both_kinematics
@settings(max_examples=5)
@given(a=inside)
def test_small_force_inside(kinematics, a):
    F = 1e-5
    w = tip_deflection(dr.PointForce(SKEW.turned((0, F, 0)), a), kinematics=kinematics)
    assert w == pytest.approx(F * a**2 * (3 - a) / (6 * 2.0) + F * a / 40.0, rel=1e-8)


@both_kinematics
@settings(max_examples=5)
@given(a=inside)
def test_small_moment_inside(kinematics, a):
    M = 1e-5
    w = tip_deflection(dr.PointMoment(SKEW.turned((0, 0, M)), a), kinematics=kinematics)
    assert w == pytest.approx(M * a * (1 - a / 2) / 2.0, rel=1e-8)


@both_kinematics
@settings(max_examples=5)
@given(ends=st.tuples(inside, inside).map(sorted).filter(lambda ends: ends[1] - ends[0] > 0.1))
def test_small_line_force_between(kinematics, ends):
    q, (a, b) = 1e-5, ends
    w = tip_deflection(dr.LineForce(SKEW.turned((0, q, 0)), between=(a, b)), kinematics=kinematics)
    bending = q / (6 * 2.0) * (b**3 - a**3 - (b**4 - a**4) / 4)
    shear = q * (b**2 - a**2) / 2 / 40.0
    assert w == pytest.approx(bending + shear, rel=1e-8)


@both_kinematics
def test_loads_of_one_place_and_of_all_rods_add_up(kinematics):
    F = np.array(SKEW.turned((1.0, 4.0, 0)))
    whole = dr.solve(cantilever(SKEW.straight(GENERAL), dr.PointForce(F, "end")), kinematics=kinematics, **MESH)
    parts = [dr.PointForce(0.3 * F, 1.0), dr.PointForce(0.7 * F, "end", rod=0), dr.PointForce(0 * F, 0.5)]
    split = dr.solve(cantilever(SKEW.straight(GENERAL), *parts), kinematics=kinematics, **MESH)
    assert max(differences(split, whole).values()) <= 1e-10


@both_kinematics
def test_line_force_in_pieces_is_the_whole(kinematics):
    f = SKEW.turned((0.5, 3.0, 0))
    whole = cantilever(SKEW.straight(GENERAL), dr.LineForce(f))
    pieces = cantilever(
        SKEW.straight(GENERAL), dr.LineForce(f, between=(0, 0.25)), dr.LineForce(f, between=(0.25, 1.0))
    )
    a, b = (dr.solve(scene, kinematics=kinematics, **MESH) for scene in (whole, pieces))
    assert max(differences(a, b).values()) <= 1e-10


@both_kinematics
def test_in_a_plane_a_moment_may_follow_or_not(kinematics):
    rod = SKEW.straight(GENERAL)
    dead = cantilever(rod, dr.PointMoment(SKEW.turned((0, 0, 7.0)), "end"), dr.PointForce(SKEW.turned((0, 2, 0)), 0.5))
    following = replace(dead, loads=[dr.FollowerMoment((0, 0, 7.0), "end"), dead.loads[1]])
    a, b = (dr.solve(scene, kinematics=kinematics, **MESH) for scene in (dead, following))
    assert max(differences(a, b).values()) <= 1e-10


# Heavy cantilever, w L³/EI: tip position and moment at the clamp. Shooting, 11 digits; inextensible, then stretched.
HEAVY = [
    (KIRCHHOFF, 1.0, (0.9912463953466364, -0.12347140198335323), 0.4969333999307173),
    (KIRCHHOFF, 10.0, (0.6563537612385947, -0.7001997155143141), 3.7421911108715613),
    (KIRCHHOFF, 50.0, (0.24501475632057124, -0.9079171234772743), 9.528468520582255),
    (
        dr.Section(EA=1200.0, GA=500.0, GJ=0.7, EI=1.0),
        20.0,
        (0.4441248645514391, -0.8414546950361245),
        5.73220618971832,
    ),
]


@both_kinematics
@pytest.mark.parametrize(("section", "weight", "tip", "moment"), HEAVY)
def test_heavy_cantilever(section, weight, tip, moment, kinematics):
    dense = dr.Section(**{name: getattr(section, name) for name in ("EA", "GA", "GJ", "EI", "rigid")}, rhoA=0.5)
    weighed = cantilever(SKEW.straight(dense), dr.Gravity(SKEW.turned((0, -weight / 0.5, 0))))
    pressed = cantilever(SKEW.straight(section), dr.LineForce(SKEW.turned((0, -weight, 0))))
    a, b = (dr.solve(scene, elements=16, degree=4, kinematics=kinematics) for scene in (weighed, pressed))
    np.testing.assert_allclose(SKEW.back(a.tip), [*tip, 0.0], rtol=0, atol=1e-9 * max(1.0, weight))
    assert a.rods[0].m[-1, 0, 2] == pytest.approx(-moment, rel=1e-4)
    assert max(differences(a, b).values()) <= 1e-10


@both_kinematics
@pytest.mark.parametrize("force", [10.0, 500.0])
def test_load_steps_follow_the_histories(force, kinematics):
    table = ((0.0, 0.0), (0.02, 0.2), (0.3, 1.0), (1.0, 0.5))
    load = dr.PointForce(SKEW.turned((0, force, 0)), "end", history=table)
    result = dr.solve(cantilever(SKEW.straight(GENERAL), load), kinematics=kinematics, **MESH)
    if all(step.stable and step.cuts == 0 for step in result.log):
        np.testing.assert_array_equal(result.t, [0.0, 0.02, 0.3, 1.0])
    # Where the rod loses its stability or turns back, the stepping looks for another way before it goes on.
    assert {t for t, _ in table} <= set(result.t)
    for t, factor in table[1:]:
        alone = dr.solve(tip_loaded(GENERAL, factor * force), kinematics=kinematics, **MESH)
        assert np.linalg.norm(result.rods[0].r[list(result.t).index(t)] - alone.rods[0].r[-1]) <= 1e-10


@both_kinematics
def test_histories_of_all_kinds_meet_where_they_agree(kinematics):
    F = SKEW.turned((0, 6.0, 0))
    histories = [None, dr.Steady(), ((0, 0), (1, 2), (2, 1)), lambda t: t * t / 4]
    motion = dr.Static(t_end=2.0)
    results = [
        dr.solve(
            cantilever(SKEW.straight(GENERAL), dr.PointForce(F, "end", history=history), motion=motion),
            kinematics=kinematics,
            **MESH,
        )
        for history in histories
    ]
    for result in results[1:]:
        assert max(differences(result, results[0]).values()) <= 1e-10


def three_rods() -> tuple[list[dr.Rod], list[list[object]], list[int]]:
    """Rods that differ in shape, stiffness by a million and length by a hundred; loads and elements of each."""
    soft = dr.Section(EA=1e-3, GA=4e-4, GJ=1e-6, EI=(1e-6, 2e-6))
    short = Pose(SKEW.Q, np.array([1.0, 2.0, 3.0]))
    rods = [SKEW.straight(GENERAL), short.arc(soft, radius=0.02, angle=1.0), dr.Rod.curved(2.0, GENERAL, (1, 2, 3))]
    loads: list[list[object]] = [
        [dr.PointForce((3, -4, 5), "end"), dr.PointMoment((0.3, 0.4, 0.5), 0.4)],
        [dr.PointForce((0.0, 0.01, 0.005), "end"), dr.LineForce((0, 0, 0.2), between=(0.005, 0.015))],
        [dr.FollowerForce((0.1, 0.5, 0.2), "end"), dr.FollowerMoment((0.1, 0.2, 0.3), 1.0)],
    ]
    return rods, loads, [5, 3, 8]


def test_each_of_several_rods_answers_as_if_alone():
    rods, loads, elements = three_rods()
    every = [replace(load, rod=i) for i, own in enumerate(loads) for load in own]
    together = dr.solve(dr.Scene(rods, [dr.Clamp("start")], every), elements=elements, degree=3)
    for i, (rod, own, n) in enumerate(zip(rods, loads, elements, strict=True)):
        alone = dr.solve(cantilever(rod, *own), elements=n, degree=3, kinematics=dr.Spatial()).rods[0]
        here = together.rods[i]
        np.testing.assert_array_equal(here.s.shape, (3 * n + 1,))
        for name, scale in (
            ("r", rod.length),
            ("frames", 1.0),
            ("n", np.abs(alone.n).max()),
            ("m", np.abs(alone.m).max()),
        ):
            got, expected = getattr(here, name)[-1], getattr(alone, name)[-1]
            np.testing.assert_allclose(got, expected, rtol=0, atol=1e-10 * scale, err_msg=f"{name} of rod {i}")


@both_kinematics
def test_parallel_rods_in_one_plane_answer_alike(kinematics):
    rods = [SKEW.straight(GENERAL, start=(0, 0.1 * i, 0)) for i in range(3)]
    scene = dr.Scene(rods, [dr.Clamp("start")], [dr.PointForce(SKEW.turned((0, 5.0, 0)), "end")])
    result = dr.solve(scene, kinematics=kinematics, **MESH)
    first = SKEW.back(result.rods[0].r[-1])
    for i in (1, 2):
        np.testing.assert_allclose(SKEW.back(result.rods[i].r[-1]) - [0, 0.1 * i, 0], first, rtol=0, atol=1e-10)
