"""Points against a surface: forces that push and rub within their limits, exact gradients, closed books, a memory."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

import dolfinrod as dr
from dolfinrod.scene import Touch
from dolfinrod.scene.reply import OPEN, SLIDES, STICKS, Booked, Reply
from tests.scenes import FLAT, Pose, largest, poses

Array = NDArray[np.float64]

EPS = float(np.finfo(float).eps)
STIFF, RADIUS = 3e3, 0.05
LAWS = [
    dr.Penalty(STIFF, 0.02),
    dr.SmoothPenalty(STIFF, 0.01, 0.02),
    dr.AugmentedLagrangian(STIFF, 1e-3),
    dr.Penalty(STIFF, 0.02, damping=0.05),
    dr.SmoothPenalty(STIFF, 0.01, 0.02, damping=0.05),
]
FRICTIONS = [None, dr.Coulomb(0.3), dr.Coulomb(5.0, eps_T=1e3), dr.CreepingCoulomb(0.4, 0.1)]
LEVELS = [1.0, 0.5]
SURFACES = ["plane", "core", "tube"]
N = 40
MOTION = dr.Dynamic(t_end=1.0, dt=0.1)
every_law = pytest.mark.parametrize("law", LAWS, ids=["penalty", "smooth", "augmented", "damped", "smooth damped"])
every_spring = pytest.mark.parametrize("law", [law for law in LAWS if not isinstance(law, dr.AugmentedLagrangian)])
every_friction = pytest.mark.parametrize("friction", FRICTIONS, ids=["smooth", "slides", "sticks", "creeps"])
every_level = pytest.mark.parametrize("level", LEVELS, ids=["end", "middle"])
every_surface = pytest.mark.parametrize("kind", SURFACES)


def surface(kind: str, pose: Pose = FLAT) -> dr.Plane | dr.Cylinder:
    """A surface through the origin of a scene with normal along its z there, which is pushed and turned."""
    spin = pose.turned((0.3, 0.1, 0.2))
    motion = dr.WallMotion(velocity=pose.turned((0.1, 0.2, 0)), spin=spin, about=pose.placed((0.2, 0.1, 0.3)))
    if kind == "plane":
        return dr.Plane(pose.placed((0, 0, 0)), pose.turned((0, 0, 1)), motion)
    side, z = ("outside", -1) if kind == "core" else ("inside", 1)
    return dr.Cylinder(pose.placed((0, 0, z)), pose.turned((0.1, 1, 0)), 1.0, side, motion)


@dataclass(frozen=True, eq=False)
class Walk:
    """Where points go near the origin of a scene, some in contact, and how their sections turn.

    Args:
        x: Places at every time, shape (n_t, n, 3) [m].
        turn: Rotation vectors over the steps, shape (n_t − 1, n, 3) [rad].
    """

    x: Array
    turn: Array

    def seen(self, pose: Pose) -> Walk:
        """The same in a scene set up elsewhere."""
        return Walk(pose.origin + self.x @ pose.Q.T, self.turn @ pose.Q.T)


def walk(seed: int, steps: int = 1, n: int = N) -> Walk:
    rng = np.random.default_rng(seed)
    start = np.array([0, 0, RADIUS + 0.01]) + rng.normal(size=(n, 3)) * [0.05, 0.05, 0.02]
    moves = rng.normal(size=(steps, n, 3)) * 0.02
    # Back and forth through the surface rather than away from it.
    moves[:, :, 2] *= np.where(np.arange(steps) % 2, 1.0, -1.0)[:, None] * np.sign(moves[:, :, 2])
    return Walk(np.cumsum([start, *moves], axis=0), rng.normal(size=(steps, n, 3)) * 0.3)


def times(way: Walk) -> Array:
    return np.linspace(0.1, 0.5, len(way.x))


def touch(contact: dr.Contact, way: Walk, level: float = 1.0) -> Touch:
    """Where the way begins."""
    points = Touch(contact, np.full(way.x.shape[1], RADIUS), MOTION, level)
    points.place(way.x[0], 0.1)
    return points


def walked(points: Touch, way: Walk, first: int = 0, last: int | None = None) -> list[tuple[Reply, Booked]]:
    """Steps of the way, each of them accepted; multipliers are renewed once in a step."""
    taken = []
    for t, x, turn in list(zip(times(way)[1:], way.x[1:], way.turn, strict=True))[first:last]:
        points.begin(float(t))
        points.respond(x, turn)
        points.renew()
        taken.append((fresh(points, x, turn), points.accept()))
    return taken


def fresh(points: Touch, x: Array, turn: Array) -> Reply:
    """The answer to a place as such, not as the next one of an iteration."""
    points.soften(1.0)
    return points.respond(x, turn)


@every_surface
@every_level
@every_friction
@every_law
def test_gradients_are_those_of_forces_and_moments(law, friction, level: float, kind: str) -> None:
    way, step = walk(3, 2), 1e-7
    points = touch(dr.Contact(surface(kind), law, friction), way, level)
    walked(points, way, last=1)
    points.begin(0.5)
    x, turn = way.x[2], way.turn[1]
    points.respond(x, turn)
    points.renew()
    fresh(points, x, turn)
    slope = points.gradient()
    on = slope.points
    assert len(on) > 5
    for by, blocks in (("x", (slope.f_x, slope.m_x)), ("turn", (slope.f_turn, slope.m_turn))):
        for k, δ in enumerate(step * np.eye(3)):
            ends = [fresh(points, *((x + d, turn) if by == "x" else (x, turn + d))) for d in (δ, -δ)]
            differences = [[getattr(end, name)[on] for end in ends] for name in ("force", "moment")]
            for block, (high, low) in zip(blocks, differences, strict=True):
                # Truncation is of the second order in the step over a depth; round-off is of forces over the step.
                np.testing.assert_allclose(block[:, :, k], (high - low) / (2 * step), atol=1e-5 * STIFF)


@every_surface
@every_level
@every_friction
@every_law
def test_forces_push_and_rub_within_their_limits_and_no_step_gives_energy(law, friction, level, kind) -> None:
    way = walk(5, 6)
    points = touch(dr.Contact(surface(kind), law, friction), way, level)
    for reply, booked in walked(points, way):
        p, n, t = reply.pressure, reply.normal, reply.traction
        assert p.any()
        assert (p >= 0.0).all()
        np.testing.assert_allclose(np.linalg.norm(n, axis=1), p > 0.0, atol=8 * EPS)
        np.testing.assert_allclose(reply.force, p[:, None] * n + t, atol=8 * EPS * p.max())
        assert (booked.stored >= 0.0).all()
        assert (booked.rubbed >= -1e-12 * STIFF * RADIUS**2).all()
        assert (booked.damped >= 0.0).all()
        assert booked.damped.any() == (law.damping > 0.0)
        assert not t[p == 0.0].any()
        if isinstance(friction, dr.Coulomb):
            assert (np.linalg.norm(t, axis=1) <= friction.mu * p * (1 + 8 * EPS)).all()
            np.testing.assert_allclose(np.einsum("ni,ni->n", t, n), 0.0, atol=8 * EPS * largest(t))
            np.testing.assert_allclose(reply.moment, -RADIUS * np.cross(n, t), atol=8 * EPS * RADIUS * largest(t))
        else:
            assert not reply.moment.any()
        if friction is None:
            assert not t.any()
            assert not booked.rubbed.any()


@every_friction
@every_spring
def test_work_in_the_middle_of_steps_is_what_is_stored_taken_or_given_by_the_wall(law, friction) -> None:
    way = walk(7, 6)
    contact = dr.Contact(surface("plane"), law, friction)
    points = touch(contact, way, 0.5)
    stored = points.stored()
    scale = STIFF * RADIUS**2
    for k, (reply, booked) in enumerate(walked(points, way)):
        work = np.einsum("ni,ni->n", reply.force, way.x[k + 1] - way.x[k])
        work += np.einsum("ni,ni->n", reply.moment, way.turn[k])
        taken = booked.rubbed + booked.damped
        np.testing.assert_allclose(work, stored - booked.stored - taken + booked.pushed, atol=1e-12 * scale)
        stored = booked.stored


@every_friction
@every_spring
def test_forces_at_the_end_of_steps_never_give_more_than_was_stored(law, friction) -> None:
    way = walk(11, 6)
    points = touch(dr.Contact(surface("plane"), law, friction), way)
    stored = points.stored()
    for k, (reply, booked) in enumerate(walked(points, way)):
        work = np.einsum("ni,ni->n", reply.force, way.x[k + 1] - way.x[k])
        work += np.einsum("ni,ni->n", reply.moment, way.turn[k])
        lost = stored - booked.stored - booked.rubbed - booked.damped + booked.pushed - work
        assert (lost >= -1e-12 * STIFF * RADIUS**2).all()
        stored = booked.stored


@settings(max_examples=25)
@given(
    pose=poses(),
    kind=st.sampled_from(SURFACES),
    law=st.sampled_from(LAWS),
    friction=st.sampled_from(FRICTIONS),
    level=st.sampled_from(LEVELS),
    seed=st.integers(0, 99),
)
def test_forces_turn_with_points_wall_and_sections(
    pose: Pose, kind: str, law, friction, level: float, seed: int
) -> None:
    way = walk(seed, 2)
    here = walked(touch(dr.Contact(surface(kind), law, friction), way, level), way)
    there = walked(touch(dr.Contact(surface(kind, pose), law, friction), way.seen(pose), level), way.seen(pose))
    for (reply, booked), (turned, other) in zip(here, there, strict=True):
        for name in ("force", "moment"):
            np.testing.assert_allclose(getattr(turned, name) @ pose.Q, getattr(reply, name), atol=1e-9 * STIFF * RADIUS)
        for name in ("stored", "rubbed", "pushed", "damped"):
            np.testing.assert_allclose(getattr(other, name), getattr(booked, name), atol=1e-9 * STIFF * RADIUS**2)


@every_level
@every_friction
@every_law
def test_what_is_remembered_is_all_there_is(law, friction, level: float) -> None:
    way = walk(13, 6)
    contact = dr.Contact(surface("core"), law, friction)
    whole, begun = touch(contact, way, level), touch(contact, way, level)
    expected = walked(whole, way)[3:]
    walked(begun, way, last=3)
    again = Touch(contact, np.full(N, RADIUS), MOTION, level)
    again.recall(begun.memory(), float(times(way)[3]))
    for (reply, booked), (other, also) in zip(expected, walked(again, way, 3), strict=True):
        for name in ("gap", "pressure", "traction", "moment", "state"):
            np.testing.assert_array_equal(getattr(other, name), getattr(reply, name))
        np.testing.assert_array_equal(also.rubbed, booked.rubbed)
    for name, values in whole.memory().items():
        np.testing.assert_array_equal(again.memory()[name], values)


@every_level
@every_friction
@every_law
def test_a_step_that_was_tried_in_vain_leaves_no_trace(law, friction, level: float) -> None:
    way = walk(17, 3)
    contact = dr.Contact(surface("tube"), law, friction)
    straight, stumbling = touch(contact, way, level), touch(contact, way, level)
    walked(straight, way, last=2)
    walked(stumbling, way, last=2)
    stumbling.begin(0.9)
    stumbling.respond(way.x[3] - 0.01, 2 * way.turn[2])
    stumbling.renew()
    ((reply, booked),), ((other, also),) = walked(straight, way, 2), walked(stumbling, way, 2)
    np.testing.assert_array_equal(other.force, reply.force)
    np.testing.assert_array_equal(also.stored, booked.stored)
    np.testing.assert_array_equal(also.rubbed, booked.rubbed)


@settings(max_examples=30)
@given(
    eps_N=st.floats(1.0, 1e6),
    stiffer=st.floats(0.01, 10.0),
    depth=st.floats(1e-3, 1.0),
    tolerance=st.floats(1e-9, 1e-4),
)
def test_renewals_bring_a_spring_to_the_wall(eps_N: float, stiffer: float, depth: float, tolerance: float) -> None:
    # A spring k that is relaxed so deep in the wall: each renewal leaves the part k/(k + ε) of the penetration, ε = ε_N
    # until a renewal leaves more than a tenth, and ten times as much after each that does.
    points = Touch(dr.Contact(dr.Plane(), dr.AugmentedLagrangian(eps_N, tolerance)), np.array([RADIUS]), dr.Static())
    points.place(np.array([[0, 0, RADIUS + depth]]), 0.0)
    points.begin(1.0)
    k, λ, ε, left = stiffer * eps_N, 0.0, eps_N, depth
    while True:
        z, before = (λ - k * depth) / (k + ε), left
        reply, left = points.respond(np.array([[0, 0, RADIUS + z]]), np.zeros((1, 3))), -z
        assume(abs(left / before - 0.1) > 1e-6)
        assert reply.pressure[0] == pytest.approx(k * (z + depth), rel=1e-9)
        assert left == pytest.approx(k / (k + ε) * before, rel=1e-6, abs=1e-3 * tolerance)
        if points.renew():
            break
        if λ and left > 0.1 * before:
            ε *= 10.0
        λ = float(reply.pressure[0])
    assert abs(reply.gap[0]) <= tolerance
    assert reply.pressure[0] == pytest.approx(k * depth, rel=2 * tolerance / depth)


@every_friction
@every_law
def test_where_rods_are_placed_nothing_has_moved_yet(law, friction) -> None:
    way = walk(19)
    points = touch(dr.Contact(surface("plane"), law, friction), way)
    reply = points.respond(way.x[0], np.zeros((N, 3)))
    assert reply.pressure.any()
    assert not reply.traction.any()
    assert np.isfinite(points.gradient().f_x).all()


@every_friction
@every_law
def test_no_points_are_no_trouble(law, friction) -> None:
    points = Touch(dr.Contact(surface("core"), law, friction), np.zeros(0), dr.Static())
    points.place(np.zeros((0, 3)), 0.0)
    points.begin(0.5)
    reply = points.respond(np.zeros((0, 3)), np.zeros((0, 3)))
    assert reply.force.shape == (0, 3)
    assert len(points.gradient().points) == 0
    assert points.renew()
    assert points.accept().stored.shape == (0,)


@every_surface
@every_friction
@every_law
def test_an_iteration_that_stays_where_it_is_ends_with_the_law(law, friction, kind: str) -> None:
    way = walk(23, 3)
    points = touch(dr.Contact(surface(kind), law, friction), way)
    points.begin(0.3)
    for x, turn in zip(way.x[1:], way.turn, strict=True):
        points.respond(x, turn)
    # What was kept pressed pulls once at most, and what was let go of is pressed again in the next answer.
    for _ in range(3):
        settled = points.respond(way.x[3], way.turn[2])
    lawful = fresh(points, way.x[3], way.turn[2])
    for name in ("pressure", "force", "moment", "state"):
        np.testing.assert_array_equal(getattr(settled, name), getattr(lawful, name))


@pytest.mark.parametrize("friction", FRICTIONS[:3], ids=["smooth", "slides", "sticks"])
@every_law
def test_a_softened_wall_and_its_anchors_are_softer_until_the_next_step(law, friction) -> None:
    way = walk(29)
    points = touch(dr.Contact(surface("plane"), law, friction), way)
    points.begin(0.5)
    full = points.respond(way.x[1], way.turn[0])
    points.soften(10.0)
    np.testing.assert_allclose(points.respond(way.x[1], way.turn[0]).force, full.force / 10.0, atol=1e-12 * STIFF)
    for back in (lambda: points.soften(1.0), lambda: points.begin(0.5)):
        back()
        np.testing.assert_array_equal(points.respond(way.x[1], way.turn[0]).force, full.force)


def test_a_point_that_leaves_and_comes_back_begins_anew() -> None:
    contact = dr.Contact(dr.Plane(), dr.Penalty(STIFF), dr.Coulomb(0.5))
    way = Walk(
        RADIUS * np.array([[[0, 0, 0.9]], [[0.5, 0, 0.9]], [[0.5, 0, 1.5]], [[0.5, 0, 0.9]]]), np.zeros((3, 1, 3))
    )
    points = touch(contact, way)
    (rubbed, _), (left, booked), (back, _) = walked(points, way)
    assert rubbed.traction.any()
    assert (left.state, left.force.any()) == (OPEN, False)
    assert booked.rubbed > 0.0  # what the anchor still held
    assert not back.traction.any()


def pushed_along(way: float) -> Touch:
    """A point on a floor of 1e4 N/m², pressed by 1 N/m, that a step has taken along it, μ = 0.5."""
    contact = dr.Contact(dr.Plane((0.0, 0.0, 0.0), (0.0, 0.0, 1.0)), dr.Penalty(1e4), dr.Coulomb(0.5))
    points = Touch(contact, np.array([0.01]), dr.Static(t_end=2.0))
    points.place(np.array([[0.0, 0.0, 0.0099]]), 0.0)
    points.begin(1.0)
    fresh(points, np.array([[way, 0.0, 0.0099]]), np.zeros((1, 3)))
    points.accept()
    points.begin(2.0)
    return points


@given(way=st.floats(1e-4, 1e-2))
def test_what_slid_slides_on_where_it_is_told_to_and_halts_before_it_slides_back(way: float) -> None:
    points, still = pushed_along(way), np.zeros((1, 3))
    points.cling()
    points.glide()
    on = points.respond(np.array([[1.00001 * way, 0.0, 0.0099]]), still)
    assert (on.state[0], points.forced) == (SLIDES, False)
    assert on.traction[0] == pytest.approx([-0.5, 0.0, 0.0], abs=1e-9)
    back = points.respond(np.array([[-way, 0.0, 0.0099]]), still)
    assert (back.state[0], points.forced) == (STICKS, True)
    assert points.respond(np.array([[-way, 0.0, 0.0099]]), still).traction[0] == pytest.approx(
        [0.5, 0.0, 0.0], abs=1e-9
    )


@given(way=st.floats(1e-3, 1e-2), off=st.floats(1e-6, 1e-4))
def test_what_stuck_too_hard_slides_before_it_leaves(way: float, off: float) -> None:
    points, still = pushed_along(1e-6), np.zeros((1, 3))
    points.cling()
    assert points.respond(np.array([[1e-6, 0.0, 0.0099]]), still).state[0] == STICKS
    torn = points.respond(np.array([[way, 0.0, 0.01 + off]]), still)
    # Its pressure is below zero, and so is what friction does: the line that Newton's method follows.
    assert torn.state[0] == SLIDES
    assert torn.pressure[0] == pytest.approx(-1e4 * off, rel=1e-9)
    assert torn.traction[0] == pytest.approx([0.5e4 * off, 0.0, 0.0], rel=1e-9)
    assert points.respond(np.array([[way, 0.0, 0.01 + off]]), still).state[0] == OPEN
