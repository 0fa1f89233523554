"""Critical loads and frequencies against references, with their order and their number of modes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from verification.case import UPRIGHT
from verification.cases import postbuckling
from verification.eigencases import CASES
from verification.eigenmodels import EigenContinuum
from verification.models import Continuum
from verification.references.lateral import lateral
from verification.references.scalar import scalar
from verification.report.critical import brackets, eigenvalues
from verification.stability import LIMIT, MODELS, bracket, eigenstudy, pairs

pytestmark = pytest.mark.serial

BY_NAME = {case.name: case for case in CASES}
# On the crest the wall first pushes the rod until it just touches, which must not let it go.
QUICK = ("column-PP", "column-CP", "vibration-cantilever-1", "vibration-torsion-1", "crest")


def test_names_are_unique():
    assert len(BY_NAME) == len(CASES)


@pytest.mark.parametrize("name", QUICK)
def test_values_orders_and_multiplicities(name):
    study = eigenstudy(BY_NAME[name], EigenContinuum(), meshes=(4, 8))
    assert study.holds or study.errors[-1] > LIMIT
    assert study.multiplicity == study.expected
    assert study.order.observed == pytest.approx(6, abs=0.3)


def test_a_critical_load_lies_between_stable_and_unstable():
    row = bracket(BY_NAME["column-CF"], EigenContinuum())
    assert (row.holds, row.stable, row.directions) == (True, (True, False), (0, 2))
    assert "unstable" in brackets((row,))


@pytest.mark.parametrize("EI_3", [100.0, pytest.param(20.0, marks=pytest.mark.slow)])
def test_kept_critical_loads_of_strips_are_found_anew(EI_3):
    assert lateral(EI_3) == pytest.approx(scalar(f"lateral-EI3_{EI_3:g}", "P_cr").value, rel=1e-12)


def test_a_strip_that_cannot_bend_in_its_plane_is_prandtls():
    """Up to EI₂/EI₃; bent by others' stiffnesses it keeps P L²/√(EI₂ GJ)."""
    assert lateral(1e8, GJ=3.0, EI_2=0.5) == pytest.approx(scalar("I1-prandtl", "c").value, rel=1e-7)


def test_a_wrong_reference_is_missed():
    case = BY_NAME["column-PP"]
    off = replace(case, reference=replace(case.reference, value=1.01 * case.reference.value))
    study = eigenstudy(off, EigenContinuum(), meshes=(4, 8))
    assert not study.holds
    assert "missed" in eigenvalues((study,))


def test_no_critical_point_is_no_value():
    """Under a tenth of its load, on the path, a column has none."""
    case = BY_NAME["column-heavy"]
    light = replace(case, reference=replace(case.reference, value=0.1 * case.reference.value))
    study = eigenstudy(light, EigenContinuum(), meshes=(4,))
    assert np.isnan(study.found[0])
    assert study.failure is not None
    assert not study.holds


@pytest.mark.parametrize("case", postbuckling.CASES[:1], ids=lambda case: case.name)
def test_let_go_a_column_stays_on_its_buckled_branch(case):
    result = Continuum(3).solve(case.scene(UPRIGHT), 16)
    assert case.error(result) < 1e-6
    assert result.log[-1].stable


@pytest.mark.slow
@pytest.mark.parametrize("case", postbuckling.CASES, ids=lambda case: case.name)
def test_buckled_columns(case):
    result = Continuum(3).solve(case.scene(UPRIGHT), 32)
    assert case.error(result) < 1e-7
    assert result.log[-1].stable


@pytest.mark.slow
@pytest.mark.parametrize("pair", pairs(), ids=lambda pair: f"{pair[0].name}-{pair[1].family}")
def test_every_critical_load_and_frequency(pair):
    study = eigenstudy(*pair)
    assert study.holds, (study.found, study.errors, study.multiplicity, study.failure)


@pytest.mark.slow
@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.family)
@pytest.mark.parametrize("case", [case for case in CASES if case.brackets], ids=lambda case: case.name)
def test_every_critical_load_is_bracketed(case, model):
    if model.family in case.models:
        row = bracket(case, model)
        assert row.holds, (row.stable, row.directions, row.failure)
