"""Ranks beyond the machine: the estimate is exact where its premises are, and is called an estimate."""

from __future__ import annotations

import json
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from verification.bundletrials import MODELS
from verification.ledger import decode, encode
from verification.plan import selected
from verification.report.misses import sentence
from verification.report.scaling import scalings
from verification.scaling import RANKS, EnsembleScaling, Scaling, ensembles, scaled
from verification.trials import APART

BUNDLE = Scaling(57, 200, 2.0, 1.3, 1.0, 0.05, 40.0, 6e4, 1e-5, 1e9)
ENSEMBLE = EnsembleScaling(10, (20.0, 10.4), (2.0,) * 10)


@given(st.floats(0.1, 10.0), st.floats(0.0, 5.0))
def test_work_shared_and_repeated_is_found_from_one_rank_and_two(shared, repeated):
    """T₁ = w + s and T₂ = w/2 + s, without anything to tell: w is found, and two ranks are as quick as measured."""
    row = replace(BUNDLE, fibres=8, one=shared + repeated, two=0.5 * shared + repeated, talk=0.0, calls=0.0)
    assert row.shared == pytest.approx(shared, rel=1e-9)
    assert row.estimated(2) == pytest.approx(row.strong, rel=1e-9)


def test_no_more_ranks_than_fibres_help_and_exchanges_take_their_share():
    assert BUNDLE.estimated(57) > BUNDLE.estimated(100)
    assert replace(BUNDLE, latency=1e-3).estimated(8) < BUNDLE.estimated(8)
    assert replace(BUNDLE, rate=1e6).estimated(8) < BUNDLE.estimated(8)
    assert all(BUNDLE.estimated(p) <= p for p in RANKS)


def test_runs_that_tell_each_other_nothing_go_to_whoever_is_free():
    assert ENSEMBLE.estimated(2) == pytest.approx(2.0)
    assert ENSEMBLE.estimated(4) == pytest.approx(10 / 3)
    assert ENSEMBLE.estimated(32) == pytest.approx(10.0)


def test_the_table_tells_what_was_measured_from_what_is_estimated():
    page = scalings((BUNDLE, ENSEMBLE))
    assert page.count("estimate") >= 1 + len(RANKS)
    assert "1.54" in page
    assert "1.92" in page
    assert "holds" not in page


def test_what_failed_is_missed_and_says_why_and_time_never_decides():
    failed = replace(BUNDLE, failure="no memory")
    assert not failed.holds
    assert "no memory" in sentence(failed)
    assert "✗" in scalings((failed,))
    assert replace(BUNDLE, two=2.0).holds
    assert "1.00 times" in replace(BUNDLE, two=2.0).words


def test_rows_are_kept_and_recalled_as_they_were():
    for found in (BUNDLE, ENSEMBLE):
        assert decode(json.loads(json.dumps(encode(found)))) == found


def test_what_takes_hours_is_done_only_where_it_is_asked_for():
    assert not set(APART) & set(selected(()))
    assert set(APART) & set(selected(("*-long",))) == {"bundles-long"}
    assert "groove-acceptance" in selected(("groove-acceptance",))


@pytest.mark.slow
@pytest.mark.serial
def test_a_small_bundle_and_a_small_ensemble_run_on_one_rank_and_two():
    (bundle, same), ensemble = scaled(MODELS[-1], 2, 1), ensembles(2, 2)
    assert bundle.holds, bundle
    assert same.holds, same
    assert same.steps == 1
    assert min(same.seconds) > 0.0
    assert min(bundle.one, bundle.two, bundle.half, bundle.calls, bundle.rate) > 0.0
    assert ensemble.holds, ensemble
    assert len(ensemble.each) == 2
