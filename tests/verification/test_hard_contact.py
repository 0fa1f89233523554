"""Hard contacts end where an independent answer says or are refused in words; the fibre in the groove."""

from __future__ import annotations

from dataclasses import replace
from html.parser import HTMLParser

import numpy as np
import pytest

from dolfinrod.scene import Section, Static
from verification.answers import Exact
from verification.contact import MOST_ITERATIONS
from verification.contacts.groove import CASES as GROOVE_CASES
from verification.contacts.groove import FEED, HALF_WIDTH, LENGTH, fibre, lateral
from verification.contactwork import GROOVE, HARD, HARD_CONTACT, WALLS, units
from verification.groovebench import LIMIT, GroovePoint, GrooveSweep, Setup, sweep
from verification.grooveprofile import AGREES, GrooveProfile, SideBySide
from verification.hardcases.rodshots import SHOTS
from verification.hardcontact import ContactRow, hard_contact, pairs
from verification.report.groove import groove
from verification.report.hardcontact import hard_contacts

pytestmark = pytest.mark.serial

BY_NAME = {case.name: case for case in HARD}
MODELS = ("discrete", "continuum")
ROW = ContactRow("a", "b", "c", "continuum, 16 × P3", "converged", "", 2, 10, 0, 1e-9, "exact", 3.0)
POINT = GroovePoint(20.0, 1e-3, 1e-3, 2.0, 40, 200, 0)
SWEEP = GrooveSweep(
    "groove-pressed", "Pressed", "discrete", "elements", "40 steps", (POINT,) * 3, 1.9, "continuum, fine", 1e-4
)
LYING = GrooveProfile(
    "discrete",
    "2 elements",
    (0.0, 0.02, 0.04),
    (1e-6, 0.0, 0.0),
    (0.0, 1e-3, 1e-3),
    (0.0, 1e-4, 1e-4),
    (0, 1, 2),
    (-1e-3, 0.0, 0.0),
    (0.0, 1e-4, -1e-5),
    0.03,
    0.02,
    4.0,
    2.0,
)


def test_names_are_unique():
    assert len(BY_NAME) == len(HARD)


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("name", ["wedge-45-None", "deep-15-tight", "penalty-1e2", "penalty-1e12", "slot-100", "halo"])
def test_closed_forms_are_met_to_many_digits(name, model):
    row = hard_contact(BY_NAME[name], model, None)
    assert (row.outcome, row.holds) == ("converged", True)
    # What is left at ε_N = 1e12 N/m² is the rounding of places over penetrations of 1e-14 m.
    assert row.error <= (1e-6 if name == "penalty-1e12" else 1e-9)


@pytest.mark.parametrize("model", MODELS)
def test_a_wall_turns_under_a_fibre(model):
    row = hard_contact(BY_NAME["turned-10"], model, None)
    assert (row.outcome, row.holds) == ("converged", True)


def test_another_end_without_a_warning_is_wrong():
    elsewhere = replace(BY_NAME["halo"], answer=Exact("nowhere", lambda _: 1.0))
    row = hard_contact(elsewhere, "continuum", None)
    assert (row.outcome, row.holds) == ("WRONG", False)
    assert "WRONG" in hard_contacts((row,))


def test_a_fibre_without_a_radius_is_refused_in_words():
    halo = BY_NAME["halo"]

    def bare():
        scene = halo.scene()
        round_ = scene.rods[0].section
        section = Section(EA=round_.EA, GA=round_.GA, GJ=round_.GJ, EI=round_.EI)
        return replace(scene, rods=[replace(scene.rods[0], section=section)])

    row = hard_contact(replace(halo, scene=bare), "continuum", None)
    assert (row.outcome, row.steps, row.holds) == ("refused", 0, True)
    assert "radius" in row.reason


def test_many_iterations_and_refusals_without_a_reason_are_missed():
    assert ROW.holds
    assert not replace(ROW, iterations=round(MOST_ITERATIONS * ROW.steps) + 1).holds
    assert not replace(ROW, outcome="refused").holds
    assert replace(ROW, outcome="refused", reason="no").holds
    assert not replace(ROW, outcome="crawls", reason="no").holds
    assert "many iterations" in hard_contacts((replace(ROW, iterations=99),))


def test_statics_knows_no_scheme_and_motions_are_taken_by_all():
    for case in HARD:
        static = isinstance(case.scene().motion, Static)
        assert len(pairs(case)) == (2 if static else 3)
        assert all((scheme is None) == static for _, scheme in pairs(case))


def test_a_quick_run_has_one_of_each_group_but_of_shots():
    chosen = [unit.parameters[0] for unit in units((HARD_CONTACT,), quick=True)]
    groups = [BY_NAME[str(name)].group for name in dict.fromkeys(chosen)]
    assert sorted(groups) == sorted({case.group for case in HARD} - {SHOTS})


def test_the_groove_is_that_of_the_design():
    """process.md 6.2: depth 0.402 mm, left flank 15° to the surface, right wall 15° to its normal, foot at 0.108 mm."""
    profile = 1e3 * np.asarray(lateral().profile)
    assert profile[1:4] == pytest.approx(np.array([(-1.5, 0.0), (0.0, -0.402), (0.108, 0.0)]), abs=5e-4)


def test_the_fibre_starts_as_near_to_the_flank_as_said():
    x = fibre(2e-6).centerline(np.linspace(0.0, LENGTH, 5))
    radius = Section.ramie().radius
    assert lateral().closest(x).distance == pytest.approx(radius + 2e-6, abs=1e-15)
    assert abs(x[:, 2] - FEED).max() < radius
    assert -HALF_WIDTH < FEED < 0.0


def test_a_sweep_holds_where_everything_was_solved_and_the_models_agree():
    assert SWEEP.holds
    assert not replace(SWEEP, points=(POINT, replace(POINT, error=2.0 * LIMIT))).holds
    assert not replace(SWEEP, points=(replace(POINT, error=np.nan, failure="did not settle"), POINT)).holds


def test_diagrams_and_tables_show_what_was_found():
    pair = SideBySide("groove-pressed", "Pressed", (LYING, replace(LYING, solver="continuum")), 1e-3, 1e-2, 1e-9, 0.1)
    failed = replace(POINT, at=40.0, error=np.nan, force=np.nan, failure="did not settle")
    text = groove((SWEEP, replace(SWEEP, solver="continuum", points=(POINT, failed))), (pair,))
    HTMLParser().feed(text)
    assert "nan" not in text
    assert "did not settle" in text
    assert "arc length [mm]" in text
    assert pair.holds
    assert not replace(pair, forces=2.0 * AGREES).holds


def test_a_full_run_of_the_groove_has_both_models_over_everything():
    words = [unit.words for unit in units((GROOVE,), quick=False)]
    for case in GROOVE_CASES:
        for model in MODELS:
            for over in ("elements", "steps", "penalty"):
                assert any(case.title in w and model in w and over in w for w in words)
    assert len(list(units((GROOVE,), quick=True))) == 1


@pytest.mark.slow
@pytest.mark.parametrize("case", WALLS, ids=lambda case: case.name)
def test_every_hard_contact(case):
    rows = [hard_contact(case, *pair) for pair in pairs(case)]
    assert [(row.solver, row.outcome, row.a_step, row.reason) for row in rows if not row.holds] == []


@pytest.mark.slow
@pytest.mark.parametrize("model", MODELS)
def test_both_models_settle_on_one_answer_in_the_groove(model):
    """On meshes from coarse to fine, measured against the other model: 2 for the discrete one."""
    base = Setup("discrete", 80, 40) if model == "discrete" else Setup("continuum", 20, 40)
    found = sweep(GROOVE_CASES[0], base, "elements")
    assert found.holds
    assert found.order is not None
    assert found.order >= 1.75
