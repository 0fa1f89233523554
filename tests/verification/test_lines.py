"""Diagrams with even axes."""

from __future__ import annotations

import re

import pytest

from verification.report.lines import LEFT, Trace, linear


@pytest.mark.parametrize("value", [0.0, -0.25, 3e-7])
def test_what_stays_as_it_is_has_an_axis_of_its_own_size(value):
    drawn = linear([Trace("p1", (0.0, 1.0), (value, value), "still")], "time", "force")
    marks = [float(mark.replace("−", "-")) for mark in re.findall(r'text-anchor="end">([^<]*)<', drawn)]
    assert min(marks) <= value <= max(marks)
    assert max(map(abs, marks)) <= max(1.0, 2.0 * abs(value))
    assert max(map(abs, marks)) >= 1e-10


def test_marks_of_an_axis_fit_beside_it():
    drawn = linear([Trace("p1", (0.0, 1.0), (-5e-11, 5e-11), "noise")], "time", "force")
    longest = max(re.findall(r'text-anchor="end">([^<]*)<', drawn), key=len)
    # Letters of 15 px are about 9 px wide.
    assert 9.0 * len(longest) <= LEFT - 5
