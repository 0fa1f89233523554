"""Rods against rods: third law, exact gradients, one answer whoever is named first, loads of the textbook."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

import dolfinrod as dr
from dolfinrod.scene.meeting import Coupling, Meeting, Strands
from dolfinrod.scene.meeting.facing import look
from dolfinrod.scene.meeting.neighbours import near
from dolfinrod.scene.rodcontact import RodContact
from tests.scenes import Pose, largest, poses

Array = NDArray[np.float64]

STIFF, RADIUS, HALO = 1e3, 0.05, 0.01
LAW = dr.Penalty(STIFF, HALO)
LAWS = [LAW, dr.SmoothPenalty(STIFF, 0.01, HALO)]
# In steps of one second they resist three times as hard as they are stiff.
DAMPED = [dr.Penalty(STIFF, HALO, damping=3.0), dr.SmoothPenalty(STIFF, 0.01, HALO, damping=3.0)]
LENGTH, ELEMENTS = 1.0, 8
S = np.linspace(0.0, LENGTH, ELEMENTS + 1)
KINDS = ["smooth", "lagrange"]
every_kind = pytest.mark.parametrize("kind", KINDS)
every_law = pytest.mark.parametrize("law", LAWS, ids=["penalty", "smooth"])
every_damped = pytest.mark.parametrize("law", DAMPED, ids=["penalty", "smooth"])
every_level = pytest.mark.parametrize("level", [1.0, 0.5], ids=["end", "middle"])


def strands(kind: str, n_rods: int = 2, radius: float = RADIUS) -> Strands:
    """Rods of one length and mesh: cubics of one model, or quadratic elements with three nodes of the other."""
    if kind == "smooth":
        return Strands.smooth([S] * n_rods, np.full(n_rods, radius))
    cells = np.arange(0, ELEMENTS, 2)
    nodes = cells[:, None] + np.arange(3)
    every = np.concatenate([nodes + k * len(S) for k in range(n_rods)])
    ends = np.tile(S[nodes[:, ::2]], (n_rods, 1))
    rod = np.repeat(np.arange(n_rods), len(cells))
    return Strands.lagrange(rod, ends, every, np.array([0.0, 0.5, 1.0]), np.full(n_rods, radius))


def straight(angle: float, height: float, shift: float = 0.0) -> Array:
    """Nodes of a rod across the z axis."""
    along = (S - 0.5 * LENGTH + shift)[:, None]
    return along * np.array([np.cos(angle), np.sin(angle), 0.0]) + np.array([0.0, 0.0, height])


def tangle(seed: int, n_rods: int = 3) -> Array:
    """Bent rods that cross near the origin, some pressed, shape (n_nodes, 3)."""
    rng = np.random.default_rng(seed)
    rods = []
    for k in range(n_rods):
        bent = straight(rng.uniform(0.0, 3.0), 1.9 * RADIUS * k, rng.uniform(-0.2, 0.2))
        bent[:, 2] += rng.uniform(-0.2, 0.2) * (S - 0.5 * LENGTH) ** 2
        rods.append(bent + rng.normal(scale=0.002, size=bent.shape))
    return np.concatenate(rods)


def met(x: Array, lines: Strands, law: dr.Penalty | dr.SmoothPenalty = LAW, level: float = 1.0) -> Meeting:
    """Rods placed there, and asked once."""
    meeting = Meeting(RodContact(law), lines, level)
    meeting.place(x, 0.0)
    meeting.respond(x, np.zeros_like(x))
    return meeting


def force(meeting: Meeting, x: Array) -> Array:
    return meeting.respond(x, np.zeros_like(x)).force


def dense(coupling: Coupling) -> Array:
    """∂f/∂x of all nodes, shape (3 n_nodes, 3 n_nodes)."""
    K = np.zeros((coupling.n_nodes, 3, coupling.n_nodes, 3))
    for nodes, block in zip(coupling.nodes, coupling.f_x, strict=True):
        for i, a in enumerate(nodes):
            for j, b in enumerate(nodes):
                K[a, :, b] += block[i, :, j]
    return K.reshape(3 * coupling.n_nodes, -1)


@every_kind
@every_level
@settings(max_examples=5, deadline=None)
@given(seed=st.integers(0, 999), pose=poses())
def test_third_law_wherever_the_scene_is_set_up(kind, level, seed, pose: Pose):
    x_0, x = tangle(seed), tangle(seed) + np.random.default_rng(seed).normal(scale=0.002, size=(27, 3))
    here, there = (Meeting(RodContact(LAW), strands(kind, 3), level) for _ in range(2))
    here.place(x_0, 0.0)
    there.place(pose.origin + x_0 @ pose.Q.T, 0.0)
    f, moved = force(here, x), force(there, pose.origin + x @ pose.Q.T)
    size, acting = np.abs(f).sum() + 1e-12, (1.0 - level) * x_0 + level * x
    assert largest(f.sum(axis=0)) <= 1e-13 * size
    assert largest(np.cross(acting, f).sum(axis=0)) <= 1e-13 * size
    assert largest(moved - f @ pose.Q.T) <= 1e-9 * size


@every_kind
@pytest.mark.parametrize("seed", range(4))
def test_who_is_named_first_does_not_matter(kind, seed):
    x = tangle(seed).reshape(3, -1, 3)
    f = force(met(x.reshape(-1, 3), strands(kind, 3)), x.reshape(-1, 3)).reshape(x.shape)
    turned = x[::-1].reshape(-1, 3)
    assert largest(f) > 0.0
    assert largest(force(met(turned, strands(kind, 3)), turned).reshape(x.shape)[::-1] - f) <= 1e-12 * largest(f)


@every_kind
@every_law
@every_level
def test_gradient_is_that_of_the_forces(kind, law, level):
    """Side by side intervals of contact stay as they are; across, what their ends do is of high order in the depth."""
    for angle, depth, bound in ((0.0, 0.3 * HALO, 1e-8), (0.7, 1e-3 * HALO, 1e-6)):
        x_0 = np.concatenate([straight(0.0, 0.0), straight(angle, 2 * RADIUS + HALO - depth)])
        rng, lines = np.random.default_rng(1), strands(kind)
        x = x_0 + rng.normal(scale=0.1 * depth, size=x_0.shape)
        dx, meeting = rng.normal(size=x.shape), met(x_0, lines, law, level)
        meeting.respond(x, np.zeros_like(x))
        K, h = meeting.gradient(), 1e-3 * depth
        change, none = K.times(dx, np.zeros_like(dx))
        half, whole = ((force(meeting, x + k * h * dx) - force(meeting, x - k * h * dx)) / (2 * k * h) for k in (1, 2))
        assert largest((4 * half - whole) / 3 - change) <= bound * largest(change)
        assert not none.any()
        assert largest(dense(K) @ dx.ravel() - change.ravel()) <= 1e-13 * largest(change)
        if level == 1.0:
            assert largest(dense(K) - dense(K).T) <= 1e-14 * largest(dense(K))
        nodal, blocks = K.nodal(), dense(K).reshape(len(x), 3, len(x), 3)
        assert nodal.f_x is not None
        diagonal = blocks[nodal.nodes, :, nodal.nodes]
        assert largest(nodal.f_x - diagonal) <= 1e-13 * largest(diagonal)


@every_kind
def test_steady_contact_only_resists(kind):
    """Half within each other, rods are turned out of balance by normals that turn; without that, −∂f/∂x ≥ 0."""
    x = np.concatenate([straight(0.0, 0.0), straight(0.7, RADIUS)])
    meeting = met(x, strands(kind))
    f = force(meeting, x)
    whole = dense(meeting.gradient())
    meeting.steady = True
    K = dense(meeting.gradient())
    assert largest(force(meeting, x) - f) == 0.0
    assert largest(K - K.T) <= 1e-14 * largest(K)
    assert np.linalg.eigvalsh(0.5 * (whole + whole.T))[-1] > 1e-2 * largest(K)
    assert np.linalg.eigvalsh(0.5 * (K + K.T))[-1] <= 1e-12 * largest(K)
    meeting.begin(1.0)
    assert largest(dense(meeting.gradient()) - whole) == 0.0


@every_kind
@every_law
def test_rods_side_by_side_carry_the_law(kind, law):
    """A line load q is met at the gap g_0 − q/ε_N of a penalty, whatever the mesh."""
    gap = HALO - 0.004
    x = np.concatenate([straight(0.0, 0.0), straight(0.0, 2 * RADIUS + gap)])
    meeting = met(x, strands(kind), law)
    q = law.pressure(np.array([gap]), np.zeros(1))[0][0]
    assert force(meeting, x)[len(S) :, 2].sum() == pytest.approx(q * LENGTH, rel=1e-12)
    assert meeting.met().gap == pytest.approx(gap, abs=1e-14)
    assert meeting.met().length[meeting.met().rod_a == 0].sum() == pytest.approx(LENGTH, rel=1e-12)


@every_kind
def test_ends_of_rods_are_round(kind):
    """Two of them press with half of their points each, over (2/3) √(2 d δ) beyond the end to first order in δ/d.

    In the span that reaches beyond it the load has a kink, over which Gauss points err by a part of that length.
    """
    depth, shift = 1e-2 * HALO, 0.31
    d = 2 * RADIUS + HALO - depth
    x = np.concatenate([straight(0.0, 0.0), straight(0.0, d, shift)])
    carried = LENGTH - shift + 2 / 3 * np.sqrt(2 * d * depth)
    assert force(met(x, strands(kind)), x)[len(S) :, 2].sum() == pytest.approx(STIFF * depth * carried, rel=3e-3)


@every_kind
@pytest.mark.parametrize("angle", [0.3, 1.0, np.pi / 2])
def test_crossing_rods_press_like_a_parabola(kind, angle):
    """p = ε_N (δ − s² sin² α/2d) along a rod, to first order in δ/d: F = ε_N (4/3) δ √(2 δ d)/sin α."""
    errors = []
    for depth in (1e-2 * HALO, 1e-3 * HALO):
        d = 2 * RADIUS + HALO - depth
        x = np.concatenate([straight(0.0, 0.0), straight(angle, d, 0.013)])
        exact = STIFF * 4 / 3 * depth * np.sqrt(2 * depth * d) / np.sin(angle)
        errors.append(abs(force(met(x, strands(kind)), x)[len(S) :, 2].sum() / exact - 1.0))
    assert met(x, strands(kind)).met().gap.min() == pytest.approx(HALO - depth, abs=1e-2 * depth)
    assert errors[0] < 2e-2 * HALO / (2 * RADIUS)
    assert errors[1] == pytest.approx(0.1 * errors[0], rel=0.05)


@every_law
def test_work_of_a_mean_load_is_what_is_stored(law):
    x = np.concatenate([straight(0.0, 0.0), straight(1.0, 2 * RADIUS + 1.2 * HALO)])
    meeting = met(x, strands("smooth"), law, level=0.5)
    work, stored = 0.0, meeting.stored()
    assert stored == 0.0
    for way in np.linspace(0.0, 1.0, 9)[1:]:
        moved = x.copy()
        moved[len(S) :] += way * np.array([0.03, 0.02, -0.7 * HALO])
        start, x_now = meeting._x_0, moved
        work += np.vdot(force(meeting, x_now), x_now - start)
        stored, rubbed, damped = meeting.accept()
        assert rubbed == damped == 0.0
    assert -work == pytest.approx(stored, rel=2e-3)


def inert(x: Array, lines: Strands, law: dr.Penalty | dr.SmoothPenalty, level: float = 1.0) -> Meeting:
    """Rods with inertia, placed there."""
    meeting = Meeting(RodContact(law), lines, level, inert=True)
    meeting.place(x, 0.0)
    meeting.begin(1.0)
    return meeting


@every_level
@every_damped
def test_damping_only_takes_and_the_books_are_closed(law, level):
    """On the way into contact, and out of it so fast that nothing pushes at last."""
    x = np.concatenate([straight(0.0, 0.0), straight(1.0, 2 * RADIUS + 1.2 * HALO)])
    meeting = inert(x, strands("smooth"), law, level)
    before, taken, most = meeting.stored(), 0.0, 0.0
    for k, way in enumerate((-0.4, -0.3, -0.3, 0.1, 0.3, 0.3, 0.4)):
        meeting.begin(k + 1.0)
        to = x.copy()
        to[len(S) :] += np.array([0.01, 0.01, way * HALO])
        work = -np.vdot(force(meeting, to), to - x)
        after, rubbed, damped = meeting.accept()
        assert rubbed == 0.0
        assert damped >= 0.0
        lost, blur = work - (after - before) - damped, 2e-3 * (abs(work) + abs(after - before))
        assert abs(lost) <= blur if level < 1.0 else lost >= -blur
        x, before, taken, most = to, after, taken + damped, max(most, after)
    assert before == 0.0
    assert taken > 0.5 * most


@every_kind
@every_level
@every_damped
def test_gradient_of_a_damped_load_is_that_of_the_forces(kind, law, level):
    """Rods side by side that near one another in a step; then ones that part so fast that nothing pushes."""
    depth = 0.3 * HALO
    x_0 = np.concatenate([straight(0.0, 0.0), straight(0.0, 2 * RADIUS + HALO - depth)])
    rng, meeting = np.random.default_rng(1), inert(x_0, strands(kind), law, level)
    nearer = x_0 + rng.normal(scale=0.05 * depth, size=x_0.shape)
    nearer[len(S) :, 2] -= 0.3 * depth
    dx, h = rng.normal(size=x_0.shape), 1e-3 * depth
    meeting.respond(nearer, np.zeros_like(x_0))
    change, _ = meeting.gradient().times(dx, np.zeros_like(dx))
    ways = ((force(meeting, nearer + k * h * dx) - force(meeting, nearer - k * h * dx)) / (2 * k * h) for k in (1, 2))
    half, whole = ways
    assert largest((4 * half - whole) / 3 - change) <= 1e-7 * largest(change)
    apart = x_0.copy()
    apart[len(S) :, 2] += 0.9 * depth
    assert not force(meeting, apart).any()
    assert not meeting.gradient().times(dx, np.zeros_like(dx))[0].any()
    assert not len(meeting.met().gap)


@pytest.mark.parametrize("way", [1, -1], ids=["along", "against"])
def test_force_does_not_jump_where_contact_leaves_the_end_of_a_span(way):
    """One cubic over a straight line, open at one end, to which it first draws away; at the other it just touches."""
    places, lengths = np.linspace(0.0, 1.0, 4), np.array([[0.0, LENGTH]] * 2)
    nodes = np.arange(8).reshape(2, 4)
    lines = Strands.lagrange(np.arange(2), lengths, nodes, places, np.array([RADIUS, RADIUS]))
    forces = []
    for end in (-1e-12, 1e-12):
        bent = np.poly1d([2.0, -3.0, 0.0, 1.0]) * 0.015 + np.poly1d([1.0, -2.0, 1.0, 0.0]) * 0.03
        bent = bent + np.poly1d([-2.0, 3.0, 0.0, 0.0]) * end + np.poly1d([1.0, -1.0, 0.0, 0.0]) * 2.57
        height = 2 * RADIUS + HALO + 0.3 * HALO * bent(places[::way])
        x = np.concatenate([places[:, None] * [1.0, 0.0, 0.0], np.stack([places, 0 * places, height], axis=1)])
        forces.append(force(met(x, replace(lines, spans=1)), x))
    assert largest(forces[0]) > 0.01 * STIFF * HALO * LENGTH
    assert largest(forces[1] - forces[0]) <= 1e-9 * largest(forces[0])


@pytest.mark.parametrize("way", [1, -1], ids=["along", "against"])
@pytest.mark.parametrize(
    "bent",
    [(-4.0, 2.8, 0.0), (-10.0, 8.7, -1.44, 0.0), (28.27, -40.4, 11.13, 0.0)],
    ids=["touches", "touches and leaves", "touches in the middle, too"],
)
def test_force_does_not_jump_where_an_end_comes_to_touch_beside_another_contact(bent, way):
    """One cubic over a straight line, beyond its reach in between, within it at one end, at the other just so."""
    places, lengths = np.linspace(0.0, 1.0, 4), np.array([[0.0, LENGTH]] * 2)
    nodes, forces = np.arange(8).reshape(2, 4), []
    lines = Strands.lagrange(np.arange(2), lengths, nodes, places, np.array([RADIUS, RADIUS]))
    for end in (-1e-12, 1e-12):
        height = 2 * RADIUS + HALO + 0.3 * HALO * (np.polyval(bent, places[::way]) + end)
        x = np.concatenate([places[:, None] * [1.0, 0.0, 0.0], np.stack([places, 0 * places, height], axis=1)])
        forces.append(force(met(x, replace(lines, spans=1)), x))
    assert largest(forces[0]) > 0.01 * STIFF * HALO * LENGTH
    assert largest(forces[1] - forces[0]) <= 1e-9 * largest(forces[0])


def test_a_node_that_goes_astray_takes_no_memory():
    """In the midst of an iteration, before it is given up: spans of 1e9 others."""
    x = np.concatenate([straight(0.0, 0.0), straight(0.7, 2 * RADIUS)])
    course = met(x, strands("smooth"))._spans.course
    every, far = np.ones(2 * ELEMENTS, dtype=bool), x.copy()
    far[-1] = 1e9
    there = {tuple(pair) for pair in near(course(x), every, HALO) if pair.max() < 2 * ELEMENTS - 2}
    found = {tuple(pair) for pair in near(course(far), every, HALO) if pair.max() < 2 * ELEMENTS - 2}
    assert there
    assert there <= found


def side_by_side(seed: int) -> Array:
    """Rods that touch in many places, between which they draw apart."""
    rng = np.random.default_rng(seed)
    rods = straight(0.0, 0.0), straight(rng.uniform(0.0, 0.02), 2 * RADIUS + 0.5 * HALO, rng.uniform(-0.06, 0.06))
    return np.concatenate([rod + rng.normal(scale=HALO, size=rod.shape) * [3.0, 1.0, 1.0] for rod in rods])


@pytest.mark.parametrize("seed", range(150))
def test_all_that_is_within_reach_is_looked_at(seed):
    """Loads of every span against the midpoint rule on points that are many and everywhere."""
    x, n = side_by_side(seed), 400
    meeting = met(x, strands("smooth"))
    pressed, near, spans = meeting._pressed, meeting._near, meeting._spans
    on, first, last = (np.repeat(runs, n) for runs in (near.on, near.first, near.last))
    there = look(spans.course(x), on, np.tile((np.arange(n) + 0.5) / n, len(near.on)), first, last)
    depth = 2 * RADIUS + HALO - np.linalg.norm(there.d, axis=1)
    depth[(depth < 0.0) | (there.b < first) | (there.b > last)] = 0.0
    expected = np.bincount(on, 0.5 * STIFF * depth * spans.length[on] / n, len(spans.length))
    found = np.bincount(pressed.a, pressed.p * pressed.length, len(spans.length))
    assert largest(found - expected) <= 0.02 * largest(expected)


def test_a_rod_touches_itself_only_where_a_loop_closes():
    s = np.linspace(0.0, 1.0, 41)
    φ = 2 * np.pi * s / 0.8
    turn = np.stack([np.cos(φ), np.sin(φ), 0.8 * RADIUS * φ / np.pi], axis=1) * np.array(
        [0.8 / (2 * np.pi)] * 2 + [1.0]
    )
    thin = Strands.smooth([s], np.array([RADIUS]))
    meeting = met(turn, thin)
    spots = meeting.met()
    assert len(spots.gap) > 0
    assert np.abs(spots.s_a - spots.s_b).min() > 2 * np.pi * RADIUS
    assert largest(force(meeting, turn).sum(axis=0)) <= 1e-13 * largest(force(meeting, turn))
    line = np.stack([s, 0 * s, 0 * s], axis=1)
    assert not force(met(line, thin), line).any()


@every_kind
def test_parts_of_the_cells_add_up(kind):
    x, lines = tangle(5), strands(kind, 3)
    odd = np.arange(len(lines.rod)) % 2 == 1
    parts = [Meeting(RodContact(LAW), lines, mine=mine) for mine in (odd, ~odd)]
    for part in parts:
        part.place(x, 0.0)
    whole = force(met(x, lines), x)
    assert largest(sum(force(part, x) for part in parts) - whole) <= 1e-13 * largest(whole)


def test_only_the_rods_that_are_named_touch():
    x = tangle(0)
    meeting = Meeting(RodContact(LAW, rods=(0, 2)), strands("smooth", 3))
    meeting.place(x, 0.0)
    assert not force(meeting, x)[len(S) : 2 * len(S)].any()
    apart = Meeting(RodContact(LAW, rods=(0,)), strands("smooth", 3))
    apart.place(x, 0.0)
    assert not force(apart, x).any()
    none = apart.gradient()
    assert none.f_x.shape == (0, 8, 3, 8, 3)
    assert not len(none.nodal().nodes)
    assert not len(apart.met().gap)
