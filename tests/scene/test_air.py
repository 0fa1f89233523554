"""Air: a drag law that is smooth, dissipative and objective, and the numbers it is known by."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.optimize import brentq

import dolfinrod as dr
from dolfinrod.scene import SceneError
from dolfinrod.scene.drag import CREEPING, FAST, SLOW, drag_coefficients, resistances
from tests.scenes import Pose, poses

Array = NDArray[np.float64]

AIR = dr.Air()
ALONG_X = np.array([[1.0, 0.0, 0.0]])
FIBRE = np.array([20e-6])
# From creep to beyond the last range of the law: w = 1e-6 … 1e4 at these diameters.
speeds = st.floats(-6.0, 3.0).map(lambda exponent: 10.0**exponent)
diameters = st.floats(-5.0, -3.0).map(lambda exponent: np.array([10.0**exponent]))


@st.composite
def unit_vectors(draw: st.DrawFn) -> Array:
    """Any direction, shape (1, 3)."""
    v = np.array(draw(st.tuples(*[st.floats(-1.0, 1.0)] * 3).filter(lambda v: np.linalg.norm(v) > 0.1)))
    return v[None] / np.linalg.norm(v)


velocities = st.builds(lambda speed, direction: speed * direction, speeds, unit_vectors())


# Air of 1.204 kg/m³ and 1.503e-5 m²/s past a fibre of 20 µm: design/process.md, 2.4, whose digits these are.
@pytest.mark.parametrize(
    ("U", "w", "c_n", "f_n", "f_t"),
    [
        (0.1, 0.133, 23.42, 5.64e-6, 3.21e-6),
        (1.0, 1.33, 4.491, 1.081e-4, 6.29e-5),
        (5.0, 6.65, 1.752, 1.055e-3, 5.54e-4),
        (10.0, 13.3, 1.265, 3.046e-3, 1.454e-3),
        (20.0, 26.6, 0.968, 9.324e-3, 3.90e-3),
        (30.0, 39.9, 0.8528, 1.848e-2, 7.00e-3),
        (65.7, 87.4, 0.7146, 7.43e-2, 2.22e-2),
    ],
)
def test_forces_on_a_fibre_are_those_of_the_table(U: float, w: float, c_n: float, f_n: float, f_t: float) -> None:
    air = dr.Air(viscosity=1.204 * 1.503e-5)
    force = air.drag(np.array([[U, U, 0.0]]), ALONG_X, FIBRE)[0]
    assert force == pytest.approx([f_t, f_n, 0.0], rel=2.3e-3)  # half a unit of the last digit
    assert drag_coefficients(np.array([U * 20e-6 / 1.503e-5]))[0][0] == pytest.approx(c_n, rel=3e-4)
    assert U * 20e-6 / 1.503e-5 == pytest.approx(w, rel=3e-3)


def test_coefficients_are_those_of_cylinders_across_a_flow() -> None:
    # C_D = 2 c_n is 10.9 at Re = 1 and 1.40 at Re = 100: design/process.md, 2.4.
    assert 2 * drag_coefficients(np.array([1.0, 100.0]))[0] == pytest.approx([10.9, 1.40], rel=5e-3)


@pytest.mark.parametrize("joint", [SLOW, FAST])
def test_value_and_slope_are_continuous_between_the_ranges(joint: float) -> None:
    before, after = resistances(np.array([joint * (1 - 1e-13), joint * (1 + 1e-13)])).T
    np.testing.assert_allclose(before, after, rtol=1e-4)
    # The slopes of the coefficients themselves, c′ = (k′ − k/w)/w.
    np.testing.assert_allclose(*(k[2:] - k[:2] / joint for k in (before, after)), rtol=1e-4)


@given(st.floats(-8.0, 6.0))
def test_resistances_and_their_slopes_go_together(exponent: float) -> None:
    w = 10.0**exponent
    h = 1e-5 * w
    low, at, high = resistances(np.array([w - h, w, w + h])).T
    assert (at[:2] > 0.0).all()
    assert (at[2:] >= 0.0).all()
    assume(all(abs(w - joint) > 2 * h for joint in (CREEPING, SLOW, FAST)))
    np.testing.assert_allclose((high - low)[:2] / (2 * h), at[2:], rtol=1e-6, atol=1e-8 * at[:2].min() / w)


@given(direction=unit_vectors(), tangent=unit_vectors(), d=diameters)
def test_creeping_flow_drags_in_proportion_to_the_velocity(direction: Array, tangent: Array, d: Array) -> None:
    slowest = 0.9 * CREEPING * AIR.viscosity / (AIR.density * d[0])
    full = AIR.drag(slowest * direction, tangent, d)
    np.testing.assert_allclose(AIR.drag(1e-6 * slowest * direction, tangent, d), 1e-6 * full, rtol=1e-9, atol=1e-30)
    # Slender-body theory: k_n = 4π/S and k_t = 4π/(2S − 1), but for terms in w².
    S = 2.0022 - np.log(CREEPING)
    assert resistances(np.array([CREEPING]))[:2, 0] == pytest.approx([4 * np.pi / S, 4 * np.pi / (2 * S - 1)], rel=1e-6)


@given(v=velocities, tangent=unit_vectors(), d=diameters, pose=poses())
def test_drag_turns_with_the_rod_and_the_wind(v: Array, tangent: Array, d: Array, pose: Pose) -> None:
    force = AIR.drag(v, tangent, d)
    np.testing.assert_allclose(
        AIR.drag(v @ pose.Q.T, tangent @ pose.Q.T, d), force @ pose.Q.T, atol=1e-10 * np.abs(force).max()
    )


@given(v=velocities, tangent=unit_vectors(), d=diameters)
def test_drag_never_feeds_energy_is_odd_and_the_same_for_both_ways_along(v: Array, tangent: Array, d: Array) -> None:
    force = AIR.drag(v, tangent, d)
    assert np.sum(force * v) > 0.0
    np.testing.assert_array_equal(AIR.drag(-v, tangent, d), -force)
    np.testing.assert_allclose(AIR.drag(v, -tangent, d), force, rtol=1e-12)


@given(v=velocities, tangent=unit_vectors(), d=diameters, spin=unit_vectors())
def test_derivatives_are_those_of_the_force(v: Array, tangent: Array, d: Array, spin: Array) -> None:
    force, by_v, by_t = AIR.linearized_drag(v, tangent, d)
    np.testing.assert_allclose(force, AIR.drag(v, tangent, d), rtol=1e-13)
    np.testing.assert_array_equal(by_v, AIR.drag_gradient(v, tangent, d))
    speed = float(np.linalg.norm(v))
    across = float(np.linalg.norm(v - np.sum(v * tangent) * tangent))
    h = 1e-5 * across / speed
    w = across * d[0] * AIR.density / AIR.viscosity
    # There the law bends within the step of the difference.
    assume(across > 1e-3 * speed and all(abs(w / joint - 1.0) > 1e-4 for joint in (CREEPING, SLOW, FAST)))
    for δv in np.eye(3)[:, None] * speed:
        change = (AIR.drag(v + h * δv, tangent, d) - AIR.drag(v - h * δv, tangent, d)) / (2 * h)
        np.testing.assert_allclose(by_v[0] @ δv[0], change[0], atol=1e-5 * np.linalg.norm(by_v) * speed)
    # Tangents on a circle about the spin: δt = spin × t, with second-order changes along t left out by the difference.
    δt = np.cross(spin, tangent)
    turned = [t / np.linalg.norm(t) for t in (tangent + h * δt, tangent - h * δt)]
    change = (AIR.drag(v, turned[0], d) - AIR.drag(v, turned[1], d)) / (2 * h)
    np.testing.assert_allclose(by_t[0] @ δt[0], change[0], atol=1e-5 * np.linalg.norm(by_t))


def test_rest_and_wind_along_a_rod_are_no_trouble() -> None:
    still = AIR.linearized_drag(np.zeros((1, 3)), ALONG_X, FIBRE)
    assert not still[0].any()
    assert (np.linalg.eigvalsh(still[1][0]) > 0.0).all()
    force, by_v, _ = AIR.linearized_drag(30.0 * ALONG_X, ALONG_X, FIBRE)
    assert force[0, 0] > 0.0
    assert not force[0, 1:].any()
    assert np.isfinite(by_v).all()


def test_a_horizontal_ramie_fibre_falls_at_the_known_speed() -> None:
    # design/process.md, 2.4: 0.08695 m/s at Re 0.1157, in air of 20 °C.
    weight = dr.Section.ramie().rhoA * 9.81
    speed = brentq(lambda v: AIR.drag(np.array([[0.0, v, 0.0]]), ALONG_X, FIBRE)[0, 1] - weight, 1e-3, 1.0, xtol=1e-14)
    assert speed == pytest.approx(0.08695, abs=5e-6)
    assert speed * 20e-6 * AIR.density / AIR.viscosity == pytest.approx(0.1157, abs=5e-5)


def test_air_flows_as_it_is_told() -> None:
    x = np.array([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]])
    np.testing.assert_array_equal(dr.Air((1, 2, 3)).velocity(x, 0.0), [[1, 2, 3]] * 2)
    np.testing.assert_array_equal(dr.Air(lambda x, t: t * x).velocity(x, 2.0), 2 * x)
    with pytest.raises(SceneError, match=r"^air\.field must give finite velocities of shape \(2, 3\), got"):
        dr.Air(lambda x, _: x[0]).velocity(x, 0.0)
    with pytest.raises(SceneError, match=r"^air\.field must give finite velocities"):
        dr.Air(lambda x, _: np.nan * x).velocity(x, 0.0)


def test_a_point_that_a_diverging_iteration_has_lost_is_no_fault_of_the_air() -> None:
    x = np.array([[1.0, 2.0, 3.0], [np.nan, 5.0, 6.0]])
    np.testing.assert_array_equal(dr.Air(lambda x, _: 2 * x).velocity(x, 0.0), 2 * x)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"field": 1.0}, r"^Air\.field must have 3 entries \[m/s\], got 1\.0"),
        ({"density": 0.0}, r"^Air\.density must be positive, got 0\.0 kg/m³"),
        ({"viscosity": -1.0}, r"^Air\.viscosity must be positive, got -1\.0 Pa s"),
    ],
)
def test_what_cannot_be_is_refused_in_words(changes: dict[str, object], message: str) -> None:
    with pytest.raises(SceneError, match=message):
        dr.Air(**changes)
