"""The models differ by the discretisation error of the coarser one and by nothing else."""

from __future__ import annotations

from dataclasses import replace

import pytest

from verification.cases import bend45, elastica, follower, heavy
from verification.crosscheck import compare, crosschecks
from verification.models import Continuum, Discrete, natural
from verification.workprecision import study

pytestmark = pytest.mark.serial

CASES = (
    elastica.inextensible(10.0),
    follower.inextensible(20.0),
    heavy.inextensible(50.0),
    bend45.bend(600.0, kirchhoff=True),
)


def studies(case):
    """By both models, the continuum's far finer."""
    return study(case, Continuum(4, natural(case)), (8, 16)), study(case, Discrete(), (10, 20, 40, 80))


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_models_differ_by_their_discretisation_errors_which_fall(case):
    coarse, fine = compare(*studies(case), case.length)
    assert coarse.holds
    assert fine.holds
    assert fine.difference / fine.estimate == pytest.approx(1.0, abs=0.02)
    assert coarse.difference / fine.difference == pytest.approx(4.0, rel=0.1)


def test_no_reference_enters():
    case = CASES[0]
    elsewhere = replace(case, reference=replace(case.reference, value=(9.0, 9.0, 9.0)))
    rows = [crosschecks(studies(c), {case.name: case.length}) for c in (case, elsewhere)]
    assert rows[0] == rows[1]


def test_a_model_that_is_off_is_found_out():
    """Both too large and too small a difference are unexplained."""
    row = compare(*studies(CASES[0]), CASES[0].length)[0]
    assert not replace(row, difference=1.2 * row.difference).holds
    assert not replace(row, difference=0.8 * row.difference).holds
    assert not replace(row, failure="discrete chord on 20 elements: diverged").holds


def test_the_stand_in_for_a_rigid_extension_is_known_and_small():
    """EA = 1e8·EI/L² under a force of 10 EI/L² or less."""
    continuum, discrete = studies(CASES[0])
    assert {r.elongation for r in continuum.records} == {0.0}
    assert all(1e-8 < r.elongation <= 1e-7 for r in discrete.records)
