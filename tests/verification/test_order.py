"""Orders are read off what lies above round-off."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from verification.order import FLOOR, order

pytestmark = pytest.mark.serial

MESHES = (4, 8, 16)


@given(power=st.floats(0.5, 6.0), factor=st.floats(1e-3, 10.0))
def test_pure_power_is_found(power, factor):
    errors = [factor * n**-power for n in MESHES]
    assert order(errors, MESHES, 2).observed == pytest.approx(power)


def test_finest_pair_above_round_off_counts():
    found = order((1e-6, 1e-6 / 256, 1e-16), MESHES, 8)
    assert found.observed == pytest.approx(8.0)
    assert found.meshes == (4, 8)
    assert found.worst == 1e-6


def test_round_off_shows_no_order():
    found = order((FLOOR / 2, FLOOR / 3, FLOOR / 4), MESHES, 4)
    assert found.observed is None
    assert found.meshes is None


def test_failed_meshes_are_passed_over():
    assert order((np.nan, 1e-2, 2.5e-3), MESHES, 2).observed == pytest.approx(2.0)
