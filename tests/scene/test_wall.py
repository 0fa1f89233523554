"""Walls move as rigid bodies: turned about a point, then shifted, over a history or for ever."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

import dolfinrod as dr
from dolfinrod.scene import SceneError

# Of a size between nothing and a few, as round-off is judged against the largest.
numbers = st.integers(-900, 900).map(lambda n: n / 90)
vectors = st.tuples(numbers, numbers, numbers)
histories = st.sampled_from([None, dr.Steady(), ((0.0, 0.0), (1.0, 3.0), (4.0, -1.0)), np.sin])


@st.composite
def motions(draw: st.DrawFn) -> dr.WallMotion:
    """Any motion about one axis."""
    axis, (angle, spin) = np.array(draw(vectors)), draw(st.tuples(numbers, numbers))
    pushed, drawn, about = draw(vectors), draw(vectors), draw(vectors)
    return dr.WallMotion(pushed, angle * axis, draw(histories), drawn, spin * axis, about)


def factor(history: object, t: float, t_end: float) -> float:
    """f at a time, written anew."""
    if isinstance(history, dr.Steady):
        return 1.0
    if callable(history):
        return float(history(t))
    return t / t_end if history is None else float(np.interp(t, *np.transpose(history)))


@settings(max_examples=50)
@given(motion=motions(), t=st.floats(0.0, 4.0), X=vectors)
def test_a_wall_is_turned_about_a_point_and_shifted(motion: dr.WallMotion, t: float, X: object) -> None:
    X, f, about = np.array([X]), factor(motion.history, t, 4.0), np.array(motion.about)
    turn = f * np.array(motion.rotation) + t * np.array(motion.spin)
    expected = about + Rotation.from_rotvec(turn).apply(X - about)
    expected += f * np.array(motion.displacement) + t * np.array(motion.velocity)
    pose = motion.pose(t, 4.0)
    np.testing.assert_allclose(pose.out(X), expected, atol=1e-10)
    np.testing.assert_allclose(pose.back(expected), X, atol=1e-10)
    np.testing.assert_allclose(motion.turn(t, 4.0), turn, atol=1e-14)
    np.testing.assert_allclose(pose.Q.T @ pose.Q, np.eye(3), atol=1e-14)
    assert np.linalg.det(pose.Q) == pytest.approx(1.0)


def test_turns_count_beyond_a_full_one() -> None:
    roller = dr.WallMotion(spin=(0, 0, 4 * np.pi), about=(1, 0, 0))
    assert roller.turn(1.5, 2.0) == pytest.approx([0, 0, 6 * np.pi])
    assert roller.pose(1.5, 2.0).out(np.array([[2.0, 0, 0]])) == pytest.approx(np.array([[2.0, 0, 0]]))
    assert roller.pose(1.625, 2.0).out(np.array([[2.0, 0, 0]])) == pytest.approx(np.array([[1.0, 1.0, 0]]))


@settings(max_examples=50)
@given(axis=vectors, rotation=numbers, spin=numbers)
def test_turns_about_one_axis_may_be_written_with_round_off(axis: object, rotation: float, spin: float) -> None:
    motion = dr.WallMotion(rotation=rotation * np.array(axis), spin=spin * np.array(axis))
    np.testing.assert_allclose(motion.turn(2.0, 4.0), (0.5 * rotation + 2.0 * spin) * np.array(axis), atol=1e-12)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (
            lambda: dr.WallMotion(rotation=(0, 0, 1), spin=(0, 1e-3, 1)),
            r"^WallMotion\.spin must be along rotation \(0\.0, 0\.0, 1\.0\) rad, got \(0\.0, 0\.001, 1\.0\) rad/s$",
        ),
        (lambda: dr.WallMotion(velocity=1.0), r"^WallMotion\.velocity must have 3 entries \[m/s\], got 1\.0"),
        (
            lambda: dr.WallMotion((0, np.inf, 0)),
            r"^WallMotion\.displacement\[1\] must be a finite number \[m\], got inf",
        ),
        (lambda: dr.WallMotion(spin=(0, 0, "fast")), r"^WallMotion\.spin\[2\] must be a finite number \[rad/s\], got"),
        (lambda: dr.WallMotion(history="ramp"), r"^WallMotion\.history must be None, Steady\(\), rows \(t, factor\)"),
        (lambda: dr.Plane(motion=(1, 0, 0)), r"^Plane\.motion must be WallMotion or None, got \(1, 0, 0\)$"),
        (lambda: dr.Plane(normal=(0, 0, 0)), r"^Plane\.normal must not be zero, got \(0, 0, 0\)$"),
        (lambda: dr.Plane(point=(0, 0)), r"^Plane\.point must have 3 entries \[m\], got \(0, 0\)$"),
    ],
)
def test_what_cannot_be_is_refused_in_words(make: Callable[[], object], message: str) -> None:
    with pytest.raises(SceneError, match=message):
        make()
