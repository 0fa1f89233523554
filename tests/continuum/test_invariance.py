"""What must not change the answer: where the scene stands, in which steps it is loaded, how it is written down."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import dolfinrod as dr
from tests.scenes import FLAT, GENERAL, SKEW, Pose, both_kinematics, cantilever, differences, largest, poses

DEAD_TABLE = ((0.0, 0.0), (0.5, 1.0), (1.0, 0.0))
MESH = {"elements": 6, "degree": 3}


def planar_scene(pose: Pose) -> dr.Scene:
    """Everything a plane can hold: an arc under dead and follower loads, its end moved and turned."""
    rod = pose.arc(GENERAL, radius=0.8, angle=1.5)
    loads = [
        dr.PointForce(pose.turned((1.0, -2.0, 0.0)), 0.5),
        dr.PointMoment(pose.turned((0, 0, 0.6)), 0.7),
        dr.FollowerForce((0.4, 0.9, 0), 0.8),
        dr.LineForce(pose.turned((0.3, 1.0, 0.0)), between=(0.2, 0.9)),
    ]
    end = dr.Prescribed("end", displacement=pose.turned((-0.1, 0.2, 0)), rotation=pose.turned((0, 0, 0.8)))
    return dr.Scene([rod], [dr.Clamp("start"), end], loads)


def spatial_scene(pose: Pose) -> dr.Scene:
    """The same kinds of loads out of every plane, on a rod with two bending stiffnesses."""
    rod = pose.arc(GENERAL, radius=0.8, angle=1.5)
    loads = [
        dr.PointForce(pose.turned((1.0, -2.0, 1.5)), "end"),
        dr.PointMoment(pose.turned((0.5, 0.2, 0.6)), 0.7),
        dr.FollowerForce((0.4, 0.9, -0.3), 0.8),
        dr.FollowerMoment((0.3, -0.2, 0.4), "end"),
        dr.LineForce(pose.turned((0.3, 1.0, -0.5)), between=(0.2, 0.9)),
    ]
    return cantilever(rod, *loads)


@cache
def at_rest(scene: Callable[[Pose], dr.Scene], kinematics: dr.Planar | dr.Spatial) -> dr.Result:
    """The answer where the scene's axes are those of space."""
    return dr.solve(scene(FLAT), kinematics=kinematics, **MESH)


def assert_turned_with(pose: Pose, result: dr.Result, still: dr.Result) -> None:
    """The answer at `pose` is the one at rest, carried along; strains and resultants are the same."""
    for moved, rod in zip(result.rods, still.rods, strict=True):
        reach = np.linalg.norm(pose.origin) + rod.s[-1]
        np.testing.assert_allclose(pose.back(moved.r[-1]), rod.r[-1], rtol=0, atol=1e-10 * reach)
        np.testing.assert_allclose(pose.Q.T @ moved.frames[-1], rod.frames[-1], rtol=0, atol=1e-10)
        for name in ("n", "m", "gamma", "kappa"):
            a, b = getattr(moved, name)[-1], getattr(rod, name)[-1]
            np.testing.assert_allclose(a, b, rtol=0, atol=1e-10 * reach * max(1.0, largest(b)))


@settings(max_examples=5)
@given(pose=poses())
@both_kinematics
def test_rigid_motion_of_a_planar_scene_moves_the_answer(kinematics, pose):
    moved = dr.solve(planar_scene(pose), kinematics=kinematics, **MESH)
    assert_turned_with(pose, moved, at_rest(planar_scene, kinematics))


@settings(max_examples=8)
@given(pose=poses())
def test_rigid_motion_of_a_spatial_scene_moves_the_answer(pose):
    assert_turned_with(pose, dr.solve(spatial_scene(pose), **MESH), at_rest(spatial_scene, dr.Spatial()))


SCENES = [
    pytest.param(planar_scene(SKEW), dr.Planar(), id="planar"),
    pytest.param(planar_scene(SKEW), dr.Spatial(), id="planar scene in space"),
    pytest.param(spatial_scene(SKEW), dr.Spatial(), id="spatial"),
]


@pytest.mark.parametrize(("scene", "kinematics"), SCENES)
def test_number_of_load_steps_does_not_matter(scene, kinematics):
    one = dr.solve(scene, kinematics=kinematics, **MESH)
    for steps in (8, 20):
        many = dr.solve(replace(scene, motion=dr.Static(steps=steps)), kinematics=kinematics, **MESH)
        assert many.statistics.load_steps == steps
        assert max(differences(many, one).values()) <= 1e-10


@pytest.mark.parametrize(("scene", "kinematics"), SCENES)
@pytest.mark.parametrize("steps", [None, 8])
def test_unloading_leads_back_to_the_start(steps, scene, kinematics):
    scene = replace(
        scene,
        supports=[replace(s, history=DEAD_TABLE) if isinstance(s, dr.Prescribed) else s for s in scene.supports],
        loads=[replace(load, history=DEAD_TABLE) for load in scene.loads],
        motion=dr.Static(steps=steps),
    )
    result = dr.solve(scene, kinematics=kinematics, **MESH)
    rod = result.rods[0]
    assert largest(rod.r[result.t == 0.5] - rod.r[0]) > 0.1
    assert largest(rod.r[-1] - rod.r[0]) <= 1e-10
    assert largest(rod.frames[-1] - rod.frames[0]) <= 1e-10
    assert largest(rod.n[-1]) <= 1e-9
    assert largest(rod.m[-1]) <= 1e-9


LOOP = {
    (1, 0, 0): ((0, 0), (1, 3), (2, 3), (3, 0), (4, 0)),
    (0, 1, 0): ((0, 0), (1, 0), (2, 4), (3, 4), (4, 0)),
    (0, 0, 1): ((0, 0), (1, 2), (2, -5), (3, 5), (4, 0)),
}


def test_a_loop_of_forces_in_space_leads_back_to_the_start():
    forces = [dr.PointForce(SKEW.turned(axis), "end", history=table) for axis, table in LOOP.items()]
    scene = cantilever(SKEW.arc(GENERAL, angle=1.0), *forces, motion=dr.Static(steps=12, t_end=4.0))
    rod = dr.solve(scene, **MESH).rods[0]
    assert largest(rod.r[6] - rod.r[0]) > 0.3
    assert largest(rod.r[-1] - rod.r[0]) <= 1e-10
    assert largest(rod.frames[-1] - rod.frames[0]) <= 1e-10


def test_the_order_of_forces_does_not_matter():
    early, late = ((0, 0), (0.5, 1), (1, 1)), ((0, 0), (0.5, 0), (1, 1))

    def solved(first: object, second: object) -> dr.Result:
        y = dr.PointForce(SKEW.turned((0, 3, 0)), "end", history=first)
        z = dr.PointForce(SKEW.turned((0, 0, 4)), "end", history=second)
        return dr.solve(cantilever(SKEW.straight(GENERAL), y, z, motion=dr.Static(steps=4)), **MESH)

    assert max(differences(solved(early, late), solved(late, early)).values()) <= 1e-10


RODS = {
    "straight": SKEW.straight(GENERAL),
    "arc": SKEW.arc(GENERAL, angle=2.0),
    "helix": dr.Rod.curved(1.0, GENERAL, (3.0, 1.0, 5.0), start=SKEW.placed((0, 0, 0)), pretwist=2.0),
}


@pytest.mark.parametrize("rod", RODS.values(), ids=RODS.keys())
def test_zero_load_does_not_drift(rod):
    scene = cantilever(rod, dr.PointForce((0, 0, 0), "end"), motion=dr.Static(steps=20))
    history = dr.solve(scene, **MESH).rods[0]
    assert len(history.r) == 21
    np.testing.assert_allclose(history.r[1:], history.r[[0] * 20], rtol=0, atol=1e-13)
    np.testing.assert_allclose(history.frames[1:], history.frames[[0] * 20], rtol=0, atol=1e-13)


@both_kinematics
@settings(max_examples=5)
@given(force=st.tuples(st.floats(-5, 5), st.floats(-5, 5)), angle=st.floats(0.1, 2.0))
def test_a_rod_may_be_parametrised_from_either_end(kinematics, force, angle):
    forth = SKEW.arc(GENERAL, angle=angle)
    end, frame = forth.centerline([forth.length])[0], forth.frames([forth.length])[0]
    back = dr.Rod.arc(1.0, angle, GENERAL, start=end, direction=-frame[:, 0], towards=frame[:, 1])
    load = dr.PointForce(SKEW.turned((*force, 0)), "end")
    a = dr.solve(cantilever(forth, load), kinematics=kinematics, **MESH)
    mirrored = dr.Scene([back], [dr.Clamp("end")], [replace(load, at="start")])
    b = dr.solve(mirrored, kinematics=kinematics, **MESH)
    np.testing.assert_allclose(b.rods[0].r[-1, ::-1], a.rods[0].r[-1], rtol=0, atol=1e-10)
    # The cut is seen from its other side (−m), with d1 and d3 reversed and d2 as it was.
    np.testing.assert_allclose(b.rods[0].m[-1, ::-1] * [1, -1, 1], a.rods[0].m[-1], rtol=0, atol=1e-9)


@both_kinematics
def test_units_do_not_matter(kinematics):
    """A fibre of 40 mm and 20 µm in SI units answers as one with L = EI = 1."""
    fibre, L = dr.Section.ramie(), 0.04
    EI = fibre.EI[0]
    relative = dr.Section(EA=fibre.EA * L**2 / EI, GA=fibre.GA[0] * L**2 / EI, GJ=fibre.GJ / EI, EI=1.0)

    def solved(section: dr.Section, length: float, unit: float) -> dr.Result:
        loads = [
            dr.PointForce(SKEW.turned((unit, 4 * unit, 0)), "end"),
            dr.PointMoment(SKEW.turned((0, 0, 2 * unit * length)), length / 2),
            dr.LineForce(SKEW.turned((0, 3 * unit / length, 0))),
        ]
        pose = Pose(SKEW.Q, SKEW.origin * length)
        return dr.solve(cantilever(pose.straight(section, length=length), *loads), kinematics=kinematics, **MESH)

    small, one = solved(fibre, L, EI / L**2), solved(relative, 1.0, 1.0)
    assert small.statistics.newton_iterations == one.statistics.newton_iterations
    a, b = small.rods[0], one.rods[0]
    np.testing.assert_allclose(a.r[-1] / L, b.r[-1], rtol=0, atol=1e-11)
    np.testing.assert_allclose(a.n[-1] * L**2 / EI, b.n[-1], rtol=0, atol=1e-9)
    np.testing.assert_allclose(a.m[-1] * L / EI, b.m[-1], rtol=0, atol=1e-9)
    assert small.energy["strain"][-1] * L / EI == pytest.approx(one.energy["strain"][-1], rel=1e-11)
