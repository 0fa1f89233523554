"""Explicit steps have the limits of linear theory; the maps tell apart what converges, dissipates and fails."""

from __future__ import annotations

from dataclasses import replace
from html.parser import HTMLParser

import numpy as np
import pytest

from dolfinrod.scene import Section
from verification.explicit import Explicit, ForwardEuler, SymplecticEuler
from verification.explicitlimit import LENGTH, WAVES, ExplicitLimit, explicit_limit, fibre, highest
from verification.maps import LIMIT, SCHEMES, Cell, cells
from verification.report.maps import limits, maps
from verification.stepping import MAPS, units

pytestmark = pytest.mark.serial

BY_NAME = {scheme.name: scheme for scheme in SCHEMES}
CELL = Cell("symplectic Euler", 0.0, 1e-3, 1e-7, "converged", 1e-3, -1e-4, 3e3, 2e-7, "")


@pytest.mark.parametrize("wave", WAVES[:3], ids=lambda wave: wave.name)
def test_the_longest_stable_step_is_two_over_the_highest_frequency(wave):
    row = explicit_limit(wave, 6)
    assert row.holds
    assert row.measured == pytest.approx(row.matrices, rel=2e-3)


@pytest.mark.parametrize(
    ("wave", "l", "stated", "digits"), [(3, 5e-4, 1.060e-7, 3), (3, 2e-4, 4.240e-8, 3), (1, 5e-4, 4.9e-7, 1)]
)
def test_formulas_give_what_the_design_states(wave, l, stated, digits):
    """process.md 0.3 and 1.1: 1.06e-7 s (axial, and of all) and 4.9e-7 s (torsion) at 0.5 mm, 4.24e-8 s at 0.2 mm."""
    assert WAVES[wave].closed(Section.ramie(), l) == pytest.approx(stated, rel=10.0**-digits)


@pytest.mark.parametrize(("k", "within"), [(0, 1e-3), (1, 1e-3), (2, 5e-2)])
def test_formulas_of_long_chains_are_those_of_the_matrices(k, within):
    """Bending: the half node at the free end turns with a half element alone, five per cent faster."""
    rod = Explicit(fibre(), 40)
    rod.held = rod.letting_go(list(WAVES[k].places))
    assert 2.0 / highest(rod) == pytest.approx(WAVES[k].closed(Section.ramie(), LENGTH / 40), rel=within)


def test_forward_euler_grows_as_it_must():
    """Axial vibrations of one element: energy times 1 + ω²Δt² a step, however short the step."""
    rod = Explicit(fibre(), 1)
    rod.held = rod.letting_go([0])
    ω = highest(rod)
    start = rod.kicked(1e-6 * ω)
    for part, steps in ((0.1, 40), (0.02, 1000)):
        moved = rod.run(ForwardEuler(), start, part / ω, steps)
        assert not moved.lost
        assert 1.0 + moved.gained / moved.supplied == pytest.approx((1.0 + part**2) ** steps, rel=1e-6)


def test_symplectic_euler_keeps_the_energy_within_a_bound():
    """ω²r² + v² − ω²Δt r v is kept, so that the energy stays within 1 ± ωΔt/2 of it, whatever the number of steps."""
    rod = Explicit(fibre(), 1)
    rod.held = rod.letting_go([0])
    ω, part = highest(rod), 0.2
    start = rod.kicked(1e-6 * ω)
    for steps in (5, 50, 2003):
        moved = rod.run(SymplecticEuler(), start, part / ω, steps)
        assert abs(moved.gained) <= (part / 2.0) / (1.0 - part / 2.0) * moved.supplied


@pytest.mark.parametrize(
    ("scheme", "dt", "outcome"),
    [
        ("discrete, implicit Euler", 1e-4, "dissipated"),
        ("continuum, implicit Euler", 1e-4, "dissipated"),
        ("continuum, midpoint", 2e-5, "converged"),
        ("symplectic Euler", 1e-5, "failed"),
        ("forward Euler", 2e-7, "failed"),
    ],
)
def test_a_few_cells(scheme, dt, outcome):
    """Where the explicit schemes are long lost, the implicit ones finish."""
    (cell,) = cells(BY_NAME[scheme], 20, 0.0, (dt,))
    assert cell.outcome == outcome
    assert cell.holds
    assert bool(cell.reason) == (outcome == "failed")
    assert (cell.lost < -LIMIT) == (outcome == "dissipated")


def test_a_scheme_that_fails_within_its_limit_or_survives_beyond_is_missed():
    assert CELL.holds
    assert not Cell("symplectic Euler", 0.0, 1e-3, 1e-7, "failed", np.nan, 2.0, np.nan, 2e-7, "").holds
    assert not Cell("symplectic Euler", 0.0, 1e-3, 3e-7, "converged", 1e-3, 0.0, 1e3, 2e-7, "").holds
    assert not Cell("discrete, implicit Euler", 0.0, 1e-3, 1e-7, "failed", np.nan, 2.0, np.nan, None, "").holds


def test_pictures_say_by_signs_what_they_say_by_colours():
    other = Cell("symplectic Euler", 0.0, 2e-3, 1e-6, "failed", np.nan, 2.0, np.nan, 4e-7, "blew up")
    text = maps((CELL, other))
    HTMLParser().feed(text)
    assert text.count("✓") == 2
    assert text.count("✗") == 2
    assert text.count('class="bound"') == 2
    assert "blew up" in text
    assert "nan" not in text


def test_the_table_has_the_limits_three_ways():
    row = ExplicitLimit("axial", 5e-4, 1.0595e-7, 1.06e-7, 1.061e-7, None)
    assert row.holds
    assert all(words in limits((row,)) for words in ("1.060e−7", "1.061e−7", "0.9995", "0.5 mm", "holds"))
    assert not replace(row, measured=1.07e-7).holds
    assert "missed" in limits((replace(row, measured=1.07e-7),))


def test_a_quick_run_has_every_scheme():
    words = [unit.words for unit in units((MAPS,), quick=True)]
    assert all(any(name in line for line in words) for name in BY_NAME)
    assert len(words) < len(list(units((MAPS,), quick=False))) / 4


@pytest.mark.slow
@pytest.mark.parametrize("elements", [80, 200])
def test_limits_of_the_paper_s_meshes(elements):
    row = explicit_limit(WAVES[3], elements)
    assert row.stated is not None
    assert row.measured == pytest.approx(row.stated, rel=2e-3)


@pytest.mark.slow
@pytest.mark.parametrize("scheme", SCHEMES, ids=lambda scheme: scheme.name)
def test_maps_of_every_scheme(scheme):
    for elements in (20, 80):
        found = cells(scheme, elements, 0.0)
        assert [cell for cell in found if not cell.holds] == []
