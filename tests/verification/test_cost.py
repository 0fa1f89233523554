"""What an iteration and a process cost: that it is measured, and shown as it was found."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest

from verification.cold import PROCESSES, SECONDS, Cold, cold
from verification.growth import POWER, Growth, GrowthStudy, grown
from verification.growthtrials import COLD, GROWN, GROWTH, LIMIT, MESHES, listing, names, units
from verification.ledger import decode, encode
from verification.limit import TWICE, Limit, limit
from verification.report.limit import TITLES, bars, contents
from verification.report.misses import sentence

pytestmark = pytest.mark.serial

FOUND = Limit("planar", "8 × P3", 147, 19, 0.12, 0.1, 0.1, 0.3, 0.08)
START = Cold("dolfinrod run", 1.2, 1.1, 20.0, SECONDS)


def growing(power: float) -> GrowthStudy:
    """A study whose time grows by a power."""
    return GrowthStudy(
        "discrete", 1, tuple(Growth(n, 7 * n, 5, 0.02 * n**power, 0.01 * n) for n in (100, 1000, 10_000))
    )


@pytest.mark.parametrize("model", ["planar", "discrete"])
def test_an_iteration_is_taken_apart_in_a_process_of_its_own(model):
    found = limit(model, 4, 2, 2)
    assert not found.failure
    assert min(found.assembly, found.factors, found.python, found.banded) > 0.0
    assert (found.petsc > 0.0) == (model == "planar")
    # Of a block of 13 of the discrete element; of an element of P2 with its neighbour's end.
    assert found.half == {"discrete": 12}.get(model, found.half)
    assert found.unknowns > 2 * found.half


def test_a_finer_mesh_costs_more():
    study = grown("discrete", 1, (10, 400))
    assert not any(row.failure for row in study.rows)
    assert study.rows[1].ms > study.rows[0].ms
    assert study.rows[1].memory > 0.0
    assert study.slope("ms") is None


@pytest.mark.slow
def test_a_whole_process_compiles_once():
    found = cold(next(k for k, (*_, runs) in enumerate(PROCESSES) if runs), 1, compiling=True)
    assert not found.failure
    assert found.compiling > found.processor > 0.0


def test_a_process_that_fails_says_why(monkeypatch):
    monkeypatch.setattr("verification.cold.PROCESSES", (("fails", ("-c", "raise SystemExit('no luck')"), True),))
    found = cold(0, 1, compiling=False)
    assert found.failure == "no luck"
    assert not found.holds
    assert "no luck" in sentence(found)
    assert limit("planar", 0, 2, 2).failure


def test_limits_are_limits():
    assert FOUND.within
    assert FOUND.ratio == pytest.approx(1.25)
    slow = replace(FOUND, factors=1.01 * TWICE * FOUND.banded)
    assert slow.holds
    assert not slow.within
    assert "killed" in sentence(replace(FOUND, failure="killed"))
    assert growing(POWER - 0.01).within
    assert not growing(POWER + 0.01).within
    assert "1.11" in sentence(growing(POWER + 0.01))
    assert START.within
    assert not replace(START, clock=1.01 * SECONDS).within
    assert replace(START, clock=9.0, limit=None).within


def test_growth_is_the_power_on_fine_meshes():
    assert growing(1.05).slope("ms") == pytest.approx(1.05, abs=1e-12)
    failed = replace(growing(1.0), rows=(*growing(1.0).rows, Growth(100_000, 0, 0, np.nan, np.nan, "killed")))
    assert failed.slope("ms") == pytest.approx(1.0, abs=1e-12)
    assert not failed.holds
    assert "killed" in failed.words


def test_growth_of_time_is_marked_but_no_miss():
    """On a busy machine it says little; that of memory is the same everywhere."""
    slow = growing(POWER + 0.05)
    assert slow.holds
    assert not slow.within
    assert growing(POWER - 0.05).within
    assert not replace(slow, rows=tuple(replace(row, memory=row.ms) for row in slow.rows)).holds


def test_chosen_one_by_one():
    assert names() == (LIMIT, GROWTH, COLD)
    assert [len(list(units((name,), quick=False))) for name in names()] == [len(MESHES), len(GROWN), len(PROCESSES)]
    assert [len(list(units((name,), quick=True))) for name in names()] == [3, len(GROWN), 1]
    assert [name for name, _ in listing((COLD, LIMIT, "columns"))] == [LIMIT, COLD]


def test_rows_are_kept_and_recalled_as_they_were():
    for found in (FOUND, growing(1.0), START):
        assert decode(json.loads(json.dumps(encode(found)))) == found


class Found:
    iterations = (FOUND, replace(FOUND, model="discrete", petsc=0.0), replace(FOUND, failure="killed"))
    starts = (START, replace(START, words="import", compiling=None, limit=None), replace(START, failure="killed"))
    costs = (*iterations, growing(1.0), *starts)


def test_sections_show_every_row():
    parts = contents(Found)
    assert parts.keys() == TITLES.keys()
    assert bars(Found.iterations[:2]).count("<title>") == 8
    assert "killed" in parts["limit"]
    assert "10\u202f000" in parts["growth"] or "10000" in parts["growth"] or "10,000" in parts["growth"]
    assert "20" in parts["cold"]
    assert "killed" in parts["cold"]
