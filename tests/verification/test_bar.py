"""Rods that stay straight, and a coil that stays a helix: what is uniform is met as theory says."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dolfinrod.scene import Planar
from verification.case import SKEW
from verification.cases import bar, spring
from verification.models import Continuum, Discrete
from verification.references import Coil
from verification.workprecision import measure

pytestmark = pytest.mark.serial

rates, loads = st.floats(-9.0, 9.0), st.floats(-20.0, 20.0)
coils = st.builds(
    lambda κ1, κ2, κ3, force, moment: Coil((κ1, κ2, 10.0 + κ3), force, moment, (900.0, 400.0, 300.0), (0.7, 1.0, 2.0)),
    *(rates, rates, rates, loads, st.floats(-2.0, 2.0)),
)


@pytest.mark.parametrize("model", [Continuum(1, Planar()), Continuum(3), Discrete()], ids=lambda model: model.name)
@pytest.mark.parametrize("case", [bar.pulled(20.0), bar.pulled(-4.0), bar.laden(30.0)], ids=lambda case: case.name)
def test_stretch_is_exact_at_the_end_of_one_element(case, model):
    assert measure(case, model, 1, pose=SKEW).error < 1e-14


@pytest.mark.parametrize("elements", [20, 40, 80])
def test_discrete_twist_is_exact_on_any_mesh(elements):
    assert measure(bar.twisted(3.0), Discrete(), elements, pose=SKEW).error < 1e-13


@pytest.mark.parametrize("model", [Continuum(3), Discrete()], ids=lambda model: model.name)
def test_torque_about_the_axis_is_the_same_dead_and_following(model):
    dead, following = (measure(bar.twisted(2.65, follower=f), model, 48) for f in (False, True))
    assert dead.error == pytest.approx(following.error, abs=1e-13)
    assert dead.error < 1e-9


@given(coil=coils, s=st.floats(0.0, 1.0))
def test_coil_is_in_balance(coil, s):
    """n and m + r × n are the same all along it, and its centreline has the slope R (e₁ + Γ)."""
    h = 1e-4
    n, origin = coil.force * coil.axis, coil.section_moment
    r = coil.centreline(np.array([s]))[0]
    R = coil.rotation(s)
    assert R @ n == pytest.approx(n, abs=1e-12 * (1.0 + abs(coil.force)))
    assert R @ coil.section_moment + np.cross(r, n) == pytest.approx(origin, abs=1e-11 * (1.0 + np.abs(origin).max()))
    slope = np.diff(coil.centreline(np.array([s - h, s + h])), axis=0)[0] / (2.0 * h)
    assert slope == pytest.approx(R @ coil.tangent, abs=1e-5)


def test_coil_changes_its_twist_and_both_curvatures():
    for case in spring.CASES:
        assert case.reference.value[2] != pytest.approx(0.0, abs=1e-3)
    for force, moment in ((20.0, -1.0), (-5.0, 1.0)):
        coil = Coil(spring.CURVATURE, force, moment, spring.STRETCHING, spring.BENDING)
        assert np.abs(coil.natural_curvature - spring.CURVATURE).min() > 0.05
