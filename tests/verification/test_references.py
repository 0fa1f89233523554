"""The references agree with each other: tabulated values, closed forms, limits and identities."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from verification.cases import CASES
from verification.references import cantilever_tip, circle, elastica, peers, tabulated

pytestmark = pytest.mark.serial

loads = st.floats(0.2, 60.0)
stiffnesses = st.floats(200.0, 1e9)


@pytest.mark.parametrize("alpha", [1, 2, 5, 10])
def test_closed_forms_agree_with_the_tabulated_elastica(alpha):
    x, y, _ = tabulated(f"A1-inext-alpha{alpha}").value
    assert cantilever_tip(alpha) == pytest.approx((x, y), abs=1e-13)
    assert elastica(float(alpha), np.array([1.0]))[0] == pytest.approx((x, y), abs=1e-13)


@pytest.mark.parametrize("alpha", [1, 10])
def test_closed_form_agrees_with_the_tabulated_simo_reissner_cantilever(alpha):
    x, y, _ = tabulated(f"A2-SR-alpha{alpha}-Lh10-nu0.3").value
    assert cantilever_tip(alpha, EA=1200.0, GA=1200.0 / 2.6 * 5 / 6) == pytest.approx((x, y), abs=5e-14)


@given(alpha=loads, stiffness=stiffnesses)
def test_equal_axial_and_shear_stiffness_only_shift_the_elastica_along_the_load(alpha, stiffness):
    x, y = cantilever_tip(alpha)
    assert cantilever_tip(alpha, EA=stiffness, GA=stiffness) == pytest.approx((x, y + alpha / stiffness), abs=1e-12)


@given(alpha=loads)
def test_elastica_has_unit_speed_and_ends_where_the_quadrature_says(alpha):
    s, h = np.linspace(0.05, 0.95, 7), 1e-4
    slope = (elastica(alpha, s + h) - elastica(alpha, s - h)) / (2 * h)
    curvature = np.sqrt(2 * alpha)
    assert np.linalg.norm(slope, axis=1) == pytest.approx(np.ones(7), abs=(curvature * h) ** 2 + 1e-9)
    assert elastica(alpha, np.array([0.0, 1.0])) == pytest.approx(
        np.array([(0.0, 0.0), cantilever_tip(alpha)]), abs=1e-10
    )


@given(alpha=st.floats(1e-4, 1e-3), EA=stiffnesses, GA=stiffnesses)
def test_small_loads_give_timoshenko_deflection(alpha, EA, GA):
    _, y = cantilever_tip(alpha, EA=EA, GA=GA)
    assert y == pytest.approx(alpha * (1 / 3 + 1 / GA), rel=1e-5)


@pytest.mark.parametrize("alpha", [500.0, 5000.0])
def test_heavy_loads_leave_a_boundary_layer_at_the_clamp(alpha):
    # A half-infinite elastica turns by π/2 within x = √(2/α).
    assert cantilever_tip(alpha)[0] == pytest.approx(np.sqrt(2 / alpha), rel=1e-12)


@given(moment=st.floats(0.1, 60.0), s=st.floats(0.0, 1.0))
def test_rolled_rod_stays_on_its_circle(moment, s):
    assert np.linalg.norm(circle(moment, np.array([s]))[0] - (0.0, 1 / moment)) == pytest.approx(1 / moment)


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_every_reference_has_an_address(case):
    reference = case.reference
    assert np.isfinite(reference.value).all()
    assert reference.method
    assert reference.source
    assert reference.digits_trusted >= 9
    assert reference.agreement <= 1e-11


@pytest.mark.parametrize("case", [case for case in CASES if case.centreline], ids=lambda case: case.name)
def test_exact_centreline_ends_at_the_reference_tip(case):
    assert case.centreline(np.array([1.0]))[0] == pytest.approx(case.reference.value, abs=1e-13)


@pytest.mark.parametrize("problem", ["elastica", "bend"])
def test_published_figures_get_slower_with_accuracy(problem):
    for kinematics in ("planar", "spatial"):
        ordered = sorted((p for p in peers(problem) if p.kinematics == kinematics), key=lambda p: -p.error)
        assert [p.ms for p in ordered] == sorted(p.ms for p in ordered)
