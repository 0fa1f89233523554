"""What an increment foretells, as Newton's method and a chord method leave it."""

from __future__ import annotations

from math import inf

from hypothesis import given
from hypothesis import strategies as st

from discrete.pace import FINE, FINEST, Pace

GOAL = 1e-12
NEAR = 1.0 + 1e-9


@given(st.floats(1e-2, 1e2), st.floats(1e-6, 1e-3))
def test_newton_leaves_no_more_than_is_foretold(C: float, before: float) -> None:
    size = C * before**2
    pace = Pace(size, before, GOAL, 0.0, FINE)
    assert C * size**2 <= pace.left * NEAR
    assert pace.foretold == (pace.left <= GOAL and size < before)


@given(st.floats(1e-6, 0.9), st.floats(1e-8, 1e-2))
def test_a_chord_leaves_the_same_part_again(part: float, before: float) -> None:
    pace = Pace(part * before, before, GOAL, inf, FINE)
    assert abs(pace.left - part**2 * before) <= 1e-9 * pace.left
    assert not pace.foretold
    assert Pace(part * before, before, GOAL, 1.0, FINE).foretold == (pace.left <= GOAL)


@given(st.floats(0.0, 1.0), st.floats(0.0, 1.0), st.sampled_from([0.0, 1.0, inf]), st.booleans())
def test_forces_are_found_neither_too_roughly_nor_too_well(size: float, before: float, age: float, new: bool) -> None:
    assert FINEST <= Pace(size, before, GOAL, age, FINE).fine(renewed=new) <= FINE


def test_slow_increments_ask_for_new_factors_and_quick_ones_do_not() -> None:
    assert Pace(1e-4, 2e-4, GOAL, inf, FINE).slow
    assert not Pace(1e-10, 1e-4, GOAL, inf, FINE).slow
    assert not Pace(1e-4, inf, GOAL, inf, FINE).slow
    assert not Pace(2e-4, 1e-4, GOAL, inf, FINE).slow
