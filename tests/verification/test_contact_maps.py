"""Maps of contact tell apart what rests, creeps, chatters and fails; pictures say by signs what they say by colours."""

from __future__ import annotations

from dataclasses import replace
from html.parser import HTMLParser

import numpy as np
import pytest

from verification.contactaudit import BRINGING, STORED, WORKS, audit
from verification.contactmaps import CREEP, SCHEMES, SETTLED, ContactCell, cells, outcome, period
from verification.contactwork import MAPS, units
from verification.report.contactmaps import contact_maps

pytestmark = pytest.mark.serial

BY_NAME = {scheme.name: scheme for scheme in SCHEMES}
EULER, LITERAL, MIDPOINT = (
    f"continuum, {words}"
    for words in (
        "implicit Euler, friction that sticks",
        "implicit Euler, creeping friction",
        "midpoint, friction that sticks",
    )
)
CELL = ContactCell(EULER, 1e-3, 1e4, 1e-5, "converged", 1e-6, 0, 1e-11, 0.8, 0.0, 3.5, 5.0, "")


def ledger(**entries: tuple[float, ...]) -> dict[str, np.ndarray]:
    """Entries that are named, zeros for the rest."""
    return {name: np.array(entries.get(name.replace(" ", "_"), (0.0, 0.0, 0.0))) for name in (*STORED, *WORKS)}


def test_an_audit_counts_what_contact_stores_and_what_friction_takes():
    sound = ledger(
        kinetic=(0.0, 0.5, 1.0), contact=(0.0, 0.2, 0.1), load_work=(0.0, 1.0, 2.0), friction=(0, -0.3, -0.9)
    )
    assert audit(sound) == (pytest.approx(0.0, abs=1e-15), 0.0, 0.0)
    gap, _, _ = audit(sound | {"friction": np.array([0.0, -0.3, -0.5])})
    assert gap == pytest.approx(0.2)


def test_what_the_steps_make_is_measured_by_all_that_went_in():
    """What a wall pushes and what penetrations store at the start count."""
    made = ledger(
        contact=(1.0, 0.0, 0.0), wall_work=(0.0, 1.0, 1.0), kinetic=(0.0, 3.0, 3.0), numerical=(0.0, 1.0, 1.0)
    )
    assert audit(made) == (pytest.approx(0.0, abs=1e-15), pytest.approx(-0.5), pytest.approx(0.5))
    assert set(BRINGING) < set(WORKS)


@pytest.mark.parametrize(
    ("swing", "flips", "crept", "held", "found"),
    [
        (0.0, 0, 0.0, False, "converged"),
        (SETTLED, 1, CREEP * 1e-5, False, "converged"),
        (2.0 * SETTLED, 0, 0.0, False, "chatters"),
        (0.0, 2, 0.0, False, "chatters"),
        (np.nan, 0, 0.0, False, "chatters"),
        (0.0, 0, 2.0 * CREEP * 1e-5, False, "creeps"),
        (0.0, 0, 2.0 * CREEP * 1e-5, True, "chatters"),
        (0.0, 0, CREEP * 1e-5, True, "converged"),
    ],
)
def test_the_rules(swing, flips, crept, held, found):
    """What swings about anchors that stay where they are does not creep, nor is it at rest."""
    assert outcome(swing, flips, crept, held=held) == found


def test_a_touch_takes_half_a_period():
    """process.md 6.8, C2: 15.45 µs at c = 2e4 N/m²."""
    assert period(2e4) == pytest.approx(15.45e-6, rel=1e-3)


def test_an_implicit_scheme_that_fails_is_missed_but_for_the_midpoint_rule_in_steps_beyond_a_touch():
    assert CELL.holds
    assert not replace(CELL, outcome="failed").holds
    assert not replace(CELL, outcome="creeps").holds
    assert replace(CELL, scheme=LITERAL, outcome="creeps").holds
    assert replace(CELL, scheme=MIDPOINT, outcome="failed", dt=5e-5).holds
    assert not replace(CELL, scheme=MIDPOINT, outcome="failed", dt=1e-6).holds


@pytest.mark.parametrize(
    ("scheme", "eps_N", "found"),
    [
        (EULER, 1e4, "converged"),
        (LITERAL, 1e4, "creeps"),
        pytest.param(MIDPOINT, 1e4, "chatters", marks=pytest.mark.slow),
    ],
)
def test_a_few_cells(scheme, eps_N, found):
    """Steps of 50 µs are beyond every touch on these walls."""
    (cell,) = cells(BY_NAME[scheme], 5, eps_N, (5e-5,))
    assert cell.outcome == found
    assert cell.holds


def test_pictures_say_by_signs_what_they_say_by_colours():
    failed = replace(
        CELL, eps_N=1e6, outcome="failed", swing=np.nan, iterations=np.nan, ms=np.nan, reason="did not settle"
    )
    others = (failed, replace(CELL, dt=5e-5, outcome="creeps"), replace(CELL, eps_N=1e6, dt=5e-5, outcome="chatters"))
    text = contact_maps((CELL, *others))
    HTMLParser().feed(text)
    assert all(text.count(sign) == 2 for sign in "✓→≈")
    assert text.count('class="bound"') == 1
    assert "did not settle" in text
    assert "nan" not in text


def test_a_quick_run_has_every_scheme():
    words = [unit.words for unit in units((MAPS,), quick=True)]
    assert all(any(name in line for line in words) for name in BY_NAME)
    assert len(words) < len(list(units((MAPS,), quick=False))) / 4


@pytest.mark.slow
@pytest.mark.parametrize("scheme", SCHEMES, ids=lambda scheme: scheme.name)
def test_maps_of_every_scheme(scheme):
    for eps_N in (1e4, 1e6):
        found = cells(scheme, 10, eps_N)
        assert [(cell.eps_N, cell.dt, cell.outcome, cell.reason) for cell in found if not cell.holds] == []
