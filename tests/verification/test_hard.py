"""Hard cases: what is not reached is refused with a reason, and nothing wrong is called converged."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from verification.hard import SHARE, HardRow, hard, pairs, share, shares, wrong
from verification.hardcase import Place
from verification.hardcases import CASES
from verification.report.robust import hard as hard_table

pytestmark = pytest.mark.serial

ROW = HardRow("soft", "", "", "continuum", "16 × P3", "converged", "", 2, 9, 1, True, 1e-9, "straight", 5.0)
BY_NAME = {case.name: case for case in CASES}
QUICK = ("elastica-10-circle-1e+06", "closed-rotation", "units-1e-12-1", "mesh-2", "degree-1", "column-1.5-0")


def test_names_are_unique():
    assert len(BY_NAME) == len(CASES)


@pytest.mark.parametrize("name", QUICK)
def test_a_few_hard_cases_end_where_they_should(name):
    row = hard(BY_NAME[name], "continuum")
    assert row.converged
    assert row.error <= BY_NAME[name].limit


def test_an_unstable_column_is_flagged_and_stays_straight():
    row = hard(BY_NAME["column-1.5-0"], "continuum")
    assert (row.outcome, row.stable) == ("flagged", False)
    assert row.error < 1e-9


def test_another_equilibrium_is_called_wrong():
    elsewhere = replace(BY_NAME["mesh-2"], check=Place((9.0, 9.0, 9.0), 1.0, "elsewhere"))
    row = hard(elsewhere, "continuum")
    assert row.outcome == "WRONG"
    assert wrong((row,)) == (row,)
    assert share((row,)) == 0.0
    assert "WRONG" in hard_table((row,))


def test_another_equilibrium_called_unstable_is_no_lie_but_not_what_was_sought():
    elsewhere = replace(BY_NAME["column-1.5-0"], check=Place((9.0, 9.0, 9.0), 1.0, "elsewhere"))
    row = hard(elsewhere, "continuum")
    assert (row.outcome, row.holds, row.converged) == ("elsewhere", True, False)


def test_a_share_is_that_of_all_hard_cases_or_none():
    rows = tuple(replace(ROW, case=case.name, model=family) for case, family in pairs())
    (found,) = shares(rows)
    assert (found.converged, found.holds) == (found.total, True)
    assert shares(rows[1:]) == ()
    refused = int(found.total * (1.0 - SHARE)) + 1
    continuum = [row for row in rows if row.model == "continuum"]
    (short,) = shares((*(replace(row, outcome="refused") for row in continuum[:refused]), *continuum[refused:]))
    assert not short.holds


def test_a_stable_verdict_on_an_unstable_equilibrium_is_wrong():
    row = hard(replace(BY_NAME["mesh-2"], unstable=True), "continuum")
    assert row.outcome == "WRONG"


def test_what_cannot_be_solved_is_refused_with_a_reason():
    """Two quarters of a turn between neighbouring nodes are more than one linear element can show."""
    row = hard(replace(BY_NAME["rollup-10"], elements=2, degree=1), "continuum")
    assert row.outcome == "refused"
    assert row.reason
    assert np.isnan(row.error)
    assert row.holds
    assert not row.converged


@pytest.mark.slow
def test_nearly_all_hard_cases_converge_and_none_is_wrong():
    rows = tuple(hard(case, family) for case, family in pairs() if family == "continuum")
    assert [(row.case, row.error) for row in wrong(rows)] == []
    assert share(rows) >= SHARE, [(row.case, row.reason) for row in rows if not row.converged]
    assert all(row.reason for row in rows if row.outcome == "refused")


@pytest.mark.slow
def test_the_discrete_model_is_never_wrong_without_a_warning():
    rows = tuple(hard(case, family) for case, family in pairs() if family == "discrete")
    assert [(row.case, row.error) for row in wrong(rows, "discrete")] == []
