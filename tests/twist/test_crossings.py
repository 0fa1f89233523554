"""Who crosses whom as seen from above, on which side, and who has changed places."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import dolfinrod as dr
from tests.twist.fibres import MIRROR, wandering
from verification.references.coils import rigid_bundle

pytestmark = pytest.mark.serial

X = np.linspace(0.0, 0.04, 81)
# Crosses it from left to right at X = 0.5, on top and below.
LINE = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]])
ABOVE = np.array([[0.0, 0.1, -0.3], [1.0, 0.1, 0.3]])
BELOW = ABOVE * [1.0, -1.0, 1.0]


def test_from_the_left_over_the_top_to_the_right_is_z():
    """process.md section 3."""
    assert dr.twist.crossings([LINE, ABOVE]) == (dr.twist.Crossing(0, 1, 0.5, over=1, sign=1, gap=0.1),)
    assert dr.twist.crossings([LINE, BELOW]) == (dr.twist.Crossing(0, 1, 0.5, over=0, sign=-1, gap=0.1),)


def test_whoever_is_named_first():
    (found,) = dr.twist.crossings([ABOVE, LINE])
    assert (found.over, found.sign) == (0, 1)


def test_either_way_along_the_fibre():
    assert dr.twist.crossings([LINE[::-1], ABOVE]) == dr.twist.crossings([LINE, ABOVE])


@settings(max_examples=30)
@given(st.integers(0, 10**6))
def test_the_mirror_image_has_the_opposite_signs_and_the_same_on_top(seed):
    fibres = wandering(seed, (90, 80, 101))
    right, left = dr.twist.crossings(fibres), dr.twist.crossings([r * MIRROR for r in fibres])
    assert [c.sign for c in left] == [-c.sign for c in right]
    assert [(c.k, c.l, c.over) for c in left] == [(c.k, c.l, c.over) for c in right]
    np.testing.assert_allclose([c.X for c in left], [c.X for c in right], atol=1e-15)


@settings(max_examples=30)
@given(st.integers(0, 10**6))
def test_signs_add_up_to_twice_the_winding_but_for_the_ends(seed):
    pair = wandering(seed, (90, 80))
    total = sum(c.sign for c in dr.twist.crossings(pair))
    assert abs(2.0 * dr.twist.winding(*pair).turns - total) < 1.0


def test_a_turned_bundle_crosses_twice_a_turn():
    """57 fibres over 2.2 turns: each of 1596 pairs four times, or five where its angle at A is near enough to ±X."""
    found = dr.twist.crossings(rigid_bundle(2.0 * np.pi * 55.0 * X, X))
    assert {c.sign for c in found} == {1}
    each = np.zeros((57, 57), dtype=int)
    for c in found:
        each[c.k, c.l] += 1
    assert set(each[np.triu_indices(57, 1)]) == {4, 5}
    assert all(a.X <= b.X for a, b in pairwise(found))


def test_fibres_side_by_side_in_a_plane_do_not_cross():
    flat = [np.stack([X, 1e-5 * k + 0 * X, 0 * X], axis=1) for k in range(3)]
    assert dr.twist.crossings(flat) == ()


def test_fibre_5_crosses_fibre_4():
    """|Δw| ≥ 0.4 and another order in Z at B than at A: process.md section 3."""
    steep = ABOVE * [1.0, 1.0, 5.0]
    assert dr.twist.exchanges([LINE, steep]) == (dr.twist.Exchange(1, 0, dr.twist.winding(LINE, steep).turns),)
    assert dr.twist.exchanges([LINE, steep * [1.0, -1.0, 1.0]])[0].turns < -0.4
    # 0.398 turns are less than 0.4.
    assert dr.twist.exchanges([LINE, ABOVE]) == ()


def test_a_whole_turn_changes_no_places():
    a = rigid_bundle(2.0 * np.pi * 25.0 * X, X, 2)
    assert abs(dr.twist.winding(*a).turns) == pytest.approx(1.0)
    assert dr.twist.exchanges(a) == ()


def test_only_what_is_new_counts():
    fibres = [LINE, ABOVE * [1.0, 1.0, 5.0]]
    assert dr.twist.exchanges(fibres, before=fibres) == ()
    apart = [LINE, np.array([[0.0, 0.1, -1.5], [1.0, 0.1, -1.5]])]
    assert dr.twist.exchanges(fibres, before=apart) == dr.twist.exchanges(fibres)


def test_a_fibre_that_turns_back_is_refused():
    with pytest.raises(ValueError, match="a list of crossings needs fibres that run along X, but fibre 1 turns back"):
        dr.twist.crossings([LINE, [[0.0, 1.0, 0.0], [0.7, 1.0, 0.0], [0.6, 1.0, 0.0], [1.0, 1.0, 0.0]]])
