"""The references agree with each other: tabulated values, closed forms, limits and identities."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from verification.cases import CASES
from verification.references import cantilever_tip, circle, elastica, follower, follower_tip, heavy, peers, tabulated

pytestmark = pytest.mark.serial

TIP = np.array([1.0])
loads = st.floats(0.2, 60.0)
stiffnesses = st.floats(200.0, 1e9)


@pytest.mark.parametrize("alpha", [0.2, 0.4, *range(1, 11)])
def test_closed_forms_agree_with_the_tabulated_elastica(alpha):
    x, y, _ = tabulated(f"A1-inext-alpha{alpha}").value
    assert cantilever_tip(alpha) == pytest.approx((x, y), abs=1e-13)
    assert elastica(float(alpha), np.array([1.0]))[0] == pytest.approx((x, y), abs=1e-13)


@pytest.mark.parametrize("alpha", [0.4, 1, 4, 10])
@pytest.mark.parametrize(
    ("section", "EA", "GA"), [("Lh10-nu0.3", 1200.0, 1200.0 / 2.6 * 5 / 6), ("Lh5-nu0.0", 300.0, 150.0)]
)
def test_closed_form_agrees_with_the_tabulated_simo_reissner_cantilever(alpha, section, EA, GA):
    x, y, _ = tabulated(f"A2-SR-alpha{alpha}-{section}").value
    assert cantilever_tip(alpha, EA=EA, GA=GA) == pytest.approx((x, y), abs=5e-14)


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


@pytest.mark.parametrize("alpha", [1, 2, 5, 10, 20])
def test_closed_form_and_steps_agree_with_the_tabulated_follower_force(alpha):
    x, y, _ = tabulated(f"C1-inext-alpha{alpha}").value
    assert follower(float(alpha), TIP)[0] == pytest.approx((x, y), abs=1e-14)
    assert follower_tip(float(alpha)) == pytest.approx((x, y), abs=1e-13)


@pytest.mark.parametrize("thousands", [10, 50, 100, 130])
def test_steps_agree_with_the_tabulated_simo_reissner_follower_force(thousands):
    # EI = 3.5e7 N m² and L = 100 m make EI/L² = 3500 N.
    x, y, _ = tabulated(f"C2-SR-P{thousands}k").value
    tip = follower_tip(1e3 * thousands / 3500.0, EA=4.2e8 / 3500.0, GA=1.61538e8 / 3500.0)
    assert tip == pytest.approx((x / 100.0, y / 100.0), abs=5e-14)


@given(alpha=st.floats(1e-4, 1e-3), EA=stiffnesses, GA=stiffnesses)
@settings(max_examples=20)
def test_small_follower_forces_bend_the_rod_as_dead_ones_do(alpha, EA, GA):
    assert follower_tip(alpha, EA=EA, GA=GA)[1] == pytest.approx(alpha * (1 / 3 + 1 / GA), rel=1e-5)


@given(alpha=st.floats(0.2, 60.0), s=st.floats(0.1, 1.0))
def test_follower_force_seen_from_a_section_is_that_on_a_shorter_rod(alpha, s):
    """The last part s of a rod under α is a rod under α s², turned and shrunk: chords keep their lengths."""
    whole = follower(alpha, np.array([1.0 - s, 1.0]))
    part = s * follower(alpha * s**2, TIP)[0]
    assert np.linalg.norm(whole[1] - whole[0]) == pytest.approx(np.linalg.norm(part), abs=1e-13)


@pytest.mark.parametrize("beta", [0.5, 1, 2, 5, 8, 10, 20, 50])
def test_collocation_agrees_with_the_tabulated_heavy_elastica(beta):
    x, y, _ = tabulated(f"J1-heavy-beta{beta}").value
    assert heavy(float(beta), TIP)[0] == pytest.approx((x, y), abs=5e-14)


@pytest.mark.parametrize("beta", [5, 20])
def test_collocation_agrees_with_the_tabulated_simo_reissner_heavy_cantilever(beta):
    x, y, _ = tabulated(f"J2-heavySR-beta{beta}-EA1200").value
    assert heavy(float(beta), TIP, EA=1200.0, GA=500.0)[0] == pytest.approx((x, y), abs=1e-14)


@given(beta=st.floats(0.2, 50.0), stiffness=stiffnesses)
@settings(max_examples=20)
def test_equal_axial_and_shear_stiffness_only_lower_the_heavy_elastica(beta, stiffness):
    s = np.linspace(0.0, 1.0, 5)
    shift = np.outer(beta / stiffness * (s - 0.5 * s**2), (0.0, -1.0))
    assert heavy(beta, s, EA=stiffness, GA=stiffness) == pytest.approx(heavy(beta, s) + shift, abs=1e-12)


@given(beta=st.floats(1e-4, 1e-3), EA=stiffnesses, GA=stiffnesses)
@settings(max_examples=20)
def test_small_weights_give_timoshenko_deflection(beta, EA, GA):
    assert heavy(beta, TIP, EA=EA, GA=GA)[0, 1] == pytest.approx(-beta * (1 / 8 + 1 / (2 * GA)), rel=1e-5)


@given(moment=st.floats(0.1, 60.0), s=st.floats(0.0, 1.0))
def test_rolled_rod_stays_on_its_circle(moment, s):
    assert np.linalg.norm(circle(moment, np.array([s]))[0] - (0.0, 1 / moment)) == pytest.approx(1 / moment)


@pytest.mark.parametrize(("turns", "id"), [(0.125, "1/8"), (0.25, "1/4"), (0.5, "1/2"), (1, "1"), (2, "2"), (5, "5")])
def test_circle_agrees_with_the_tabulated_turns(turns, id):
    x, y, _ = tabulated(f"B-turns-{id}").value
    assert circle(2 * np.pi * turns, TIP)[0] == pytest.approx((x, y), abs=3e-16)


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_every_reference_has_an_address(case):
    reference = case.reference
    assert np.isfinite(reference.value).all()
    assert reference.method
    assert reference.source
    # Trusted to fewer digits, the helix is still met to twelve by the continuum model.
    digits, agreement = (8, 1e-10) if case.family == "helix" else (9, 1e-11)
    assert reference.digits_trusted >= digits
    assert reference.agreement <= agreement


@pytest.mark.parametrize("case", [case for case in CASES if case.centreline], ids=lambda case: case.name)
def test_exact_centreline_ends_at_the_reference_tip(case):
    if case.quantity_name != "tip position":
        assert case.family == "bar"
        return
    assert case.centreline(np.array([case.length]))[0] == pytest.approx(case.reference.value, abs=1e-13)


@pytest.mark.parametrize("problem", ["elastica", "bend"])
def test_published_figures_get_slower_with_accuracy(problem):
    for kinematics in ("planar", "spatial"):
        ordered = sorted((p for p in peers(problem) if p.kinematics == kinematics), key=lambda p: -p.error)
        assert [p.ms for p in ordered] == sorted(p.ms for p in ordered)
