"""Planted faults are noticed: each breaks a law that the sound code obeys."""

from __future__ import annotations

import pytest

from tests.mutations.laws import LAWS
from tests.mutations.measures import SOLVERS
from tests.mutations.mutation import ASKED, Mutation
from tests.mutations.planting import with_own_discretizations, with_own_forms
from tests.mutations.registry import MUTATIONS, mutations

# A fault is the same on every rank.
pytestmark = pytest.mark.serial

QUICK = {(m.law, m.solver) for m in MUTATIONS if not m.slow}
NEEDED = [
    pytest.param(*pair, marks=[pytest.mark.slow] * (pair not in QUICK))
    for pair in sorted({(m.law, m.solver) for m in MUTATIONS})
]
PARAMETERS = [pytest.param(m, marks=[pytest.mark.slow] * m.slow, id=m.name) for m in MUTATIONS]


@pytest.mark.parametrize(("law", "solver"), NEEDED)
def test_sound_code_obeys(law, solver):
    holds, found = LAWS[law].holds(SOLVERS[solver])
    assert holds, f"{LAWS[law].statement}: off by {found:.3g}, allowed {LAWS[law].bound:.3g}"


@pytest.mark.parametrize("mutation", PARAMETERS)
def test_a_planted_fault_breaks_its_law(monkeypatch: pytest.MonkeyPatch, mutation: Mutation):
    (with_own_forms if mutation.compiles else with_own_discretizations)(monkeypatch)
    mutation.plant(monkeypatch)
    law = LAWS[mutation.law]
    holds, found = law.holds(SOLVERS[mutation.solver])
    assert not holds, f"survives: {law.statement}: off by {found:.3g} only, allowed {law.bound:.3g}"


@pytest.mark.parametrize(
    "name",
    [
        "4× axial stiffness",
        "4× axial stiffness, spatial",
        pytest.param("bending energy without ½", marks=pytest.mark.slow),
    ],
)
def test_nothing_of_a_fault_is_left(name):
    """Solved before, meanwhile and after, on the same elements."""
    mutation = next(m for m in MUTATIONS if m.name == name)
    solve, law = SOLVERS[mutation.solver], LAWS[mutation.law]
    before = law.measure(solve)
    with pytest.MonkeyPatch.context() as patch:
        with_own_forms(patch)
        mutation.plant(patch)
        assert law.measure(solve) > law.bound
    assert law.measure(solve) == before


def test_every_fault_that_the_issue_lists_is_planted():
    assert {m.asked for m in MUTATIONS} - {""} == set(ASKED)


def test_every_fault_has_a_name_of_its_own():
    rows = mutations()
    assert len({name for name, _, _ in rows}) == len(rows) == len(MUTATIONS)


def test_every_law_has_a_fault_that_breaks_it():
    assert {m.law for m in MUTATIONS} == set(LAWS)
