"""Friction: what sticks does not creep, anchors go with the wall, rods roll; the paper's rule creeps as it must."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

import dolfinrod as dr
from dolfinrod.scene import SceneError, Touch
from dolfinrod.scene.reply import OPEN, SLIDES, STICKS, Booked, Reply
from tests.scenes import largest

Array = NDArray[np.float64]

STIFF, RADIUS, MU = 3e3, 0.05, 0.5
PENALTY = dr.Penalty(STIFF)
# A point that penetrates by a tenth of its radius sticks within this distance from its anchor.
DEPTH = 0.1 * RADIUS
REACH, LIMIT = MU * DEPTH, MU * STIFF * DEPTH
STILL = np.zeros(3)
both_levels = pytest.mark.parametrize("level", [1.0, 0.5], ids=["end", "middle"])
directions = st.floats(-np.pi, np.pi).map(lambda angle: np.array([np.cos(angle), np.sin(angle), 0.0]))
few = settings(max_examples=30)


class Point:
    """One point of a rod against a surface, taken from place to place.

    Args:
        x: Where it begins, shape (3,) [m].
        surface: What it touches.
        friction: How that rubs.
        law: How it pushes.
        level: Where in a step forces act.
    """

    def __init__(self, x, surface=None, friction=None, law=PENALTY, level: float = 1.0) -> None:
        contact = dr.Contact(surface or dr.Plane(), law, friction or dr.Coulomb(MU))
        self.touch, self.x, self.t = (
            Touch(contact, np.array([RADIUS]), dr.Static(), level),
            np.asarray(x, dtype=float),
            0.0,
        )
        self.touch.place(self.x[None], 0.0)

    def led(self, x, turn=STILL, dt: float = 0.01) -> Reply:
        """Where a step leads, not yet accepted."""
        self.t += dt
        self.touch.begin(self.t)
        self.x = np.asarray(x, dtype=float)
        return self.touch.respond(self.x[None], np.asarray(turn, dtype=float)[None])

    def taken(self, x, turn=STILL, dt: float = 0.01) -> tuple[Reply, Booked]:
        """The same, accepted."""
        return self.led(x, turn, dt), self.touch.accept()

    @property
    def slip(self) -> float:
        return float(self.touch.memory()["slip"][0])


PRESSED = np.array([0.2, -0.3, RADIUS - DEPTH])
X, _, Z = np.eye(3)


@both_levels
@few
@given(path=st.lists(st.tuples(directions, st.floats(0.0, 0.9)), min_size=1, max_size=12))
def test_what_sticks_never_creeps(level: float, path: list[tuple[Array, float]]) -> None:
    point = Point(PRESSED, level=level)
    for direction, part in [*path, (path[0][0], 0.0)]:
        u = part * REACH * direction
        reply, _ = point.taken(PRESSED + u)
        assert (reply.state[0], point.slip) == (STICKS, 0.0)
        np.testing.assert_allclose(reply.traction[0], -STIFF * u, atol=1e-12 * LIMIT)


@both_levels
@few
@given(direction=directions, far=st.floats(1.1, 50.0), back=st.floats(0.1, 1.9))
def test_beyond_the_limit_the_anchor_follows(level: float, direction: Array, far: float, back: float) -> None:
    point = Point(PRESSED, level=level)
    reply, _ = point.taken(PRESSED + far * REACH * direction)
    assert reply.state[0] == SLIDES
    np.testing.assert_allclose(reply.traction[0], -LIMIT * direction, rtol=1e-12, atol=1e-12 * LIMIT)
    assert point.slip == pytest.approx((far - 1.0) * REACH, rel=1e-12)
    # It slides on and pays μ p for its way, or turns back and sticks until it slides the other way.
    _, booked = point.taken(PRESSED + 2 * far * REACH * direction)
    assert booked.rubbed[0] == pytest.approx(LIMIT * far * REACH, rel=1e-9)
    returned = point.led(PRESSED + (2 * far - back) * REACH * direction)
    assert returned.state[0] == STICKS
    np.testing.assert_allclose(returned.traction[0], (back - 1.0) * LIMIT * direction, atol=1e-9 * LIMIT)


def test_anchors_are_as_stiff_as_they_are_told() -> None:
    for eps_T, stiffness in ((None, STIFF), (100.0, 100.0)):
        reply = Point(PRESSED, friction=dr.Coulomb(MU, eps_T)).led(PRESSED + 1e-4 * X)
        assert reply.traction[0] == pytest.approx([-1e-4 * stiffness, 0, 0])


MOVES = {
    "pushed": dr.WallMotion(displacement=(0.3, -0.2, 0.4), history=[(0.0, 0.0), (0.1, 0.7), (1.0, 1.0)]),
    "drawn": dr.WallMotion(velocity=(0.5, 1.0, -0.2)),
    "turned": dr.WallMotion(rotation=(0.3, -0.2, 2.0), about=(0.1, 0.5, 0.2)),
    "turning": dr.WallMotion(spin=(-2.0, 1.0, 3.0), velocity=(1, 0, 0), about=(0.3, 0, 0)),
}


@both_levels
@pytest.mark.parametrize("motion", MOVES.values(), ids=MOVES)
def test_what_goes_with_the_wall_does_not_rub(motion: dr.WallMotion, level: float) -> None:
    start = motion.pose(0.0, 1.0)
    material = start.back(PRESSED[None])
    point = Point(PRESSED, dr.Plane(motion=motion), level=level)
    for k in range(1, 11):
        turn = motion.turn(0.1 * k, 1.0) - motion.turn(0.1 * (k - 1), 1.0)
        reply, booked = point.taken(motion.pose(0.1 * k, 1.0).out(material)[0], turn, dt=0.1)
        assert reply.pressure[0] == pytest.approx(STIFF * DEPTH)
        assert largest(reply.traction) <= 1e-11 * LIMIT
        assert (point.slip, reply.state[0]) == (0.0, STICKS)
        assert abs(booked.rubbed[0]) <= 1e-12 * LIMIT * REACH


@pytest.mark.parametrize("motion", MOVES.values(), ids=MOVES)
def test_a_wall_rubs_on_a_rod_that_stays(motion: dr.WallMotion) -> None:
    # The wall passes under the rod, whose part of the surface is where it was.
    point = Point(PRESSED, dr.Plane(motion=motion))
    reply = point.led(PRESSED, dt=1e-3)
    under = PRESSED - RADIUS * Z
    drawn = motion.pose(1e-3, 1.0).out(motion.pose(0.0, 1.0).back(under[None]))[0] - under
    n = reply.normal[0]
    drawn -= n * (n @ drawn)
    traction = reply.traction[0]
    assert traction @ drawn > 0.0
    assert np.linalg.norm(np.cross(traction, drawn)) <= 1e-2 * np.linalg.norm(traction) * np.linalg.norm(drawn)


def test_a_loaded_anchor_turns_with_its_wall() -> None:
    motion = dr.WallMotion(spin=(0, 0, 1.0), history=dr.Steady())
    point = Point(PRESSED, dr.Plane(motion=motion))
    u, θ = 0.8 * REACH * X, 0.1 * Z
    first, _ = point.taken(motion.pose(0.1, 1.0).out((PRESSED + u)[None])[0], θ, dt=0.1)
    for k in range(2, 11):
        reply, _ = point.taken(motion.pose(0.1 * k, 1.0).out((PRESSED + u)[None])[0], θ, dt=0.1)
        expected = Rotation.from_rotvec((k - 1) * θ).apply(first.traction[0])
        np.testing.assert_allclose(reply.traction[0], expected, atol=1e-12 * LIMIT)
    assert point.slip == 0.0


@both_levels
@few
@given(direction=directions, way=st.floats(0.01, 1.0))
def test_rolling_does_not_rub_and_sliding_does(level: float, direction: Array, way: float) -> None:
    move = way * RADIUS * direction
    rolling = np.cross(Z, move) / RADIUS
    point = Point(PRESSED, level=level)
    reply, _ = point.taken(PRESSED + move, rolling)
    assert largest(reply.traction) <= 1e-12 * LIMIT
    assert largest(reply.moment) <= 1e-12 * LIMIT * RADIUS
    assert point.slip == 0.0
    sliding, _ = Point(PRESSED, level=level).taken(PRESSED + move)
    spinning, _ = Point(PRESSED, level=level).taken(PRESSED, -rolling)
    np.testing.assert_allclose(sliding.traction, spinning.traction, atol=1e-9 * LIMIT)
    np.testing.assert_allclose(
        sliding.traction[0], -min(way * RADIUS / REACH, 1.0) * LIMIT * direction, atol=1e-9 * LIMIT
    )
    # The moment of what drags back at the wall turns a sliding rod until it rolls.
    assert sliding.moment[0] @ rolling > 0.0


@pytest.mark.parametrize(("side", "sign"), [("outside", 1.0), ("inside", -1.0)])
def test_rolling_around_a_cylinder_is_free_of_slip_in_the_limit_of_short_steps(side: str, sign: float) -> None:
    R = 1.0
    orbit = R + sign * (RADIUS - DEPTH)
    u = []
    for n in (50, 100):
        θ = np.linspace(0.0, 1.0, n + 1)
        path = orbit * np.stack([np.cos(θ), 0 * θ, np.sin(θ)], axis=1)
        core = dr.Cylinder((0, 0, 0), (0, 1, 0), R, side)
        point = Point(path[0], core, dr.Coulomb(100.0))
        for k in range(1, n + 1):
            # Its surface rests where it touches: ω r = ± orbit θ′, about the axis −y in which θ grows.
            reply, _ = point.taken(path[k], (0, -sign * orbit / RADIUS * (θ[k] - θ[k - 1]), 0))
        u.append(largest(reply.traction) / STIFF)
        assert point.slip == 0.0
    assert u[1] < 1e-4 * R
    assert np.log2(u[0] / u[1]) == pytest.approx(2.0, abs=0.1)


@both_levels
def test_without_a_coefficient_there_is_no_friction(level: float) -> None:
    for friction in (dr.Coulomb(0.0), dr.CreepingCoulomb(0.0, 1.0)):
        replies, slopes = [], []
        for rubs in (friction, None):
            touch = Touch(dr.Contact(dr.Plane(), PENALTY, rubs), np.array([RADIUS]), dr.Static(), level)
            touch.place(PRESSED[None], 0.0)
            touch.begin(0.1)
            replies.append(touch.respond(PRESSED[None] + [0.01, 0.02, 0.001], np.array([[0.1, 0.2, 0.3]])))
            slopes.append(touch.gradient())
        for name in ("force", "moment", "pressure"):
            np.testing.assert_array_equal(*(getattr(reply, name) for reply in replies))
        for name in ("f_x", "f_turn", "m_x", "m_turn"):
            np.testing.assert_allclose(*(getattr(slope, name) for slope in slopes), atol=1e-12 * STIFF)


@few
@given(fall=st.floats(0.1, 10.0), direction=directions, way=st.floats(0.0, 10.0))
def test_what_comes_from_afar_rubs_only_over_the_last_part_of_its_way(
    fall: float, direction: Array, way: float
) -> None:
    above = PRESSED + (1.0 + fall) * DEPTH * Z
    move = way * DEPTH * direction
    reply = Point(above, friction=dr.Coulomb(100.0)).led(PRESSED + move)
    np.testing.assert_allclose(reply.traction[0], -STIFF * move / (1.0 + fall), atol=1e-9 * STIFF * DEPTH)


def test_a_gap_under_load_within_the_tolerance_is_held_like_any_other() -> None:
    law = dr.AugmentedLagrangian(STIFF, tolerance=DEPTH)
    point = Point(PRESSED, law=law)
    point.touch.begin(0.01)
    # Multipliers leave the point a little above the wall.
    point.touch.respond((PRESSED - DEPTH * Z)[None], STILL[None])
    assert not point.touch.renew()
    λ = 2 * STIFF * DEPTH
    point.t = 0.01
    for above in (0.5, 0.25):
        place = PRESSED + (1.0 + above) * DEPTH * Z
        point.touch.soften(1.0)
        reply = point.touch.respond(place[None], STILL[None])
        point.touch.accept()
        assert reply.pressure[0] == pytest.approx(λ - above * STIFF * DEPTH)
    u = 0.1 * DEPTH * X
    reply = point.led(place + u - 0.1 * DEPTH * Z)
    np.testing.assert_allclose(reply.traction[0], -STIFF * u, atol=1e-12 * LIMIT)


@few
@given(part=st.floats(0.05, 0.95), speed=st.floats(1e-6, 1.0))
def test_the_rule_of_the_paper_creeps_where_friction_should_hold(part: float, speed: float) -> None:
    # t = −μ p v/√(v² + v_0²) = −W at v = v_0 W/√(μ²p² − W²), for a load W below μ p.
    creeping, p, dt = dr.CreepingCoulomb(MU, speed), STIFF * DEPTH, 0.01
    W = part * MU * p

    def left(v: float) -> float:
        reply = Point(PRESSED, friction=creeping).led(PRESSED + v * dt * X)
        return float(reply.traction[0, 0]) + W

    found = brentq(left, 0.0, 100 * speed, xtol=1e-12 * speed)
    assert found == pytest.approx(speed * W / np.sqrt((MU * p) ** 2 - W**2), rel=1e-6)


def test_the_rule_of_the_paper_is_against_the_velocity_in_space_with_its_normal_part() -> None:
    creeping, wall = dr.CreepingCoulomb(MU, 0.1), dr.Plane(motion=dr.WallMotion(velocity=(3.0, 0, 0)))
    assert not Point(PRESSED, wall, creeping).led(PRESSED).traction.any()
    v, dt = np.array([0.3, 0.0, -0.4]), 1e-4
    reply = Point(PRESSED, wall, creeping).led(PRESSED + v * dt, dt=dt)
    expected = -MU * reply.pressure[0] * v / np.sqrt(0.5**2 + 0.1**2)
    np.testing.assert_allclose(reply.traction[0], expected, rtol=1e-9)
    assert not reply.moment.any()
    # Sections may turn as they like.
    turning = Point(PRESSED, wall, creeping).led(PRESSED + v * dt, (1.0, 2.0, 3.0), dt=dt)
    np.testing.assert_array_equal(turning.traction, reply.traction)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: dr.Coulomb(-0.1), r"^Coulomb\.mu must not be negative, got -0\.1$"),
        (lambda: dr.Coulomb(0.1, 0.0), r"^Coulomb\.eps_T must be positive, got 0\.0 N/m²$"),
        (lambda: dr.Coulomb("rough"), r"^Coulomb\.mu must be a finite number, got 'rough'$"),
        (lambda: dr.CreepingCoulomb(-1.0, 1.0), r"^CreepingCoulomb\.mu must not be negative, got -1\.0$"),
        (lambda: dr.CreepingCoulomb(0.1, 0.0), r"^CreepingCoulomb\.v_0 must be positive, got 0\.0 m/s$"),
    ],
)
def test_what_cannot_be_is_refused_in_words(make: Callable[[], object], message: str) -> None:
    with pytest.raises(SceneError, match=message):
        make()


def test_what_only_grazes_feels_the_wall_but_does_not_rub() -> None:
    point = Point(RADIUS * Z)
    reply, _ = point.taken(RADIUS * Z + 0.1 * X)
    assert (reply.state[0], point.slip) == (OPEN, 0.0)
    assert not reply.force.any()
    # Without its stiffness a rod that lies on a wall would be free.
    np.testing.assert_allclose(point.touch.gradient().f_x[0] @ Z @ Z, -STIFF)


def test_what_stuck_clings_to_its_wall_in_the_first_answer_alone() -> None:
    far = 10 * REACH
    point = Point(PRESSED, dr.Plane(motion=dr.WallMotion(velocity=(far, 0, 2 * DEPTH))))
    point.taken(PRESSED, dt=1e-9)
    point.touch.begin(1.0)
    point.touch.cling()
    # Dragged along beyond the limit of friction, by a wall that has come nearer.
    first = point.touch.respond(PRESSED[None], STILL[None])
    np.testing.assert_allclose(first.traction[0], STIFF * far * X, rtol=1e-6, atol=1e-6 * LIMIT)
    assert first.pressure[0] == pytest.approx(3 * STIFF * DEPTH)
    then = point.touch.respond(PRESSED[None], STILL[None])
    np.testing.assert_allclose(then.traction[0], 3 * LIMIT * X, rtol=1e-6, atol=1e-6 * LIMIT)
    assert (first.state[0], then.state[0]) == (STICKS, SLIDES)


def test_what_was_pressed_is_drawn_after_a_wall_that_leaves_in_the_first_answer_alone() -> None:
    point = Point(PRESSED, dr.Plane(motion=dr.WallMotion(velocity=(0, 0, -3 * DEPTH))))
    point.taken(PRESSED, dt=1e-9)
    point.touch.begin(1.0)
    point.touch.cling()
    pressures = [point.touch.respond(PRESSED[None], STILL[None]).pressure[0] for _ in range(2)]
    assert pressures == [pytest.approx(-2 * STIFF * DEPTH), 0.0]
