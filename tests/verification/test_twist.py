"""Measures of twist against the references M, which no polygon has made."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from verification.ledger import decode, encode
from verification.references.coils import coil
from verification.report.misses import sentence
from verification.report.twist import twists
from verification.twist import EXACT, extrapolated, twiststudy
from verification.twistcases import CASES
from verification.twisttrials import WINDING, listing, names, units

pytestmark = pytest.mark.serial

FOUND = {case.name: twiststudy(case) for case in CASES}
ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize("name", FOUND)
def test_measure_is_exact_or_has_the_order_of_theory(name):
    assert FOUND[name].holds, FOUND[name]


@pytest.mark.parametrize("name", FOUND)
def test_limits_are_the_digits_trusted_and_round_off(name):
    found = FOUND[name]
    case = next(case for case in CASES if case.name == name)
    trusted = 10.0**-case.reference.digits_trusted
    assert found.limit == EXACT if found.order is None else found.limit == max(trusted, EXACT)


def test_every_entry_of_the_references_is_used():
    entries = json.loads((ROOT / "verification/references/coils.json").read_text(encoding="utf-8"))
    used = {name for name in entries for case in CASES if case.reference.id.startswith(f"{name}, ")}
    assert used == set(entries)


def test_ropes_and_ribbons_of_the_references_add_up():
    """Lk = Tw + Wr, and a lay without back-twist is a turn more than one with it."""
    ribbon = [coil("M4-ribbon-R1.0-a0.3-q4", part).value[0] for part in ("Tw", "Wr", "Lk")]
    assert ribbon[0] + ribbon[1] == pytest.approx(ribbon[2], abs=1e-9)
    lay = "M2-2strand-r0.5-lay3.0"
    without, with_it = (coil(lay, f"tw_per_lay_{kind}_backtwist").value[0] for kind in ("no", "full"))
    assert without - with_it == pytest.approx(1.0, abs=1e-14)


def test_even_powers_are_extrapolated_away():
    h = 1.0 / np.array([10.0, 20.0, 40.0])
    assert extrapolated(tuple(2.0 + 3.0 * h**2 - 5.0 * h**4)) == pytest.approx(2.0, abs=1e-14)


def test_a_wrong_reference_is_missed_and_said():
    for name in ("rigid-pairs", "trefoil"):
        case = next(case for case in CASES if case.name == name)
        (value,) = case.reference.value
        found = twiststudy(replace(case, reference=replace(case.reference, value=(value + 1e-6,))))
        assert not found.holds
        assert sentence(found).startswith(case.title)
        assert "at most" in sentence(found)


def test_a_lost_order_is_missed():
    found = FOUND["trefoil"]
    assert not replace(found, order=replace(found.order, observed=1.8)).holds


def test_chosen_like_a_family_or_one_by_one():
    assert len(list(units((WINDING,)))) == len(CASES)
    (unit,) = units(("winding:rope",))
    assert unit.topic == "twist"
    assert set(names()) == {WINDING, *(f"winding:{case.name}" for case in CASES)}
    assert len(list(listing((WINDING,)))) == len(CASES) + 1
    assert list(listing(("columns",))) == []


def test_the_section_shows_every_measure():
    page = twists(tuple(FOUND.values()))
    assert page.count("✓") == len(CASES)
    assert page.count("<polyline") > sum(s.order is not None for s in FOUND.values())
    assert "<svg" not in twists([FOUND["rope"]])


def test_a_study_is_kept_and_recalled_as_it_was():
    for found in FOUND.values():
        assert decode(json.loads(json.dumps(encode(found)))) == found
