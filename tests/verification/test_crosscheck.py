"""The models differ by the discretisation error of the coarser one and by nothing else."""

from __future__ import annotations

import pytest

from verification.cases import bend45, elastica, follower, heavy
from verification.crosscheck import compare

pytestmark = pytest.mark.serial

CASES = (
    elastica.inextensible(10.0),
    follower.inextensible(20.0),
    heavy.inextensible(50.0),
    bend45.bend(600.0, kirchhoff=True),
)


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_models_differ_by_their_discretisation_errors_which_fall(case):
    coarse, fine = compare(case, (20, 40, 80))
    assert coarse.holds
    assert fine.holds
    assert coarse.difference / fine.difference == pytest.approx(4.0, rel=0.1)
