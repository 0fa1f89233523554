"""How much one load step takes and how few steps a problem takes, beside other people's solvers."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from dolfinrod.scene import Spatial
from verification.benchmarks import BENCHMARKS
from verification.models import Continuum
from verification.references.robustness import PEER_LOADS, peer_loads, peer_steps
from verification.report.robust import fewest, largest
from verification.robustness import LOADS, OneStepLoads, Steps, benchmark_rows, loads_at_once, models, steps

pytestmark = pytest.mark.serial


def test_the_largest_load_in_one_step():
    row = loads_at_once(Continuum(2, Spatial()))
    assert row.holds
    assert row.largest >= 5000.0
    assert row.largest >= 10.0 * max(peer.largest for peer in peer_loads())


def test_a_load_that_fails_ends_the_row():
    taken = (4, 5, None, *([6] * (len(LOADS) - 3)))
    row = OneStepLoads("some model", taken, 5000.0)
    assert row.largest == LOADS[1]
    assert not row.holds


def test_only_limits_and_wrong_equilibria_are_missed():
    few = Steps("a", "A", "discrete chord", 40, 2, 9, 0, 1e-9, None, None, "", None)
    assert not few.missed
    assert replace(few, error=0.5).missed
    assert not replace(few, error=np.nan, failure="diverged").missed
    assert replace(few, error=np.nan, failure="diverged", most_steps=3).missed
    assert replace(few, most_steps=1).missed
    assert replace(few, most_iterations=8).missed


def test_peers_are_as_published():
    assert max(peer.largest for peer in peer_loads()) == PEER_LOADS[-1]
    assert all(len(peer.iterations) == len(PEER_LOADS) for peer in peer_loads())
    assert min(peer.steps for peer in peer_steps("P4") if peer.steps is not None) == 1
    assert peer_steps("no such problem") == ()


@pytest.mark.parametrize("k", [0, 1, 5])
def test_some_benchmarks(k):
    row = steps(BENCHMARKS[k], Continuum(3, Spatial()))
    assert row.holds
    assert row.best_peer is not None
    assert row.steps <= row.best_peer


def test_both_tables_show_the_peers():
    rows = (steps(BENCHMARKS[0], Continuum(3, Spatial())),)
    assert "exudyn" in fewest(rows)
    assert "500" in largest((OneStepLoads("some model", tuple([5] * len(LOADS)), None),))
    assert np.isfinite(rows[0].error)


@pytest.mark.slow
@pytest.mark.parametrize("model", models(), ids=lambda model: model.name)
def test_every_model_takes_a_huge_load_at_once(model):
    assert loads_at_once(model).holds


@pytest.mark.slow
@pytest.mark.parametrize("row", benchmark_rows(), ids=lambda row: f"{row.args[0].case.name}-{row.args[1].name}")
def test_every_benchmark(row):
    found = row()
    assert found.holds, (found.steps, found.iterations, found.error, found.failure)
