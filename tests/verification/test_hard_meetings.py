"""Rods on rods that solvers stumble over: ended where an independent answer says, or known to miss it."""

from __future__ import annotations

from dataclasses import replace
from html.parser import HTMLParser

import numpy as np
import pytest
from scipy.optimize import brentq

from dolfinrod.scene import ImplicitEuler, Midpoint, Penalty, Velocity
from verification.answers import Exact
from verification.contactaudit import deepest_of
from verification.contactwork import HARD_CONTACT, RODS, units
from verification.hardcases.rodcontacts import thick
from verification.hardcases.rodshots import HARD, SHOTS, momentum, stays
from verification.hardcontact import hard_contact, pairs
from verification.references.shots import Lens
from verification.report.hardcontact import hard_contacts

pytestmark = pytest.mark.serial

BY_NAME = {case.name: case for case in RODS}
MODELS = ("discrete", "continuum")
SCHEMES = [("discrete", ImplicitEuler()), ("continuum", ImplicitEuler()), ("continuum", Midpoint())]
UPWARDS = np.array([0.0, 0.0, 1.0])


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("name", ["crossed-1e6", "on-end", "heap"])
def test_whatever_presses_from_above_is_handed_down(name, model):
    row = hard_contact(BY_NAME[name], model, None)
    assert (row.outcome, row.holds) == ("converged", True)
    assert row.error <= 1e-9
    assert 0.0 < row.deepest < 0.5


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("name", ["drawn-0.3-3"])
def test_friction_between_rods_is_that_of_a_closed_form(name, model):
    row = hard_contact(BY_NAME[name], model, None)
    assert (row.outcome, row.holds) == ("converged", True)


@pytest.mark.parametrize(("model", "scheme"), SCHEMES)
def test_an_arrow_does_not_pass(model, scheme):
    row = hard_contact(BY_NAME["end-on"], model, scheme)
    assert (row.outcome, row.holds) == ("converged", True)


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("name", ["shot-3-4", "oblique-1"])
def test_steps_lost_where_rods_meet_are_halved_before_all_else_is_tried(name, model):
    """Whatever else leads through the whole of such a step takes more than 12 iterations a step."""
    row = hard_contact(BY_NAME[name], model, ImplicitEuler())
    assert (row.outcome, row.holds) == ("converged", True)
    assert row.cuts > 0


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("name", ["within-5-1e8", "within-15-1e6"])
def test_rods_posed_inside_one_another_part_at_once(name, model):
    """Forces of so deep a start, which turn with normals, push rods anywhere: 33 to 128 iterations a step and cuts."""
    row = hard_contact(BY_NAME[name], model, None)
    assert (row.outcome, row.holds, row.cuts) == ("converged", True, 0)


@pytest.mark.parametrize("scheme", [ImplicitEuler(), Midpoint()])
@pytest.mark.parametrize("name", ["shot-8-5", "onto-the-floor"])
def test_steps_that_get_nowhere_are_given_up_early(name, scheme):
    """Rods that part and meet again, or part on the far side: twelve iterations of each took 13 to 16 a step."""
    row = hard_contact(BY_NAME[name], "continuum", scheme)
    assert (row.outcome, row.holds) == ("converged", True)
    assert row.cuts > 0


def test_a_crossing_is_as_deep_as_its_lens_says():
    """Of straight rods that cross at right angles; this one crosses at 1.2 rad, over 1/sin of that length."""
    lens, h = Lens(1e6, 2e-5), 1e-9

    def pushes(δ: float) -> float:
        d = lens.reach - δ
        return (lens.energy(d - h) - lens.energy(d + h)) / (2.0 * h)

    row = hard_contact(BY_NAME["crossed-1e6"], "continuum", None)
    δ = brentq(lambda δ: pushes(δ) - 2e-8 * np.sin(1.2), 2.0 * h, 1e-6)
    assert row.deepest == pytest.approx(δ / lens.reach, rel=0.05)


def test_a_rod_on_the_wrong_side_and_lost_momentum_are_seen():
    """Where rods may pass each other, as they do without contact, that is told."""
    import discrete

    scene = BY_NAME["oblique-0"].scene()
    ghosts = discrete.solve(replace(scene, contacts=[]), elements=4)
    assert not stays(ghosts, 0, 1, UPWARDS)
    assert stays(ghosts, 1, 0, -UPWARDS) is False
    p = momentum(ghosts)
    rod = scene.rods[0]
    (flight,) = scene.velocities
    assert isinstance(flight, Velocity)
    np.testing.assert_allclose(p[0], rod.section.rhoA * rod.length * np.asarray(flight.v), rtol=1e-12)
    assert np.isnan(deepest_of(ghosts))


def test_a_section_ten_times_as_thick_is_that_of_a_circle():
    thin, wide = thick(1.0), thick(10.0)
    assert wide.radius == pytest.approx(10.0 * thin.radius)
    assert np.asarray(wide.EI) / wide.EA == pytest.approx(100.0 * np.asarray(thin.EI) / thin.EA)
    assert np.asarray(wide.rhoI) / wide.rhoA == pytest.approx(100.0 * np.asarray(thin.rhoI) / thin.rhoA)


def test_names_and_groups():
    assert len(BY_NAME) == len(RODS)
    assert all(case.group.startswith("rods: ") for case in RODS)
    assert isinstance(HARD, Penalty)
    chosen = {str(unit.parameters[0]) for unit in units((HARD_CONTACT,), quick=True)} & set(BY_NAME)
    assert {BY_NAME[name].group for name in chosen} == {case.group for case in RODS} - {SHOTS}


def test_the_table_says_how_deep_rods_were():
    row = hard_contact(replace(BY_NAME["along-2"], answer=Exact("nowhere", lambda _: 1.0)), "discrete", None)
    text = hard_contacts((row, replace(row, deepest=np.nan)))
    HTMLParser().feed(text)
    assert (row.outcome, row.holds) == ("WRONG", False)
    assert f"{row.deepest:.2g}" in text
    assert "nan" not in text


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("name", ["grazing", "over-an-end"])
def test_no_energy_comes_of_a_contact_that_is_leapt_over(name, model):
    """Backward Euler would take the rod from one side of it to the other: such steps are cut."""
    row = hard_contact(BY_NAME[name], model, ImplicitEuler())
    assert row.outcome == "converged", row.reason
    assert row.cuts > 0


# Name, model and scheme of rows known to be wrong.
OPEN: set[tuple[str, str, ImplicitEuler | Midpoint | None]] = set()


@pytest.mark.slow
@pytest.mark.parametrize("case", RODS, ids=lambda case: case.name)
def test_no_rod_passes_another_and_nothing_is_wrong_but_what_is_known(case):
    """Another end, energy made, or no end at all; a row that is mended has to be taken off the list."""
    rows = {(case.name, *pair): hard_contact(case, *pair) for pair in pairs(case)}
    wrong = {key for key, row in rows.items() if row.outcome not in ("converged", "elsewhere", "refused")}
    assert wrong == {key for key in OPEN if key[0] == case.name}, [(key, rows[key].reason) for key in wrong]
    assert all(row.reason for row in rows.values() if row.outcome != "converged")
    assert all(row.error < np.inf for row in rows.values() if row.outcome == "converged")
