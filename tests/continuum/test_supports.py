"""Supports hold what they name and leave free what they leave free."""

from __future__ import annotations

import numpy as np
import pytest

import dolfinrod as dr
from tests.scenes import (
    FLAT,
    GENERAL,
    KIRCHHOFF,
    SKEW,
    Pose,
    both_kinematics,
    differences,
    force_in_space,
    largest,
)

MESH = {"elements": 8, "degree": 4}
# Guides name axes of space, so scenes with them are turned by exchanging the axes.
CYCLED = Pose(np.roll(np.eye(3), 1, axis=0), np.array([0.2, -0.4, 0.1]))
axis_aligned = pytest.mark.parametrize("pose", [FLAT, CYCLED], ids=["xyz", "yzx"])


def free(pose: Pose, names: str) -> frozenset[str]:
    """Components given by the scene's own axes, in space."""
    renamed = {c: "xyz"[int(np.argmax(np.abs(pose.Q[:, i])))] for i, c in enumerate("xyz")}
    return frozenset("".join(renamed.get(c, c) for c in name) for name in names.split())


def circle(s: np.ndarray, angle: float) -> np.ndarray:
    """A unit length bent to a circle through an angle, its chord along x, shape (n, 3)."""
    start = -angle / 2
    x, y = np.sin(start + angle * s) - np.sin(start), np.cos(start) - np.cos(start + angle * s)
    return np.stack([x, y, 0 * s], axis=1) / angle


@both_kinematics
@axis_aligned
@pytest.mark.parametrize("angle", [0.5, 3.0, 5.0])
def test_hinged_rod_under_end_moments_is_an_arc(angle, pose, kinematics):
    supports = [dr.Guide("start", free(pose, "rz")), dr.Guide("end", free(pose, "x rz"))]
    moment = np.array([0, 0, angle])
    loads = [dr.PointMoment(pose.turned(-moment), "start"), dr.PointMoment(pose.turned(moment), "end")]
    scene = dr.Scene([pose.straight(KIRCHHOFF)], supports, loads)
    rod = dr.solve(scene, kinematics=kinematics, **MESH).rods[0]
    np.testing.assert_allclose(pose.back(rod.r[-1]), circle(rod.s, angle), rtol=0, atol=1e-6 * angle**2)
    np.testing.assert_allclose(rod.m[-1], [[0, 0, angle]] * len(rod.s), rtol=0, atol=1e-3)
    assert largest(rod.n[-1]) <= 1e-9


@axis_aligned
@pytest.mark.parametrize("tilt", [0.0, 0.6, 1.5])
def test_two_free_rotations_hold_the_third_component_of_the_rotation_vector(tilt, pose):
    """Bending about any axis across the rod has a rotation vector without part along it."""
    supports = [dr.Guide("start", free(pose, "ry rz")), dr.Guide("end", free(pose, "x ry rz"))]
    axis = np.array([0.0, -np.sin(tilt), np.cos(tilt)])
    loads = [
        dr.PointMoment(pose.turned(-2.5 * axis), "start"),
        dr.PointMoment(pose.turned(2.5 * axis), "end"),
    ]
    scene = dr.Scene([pose.straight(KIRCHHOFF)], supports, loads)
    rod = dr.solve(scene, kinematics=dr.Spatial(), **MESH).rods[0]
    expected = circle(rod.s, 2.5) @ np.array(
        [[1, 0, 0], [0, np.cos(tilt), np.sin(tilt)], [0, -np.sin(tilt), np.cos(tilt)]]
    )
    np.testing.assert_allclose(pose.back(rod.r[-1]), expected, rtol=0, atol=1e-6)
    assert largest(rod.m[-1, :, 0]) <= 1e-9


@both_kinematics
def test_a_pin_transmits_no_moment(kinematics):
    supports = [dr.Clamp("start"), dr.Pin("end")]
    load = dr.PointForce(SKEW.turned((0, 30.0, 0)), 0.5)
    rod = dr.solve(
        dr.Scene([SKEW.straight(GENERAL)], supports, [load]), elements=16, degree=4, kinematics=kinematics
    ).rods[0]
    np.testing.assert_allclose(rod.r[-1, -1], rod.r[0, -1], rtol=0, atol=1e-14)
    assert largest(rod.m[-1, -1]) <= 1e-4 * largest(rod.m[-1])


@both_kinematics
@axis_aligned
def test_a_component_not_prescribed_carries_no_force(pose, kinematics):
    y = int(np.argmax(np.abs(pose.Q[:, 1])))
    far = dr.Prescribed("end", displacement=tuple(0.4 if i == y else None for i in range(3)))
    rod = dr.solve(dr.Scene([pose.straight(GENERAL)], [dr.Clamp("start"), far]), kinematics=kinematics, **MESH).rods[0]
    force = pose.Q.T @ force_in_space(rod, -1)
    assert pose.back(rod.r[-1])[-1, 1] == pytest.approx(0.4, abs=1e-14)
    assert force[1] > 1.0
    assert largest(force[[0, 2]]) <= 1e-9


@both_kinematics
@axis_aligned
def test_sliding_clamp_moved_sideways(pose, kinematics):
    """12 EI δ/L³ for a small δ: a guide holds the rotation, a prescribed displacement moves the same section."""
    y = int(np.argmax(np.abs(pose.Q[:, 1])))
    supports = [
        dr.Clamp("start"),
        dr.Guide("end", free={"x", "y", "z"}),
        dr.Prescribed("end", displacement=tuple(1e-5 if i == y else None for i in range(3))),
    ]
    rod = dr.solve(dr.Scene([pose.straight(KIRCHHOFF)], supports), kinematics=kinematics, **MESH).rods[0]
    np.testing.assert_allclose(pose.Q.T @ force_in_space(rod, -1), [0, 12e-5, 0], rtol=1e-7, atol=1e-12)
    np.testing.assert_allclose(rod.frames[-1, -1], rod.frames[0, -1], rtol=0, atol=1e-14)


@both_kinematics
@axis_aligned
def test_prop_inside_a_cantilever(pose, kinematics):
    """A prop at the middle of a cantilever takes 5/2 of a small tip force (force method)."""
    P = 1e-4
    supports = [dr.Clamp("start"), dr.Guide(0.5, free=free(pose, "x z rx ry rz"))]
    load = dr.PointForce(pose.turned((0, P, 0)), "end")
    rod = dr.solve(dr.Scene([pose.straight(KIRCHHOFF)], supports, [load]), kinematics=kinematics, **MESH).rods[0]
    prop, before, after = (int(np.argmin(np.abs(rod.s - s))) for s in (0.5, 0.4, 0.6))
    assert pose.back(rod.r[-1])[prop, 1] == pytest.approx(0.0, abs=1e-14)
    jump = force_in_space(rod, after) - force_in_space(rod, before)
    np.testing.assert_allclose(pose.Q.T @ jump, [0, 2.5 * P, 0], rtol=1e-6, atol=1e-9)


@pytest.mark.parametrize("held", ["y", "x z"])
def test_one_direction_held_in_a_plane_askew_to_the_axes(held):
    """The plane holds y and is turned about it; the rod and the held direction are askew to each other."""
    c = np.sqrt(0.5)
    across = np.array([c, 0, -c])
    direction, d2 = 0.6 * across + 0.8 * np.eye(3)[1], -0.8 * across + 0.6 * np.eye(3)[1]
    rod = dr.Rod.straight(1.0, GENERAL, start=(0.3, 0.1, -0.2), direction=direction, d2=d2)
    guide = dr.Guide("end", free=frozenset({"x", "y", "z", "rx", "ry", "rz"}).difference(held.split()))
    load = dr.PointForce(tuple(15.0 * d2 - 1.0 * direction), 0.5)
    scene = dr.Scene([rod], [dr.Clamp("start"), guide], [load])
    planar, spatial = (dr.solve(scene, elements=8, degree=4, kinematics=k) for k in (None, dr.Spatial()))
    assert planar.formulation.kinematics == "planar"
    gaps = differences(planar, spatial)
    assert gaps["r"] <= 1e-7
    assert gaps["n"] <= 1e-5
    moved = planar.tip - planar.rods[0].r[0, -1]
    kept, freed = (moved[1], moved @ across) if held == "y" else (moved @ across, moved[1])
    assert abs(kept) <= 1e-14
    assert abs(freed) > 0.005
    force = force_in_space(planar.rods[0], -1)
    assert abs(force @ across if held == "y" else force[1]) <= 1e-9


def test_two_places_may_hold_different_directions():
    c = np.sqrt(0.5)
    rod = dr.Rod.straight(1.0, GENERAL, direction=(c, c, 0))
    guides = [
        dr.Guide("end", free={"y", "z", "rx", "ry", "rz"}),
        dr.Guide(0.5, free={"x", "z", "rx", "ry", "rz"}),
    ]
    scene = dr.Scene([rod], [dr.Clamp("start"), *guides], [dr.PointForce((-1, 2, 0), "end")])
    result = dr.solve(scene, elements=4, degree=2)
    moved = result.rods[0].r[-1] - result.rods[0].r[0]
    assert abs(moved[-1, 0]) <= 1e-14
    assert abs(moved[4, 1]) <= 1e-14
