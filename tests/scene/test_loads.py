"""Loads, their histories and the motion: plain values, and what cannot be."""

from __future__ import annotations

from collections.abc import Callable
from math import inf, nan

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dolfinrod.scene import (
    FollowerForce,
    FollowerMoment,
    Gravity,
    LineForce,
    PointForce,
    PointMoment,
    SceneError,
    Static,
    Steady,
    factor,
    kinks,
)

POINT_LOADS = (PointForce, PointMoment, FollowerForce, FollowerMoment)
finite = st.floats(-1e6, 1e6)
tables = st.dictionaries(st.floats(0.0, 10.0), finite, min_size=1, max_size=6).map(lambda d: tuple(sorted(d.items())))


@pytest.mark.parametrize("kind", POINT_LOADS)
def test_vectors_come_as_any_sequence_and_stay_tuples_of_floats(kind: type[PointForce]) -> None:
    loads = {kind(v, at="end") for v in ((1, 0, 2), [1.0, 0.0, 2.0], np.array([1, 0, 2]))}
    assert len(loads) == 1
    (load,) = loads
    held = getattr(load, "force" if "Force" in kind.__name__ else "moment")
    assert held == (1.0, 0.0, 2.0)
    assert all(type(x) is float for x in held)


@given(t=st.floats(0.0, 2.0), t_end=st.floats(0.5, 2.0))
def test_no_history_is_proportional_and_steady_is_full(t: float, t_end: float) -> None:
    assert factor(None, t, t_end) == t / t_end
    assert factor(None, t_end, t_end) == 1.0
    assert factor(Steady(), t, t_end) == 1.0
    assert kinks(None) == kinks(Steady()) == ()


@given(table=tables, t=st.floats(-1.0, 11.0))
def test_a_table_is_met_at_its_rows_linear_between_and_constant_beyond(
    table: tuple[tuple[float, float], ...], t: float
) -> None:
    history = PointForce((1, 0, 0), "end", history=list(table)).history
    assert history == table
    assert kinks(history) == tuple(row[0] for row in table)
    for time, value in table:
        assert factor(history, time, 1.0) == value
    assert factor(history, table[0][0] - 1.0, 1.0) == table[0][1]
    assert factor(history, table[-1][0] + 1.0, 1.0) == table[-1][1]
    values = [value for _, value in table]
    slack = 1e-15 * max(map(abs, values))
    assert min(values) - slack <= factor(history, t, 1.0) <= max(values) + slack


def test_a_table_halfway_is_the_mean() -> None:
    assert factor(((0.0, 1.0), (0.5, 3.0)), 0.25, 1.0) == 2.0


def test_a_function_of_time_is_called_and_its_result_checked() -> None:
    assert factor(np.cos, 0.0, 1.0) == 1.0
    assert kinks(np.cos) == ()
    with pytest.raises(SceneError, match=r"history\(0\.5\) must be a finite number, got inf"):
        factor(lambda t: inf, 0.5, 1.0)  # noqa: ARG005


def test_static_by_default_steps_as_it_can_to_one() -> None:
    assert Static() == Static(steps=None, t_end=1.0)
    assert Static(np.int64(4)).steps == 4


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: PointForce((0, nan, 0), "end"), r"PointForce\.force\[1\] must be a finite number \[N\], got nan N"),
        (lambda: PointForce((0, 1), "end"), r"PointForce\.force must have 3 entries \[N\], got \(0, 1\)"),
        (lambda: PointForce(5.0, "end"), r"PointForce\.force must have 3 entries \[N\], got 5\.0"),
        (lambda: PointForce("xyz", "end"), r"PointForce\.force must have 3 entries \[N\], got 'xyz'"),
        (lambda: PointForce((0, 0, 1), at=-1), r"PointForce\.at must not be negative, got -1\.0 m"),
        (lambda: PointForce((0, 0, 1), at=None), r"PointForce\.at must be a finite number \[m\], got None"),
        (lambda: FollowerForce((0, 0, 1), at="tip"), r'FollowerForce\.at must be "start", "end" or an arc length'),
        (
            lambda: PointMoment((0, 0, inf), at="end"),
            r"PointMoment\.moment\[2\] must be a finite number \[N m\], got inf N m",
        ),
        (
            lambda: FollowerMoment((0, 0, 1), "end", rod=0.5),
            r"FollowerMoment\.rod must be the number of a rod .* got 0\.5",
        ),
        (lambda: LineForce((0, nan, 0)), r"LineForce\.force\[1\] must be a finite number \[N/m\], got nan N/m"),
        (lambda: LineForce((0, 0, 1), between=(2, 1)), r"LineForce\.between must ascend, got \(2\.0, 1\.0\) m"),
        (lambda: LineForce((0, 0, 1), between=(-1, 1)), r"LineForce\.between\[0\] must not be negative, got -1\.0 m"),
        (lambda: Gravity((0, 0, nan)), r"Gravity\.g\[2\] must be a finite number \[m/s²\], got nan m/s²"),
        (lambda: Gravity((0, 0, 1), history="slow"), r"Gravity\.history must be None, Steady\(\), rows .*, got 'slow'"),
        (
            lambda: Gravity((0, 0, 1), history=()),
            r"Gravity\.history must have at least one row \(t, factor\), got none",
        ),
        (
            lambda: Gravity((0, 0, 1), history=[(0, 1, 2)]),
            r"Gravity\.history\[0\] must have 2 entries, got \(0, 1, 2\)",
        ),
        (
            lambda: Gravity((0, 0, 1), history=[(0, nan)]),
            r"Gravity\.history\[0\]\[1\] must be a finite number, got nan",
        ),
        (
            lambda: Gravity((0, 0, 1), history=[(1, 0), (0, 0)]),
            r"Gravity\.history\[1\]\[0\] must be later than 1\.0, .* got 0\.0",
        ),
        (lambda: Static(steps=0), r"Static\.steps must be a whole number of at least 1, got 0"),
        (lambda: Static(steps=2.5), r"Static\.steps must be a whole number of at least 1, got 2\.5"),
        (lambda: Static(t_end=0.0), r"Static\.t_end must be positive, got 0\.0"),
    ],
)
def test_what_cannot_be_is_refused_in_words(make: Callable[[], object], message: str) -> None:
    with pytest.raises(SceneError, match=message):
        make()
