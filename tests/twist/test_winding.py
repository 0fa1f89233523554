"""Fibres wind about one another as often as they do, whoever looks and however they are given."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import dolfinrod as dr
from dolfinrod.twist import gauss
from tests.twist.fibres import MIRROR, wandering
from verification.references.coils import helix, rigid_bundle

pytestmark = pytest.mark.serial

# One winding: sums of some hundred angles, each off by round-off.
ROUND_OFF = 1e-12
X = np.linspace(0.0, 0.04, 81)
turns = st.floats(-3.0, 3.0)


def plied(w, n=81, radius=40e-6, other=np.pi):
    """Two strands that wind w times."""
    x = np.linspace(0.0, 0.04, n)
    angle = 2.0 * np.pi * w * x / 0.04
    return [np.stack([x, radius * np.cos(angle + φ), radius * np.sin(angle + φ)], axis=1) for φ in (0.3, 0.3 + other)]


@settings(max_examples=30)
@given(turns)
def test_a_plied_pair_winds_as_it_was_plied(w):
    assert dr.twist.winding(*plied(w)).turns == pytest.approx(w, abs=ROUND_OFF)


def test_right_handed_is_positive():
    """From −Z over the top (+Y) to +Z as X grows: Z twist, process.md section 3."""
    x = np.linspace(0.0, 1.0, 21)
    angle = np.pi * (x - 0.5)
    over = np.stack([x, np.cos(angle), np.sin(angle)], axis=1)
    assert dr.twist.winding(over * [1.0, 0.0, 0.0], over).turns == pytest.approx(0.5, abs=ROUND_OFF)


def test_57_fibres_turned_rigidly_have_the_twist_they_were_given():
    """T = 55 turns per metre over 40 mm, 2.2 turns of every pair; process.md section 3."""
    found = dr.twist.pairs(rigid_bundle(2.0 * np.pi * 55.0 * X, X))
    assert found.T == pytest.approx(55.0, abs=ROUND_OFF)
    k, l = np.triu_indices(57, 1)
    np.testing.assert_allclose(found.turns[k, l], 2.2, atol=ROUND_OFF)
    np.testing.assert_array_equal(found.turns, found.turns.T)
    assert not found.gauss.any()


@pytest.mark.parametrize("half", [0.1, 1.0, 10.0, 1e3])
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_crossed_lines(side, half):
    """(1/π) atan(a tan α/h), which tends to half a turn."""
    a, h, slope = half, 0.05, 0.4
    lower = np.array([[-a, 0.0, 0.0], [a, 0.0, 0.0]])
    upper = np.array([[-a, side * h, -slope * a], [a, side * h, slope * a]])
    w = dr.twist.winding(lower, upper).turns
    assert w == pytest.approx(side * np.arctan(a * slope / h) / np.pi, abs=ROUND_OFF)
    assert abs(abs(w) - 0.5) <= h / (np.pi * slope * a)


@settings(max_examples=30)
@given(turns, st.integers(30, 200), st.integers(30, 200), st.booleans())
def test_nodes_need_not_be_at_the_same_places(w, n, m, back):
    one, other = plied(w, n)[0], plied(w, m)[1]
    assert dr.twist.winding(one, other[::-1] if back else other).turns == pytest.approx(w, abs=ROUND_OFF)


@settings(max_examples=30)
@given(turns)
def test_the_mirror_image_winds_the_other_way(w):
    one, other = plied(w)
    assert dr.twist.winding(one * MIRROR, other * MIRROR).turns == -dr.twist.winding(one, other).turns


@settings(max_examples=30)
@given(st.integers(0, 10**6))
def test_who_is_named_first_does_not_matter(seed):
    one, other = wandering(seed, (200, 170))
    assert dr.twist.winding(one, other).turns == pytest.approx(dr.twist.winding(other, one).turns, abs=ROUND_OFF)


@settings(max_examples=30)
@given(st.integers(0, 10**6), st.floats(-np.pi, np.pi))
def test_a_bundle_moved_and_turned_about_x_winds_the_same(seed, angle):
    c, s = np.cos(angle), np.sin(angle)
    Q = np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])
    fibres = wandering(seed, (150, 120, 99))
    moved = [np.array([0.3, -0.2, 0.5]) + r @ Q.T for r in fibres]
    np.testing.assert_allclose(dr.twist.pairs(moved).turns, dr.twist.pairs(fibres).turns, atol=1e-10)


@settings(max_examples=30)
@given(st.integers(0, 10**6))
def test_winding_is_the_gauss_integral_of_fibres_that_go_on_straight(seed):
    """Two ways without a common line of code: angles at the same X, solid angles of segments."""
    one, other = wandering(seed, (120, 90))
    assert dr.twist.winding(one, other).turns == pytest.approx(gauss.lengthened(one, other), abs=1e-10)


def test_only_the_stretch_that_both_share_counts():
    one, other = plied(2.0)
    found = dr.twist.winding(one[:61], other[20:])
    assert found.turns == pytest.approx(1.0, abs=ROUND_OFF)
    assert found.length == pytest.approx(0.02)
    assert found.T == pytest.approx(50.0)


def test_a_pair_and_all_pairs_are_one():
    fibres = wandering(3, (80, 87, 94, 101, 108))
    all_of = dr.twist.pairs(fibres)
    for k, l in ((0, 1), (3, 1), (2, 4)):
        assert dr.twist.winding(fibres[k], fibres[l]).turns == pytest.approx(all_of.turns[k, l], abs=ROUND_OFF)


def test_stretches_too_far_apart_are_left_out():
    """Two lines at a distance h with slope 1 against each other are nearer than d where |z| < √(d² − h²)."""
    lower, h, d = np.array([[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]]), 0.03, 0.05
    upper = np.array([[-1.0, h, -1.0], [1.0, h, 1.0]])
    found = dr.twist.winding(lower, upper, within=d)
    assert found.turns == pytest.approx(np.arctan(0.04 / h) / np.pi, abs=ROUND_OFF)
    assert found.left_out == pytest.approx(2.0 - 0.08)
    none = dr.twist.winding(lower, upper, within=0.02)
    assert (none.turns, none.left_out) == (0.0, 2.0)
    everything = dr.twist.winding(lower, upper, within=2.0)
    assert everything == dr.twist.winding(lower, upper)


def test_parallel_fibres_too_far_apart_are_left_out():
    line, beside = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]), np.array([[0.0, 0.1, 0.0], [1.0, 0.1, 0.0]])
    found = dr.twist.winding(line, beside, within=0.05)
    assert (found.turns, found.left_out) == (0.0, 1.0)
    assert dr.twist.winding(line, beside, within=0.2).left_out == 0.0


@pytest.mark.parametrize("w", [2.0, -2.0])
def test_a_hook_is_taken_by_the_gauss_integral_and_said(w):
    """A fibre with a loop beside it, off the other one, winds as without."""
    one, other = plied(w, 161)
    middle = other[80]
    φ = np.linspace(0.0, 2.0 * np.pi, 41)[1:-1, None]
    away = middle * [0.0, 1.0, 1.0] / np.linalg.norm(middle[1:])
    loop = middle + 20e-6 * (np.sin(φ) * [1.0, 0.0, 0.0] + (1.0 - np.cos(φ)) * away)
    hooked = np.concatenate([other[:81], loop, other[81:]])
    found = dr.twist.winding(one, hooked)
    assert found.gauss
    assert not dr.twist.winding(one, other).gauss
    assert found.turns == pytest.approx(w, abs=1e-10)
    assert dr.twist.winding(one * MIRROR, hooked * MIRROR).turns == pytest.approx(-w, abs=1e-10)


def test_a_hook_about_the_other_fibre_counts():
    """Once round it, closed in itself: a turn, either way."""
    line = np.array([[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]])
    t = np.linspace(0.0, 1.0, 81)
    for side in (1.0, -1.0):
        coiled = np.stack([0.2 * np.sin(2 * np.pi * t), np.cos(2 * np.pi * t), side * np.sin(2 * np.pi * t)], axis=1)
        whole = np.concatenate([[[-1.0, 1.0, 0.0]], coiled, [[1.0, 1.0, 0.0]]])
        found = dr.twist.winding(line, whole)
        assert found.gauss
        assert found.turns == pytest.approx(side, abs=1e-10)


def test_one_hook_among_many_fibres():
    fibres = rigid_bundle(2.0 * np.pi * 55.0 * X, X, 5)
    back = fibres[2].copy()
    back[40, 0] = back[39, 0] - 1e-5
    found = dr.twist.pairs([*fibres[:2], back, *fibres[3:]])
    assert found.gauss[2].tolist() == found.gauss[:, 2].tolist() == [True, True, False, True, True]
    assert found.gauss.sum() == 8
    assert found.T == pytest.approx(55.0, abs=1e-9)


@pytest.mark.parametrize("per_turn", [1.5, 2.1, 3.0, 4.0])
def test_points_too_far_apart_are_refused(per_turn):
    with pytest.raises(dr.twist.TooCoarse, match=r"fibres 0 and 1 turn about each other by .* closer together"):
        dr.twist.winding(*plied(20.0, int(20 * per_turn) + 1))


@pytest.mark.parametrize("w", [20.0, -20.0])
def test_smooth_curves_through_few_points_are_taken(w):
    """Three points a turn are too few for lines between them, not for a curve whose slopes are known."""
    x = np.linspace(0.0, 0.04, 61)
    angle, rate = 2.0 * np.pi * w * x / 0.04, 2.0 * np.pi * w / 0.04
    one = [np.stack([x, 4e-5 * np.cos(angle + φ), 4e-5 * np.sin(angle + φ)], axis=1) for φ in (0.0, np.pi)]
    slopes = [np.stack([1.0 + 0.0 * x, -rate * r[:, 2], rate * r[:, 1]], axis=1) for r in one]
    found = dr.twist.winding(*(dr.twist.smooth(r, x, m) for r, m in zip(one, slopes, strict=True)))
    assert found.turns == pytest.approx(w, abs=ROUND_OFF)


def test_fibres_that_meet_are_refused():
    one = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]])
    for through in ([[0.0, 0.1, 0.1], [1.0, -0.1, -0.1]], [[0.0, 0.1, 0.0], [0.5, 0.0, 0.0], [1.0, 0.0, 0.1]]):
        with pytest.raises(ValueError, match="fibres 0 and 1 meet near X"):
            dr.twist.winding(one, through)


@pytest.mark.parametrize(
    ("fibres", "words"),
    [
        ([np.zeros((5, 2))] * 2, "fibre 0 must be two or more points in space"),
        ([helix(X, 1.0, 1.0), np.full((3, 3), np.nan)], "fibre 1 must be finite"),
        ([helix(X, 1.0, 1.0)], "two or more fibres, got 1"),
        ([], "at least one fibre"),
        ([helix(X, 1.0, 1.0), [[9.0, 0.0, 0.0], [9.5, 0.0, 0.0], [9.4, 0.0, 0.0]]], "fibres 0 and 1 share no stretch"),
        ([helix(X, 1.0, 1.0), helix(X + 9.0, 1.0, 1.0)], "fibres 0 and 1 share no stretch of X"),
    ],
)
def test_what_is_no_pair_is_refused_in_words(fibres, words):
    with pytest.raises(ValueError, match=words):
        dr.twist.pairs(fibres)


def test_a_distance_that_is_none_is_refused():
    with pytest.raises(ValueError, match="within must be a positive distance, got -1"):
        dr.twist.winding(*plied(1.0), within=-1.0)
