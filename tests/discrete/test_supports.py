"""Sections that are pinned, guided, hinged, moved and turned, anywhere along a rod."""

from __future__ import annotations

import numpy as np
import pytest

import discrete
from dolfinrod.scene import Clamp, Guide, Pin, PointForce, PointMoment, Prescribed, Rod, Scene, Steady
from tests.scenes import GENERAL, KIRCHHOFF


def test_beam_with_supports_and_loads_between_its_ends():
    """Small load P at a quarter of a beam on three supports: three-moment equation, M_2 = 3 P L/64 a span of L/2."""
    P = 1e-3
    scene = Scene(
        [Rod.straight(1.0, KIRCHHOFF)],
        [
            Pin("start"),
            Guide("start", free={"x", "y", "z", "ry", "rz"}),
            Guide(0.5, free={"x", "rx", "ry", "rz"}),
            Guide("end", free={"x", "rx", "ry", "rz"}),
        ],
        [PointForce((0.0, -P, 0.0), 0.25)],
    )
    h = discrete.solve(scene, elements=8).rods[0]
    assert {0.0, 0.25, 0.5, 1.0} <= set(h.s)
    middle = int(np.flatnonzero(h.s == 0.5)[0])
    assert h.m[-1, middle, 2] == pytest.approx(-3 / 64 * P, rel=1e-4)
    assert h.r[-1, middle, 1] == pytest.approx(0.0, abs=1e-15)


def test_hinge_and_slider_turn_about_their_axes_only():
    scene = Scene(
        [Rod.straight(1.0, GENERAL)],
        [Guide("start", free={"rz"}), Guide("end", free={"x", "ry", "rz"})],
        [PointForce((0.0, 20.0, 9.0), 0.4), PointMoment((0.5, 0.4, 0.3), "end")],
    )
    result = discrete.solve(scene, elements=20)
    assert result.statistics.newton_iterations <= 8
    h = result.rods[0]
    start, end = h.frames[-1, 0], h.frames[-1, -1]
    assert start[:, 2] == pytest.approx([0.0, 0.0, 1.0], abs=1e-12)
    # The rotation vector of the end has no component along x: its axis lies in the plane y-z.
    axial = np.array([end[2, 1] - end[1, 2], end[0, 2] - end[2, 0], end[1, 0] - end[0, 1]])
    assert axial[0] == pytest.approx(0.0, abs=1e-10)
    assert np.abs(axial[1:]).min() > 1e-3
    assert h.r[-1, -1, 1:] == pytest.approx([0.0, 0.0], abs=1e-14)


@pytest.mark.parametrize("turns", [1, 3])
def test_prescribed_rotations_go_beyond_a_turn(turns):
    """An end turned about the axis carries the torque GJ·angle, an end bent round the moment EI·angle."""
    angle = 2 * np.pi * turns
    for rotation, expected in (((angle, 0, 0), (0.7 * angle, 0, 0)), ((0, 0, angle), (0, 0, 2.0 * angle))):
        free = {"x", "y", "z"} if rotation[2] else {"x"}
        held = [Clamp("start"), Prescribed("end", rotation=rotation)]
        if not rotation[2]:
            held.append(Guide("end", free={*free, "rx", "ry", "rz"}))
        h = discrete.solve(Scene([Rod.straight(1.0, GENERAL)], held), elements=24).rods[0]
        assert h.m[-1] == pytest.approx(np.tile(expected, (25, 1)), abs=1e-8)
        assert h.frames[-1, -1] == pytest.approx(np.eye(3), abs=1e-12)


def test_prescribed_motions_at_one_place_compose_in_order():
    quarter = np.pi / 2
    held = [
        Clamp("start"),
        Prescribed("end", displacement=(-0.5, 0.2, None), rotation=(0, 0, quarter)),
        Prescribed("end", displacement=(0.1, None, 0.1), rotation=(quarter, 0, 0), history=Steady()),
    ]
    h = discrete.solve(Scene([Rod.straight(1.0, GENERAL)], held), elements=16).rods[0]
    about_z, about_x = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]]), np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]])
    assert h.frames[-1, -1] == pytest.approx(about_x @ about_z, abs=1e-14)
    assert h.r[-1, -1] == pytest.approx([0.6, 0.2, 0.1], abs=1e-14)
