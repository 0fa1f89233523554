"""Supports that move: rotations beyond full turns, displacements, histories of their own."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import dolfinrod as dr
from tests.scenes import FLAT, GENERAL, SKEW, both_kinematics, cantilever, differences, force_in_space, largest

MESH = {"elements": 8, "degree": 4}


@settings(max_examples=5)
@given(axis=st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda v: np.linalg.norm(v) > 0.1), turns=st.floats(-3, 3))
def test_turning_the_only_support_turns_the_rod_as_a_whole(axis, turns):
    vector = 2 * np.pi * turns * np.array(axis) / np.linalg.norm(axis)
    arc = SKEW.arc(GENERAL, angle=1.0)
    scene = dr.Scene([arc], [dr.Prescribed("start", displacement=(0.1, 0.2, -0.3), rotation=vector)])
    rod = dr.solve(scene, elements=2, degree=2, kinematics=dr.Spatial()).rods[0]
    Q = rotation_about(vector)
    assert largest(rod.n[-1]) + largest(rod.m[-1]) <= 1e-9
    expected = (rod.r[0] - rod.r[0, 0]) @ Q.T + rod.r[0, 0] + [0.1, 0.2, -0.3]
    np.testing.assert_allclose(rod.r[-1], expected, rtol=0, atol=1e-10)
    np.testing.assert_allclose(rod.frames[-1], Q @ rod.frames[0], rtol=0, atol=1e-10)


def rotation_about(vector: np.ndarray) -> np.ndarray:
    """Rotation matrix of a rotation vector, by Rodrigues' formula."""
    angle = np.linalg.norm(vector)
    u = vector / angle if angle > 0 else np.eye(3)[0]
    K = np.array([[0, -u[2], u[1]], [u[2], 0, -u[0]], [-u[1], u[0], 0]])
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K


@pytest.mark.parametrize("turns", [0.5, 3.0, -3.0])
def test_twisting_a_rod_between_clamps_takes_the_torque_of_saint_venant(turns):
    # GJ so small that three turns stay below the torque at which a clamped rod writhes, 8.99 EI/L.
    section = dr.Section(EA=900.0, GA=400.0, GJ=0.3, EI=1.0)
    angle = 2 * np.pi * turns
    far = dr.Prescribed("end", displacement=(0, 0, 0), rotation=SKEW.turned((angle, 0, 0)))
    result = dr.solve(dr.Scene([SKEW.straight(section)], [dr.Clamp("start"), far]), elements=24, degree=3)
    rod = result.rods[0]
    np.testing.assert_allclose(rod.m[-1], [[0.3 * angle, 0, 0]] * len(rod.s), rtol=0, atol=1e-4 * abs(angle))
    np.testing.assert_allclose(rod.r[-1], rod.r[0], rtol=0, atol=1e-10)
    assert result.energy["strain"][-1] == pytest.approx(0.3 * angle**2 / 2, rel=1e-7)


@both_kinematics
@pytest.mark.parametrize("turns", [0.5, 1.5, 3.0])
def test_bending_by_a_prescribed_end_rotation_makes_circles(turns, kinematics):
    angle = 2 * np.pi * turns
    far = dr.Prescribed("end", rotation=SKEW.turned((0, 0, angle)))
    scene = dr.Scene([SKEW.straight(GENERAL)], [dr.Clamp("start"), far])
    rod = dr.solve(scene, elements=24, degree=3, kinematics=kinematics).rods[0]
    expected = np.stack([np.sin(angle * rod.s), 1 - np.cos(angle * rod.s), 0 * rod.s], axis=1) / angle
    np.testing.assert_allclose(SKEW.back(rod.r[-1]), expected, rtol=0, atol=1e-5)
    np.testing.assert_allclose(rod.m[-1], [[0, 0, 2 * angle]] * len(rod.s), rtol=0, atol=1e-3 * angle)


@both_kinematics
def test_a_turn_there_and_back_leaves_nothing(kinematics):
    table = ((0, 0), (1, 1), (3, -0.5), (4, 0))
    far = dr.Prescribed("end", rotation=SKEW.turned((0, 0, 3 * np.pi)), history=table)
    scene = dr.Scene([SKEW.straight(GENERAL)], [dr.Clamp("start"), far], motion=dr.Static(t_end=4.0))
    rod = dr.solve(scene, elements=12, degree=3, kinematics=kinematics).rods[0]
    np.testing.assert_allclose(rod.r[-1], rod.r[0], rtol=0, atol=1e-10)
    np.testing.assert_allclose(rod.frames[-1], rod.frames[0], rtol=0, atol=1e-10)


@both_kinematics
def test_prescribed_and_dead_answers_are_the_same(kinematics):
    """What a force does, its displacement does, and the support gives the force back."""
    F = np.array(SKEW.turned((-1.0, 6.0, 0)))
    loaded = dr.solve(cantilever(SKEW.straight(GENERAL), dr.PointForce(F, "end")), kinematics=kinematics, **MESH)
    far = dr.Prescribed("end", displacement=loaded.tip - loaded.rods[0].r[0, -1])
    moved = dr.solve(dr.Scene([SKEW.straight(GENERAL)], [dr.Clamp("start"), far]), kinematics=kinematics, **MESH)
    assert max(differences(moved, loaded).values()) <= 1e-9
    np.testing.assert_allclose(force_in_space(moved.rods[0], -1), F, rtol=0, atol=1e-9)


def test_prescribed_rotations_compose_in_the_order_listed():
    a, b = np.array([1.5, 0, 0]), np.array([0, 0, 2 * np.pi + 0.8])

    def frame_after(*rotations: np.ndarray) -> np.ndarray:
        supports = [dr.Prescribed("start", displacement=(0.1, 0, 0.05), rotation=v) for v in rotations]
        rod = dr.solve(
            dr.Scene([FLAT.straight(GENERAL)], supports), elements=1, degree=1, kinematics=dr.Spatial()
        ).rods[0]
        np.testing.assert_allclose(rod.r[-1, 0], [0.2, 0, 0.1], atol=1e-14)
        assert largest(rod.m[-1]) <= 1e-9
        return rod.frames[-1, 0]

    np.testing.assert_allclose(frame_after(a, b), rotation_about(b) @ rotation_about(a), atol=1e-12)
    np.testing.assert_allclose(frame_after(b, a), rotation_about(a) @ rotation_about(b), atol=1e-12)


@both_kinematics
def test_prescribed_parts_with_their_own_histories_add_up(kinematics):
    """One bends to half a circle while the other bends back, the end standing still in between."""
    θ = SKEW.turned((0, 0, np.pi))
    supports = [
        dr.Clamp("start"),
        dr.Prescribed("end", rotation=θ, history=((0, 0), (1, 1))),
        dr.Prescribed("end", rotation=θ, history=((0, 0), (1, -1), (2, -0.5))),
    ]
    scene = dr.Scene([SKEW.straight(GENERAL)], supports, motion=dr.Static(t_end=2.0))
    result = dr.solve(scene, elements=8, degree=3, kinematics=kinematics)
    rod, middle = result.rods[0], list(result.t).index(1.0)
    np.testing.assert_allclose(rod.r[middle], rod.r[0], atol=1e-10)
    np.testing.assert_allclose(rod.m[-1], [[0, 0, np.pi]] * len(rod.s), atol=1e-4)


@both_kinematics
def test_steady_and_growing_supports_end_the_same(kinematics):
    def solved(history: object) -> dr.Result:
        u, θ = SKEW.turned((-0.1, 0.2, 0)), SKEW.turned((0, 0, 1.0))
        supports = [dr.Clamp("start"), dr.Prescribed("end", displacement=u, rotation=θ, history=history)]
        return dr.solve(dr.Scene([SKEW.straight(GENERAL)], supports), kinematics=kinematics, **MESH)

    assert max(differences(solved(dr.Steady()), solved(None)).values()) <= 1e-9
