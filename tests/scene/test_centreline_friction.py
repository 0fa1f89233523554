"""Friction at the centreline: the same force without a moment, whatever the sections do."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import dolfinrod as dr
from dolfinrod.scene import SceneError, Touch
from dolfinrod.scene.toml import dumps, loads

STIFF, RADIUS, MU = 3e3, 0.05, 0.5
DEPTH = 0.1 * RADIUS
N = 20


def points(friction: dr.Coulomb, level: float) -> Touch:
    """Points pressed against a cylinder, placed."""
    contact = dr.Contact(dr.Cylinder((0, 0, -1), (0, 1, 0), 1.0), dr.Penalty(STIFF), friction)
    touch = Touch(contact, np.full(N, RADIUS), dr.Static(), level)
    touch.place(PLACES, 0.0)
    touch.begin(0.1)
    return touch


RNG = np.random.default_rng(4)
PLACES = np.stack([RNG.normal(0, 0.1, N), RNG.normal(0, 0.1, N), np.full(N, RADIUS - DEPTH)], axis=1)
MOVES, TURNS = RNG.normal(0, 0.1 * DEPTH, (N, 3)), RNG.normal(0, 0.3, (N, 3))
both_levels = pytest.mark.parametrize("level", [1.0, 0.5], ids=["end", "middle"])


@both_levels
@settings(max_examples=20, deadline=None)
@given(spin=st.tuples(*[st.floats(-2.0, 2.0)] * 3))
def test_turning_sections_feel_and_change_nothing(level, spin):
    still, turning = (points(dr.Coulomb(MU, at="centreline"), level) for _ in range(2))
    alone, reply = still.respond(PLACES + MOVES, 0.0 * MOVES), turning.respond(PLACES + MOVES, TURNS + np.array(spin))
    np.testing.assert_array_equal(reply.traction, alone.traction)
    assert np.abs(reply.traction).max() > 0.0
    assert not reply.moment.any()
    assert not turning.turns


@both_levels
def test_sections_that_do_not_turn_are_dragged_alike(level):
    at = [points(dr.Coulomb(MU, at=where), level) for where in ("surface", "centreline")]
    surface, centreline = (touch.respond(PLACES + MOVES, 0.0 * MOVES) for touch in at)
    np.testing.assert_allclose(surface.traction, centreline.traction, atol=1e-12 * MU * STIFF * DEPTH)
    assert surface.moment.any()


@both_levels
def test_gradients_are_those_of_the_forces(level):
    touch, step = points(dr.Coulomb(MU, at="centreline"), level), 1e-8
    touch.respond(PLACES + MOVES, TURNS)
    slope = touch.gradient()
    for block in (slope.f_turn, slope.m_x, slope.m_turn):
        assert not block.any()
    for k, δ in enumerate(step * np.eye(3)):
        high, low = (touch.respond(PLACES + MOVES + d, TURNS).force[slope.points] for d in (δ, -δ))
        # Truncation is of the second order in the step over a depth; round-off is of forces over the step.
        np.testing.assert_allclose(slope.f_x[:, :, k], (high - low) / (2 * step), atol=1e-5 * STIFF)


def test_a_scene_file_names_the_place():
    rod = dr.Rod.straight(1.0, dr.Section(EA=1.0, GA=1.0, GJ=1.0, EI=1.0, radius=0.1))
    friction = dr.Coulomb(0.3, at="centreline")
    scene = dr.Scene([rod], [dr.Clamp("start")], contacts=[dr.Contact(dr.Plane((0, 0, -1)), friction=friction)])
    assert loads(dumps(scene))[0] == scene


def test_elsewhere_is_refused_in_words():
    with pytest.raises(SceneError, match=r"^Coulomb\.at must be \"surface\" or \"centreline\", got 'axis'$"):
        dr.Coulomb(0.3, at="axis")
