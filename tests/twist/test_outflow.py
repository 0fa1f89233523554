"""What leaves through a plane has the twist that it had before."""

from __future__ import annotations

import numpy as np
import pytest

import dolfinrod as dr
from verification.references.coils import rigid_bundle

pytestmark = pytest.mark.serial

SPEED, PLANE = 0.1716, 0.04
t = np.linspace(0.0, 0.02, 41)
X = np.linspace(-0.01, 0.05, 61)


def histories(angle, n=4):
    """Sections turned by angle(X, t)."""
    states = [rigid_bundle(angle(X, time), X, n) for time in t]
    return [np.stack(rows) for rows in zip(*states, strict=True)]


def straight(X, _time):
    return 0.0 * X


@pytest.mark.parametrize("T", [55.0, -55.0, 3.0])
def test_a_rigid_helix_that_moves_on_delivers_its_own_twist(T):
    found = dr.twist.outflow(t, histories(lambda X, time: 2.0 * np.pi * T * (X - SPEED * time)), X=PLANE, speed=SPEED)
    np.testing.assert_allclose(found.T, T, atol=1e-9)
    assert found.mean == pytest.approx(T, abs=1e-9)
    assert found.turns[-1] == pytest.approx(T * SPEED * 0.02, abs=1e-12)


def test_what_turns_on_the_spot_delivers_the_opposite():
    """ω about +X at the plane, no twist before it: −ω/(2πv) behind it, as false twist has it."""
    found = dr.twist.outflow(t, histories(lambda X, time: 50.0 * time + 0.0 * X), X=PLANE, speed=SPEED)
    np.testing.assert_allclose(found.T, -50.0 / (2.0 * np.pi * SPEED), rtol=1e-9)


def test_what_moves_on_straight_delivers_nothing():
    found = dr.twist.outflow(t, histories(straight), X=PLANE, speed=SPEED)
    np.testing.assert_array_equal(found.turns, 0.0)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"X": 0.06}, "fibre 0 does not reach the plane X = 0.06 m at t = 0 s: it goes from X = -0.01 to 0.05 m"),
        ({"speed": 0.0}, "a positive speed, got .* 0.0 m/s"),
    ],
)
def test_what_cannot_be_is_refused(change, words):
    with pytest.raises(ValueError, match=words):
        dr.twist.outflow(t, histories(straight), **({"X": PLANE, "speed": SPEED} | change))


def test_too_few_states_are_refused():
    with pytest.raises(ValueError, match=r"turn by .* degrees in the plane .* store more states"):
        dr.twist.outflow(t, histories(lambda X, time: 4e3 * time + 0.0 * X), X=PLANE, speed=SPEED)
