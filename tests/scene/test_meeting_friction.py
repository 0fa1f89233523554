"""Friction between rods: what sticks, slides and rolls; couples that balance, closed books, anchors that move along."""

from __future__ import annotations

from typing import Literal

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

import dolfinrod as dr
from dolfinrod.scene.meeting import Meeting, Strands
from dolfinrod.scene.rodcontact import RodContact
from tests.scenes import Pose, largest, poses

Array = NDArray[np.float64]

STIFF, RADII, HALO = 1e3, np.array([0.05, 0.03]), 0.01
D, DEPTH = RADII.sum(), 0.004
ACROSS = D + HALO - DEPTH
S = np.linspace(0.0, 1.0, 7)
N = len(S)
LINES = Strands.smooth([S, S], RADII)
every_level = pytest.mark.parametrize("level", [1.0, 0.5], ids=["end", "middle"])
every_angle = pytest.mark.parametrize("angle", [0.0, 1.0], ids=["beside", "across"])


def pair(angle: float) -> Array:
    """Two straight rods pressed together, the second above the first, shape (2 N, 3)."""
    along = (S - 0.5)[:, None] * np.array([1.0, 0.0, 0.0])
    turned = (S - 0.5)[:, None] * np.array([np.cos(angle), np.sin(angle), 0.0])
    return np.concatenate([along, turned + np.array([0.0, 0.0, ACROSS])])


def upper(v: tuple[float, float, float]) -> Array:
    """A displacement of the second rod."""
    return np.concatenate([np.zeros((N, 3)), np.tile(v, (N, 1))])


def rubbing(x: Array, mu: float, level: float = 1.0, at: Literal["surface", "centreline"] = "surface") -> Meeting:
    friction = dr.Coulomb(mu, eps_T=0.5 * STIFF, at=at)
    meeting = Meeting(RodContact(dr.Penalty(STIFF, HALO), friction), LINES, level)
    meeting.place(x, 0.0)
    return meeting


def pressing(meeting: Meeting) -> float:
    """Sum of the normal forces on the second rod [N]."""
    spots = meeting.met()
    return float(np.abs((spots.force - spots.traction)[:, 2]).sum())


@every_angle
@every_level
def test_what_sticks_is_held_by_springs_and_slides_at_the_limit(angle, level):
    x, still, μ = pair(angle), np.zeros((2 * N, 3)), 0.3
    limit = μ * DEPTH / 0.5
    meeting = rubbing(x, μ, level)
    meeting.respond(x + upper((0.0, 1e-3 * limit, 0.0)), still)
    spots = meeting.met()
    if angle == 0.0:
        assert (spots.state == 1).all()
        held = spots.traction[spots.rod_a == 0, 1].sum()
        assert held == pytest.approx(0.25 * STIFF * 1e-3 * limit * (S[-1] - S[0]), rel=1e-6)
    meeting.respond(x + upper((0.0, 3 * limit, 0.0)), still)
    spots = meeting.met()
    size, pressed = (np.linalg.norm(f, axis=1) for f in (spots.traction, spots.force - spots.traction))
    assert (spots.state == 2).all()
    # Normals of one spot fan out by √(2 δ/d) at most, so their sum is less than that of their sizes.
    assert size == pytest.approx(μ * pressed, rel=DEPTH / ACROSS)
    assert (size >= μ * pressed * (1.0 - 1e-12)).all()
    assert (spots.traction[spots.rod_a == 0, 1] > 0.0).all()


@every_angle
@every_level
@settings(max_examples=5, deadline=None)
@given(seed=st.integers(0, 999), pose=poses())
def test_third_law_with_couples_wherever_the_scene_is_set_up(angle, level, seed, pose: Pose):
    rng, x_0 = np.random.default_rng(seed), pair(angle)
    x, turn = x_0 + rng.normal(scale=5e-4, size=x_0.shape), rng.normal(scale=0.1, size=x_0.shape)
    here, there = rubbing(x_0, 0.4, level), rubbing(pose.origin + x_0 @ pose.Q.T, 0.4, level)
    felt, moved = here.respond(x, turn), there.respond(pose.origin + x @ pose.Q.T, turn @ pose.Q.T)
    size, acting = np.abs(felt.force).sum(), (1.0 - level) * x_0 + level * x
    assert largest(felt.moment) > 0.0
    assert largest(felt.force.sum(axis=0)) <= 1e-13 * size
    assert largest((np.cross(acting, felt.force) + felt.moment).sum(axis=0)) <= 1e-13 * size
    for one, other in ((felt.force, moved.force), (felt.moment, moved.moment)):
        assert largest(other - one @ pose.Q.T) <= 1e-9 * size


@every_level
@pytest.mark.parametrize("mu", [0.3, 50.0], ids=["slides", "sticks"])
@pytest.mark.parametrize("far", [False, True], ids=["anchored", "landing"])
def test_gradient_is_that_of_forces_and_couples(level, mu, far):
    # No point is about to slide within the differences: seeds for which one is show its kink.
    rng, x_0 = np.random.default_rng(5), pair(0.0)
    meeting = rubbing(x_0 + upper((0.0, 0.0, 2 * DEPTH if far else 0.0)), mu, level)
    x, turn = x_0 + rng.normal(scale=2e-4, size=x_0.shape), rng.normal(scale=0.05, size=x_0.shape)
    if not far:
        meeting.respond(x, turn)
        meeting.accept()
        meeting.begin(2.0)
        x = x + rng.normal(scale=2e-4, size=x_0.shape)
    meeting.respond(x, turn)
    K, dx, dturn = meeting.gradient(), rng.normal(size=x.shape), rng.normal(size=x.shape)
    for ways in ((dx, 0 * dx), (0 * dx, dturn)):
        seen = []
        for h in (2e-6, 1e-6):
            more, less = (meeting.respond(x + k * h * ways[0], turn + k * h * ways[1]) for k in (1, -1))
            seen.append([(more.force - less.force) / (2 * h), (more.moment - less.moment) / (2 * h)])
        for whole, half, change in zip(*seen, K.times(*ways), strict=True):
            assert largest((4 * half - whole) / 3 - change) <= 1e-8 * largest(change)
    nodal = K.nodal()
    assert all(part is not None for part in (nodal.f_turn, nodal.m_x, nodal.m_turn, K.f_turn, K.m_x, K.m_turn))


@every_angle
@every_level
def test_books_are_closed(angle, level):
    """Work done on the rods is what is stored and what friction took, which is never less than nothing."""
    rng, x = np.random.default_rng(2), pair(angle)
    meeting = rubbing(x, 0.4, level)
    meeting.respond(x, np.zeros_like(x))
    before, taken = meeting.stored(), 0.0
    for k in range(8):
        meeting.begin(k + 1.0)
        way = upper((0.0, 0.004 * (-1) ** (k // 2), 0.0)) + rng.normal(scale=1e-5, size=x.shape)
        turn = rng.normal(scale=0.02, size=x.shape)
        felt = meeting.respond(x + way, turn)
        work = np.vdot(felt.force, way) + np.vdot(felt.moment, turn)
        after, rubbed, _ = meeting.accept()
        if level == 0.5:
            assert -work == pytest.approx(after - before + rubbed, abs=1e-3 * before)
        assert rubbed >= 0.0
        x, before, taken = x + way, after, taken + rubbed
    assert taken > 0.05 * before


def test_rods_that_roll_on_each_other_do_not_rub():
    """Surfaces of two rods run alike if a_A Ψ_A = −a_B Ψ_B: gears; and a rod rolls on a still one with the way a Ψ."""
    x, still = pair(0.0), np.zeros((2 * N, 3))
    arms = RADII + 0.5 * (HALO - DEPTH)
    gears = np.repeat([[0.01 / arms[0], 0.0, 0.0], [-0.01 / arms[1], 0.0, 0.0]], N, axis=0)
    meeting = rubbing(x, 0.5)
    meeting.respond(x, gears)
    assert largest(meeting.met().traction) <= 1e-12 * STIFF * DEPTH
    alone = gears * np.repeat([[0.0], [1.0]], N, axis=0)
    meeting.respond(x, alone)
    assert largest(meeting.met().traction) > 0.1 * STIFF * DEPTH * 0.5 * S[1]
    # About the line of contact, which stays: its centre goes by −Ψ × a n.
    meeting.respond(x + upper((0.0, 1e-5, 0.0)), gears * np.repeat([[0.0], [1e-3]], N, axis=0))
    assert largest(meeting.met().traction) <= 1e-3 * 0.5 * STIFF * 1e-5 * S[1]
    assert meeting.respond(x, still).force.any()


@pytest.mark.parametrize("angle", [0.0, 1.0])
def test_what_is_stuck_turns_with_the_rods(angle):
    x, way = pair(angle), upper((2e-4, -1e-4, 0.0))
    meeting = rubbing(x, 5.0)
    felt = meeting.respond(x + way, np.zeros_like(x))
    meeting.accept()
    for axis in ((0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.6, 0.0, 0.8)):
        meeting.begin(1.0)
        θ = 1e-3
        Q = np.eye(3) + np.sin(θ) * (W := np.cross(axis, np.eye(3)).T) + (1 - np.cos(θ)) * W @ W
        turned = meeting.respond((x + way) @ Q.T, np.tile(θ * np.array(axis), (2 * N, 1)))
        # Ways along chords and arcs differ by the square of the angle, times the distance of the rods.
        assert largest(turned.force - felt.force @ Q.T) <= 0.5 * STIFF * ACROSS * θ**2 * S[1]


@every_angle
@every_level
def test_memory_goes_on_where_it_was_left(angle, level):
    x, still, way = pair(angle), np.zeros((2 * N, 3)), upper((2e-4, -1e-3, 0.0))
    one = rubbing(x, 0.4, level)
    one.respond(x + way, still)
    kept = one.accept()
    memory = one.memory()
    other = rubbing(x, 0.4, level)
    assert {name: part.shape[1:] for name, part in other.memory().items()} == {
        k: v.shape[1:] for k, v in memory.items()
    }
    other.recall(memory, x + way, 1.0)
    assert other.stored() == pytest.approx(kept[0], rel=1e-13)
    for meeting in (one, other):
        meeting.begin(2.0)
    a, b = (meeting.respond(x + 1.5 * way, still) for meeting in (one, other))
    assert np.array_equal(a.force, b.force)
    assert np.array_equal(a.moment, b.moment)
    halves = [Meeting(one.contact, LINES, level, mine=np.arange(12) % 2 == k) for k in range(2)]
    for half in halves:
        half.recall(memory, x + way, 1.0)
    assert largest(sum(half.respond(x + 1.5 * way, still).force for half in halves) - a.force) <= 1e-13 * largest(
        a.force
    )


def test_a_spot_that_moves_along_takes_its_anchors_with_it():
    """A rod that sticks and rolls along another is held as before, also where it has come to the next span of that."""
    depth, way = 1e-4, 1e-2
    x, still = pair(np.pi / 2) + upper((-0.5 * way, 0.02, DEPTH - depth)), np.zeros((2 * N, 3))
    meeting, held = rubbing(x, 0.3), upper((0.0, 0.2 * 0.3 * depth / 0.5, 0.0))
    before = meeting.respond(x + held, still).force[N:, 1].sum()
    spans = meeting.met().s_a
    meeting.accept()
    meeting.begin(2.0)
    rolls = upper((0.0, way / (RADII[1] + 0.5 * (HALO - depth)), 0.0))
    after = meeting.respond(x + held + upper((way, 0.0, 0.0)), rolls).force[N:, 1].sum()
    assert (spans.min() - S[3]) * (meeting.met().s_a[0] - S[3]) < 0.0
    assert after == pytest.approx(before, rel=0.05)


@pytest.mark.parametrize("way", [-0.15, -0.08, 0.08, 0.15])
def test_a_rod_drawn_along_itself_over_another_is_rubbed_on_whatever_span_it_is(way):
    """A crossing comes to spans that have never touched anything, on the rod that is drawn and not on the other."""
    x, still, μ = pair(np.pi / 2), np.zeros((2 * N, 3)), 0.3
    meeting = rubbing(x, μ)
    meeting.respond(x, still)
    meeting.accept()
    for k in (1, 2, 3):
        meeting.begin(k + 1.0)
        rubs = -meeting.respond(x + upper((0.0, k * way, 0.0)), still).force[N:, 1].sum()
        assert rubs == pytest.approx(np.sign(way) * μ * pressing(meeting), rel=1e-2)
        meeting.accept()


def test_a_rod_that_is_dragged_across_joints_is_rubbed_all_the_way():
    x, still, μ = pair(1.2), np.zeros((2 * N, 3)), 0.3
    meeting = rubbing(x, μ)
    for k in range(20):
        meeting.begin(k + 1.0)
        rubs = -meeting.respond(x + upper((0.012 * (k + 1), 0.0, 0.0)), still).force[N:, 0].sum()
        assert k < 3 or rubs == pytest.approx(μ * pressing(meeting), rel=1e-2)
        meeting.accept()


@every_angle
@every_level
def test_friction_at_centrelines_is_a_force_without_a_moment(angle, level):
    """Sections that turn feel and change nothing; where none turns, the forces are those of friction at surfaces."""
    rng, x, still = np.random.default_rng(6), pair(angle), np.zeros((2 * N, 3))
    moved = x + upper((0.0, 2e-4, 0.0)) + rng.normal(scale=1e-5, size=x.shape)
    alone, turning = (rubbing(x, 0.3, level, "centreline") for _ in range(2))
    for k in range(2):
        turn, way = rng.normal(scale=0.1, size=x.shape), k * upper((1e-4, 0.0, 0.0))
        held, felt = alone.respond(moved + way, still), turning.respond(moved + way, turn)
        np.testing.assert_array_equal(felt.force, held.force)
        assert not felt.moment.any()
        if k == 0:
            surface = rubbing(x, 0.3, level).respond(moved, still)
            assert largest(surface.force - held.force) <= 1e-12 * largest(held.force)
            assert surface.moment.any()
        for meeting in (alone, turning):
            meeting.accept()
            meeting.begin(k + 2.0)
    assert not turning.turns
    assert largest(turning.met().traction) > 0.0


@every_level
@pytest.mark.parametrize("mu", [0.3, 50.0], ids=["slides", "sticks"])
def test_gradient_of_friction_at_centrelines(level, mu):
    rng, x_0, still = np.random.default_rng(4), pair(0.0), np.zeros((2 * N, 3))
    meeting = rubbing(x_0, mu, level, "centreline")
    x, dx, h = x_0 + rng.normal(scale=2e-4, size=x_0.shape), rng.normal(size=x_0.shape), 1e-6
    meeting.respond(x, still)
    K = meeting.gradient()
    whole, half = (
        (meeting.respond(x + k * h * dx, still).force - meeting.respond(x - k * h * dx, still).force) / (2 * k * h)
        for k in (2, 1)
    )
    force, moment = K.times(dx, rng.normal(size=x.shape))
    assert largest((4 * half - whole) / 3 - force) <= 1e-8 * largest(force)
    assert not moment.any()
    assert all(part is None for part in (K.f_turn, K.m_x, K.m_turn, K.nodal().f_turn, K.nodal().m_turn))
