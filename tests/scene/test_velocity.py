"""Velocities at the start: rigid motions, and functions of the place."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

import dolfinrod as dr
from dolfinrod.scene import SceneError
from tests.scenes import Pose, poses

Array = NDArray[np.float64]

component = st.floats(-10.0, 10.0)
vectors = st.tuples(component, component, component)
POINTS = np.array([[0.0, 0.0, 0.0], [1.0, 2.0, 3.0], [-1.0, 0.5, 0.0], [4.0, 4.0, 4.0]])


@given(v=vectors, omega=vectors, about=vectors)
def test_distances_stay_and_the_point_turned_about_moves_with_v(v: object, omega: object, about: object) -> None:
    motion = dr.Velocity(v, omega, about)
    moved = motion.at(POINTS)
    apart, closing = POINTS[1:] - POINTS[0], moved[1:] - moved[0]
    np.testing.assert_allclose(np.einsum("ni,ni->n", apart, closing), 0.0, atol=1e-11)
    np.testing.assert_allclose(motion.at(np.array([about])), [v], atol=1e-12)


@given(v=vectors, omega=vectors, about=vectors, pose=poses())
def test_velocities_turn_with_the_scene(v: object, omega: object, about: object, pose: Pose) -> None:
    here = dr.Velocity(v, omega, about).at(POINTS)
    there = dr.Velocity(pose.turned(v), pose.turned(omega), pose.placed(about)).at(pose.origin + POINTS @ pose.Q.T)
    np.testing.assert_allclose(there, here @ pose.Q.T, atol=1e-11)


def test_a_function_gives_the_velocity_beside_the_turning() -> None:
    shear = dr.Velocity(lambda r: r[:, [1, 0, 2]] * [1.0, 0.0, 0.0], omega=(0, 0, 2), about=(1, 0, 0))
    np.testing.assert_allclose(shear.at(np.array([[1.0, 3.0, 0.0]])), [[3.0 - 6.0, 0.0, 0.0]])


@pytest.mark.parametrize("wrong", [lambda r: r[0], lambda r: r * np.nan, lambda r: r[:, :2]])
def test_a_function_of_anything_else_is_refused(wrong: object) -> None:
    with pytest.raises(SceneError, match=r"^Velocity\.v must give finite velocities of shape \(4, 3\), got"):
        dr.Velocity(wrong).at(POINTS)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"v": (1, 2)}, r"^Velocity\.v must have 3 entries \[m/s\], got \(1, 2\)"),
        ({"omega": (0, 0, np.nan)}, r"^Velocity\.omega\[2\] must be a finite number \[rad/s\], got nan rad/s"),
        ({"about": "start"}, r"^Velocity\.about must have 3 entries \[m\], got 'start'"),
        ({"rod": -1}, r"^Velocity\.rod must be the number of a rod"),
    ],
)
def test_what_cannot_be_is_refused_in_words(changes: dict[str, object], message: str) -> None:
    with pytest.raises(SceneError, match=message):
        dr.Velocity(**changes)
