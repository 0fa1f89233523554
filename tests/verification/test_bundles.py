"""What bundles cost: that they run, grow as they may, and are the same on two ranks."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest

from dolfinrod.scene import LineForce
from verification.bundles import (
    FEW,
    GROWTH,
    MOST,
    Bundle,
    BundleCost,
    BundleRanks,
    BundleStudy,
    measured,
    on_ranks,
)
from verification.bundlescene import bundle, places
from verification.bundletrials import BUNDLES, FIBRES, LONG, MODELS, listing, names, units
from verification.ledger import decode, encode
from verification.report.bundles import bundles
from verification.report.misses import sentence

pytestmark = pytest.mark.serial


def grown(by: float) -> BundleStudy:
    """A study whose memory grows by a power."""
    rows = tuple(BundleCost(n, 200, 0, 1000, 40, 9 * n, 0.1 * n, 0.06 * n, 0.03 * n, 4.0 * n**by) for n in FIBRES)
    return BundleStudy("discrete", "80", rows)


RANKS = BundleRanks(MOST, "20 × P3", 20, 1e-13, (40.0, 22.0))


@pytest.mark.parametrize("n", FIBRES)
def test_fibres_begin_at_the_edge_of_their_halos(n):
    """Packed: no two nearer than a diameter, and each at that distance from another; as many contacts as can be."""
    at = places(n)
    apart = np.linalg.norm(at[:, None] - at[None], axis=2) + 9.0 * np.eye(n)
    assert apart.min() == pytest.approx(1.0, abs=1e-12)
    assert apart.min(axis=1) == pytest.approx(np.ones(n), abs=1e-12)
    # Harborth 1974: discs of which no more can touch.
    assert (np.triu(apart) < 1.0 + 1e-9).sum() - n * (n + 1) // 2 <= np.floor(3 * n - np.sqrt(12 * n - 3))


def test_the_load_is_in_balance_along_and_presses_inwards():
    scene = bundle(7, 10)
    assert len(scene.rods) == 7
    for rod, load in zip(scene.rods, scene.loads, strict=True):
        assert isinstance(load, LineForce)
        middle = np.array(rod.centerline(0.5 * rod.length))
        assert np.dot(load.force[1:], middle[1:]) <= 0.0


@pytest.mark.parametrize("who", MODELS, ids=[who.model for who in MODELS])
def test_two_fibres_are_moved_in_a_process_of_their_own(who):
    (row,) = measured(replace(who, elements=who.elements // 5), (2,), 3).rows
    assert not row.failure
    assert row.steps == 3
    assert row.cuts == 0
    assert row.iterations >= row.steps
    assert row.memory > 0.0
    assert 0.0 < row.law + row.solver <= row.seconds


@pytest.mark.slow
@pytest.mark.parametrize("who", MODELS, ids=[who.model for who in MODELS])
def test_steps_of_many_fibres_take_no_more_iterations_than_those_of_few(who):
    few, many = measured(who, (FEW, 20), 10).rows
    assert many.cuts == few.cuts == 0
    assert many.iterations <= 1.5 * few.iterations
    assert BundleStudy(who.model, who.mesh, (few, many)).holds


@pytest.mark.slow
def test_two_ranks_give_the_same_bundle():
    found = on_ranks(MODELS[-1], FEW, 5)
    assert found.holds, found


def test_a_run_that_fails_says_why():
    (row,) = measured(Bundle("discrete", 0), (2,), 1).rows
    assert row.failure
    assert not BundleStudy("discrete", "0", (row,)).holds
    assert row.failure in sentence(BundleStudy("discrete", "0", (row,)))


def test_growth_is_the_power_from_few_to_many():
    assert grown(1.25).slope("memory") == pytest.approx(1.25, abs=1e-12)
    assert grown(1.25).slope("seconds") == pytest.approx(1.0, abs=1e-12)
    assert BundleStudy("discrete", "80", grown(1.0).rows[:2]).slope("memory") is None


def test_what_grows_too_fast_and_ranks_that_differ_are_missed_and_said():
    assert grown(GROWTH - 0.01).holds
    assert not grown(GROWTH + 0.01).holds
    assert "1.31" in sentence(grown(GROWTH + 0.01))
    assert RANKS.holds
    assert not replace(RANKS, apart=1e-9).holds
    assert "1.0e-09" in sentence(replace(RANKS, apart=1e-9))


def test_chosen_like_a_family_or_one_by_one():
    assert [unit.topic for unit in units((BUNDLES,), quick=False)] == ["bundle"] * 5
    assert [unit.topic for unit in units((BUNDLES,), quick=True)] == ["bundle"] * 2
    assert len(list(units(("bundles:discrete",), quick=False))) == 1
    parts = {"bundles:discrete", "bundles:continuum", "bundles:ranks", "bundles:scaling"}
    assert set(names()) == {BUNDLES, LONG, *parts}
    assert len(list(listing((BUNDLES,)))) == 5
    assert [unit.parameters[-1] for unit in units((LONG,), quick=False)][-1] == 200
    assert list(listing(("columns",))) == []


def test_the_section_shows_every_run():
    page = bundles((grown(1.0), RANKS))
    assert page.count("<polyline") >= 2
    assert all(f">{n}<" in page for n in FIBRES)
    assert "1.82" in page


def test_studies_are_kept_and_recalled_as_they_were():
    for found in (grown(1.0), RANKS):
        assert decode(json.loads(json.dumps(encode(found)))) == found
