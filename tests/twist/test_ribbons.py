"""Lk = Tw + Wr: curves coil, ribbons twist, and closed ones are linked a whole number of times."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import dolfinrod as dr
from tests.scenes import largest, poses, rotation
from tests.twist.fibres import MIRROR
from verification.references.coils import TORUS, TREFOIL, coil, helix, round_about, torus, trefoil

pytestmark = pytest.mark.serial

WHOLE = 1e-10


def random_ribbon(seed, n):
    """A closed curve of a few waves, and a field across it that goes round it as it likes."""
    random = np.random.default_rng(seed)
    t = 2.0 * np.pi * round_about(n)
    waves = np.concatenate([[np.cos(k * t), np.sin(k * t)] for k in range(1, 4)])
    curve, field = (
        np.einsum("wi,wn->ni", random.standard_normal((6, 3)) / np.repeat([1, 2, 3], 2)[:, None] ** p, waves)
        for p in (1.5, 0.5)
    )
    return curve, field + random.standard_normal(3)


def gap(curve):
    """Least distance of points that are not near along the curve."""
    n = len(curve)
    apart = np.abs(np.subtract.outer(np.arange(n), np.arange(n)))
    far = np.minimum(apart, n - apart) > n // 12
    return np.linalg.norm(curve[:, None] - curve, axis=2)[far].min()


def across(curve, field):
    """Its unit normal part, and how much of it there is at least."""
    e = np.roll(curve, -1, axis=0) - np.roll(curve, 1, axis=0)
    t = e / np.linalg.norm(e, axis=1)[:, None]
    u = field - np.einsum("ni,ni->n", field, t)[:, None] * t
    size = np.linalg.norm(u, axis=1)
    return u / size[:, None], size.min()


@settings(max_examples=40)
@given(st.integers(0, 10**6))
def test_closed_ribbons_are_linked_a_whole_number_of_times_which_is_twist_and_writhe(seed):
    curve, field = random_ribbon(seed, 160)
    u, least = across(curve, field)
    assume(least > 0.1)
    assume(gap(curve) > 0.05)
    linked = dr.twist.link(curve, curve + 5e-3 * u)
    assert abs(linked - round(linked)) <= WHOLE
    assert dr.twist.twist(curve, u, closed=True) + dr.twist.writhe(curve, closed=True) == pytest.approx(
        round(linked), abs=WHOLE
    )


@settings(max_examples=40)
@given(st.integers(0, 10**6), st.integers(5, 12))
def test_twist_and_writhe_of_the_coarsest_polygons_add_up_to_a_whole_number(seed, n):
    """No limit of many points is needed."""
    random = np.random.default_rng(seed)
    curve, u = random.standard_normal((2, n, 3))
    total = dr.twist.twist(curve, u, closed=True) + dr.twist.writhe(curve, closed=True)
    assert abs(total - round(total)) <= 1e-8


@pytest.mark.parametrize("turns", [1, 3, -2])
def test_a_flat_ribbon_has_the_turns_it_was_given(turns):
    t = 2.0 * np.pi * round_about(90)
    ring = np.stack([np.cos(t), np.sin(t), 0.0 * t], axis=1)
    out = np.cos(turns * t)[:, None] * ring - np.sin(turns * t)[:, None] * [0.0, 0.0, 1.0]
    assert dr.twist.writhe(ring, closed=True) == pytest.approx(0.0, abs=WHOLE)
    assert dr.twist.twist(ring, out, closed=True) == pytest.approx(turns, abs=WHOLE)
    assert dr.twist.link(ring, ring + 0.1 * out) == pytest.approx(turns, abs=WHOLE)


def test_a_right_handed_hopf_link():
    t = 2.0 * np.pi * round_about(40)
    ring = np.stack([np.cos(t), np.sin(t), 0.0 * t], axis=1)
    through = np.stack([1.0 + np.cos(t), 0.0 * t, -np.sin(t)], axis=1)
    assert dr.twist.link(ring, through) == pytest.approx(1.0, abs=WHOLE)
    assert dr.twist.link(ring, through[::-1]) == pytest.approx(-1.0, abs=WHOLE)
    assert dr.twist.link(ring, through + np.array([5.0, 0.0, 0.0])) == pytest.approx(0.0, abs=WHOLE)


@settings(max_examples=40)
@given(poses(), st.floats(0.1, 10.0))
def test_writhe_and_twist_are_of_the_shape_alone(pose, scale):
    curve, u = random_ribbon(7, 60)
    moved, turned = pose.origin + scale * curve @ pose.Q.T, u @ pose.Q.T
    assert dr.twist.writhe(moved, closed=True) == pytest.approx(dr.twist.writhe(curve, closed=True), abs=WHOLE)
    assert dr.twist.twist(moved, turned, closed=True) == pytest.approx(dr.twist.twist(curve, u, closed=True), abs=WHOLE)


@settings(max_examples=40)
@given(st.integers(0, 10**6))
def test_mirror_images_have_the_opposite_of_all(seed):
    curve, u = random_ribbon(seed, 40)
    assume(gap(curve) > 1e-3)
    for measure in (
        lambda s: dr.twist.writhe(curve * s, closed=True),
        lambda s: dr.twist.writhe(curve * s),
        lambda s: dr.twist.twist(curve * s, u * s),
        lambda s: dr.twist.link(curve * s, (curve + 0.1 * u) * s, closed=False),
    ):
        assert measure(MIRROR) == pytest.approx(-measure(np.ones(3)), abs=WHOLE)


def test_the_way_along_a_curve_and_where_it_begins_do_not_matter():
    curve = trefoil(round_about(70), *TREFOIL)
    whole = dr.twist.writhe(curve, closed=True)
    for same in (curve[::-1], np.roll(curve, 20, axis=0), np.concatenate([curve, curve[:1]])):
        assert dr.twist.writhe(same, closed=True) == pytest.approx(whole, abs=1e-12)
    # A point listed again but for round-off, and one listed twice.
    again = np.concatenate([curve[:5], curve[4:], curve[:1] + 1e-16])
    assert dr.twist.writhe(again, closed=True) == pytest.approx(whole, abs=1e-12)


def test_a_point_on_a_segment_changes_nothing():
    curve = torus(round_about(60), *TORUS[1])
    split = np.insert(curve, 30, 0.3 * curve[29] + 0.7 * curve[30], axis=0)
    assert dr.twist.writhe(split, closed=True) == pytest.approx(dr.twist.writhe(curve, closed=True), abs=1e-12)


def test_what_lies_in_a_plane_does_not_writhe():
    random = np.random.default_rng(0)
    bent = np.cumsum(np.r_[1.0, 0.4 * random.standard_normal(60)])
    flat = np.cumsum(np.stack([np.cos(0.1 * bent), np.sin(0.1 * bent), 0.0 * bent], axis=1), axis=0)
    assert abs(dr.twist.writhe(flat @ rotation((0.3, -0.7, 0.45, 0.5)).T)) <= 1e-12


def test_an_open_helix_gains_with_each_turn_what_a_long_one_has():
    """M1: 1 − pitch/length of a turn, as the turns get many."""
    expected = coil("M1-helix-r0.5-p3.0", "writhe_per_turn").value[0]
    gains = []
    for turns in (4, 16):
        one, more = (dr.twist.writhe(helix(np.linspace(0.0, n, 60 * n + 1), 0.5, 3.0)) for n in (turns, turns + 1))
        gains.append(abs(more - one - expected))
    # What is left is the chords' own, 7.5e-4 of 60 points a turn.
    assert gains[1] < min(gains[0], 2e-3)


def test_frames_of_a_rod_tell_its_twist():
    """A rod that is twisted by w turns: Tw of its d2, of its frames and of κ₁ are w."""
    s, w = np.linspace(0.0, 2.0, 41), 1.3
    φ = 2.0 * np.pi * w * s / 2.0
    frames = np.zeros((41, 3, 3))
    frames[:, 0, 0] = 1.0
    frames[:, 1:, 1:] = np.moveaxis(np.array([[np.cos(φ), -np.sin(φ)], [np.sin(φ), np.cos(φ)]]), 2, 0)
    kappa = np.stack([np.full(41, 2.0 * np.pi * w / 2.0), 0.0 * s, 0.0 * s], axis=1)
    line = np.stack([s, 0.0 * s, 0.0 * s], axis=1)
    found = (
        dr.twist.frame_twist(frames),
        dr.twist.material_twist(s, kappa),
        dr.twist.twist(line, frames[:, :, 1]),
    )
    np.testing.assert_allclose(found, w, atol=1e-12)


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        (lambda r, u: dr.twist.twist(r, u[:-1]), "a vector at every point, got 39 at 40"),
        (lambda r, _: dr.twist.twist(r, np.gradient(r, axis=0)), "lies along it"),
        (lambda r, u: dr.twist.twist(np.repeat(r, 2, axis=0), np.repeat(u, 2, axis=0)), "stands still: points 0"),
        (lambda _, u: dr.twist.twist([[0, 0, 0], [1, 0, 0], [0, 0, 0]], u[:3]), "turns back on itself at corner 1"),
        (lambda r, _: dr.twist.writhe(r[:2], closed=True), "too few different points"),
        (lambda _r, _u: dr.twist.frame_twist([np.eye(3), np.diag([1.0, -1.0, -1.0])]), "half a turn apart"),
    ],
)
def test_what_is_no_ribbon_is_refused(wrong, words):
    line = np.stack([np.linspace(0.0, 1.0, 40), np.zeros(40), np.zeros(40)], axis=1)
    with pytest.raises(ValueError, match=words):
        wrong(line, np.tile([0.0, 1.0, 0.0], (40, 1)))


def test_sums_of_blocks_are_those_of_the_whole():
    """Many segments are taken some rows at a time."""
    r = torus(round_about(1000), *TORUS[0])
    rough, fine = dr.twist.writhe(r[::2], closed=True), dr.twist.writhe(r, closed=True)
    exact = coil(f"M3-writhe-torus-{TORUS[0]}", "writhe").value[0]
    assert abs(fine - exact) == pytest.approx(abs(rough - exact) / 4.0, rel=1e-2)
    assert largest(fine + (fine - rough) / 3.0 - exact) < 1e-7
