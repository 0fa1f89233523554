"""The numbers of the issues: whole loads in one step within the iterations allowed, errors below their limits."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from verification.cases import CASES, elastica
from verification.checks import digit_checks, error_checks, limits, order_checks
from verification.models import Continuum
from verification.onestep import one_step, problems
from verification.order import Order
from verification.workprecision import Record, Study

pytestmark = pytest.mark.serial

TEN = elastica.inextensible(10.0)


def found(errors, order, *, case=TEN.name, theory=6):
    """A study with these errors and this order."""
    model = Continuum(3).name
    records = tuple(Record(case, model, "continuum", 4 * 2**k, e, None, 100, 5, 1) for k, e in enumerate(errors))
    return Study(case, TEN.title, model, "continuum", 3, records, Order(order, theory, (4, 8), max(errors)), None)


def test_whole_loads_are_taken_at_once():
    rows = [row for problem in problems() for row in one_step(*problem)]
    assert len(rows) == sum(2 if case.planar else 1 for case, _, _ in problems())
    assert [row for row in rows if not row.holds] == []


def test_errors_stay_below_the_limits_of_the_issue():
    checks = [check for limit in limits() for check in error_checks(*limit)]
    assert len(checks) > 20
    assert [check for check in checks if not check.holds] == []


@pytest.mark.parametrize(
    ("errors", "order", "holds"),
    [
        ((1e-4, 1e-9), 3.0, True),  # there
        ((1e-2, 1e-4), 5.8, True),  # not there, but on the way
        ((1e-2, 1e-4), 4.0, False),
        ((1e-2, 1e-4), None, False),
        ((1e-2, np.nan), 5.8, True),  # the finest did not converge
    ],
)
def test_eight_digits_or_the_order_that_leads_there(errors, order, holds):
    study = found(errors, order)
    records = tuple(replace(r, failure="diverged" if np.isnan(r.error) else None) for r in study.records)
    (check,) = digit_checks([replace(study, records=records)])
    assert check.holds == holds
    assert check.missed != holds


def test_a_coarse_reference_asks_for_its_own_digits():
    study = found((1e-4, 1e-6), 1.0)
    assert digit_checks([replace(study, floor=1e-5)])[0].holds
    assert not digit_checks([study])[0].holds


def test_the_best_degree_of_a_kinematics_counts():
    check = digit_checks([found((1e-2, 1e-3), 1.0), replace(found((1e-6, 1e-9), 1.0), degree=5)])[0]
    assert (check.mesh, check.holds) == ("8 × P5", True)


def test_a_short_order_is_a_miss_unless_the_case_says_why():
    (check,) = order_checks([found((1e-2, 1e-3), 3.0)])
    assert check.missed
    noted = next((case for case in CASES if case.note), None)
    if noted is not None:
        (explained,) = order_checks([found((1e-2, 1e-3), 3.0, case=noted.name)])
        assert (explained.holds, explained.missed, explained.why) == (False, False, noted.note)
