"""Rods on rods by both models: answers within their limits, no rod preferred, actions and reactions."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from verification.contact import contactstudy
from verification.contacts.runs import DISCRETE, SPACE
from verification.contacttrials import MEETINGS
from verification.meetings import CASES
from verification.meetings.bundle import vee
from verification.meetings.crossing import crossing
from verification.references.bundle import Vee
from verification.references.meetings import meeting, solved_anew
from verification.report.meetings import meeting_cases

pytestmark = pytest.mark.serial

BY_NAME = {case.name: case for case in CASES}
# Of a second or so by either model.
CHEAP = ("bundle-2-45", "pile-stack")
MODELS = {"continuum": (SPACE, 5), "discrete": (DISCRETE, 21)}


def test_names_are_unique_and_listed():
    assert len(BY_NAME) == len(CASES)
    assert len(set(MEETINGS.names())) == len(MEETINGS.names())
    assert {"meetings:crossing", "meetings:groove-bundle", "meetings:pile-v"} <= set(MEETINGS.names())
    assert ("  meetings:pile-v", BY_NAME["pile-v"].title) in list(MEETINGS.listing((MEETINGS.name,)))


def test_every_case_is_taken_by_both_models_within_limits():
    for case in CASES:
        assert {run.model for run in case.runs} == {"continuum", "discrete"}, case.name
        assert all(run.limit is not None for run in case.runs), case.name


def test_units_are_told_apart_and_quick_ones_are_fewer():
    every, quick = (list(MEETINGS.units((MEETINGS.name,), quick=quick)) for quick in (False, True))
    assert len({unit.parameters for unit in every}) == len(every)
    assert 0 < len(quick) < len(every)
    assert {unit.topic for unit in every} == {"meeting"}
    assert len(list(MEETINGS.units((MEETINGS.asked_as("pile-v"),), quick=False))) == len(BY_NAME["pile-v"].runs)


@pytest.mark.parametrize("model", ["continuum", "discrete"])
@pytest.mark.parametrize("name", CHEAP)
def test_limits_of_cheap_cases(name, model):
    case = BY_NAME[name]
    run = next(run for run in case.runs if run.model == model)
    found = contactstudy(case, replace(run, levels=run.levels[-1:]))
    assert found.holds, found
    assert case.title in meeting_cases([found])


@pytest.mark.parametrize("model", MODELS)
def test_crossed_fibres_lift_as_by_a_bvp(model):
    """Issue 7: lifts within 1e-3 of our own SciPy boundary-value solution."""
    solver, elements = MODELS[model]
    case = BY_NAME["crossing-fibres"]
    found = case.read(solver.solve(crossing("fibres"), elements))
    assert found[:2] == pytest.approx(meeting("fibres", "lift0", "lift1").value, rel=1e-3)
    # Either carries what the other one does.
    assert found[0] == pytest.approx(found[1], rel=1e-9)


@pytest.mark.parametrize("model", MODELS)
def test_forces_do_not_depend_on_which_rod_is_named_first(model):
    """To 1e-12, and the third law to round-off: resultants of the two are opposite whoever is asked."""
    solver, _ = MODELS[model]
    heap = Vee(np.pi / 4, 1.0, 1, 1, 0.01)
    scene = vee(heap)
    one = solver.solve(scene, 2)
    order = [2, 0, 1]
    other = solver.solve(replace(scene, rods=[scene.rods[k] for k in order]), 2)
    for a, b in ((0, 1), (0, 2)):
        force = one.meetings[0].force(-1, a, b)
        assert other.meetings[0].force(-1, order.index(a), order.index(b)) == pytest.approx(force, rel=1e-12, abs=1e-12)
        assert one.meetings[0].force(-1, b, a) == pytest.approx(-force, rel=1e-15)


@pytest.mark.slow
@pytest.mark.parametrize("model", MODELS)
def test_crossings_do_not_depend_on_which_rod_is_named_first(model):
    solver, elements = MODELS[model]
    one, other = (solver.solve(crossing("uneven", swapped=swapped), elements) for swapped in (False, True))
    force = one.meetings[0].force(-1, 0, 1)
    assert other.meetings[0].force(-1, 1, 0) == pytest.approx(force, rel=1e-9, abs=1e-9 * abs(force[2]))


@pytest.mark.slow
@pytest.mark.parametrize("model", ["continuum", "discrete"])
@pytest.mark.parametrize("name", sorted(BY_NAME.keys() - set(CHEAP)))
def test_limits_and_orders_of_dear_cases(name, model):
    case = BY_NAME[name]
    for run in case.runs:
        if run.model == model:
            found = contactstudy(case, run)
            assert found.holds, found


@pytest.mark.slow
@pytest.mark.parametrize("name", ["crossing-fibres", "crossing-even"])
def test_crossings_converge(name):
    """The force with second order by the discrete model; by the continuum one until contact's own quadrature shows."""
    case = BY_NAME[name]
    for run in case.runs:
        found = contactstudy(case, run)
        errors = [record.error for record in found.records]
        assert errors[-1] < errors[0], found
        if run.model == "discrete":
            assert found.order == pytest.approx(2.0, abs=0.3)


@pytest.mark.slow
def test_all_kept_references_are_found_anew():
    for name, entry in solved_anew().items():
        for key, number in entry["quantities"].items():
            assert meeting(name, key).value[0] == pytest.approx(number, rel=1e-10), (name, key)
