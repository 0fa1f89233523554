"""Cases mean the same in every pose, and measure errors as they say."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dolfinrod.scene import Planar, Spatial
from dolfinrod.scene.kinematics import detect
from verification.case import SKEW, UPRIGHT, Pose
from verification.cases import CASES, elastica
from verification.models import Continuum, Discrete

pytestmark = pytest.mark.serial

coordinates = st.tuples(*3 * [st.floats(-3.0, 3.0)])


def along(r: np.ndarray, s: np.ndarray) -> SimpleNamespace:
    """A result of one rod whose last state is r."""
    return SimpleNamespace(rods=[SimpleNamespace(s=s, r=r[None])], tip=r[-1])


@given(rotation=coordinates, origin=coordinates, point=coordinates)
def test_pose_is_undone(rotation, origin, point):
    pose = Pose(rotation, origin)
    placed = np.asarray(pose.vector(*point)) + pose.start(2.0)
    assert pose.back(placed, 2.0) == pytest.approx(point, abs=1e-12)


def test_names_are_unique():
    names = [case.name for case in CASES]
    titles = [case.title for case in CASES]
    assert len(set(names)) == len(set(titles)) == len(CASES)


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
@pytest.mark.parametrize("pose", [UPRIGHT, SKEW], ids=["upright", "skew"])
def test_stress_free_shape_is_the_same_in_every_pose(case, pose):
    s = np.linspace(0.0, case.length, 5)
    there, here = (case.scene(p).rods[0].centerline(s) for p in (pose, UPRIGHT))
    assert pose.back(there, case.length) == pytest.approx(here, abs=1e-12 * case.length)


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
@pytest.mark.parametrize("pose", [UPRIGHT, SKEW], ids=["upright", "skew"])
def test_planar_cases_are_found_planar(case, pose):
    assert isinstance(detect(case.scene(pose)), Planar if case.planar else Spatial)


@given(nudge=coordinates)
def test_error_is_the_distance_over_the_length(nudge):
    case = replace(elastica.inextensible(10.0), length=2.0)
    tip = np.asarray(case.reference.value) + nudge
    result = along(tip[None], np.array([0.0]))
    assert case.error(result) == pytest.approx(np.linalg.norm(nudge) / 2.0)


@pytest.mark.parametrize("degree", [1, 2, 3, 4, 5])
def test_centreline_error_of_a_polynomial_is_that_of_its_interpolation(degree):
    """x = sᵏ is met exactly by degree k; x = sᵏ⁺¹ is missed."""
    exact, missed = (
        replace(
            elastica.inextensible(1.0),
            centreline=lambda s, k=k: np.stack([s**k, np.zeros_like(s), np.zeros_like(s)], 1),
        )
        for k in (degree, degree + 1)
    )
    s = np.linspace(0.0, 1.0, 3 * degree + 1)
    assert exact.centreline_error(along(exact.centreline(s), s), degree) < 1e-14
    assert missed.centreline_error(along(missed.centreline(s), s), degree) > 1e-8


def test_centreline_error_of_a_shifted_line_is_the_shift():
    line = replace(elastica.inextensible(1.0), centreline=lambda s: np.stack([s, 0 * s, 0 * s], 1))
    s = np.linspace(0.0, 1.0, 5)
    assert line.centreline_error(along(line.centreline(s) + np.array([0.0, 0.3, 0.4]), s), 1) == pytest.approx(0.5)


def test_models_apply_where_they_pose_the_same_problem():
    by_name = {case.name: case for case in CASES}
    assert Discrete().applies_to(by_name["elastica-10"])
    assert not Discrete().applies_to(by_name["elastica-10-shear"])
    assert not Discrete().applies_to(by_name["bend45-600"])
    assert not Continuum(3, Planar()).applies_to(by_name["bend45-600"])
    assert Continuum(3, Planar()).applies_to(by_name["elastica-10-shear"])
