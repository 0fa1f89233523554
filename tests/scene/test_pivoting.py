"""Points that a wall presses at the end of a linear step: complementarity, whatever the step and the rod."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dolfinrod.scene.pivoting import Outlook, joined, pivoted

SIZES, SEEDS = st.integers(1, 12), st.integers(0, 2**32 - 1)


def stepped(n: int, seed: int, stiffness: float) -> tuple[np.ndarray, np.ndarray, np.ndarray, Outlook]:
    """Points on an elastic body K under loads f, some of which springs press: the step from rest, and how it moves."""
    rng = np.random.default_rng(seed)
    root = rng.normal(size=(n, n))
    K, f, pressed = root @ root.T + 0.1 * np.eye(n), rng.normal(size=n), rng.random(n) < 0.5
    # Gaps at rest; what is pressed begins within the wall.
    gap = np.where(pressed, -1.0, 1.0) * rng.random(n)
    k = np.full(n, stiffness)
    tangent = K + np.diag(np.where(pressed, k, 0.0))
    way = np.linalg.solve(tangent, f + np.where(pressed, -k * gap, 0.0))
    one = Outlook(-k * gap, -k * (gap + way), pressed, k, np.tile([0.0, 0.0, 1.0], (n, 1)), np.ones(n))
    return K, f - K @ way, np.linalg.inv(tangent), one


@given(SIZES, SEEDS, st.sampled_from((1e-2, 1.0, 1e4, 1e8)))
def test_what_is_pressed_bears_and_the_rest_is_clear(n: int, seed: int, stiffness: float) -> None:
    _, _, moves, ahead = stepped(n, seed, stiffness)
    found = pivoted(ahead, lambda i: moves[:, i].copy())
    assert found is not None
    pressed, q = found
    p = ahead.pressure - ahead.slope * (moves @ q)
    size = np.abs(ahead.pressure).max()
    assert p[pressed].min(initial=0.0) >= -1e-7 * size
    assert p[~pressed].max(initial=0.0) <= 1e-7 * size
    # The forces are those of the points exchanged, and of no others.
    assert q[pressed == ahead.pressed] == pytest.approx(0.0, abs=0.0)
    came, left = pressed & ~ahead.pressed, ahead.pressed & ~pressed
    assert q[came] == pytest.approx(p[came], abs=1e-7 * size)
    assert q[left] == pytest.approx(-p[left], abs=1e-7 * size)


def test_a_step_with_the_right_points_is_left_as_it_is() -> None:
    one = Outlook(
        start=np.array([1.0, -1.0]),
        pressure=np.array([2.0, -3.0]),
        pressed=np.array([True, False]),
        slope=np.ones(2),
        normal=np.eye(3)[:2],
        share=np.ones(2),
    )

    def never(point: int) -> np.ndarray:
        raise AssertionError(point)

    found = pivoted(one, never)
    assert found is not None
    assert found[0].tolist() == [True, False]
    assert not found[1].any()


def test_a_body_that_gives_way_has_no_way_on() -> None:
    # A push moves it towards the push: K < 0, and the step leads into the wall.
    one = Outlook(np.array([-1.0]), np.array([1.0]), np.array([False]), np.ones(1), np.eye(3)[:1], np.ones(1))
    assert pivoted(one, lambda _: np.array([-2.0])) is None


def test_walls_are_joined_point_after_point() -> None:
    (*_, one), (*_, two) = stepped(3, 1, 1.0), stepped(2, 2, 1.0)
    both = joined([one, two])
    assert both.pressure.tolist() == [*one.pressure, *two.pressure]
    assert both.normal.shape == (5, 3)
