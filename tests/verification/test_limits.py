"""The numbers of the issue: whole loads in one step within the iterations allowed, errors below their limits."""

from __future__ import annotations

import pytest

from verification.checks import error_checks
from verification.onestep import one_step, problems

pytestmark = pytest.mark.serial


def test_whole_loads_are_taken_at_once():
    rows = one_step()
    assert len(rows) == sum(2 if case.planar else 1 for case, _, _ in problems())
    assert [row for row in rows if not row.holds] == []


def test_errors_stay_below_the_limits_of_the_issue():
    checks = error_checks()
    assert len(checks) > 20
    assert [check for check in checks if not check.holds] == []
