"""A bundle turns about its axis, here and there along it, and what is delivered."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import dolfinrod as dr
from tests.twist.fibres import MIRROR
from verification.references.coils import rigid_bundle

pytestmark = pytest.mark.serial

ROUND_OFF = 1e-10
X = np.linspace(0.0, 0.04, 81)
EVEN = rigid_bundle(2.0 * np.pi * 55.0 * X, X)
TIGHTER = rigid_bundle(np.pi * 55.0 * X**2 / 0.04, X)


@settings(max_examples=30)
@given(st.floats(-200.0, 200.0))
def test_a_rigidly_turned_bundle_has_its_twist_about_any_axis_of_its_own(T):
    fibres = rigid_bundle(2.0 * np.pi * T * X, X, 7)
    assert dr.twist.axis_winding(fibres).T == pytest.approx(T, abs=ROUND_OFF)
    assert dr.twist.axis_winding(fibres, axis=(0.0, 0.0)).T == pytest.approx(T, abs=ROUND_OFF)


def test_fibres_wound_on_a_core():
    """A core that is itself bent: fibres about it turn as often as they were wound."""
    bent = np.stack([X, 1e-4 * np.sin(100 * X), 2e-4 * X], axis=1)
    wound = [r + bent * [0.0, 1.0, 1.0] for r in EVEN]
    found = dr.twist.axis_winding(wound, axis=bent)
    assert found.T == pytest.approx(55.0, abs=ROUND_OFF)
    assert found.turns == pytest.approx(2.2, abs=ROUND_OFF)
    single = dr.twist.axis_winding(wound[5:6], axis=bent)
    assert single.T == pytest.approx(55.0, abs=ROUND_OFF)


def test_far_fibres_count_with_the_square_of_their_distance():
    """Σ r² θ′ / (2π Σ r²), of two rings that turn differently."""
    rings = [(1e-5, 40.0), (3e-5, 70.0)]
    expected = (1.0 * 40.0 + 9.0 * 70.0) / 10.0
    errors = []
    for n in (81, 161):
        fine = np.linspace(0.0, 0.04, n)
        fibres = [
            np.stack([fine, r * np.cos(2 * np.pi * T * fine + φ), r * np.sin(2 * np.pi * T * fine + φ)], axis=1)
            for r, T in rings
            for φ in (0.1, 0.1 + np.pi)
        ]
        errors.append(abs(dr.twist.axis_winding(fibres, axis=(0.0, 0.0)).T - expected))
    assert errors[1] < 1e-2
    assert np.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.1)


def test_the_profile_of_a_bundle_that_gets_tighter():
    """T(X) = 55 X/L, its mean over each stretch."""
    found = dr.twist.profile(TIGHTER, 20)
    middle = 0.5 * (found.X[1:] + found.X[:-1])
    np.testing.assert_allclose(found.axis, 55.0 * middle / 0.04, atol=ROUND_OFF)
    np.testing.assert_allclose(found.pairs, 55.0 * middle / 0.04, atol=ROUND_OFF)


def test_profiles_add_up_to_windings():
    bent = [r + np.stack([0 * X, 2e-6 * np.sin(60 * X + k), 2e-6 * np.cos(90 * X * k)], 1) for k, r in enumerate(EVEN)]
    found = dr.twist.profile(bent, X[[0, 3, 35, 80]])
    length = np.diff(found.X)
    assert found.axis @ length == pytest.approx(dr.twist.axis_winding(bent).turns, abs=ROUND_OFF)
    assert found.pairs @ length == pytest.approx(0.04 * dr.twist.pairs(bent).T, abs=ROUND_OFF)


def test_what_is_delivered_is_the_last_10_mm():
    found = dr.twist.delivered(TIGHTER)
    np.testing.assert_allclose(found.X, [0.03, 0.04])
    np.testing.assert_allclose([found.axis[0], found.pairs[0]], 55.0 * 0.035 / 0.04, atol=ROUND_OFF)
    np.testing.assert_allclose(dr.twist.delivered(TIGHTER, length=0.02).pairs, 55.0 * 0.03 / 0.04, atol=ROUND_OFF)


def test_the_mirror_image_is_of_s_twist():
    image = [r * MIRROR for r in TIGHTER]
    assert dr.twist.axis_winding(image).T == pytest.approx(-dr.twist.axis_winding(TIGHTER).T, abs=ROUND_OFF)
    right, left = dr.twist.profile(TIGHTER, 5), dr.twist.profile(image, 5)
    np.testing.assert_allclose([left.axis, left.pairs], [-right.axis, -right.pairs], atol=ROUND_OFF)


def test_a_fibre_that_turns_back_is_named():
    hooked = EVEN[3].copy()
    hooked[40, 0] = hooked[39, 0] - 1e-5
    with pytest.raises(ValueError, match=r"fibre 1 turns back at X = 0.0195 m \(point 39\)"):
        dr.twist.axis_winding([EVEN[0], hooked, EVEN[2]])
    with pytest.raises(ValueError, match="fibre 1 turns back"):
        dr.twist.delivered([EVEN[0], hooked])


def test_what_has_no_axis_is_refused():
    with pytest.raises(ValueError, match="all fibres lie on the axis"):
        dr.twist.axis_winding(EVEN[:1])
    with pytest.raises(ValueError, match="the axis must reach from X = 0"):
        dr.twist.axis_winding(EVEN, axis=EVEN[0][:20])


def test_points_too_far_apart_are_refused():
    coarse = np.linspace(0.0, 0.04, 9)
    with pytest.raises(dr.twist.TooCoarse, match="the bundle turns by 99 degrees"):
        dr.twist.axis_winding(rigid_bundle(2.0 * np.pi * 55.0 * coarse, coarse))


@pytest.mark.parametrize("stations", [[0.0], [0.0, 0.02, 0.01], [0.0, 0.05]])
def test_stations_off_the_fibres_are_refused(stations):
    with pytest.raises(ValueError, match="stations must ascend within X"):
        dr.twist.profile(EVEN, np.array(stations))
