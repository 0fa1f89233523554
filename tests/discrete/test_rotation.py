"""Finite rotations and the frames of sections and elements, Eq. 10, 11 and 19–21."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from discrete.frames import deformation, direction_cosines, element_frame, inertia, transformation
from discrete.rotation import cross, exp, log, skew, tangents

vectors = st.tuples(*[st.floats(-1.7, 1.7)] * 3).map(np.array)


@given(vectors, vectors)
def test_skew_and_cross_are_the_cross_product(a, b):
    assert skew(a) @ b == pytest.approx(np.cross(a, b), abs=1e-15)
    assert cross(a[None], b[None])[0] == pytest.approx(np.cross(a, b), abs=1e-15)


@given(vectors)
def test_exponential_is_a_rotation_and_logarithm_its_inverse(θ):
    R = exp(θ)
    assert R.T @ R == pytest.approx(np.eye(3), abs=1e-14)
    assert np.linalg.det(R) == pytest.approx(1.0, abs=1e-14)
    assert R @ θ == pytest.approx(θ, abs=1e-14)
    assert log(R) == pytest.approx(θ, abs=1e-11)


@pytest.mark.parametrize("angle", [0.0, 1e-300, 1e-160, 1e-9, 1e-3, 0.49999, 0.50001, 1.0, 3.1])
def test_tangent_maps_the_spin_to_the_change_of_the_rotation_vector(angle):
    θ = angle * np.array([2.0, -1.0, 2.0]) / 3.0
    μ = np.array([0.3, -0.8, 0.5])
    Θ, change = tangents(θ, μ)
    h = 1e-6
    for i, axis in enumerate(np.eye(3)):
        slope = (log(exp(h * axis) @ exp(θ)) - log(exp(-h * axis) @ exp(θ))) / (2 * h)
        assert Θ[:, i] == pytest.approx(slope, abs=1e-8)
        moments = [tangents(θ + s * h * axis, μ)[0].T @ μ for s in (1, -1)]
        assert change[:, i] == pytest.approx((moments[0] - moments[1]) / (2 * h), abs=2e-8)


def test_series_and_closed_form_of_the_tangent_meet():
    below, above = (tangents(np.array([φ, 0, 0]), np.array([0.3, 1.0, 2.0])) for φ in (0.5 - 1e-9, 0.5 + 1e-9))
    for a, b in zip(below, above, strict=True):
        assert a == pytest.approx(b, abs=1e-8)


@given(vectors)
def test_direction_cosines_hold_the_axes_as_rows(θ):
    """Eq. 10 and 11: a vector along u has the local components (1, 0, 0)."""
    triad = exp(θ)
    A = direction_cosines(triad)
    assert A @ triad[:, 0] == pytest.approx([1.0, 0.0, 0.0], abs=1e-14)
    J = inertia(np.diag([1.0, 2.0, 3.0]), A)
    assert J @ triad[:, 1] == pytest.approx(2.0 * triad[:, 1], abs=1e-14)


def test_transformation_repeats_the_direction_cosines():
    t = exp(np.array([[0.3, -0.2, 0.9]]))
    matrix = transformation(t)[0]
    assert matrix @ matrix.T == pytest.approx(np.eye(12), abs=1e-14)
    assert all((matrix[k : k + 3, k : k + 3] == t[0]).all() for k in (0, 3, 6, 9))


@given(vectors, vectors, vectors)
def test_deformation_is_seen_from_node_i(θ, φ, δ):
    """Eq. 20 and 21: a rigid motion leaves δ_e as it is."""
    R_i = exp(θ)
    e = R_i @ (np.array([0.5, 0, 0]) + δ)
    found = deformation(e[None], R_i.T[None], (R_i @ exp(φ)).T[None], np.array([0.5]))[0]
    assert found == pytest.approx([*δ, *φ], abs=1e-11)


@given(vectors, vectors, vectors)
def test_element_frame_prefers_no_end_and_no_transverse_axis(θ, α, β):
    T = exp(θ)
    e = 0.7 * T[:, 0]
    ends = np.stack([T @ exp(0.3 * α), T @ exp(0.3 * β)])
    forth = element_frame(e[None], ends[None]).axes[0]
    back = element_frame(-e[None], ends[None, ::-1] * [-1, 1, -1]).axes[0]
    assert back == pytest.approx(forth * [-1, 1, -1], abs=1e-13)
    quarter = exp(np.array([np.pi / 2, 0, 0]))
    turned = element_frame(e[None], (ends @ quarter)[None]).axes[0]
    assert turned == pytest.approx(forth @ quarter, abs=1e-13)
    assert np.linalg.norm(e) * forth[:, 0] == pytest.approx(e, abs=1e-14)
