"""Counts and flags against what owes nothing to them: dense eigenvalues, differences of the energy."""

from __future__ import annotations

import numpy as np
import pytest

import discrete
import dolfinrod as dr
from discrete.stability import Judge
from tests.discrete.eigenvalues import falling, reached, vibrations
from tests.discrete.test_buckling import ENDS, EULER, column
from tests.discrete.test_stepping import helix
from tests.scenes import FLAT, KIRCHHOFF, SKEW, followed, rolled_up, tip_loaded

SOFT = dr.Section(EA=1e3, GA=1.0, GJ=0.8, EI=1.0)
THIN = dr.Section(EA=1e3, GA=1.0, GJ=0.1, EI=(0.05, 1.0))


@pytest.mark.parametrize(
    ("scene", "lost"),
    [
        pytest.param(column(ENDS["clamped-free"], SOFT, 2.4), 0, marks=pytest.mark.slow),
        (column(ENDS["clamped-free"], SOFT, 3.0), 2),
        pytest.param(tip_loaded(THIN, 0.2), 0, marks=pytest.mark.slow),
        (tip_loaded(THIN, 0.6), 1),
    ],
)
def test_directions_are_those_in_which_the_energy_falls(scene, lost):
    """By differences of the energy itself, which know of no tangent."""
    result = discrete.solve(scene, elements=4)
    assert falling(result) == result.log[-1].unstable_directions == lost


@pytest.mark.parametrize(
    ("scene", "stable"),
    [
        (rolled_up(KIRCHHOFF, 0.5, FLAT), True),
        (rolled_up(KIRCHHOFF, 1.0, FLAT), False),
        pytest.param(rolled_up(KIRCHHOFF, 2.0, SKEW), False, marks=pytest.mark.slow),
        (helix(factor=0.05), True),
        (helix(factor=0.1), False),
        pytest.param(helix(factor=0.2), False, marks=pytest.mark.slow),
        (followed(KIRCHHOFF, 3.0, FLAT), True),
    ],
)
def test_flags_without_a_potential_are_those_of_all_vibrations(scene, stable):
    """Roll-ups from a turn on and helix E from a tenth of its load on grow oscillations by more than 1 a radian."""
    result = discrete.solve(scene, elements=24)
    s = np.sqrt(vibrations(result))
    growth = np.abs(s.imag) / np.maximum(s.real, 1e-9)
    assert result.log[-1].stable is stable
    assert bool(growth.max() < 0.01) is stable
    assert stable or growth.max() > 1.0


@pytest.mark.parametrize("scene", [rolled_up(KIRCHHOFF, 2.0, FLAT), helix(factor=1.0)], ids=["roll-up", "helix"])
def test_only_true_eigenvalues_are_counted(scene):
    """What oscillates as it falls is no direction; rough iterations once took eigenvalues for real that are none."""
    equilibrium, found = reached(discrete.solve(scene, elements=80))
    verdict = Judge(scene, equilibrium.mesh).verdict(found.tangent, found.state.R)
    assert (verdict.stable, verdict.directions, verdict.counted) == (False, 0, None)


@pytest.mark.parametrize("elements", [10, 40, *(pytest.param(n, marks=pytest.mark.slow) for n in (80, 320))])
def test_a_buckled_round_column_may_turn_about_its_axis(elements):
    """That costs no energy: an eigenvalue zero, whose sign is round-off. State F2a-alpha80, P = 1.29389 P_E."""
    aside, loaded = ((0, 0), (0.25, 1), (0.75, 1), (1, 0)), ((0, 0), (0.25, 0), (0.75, 1), (1, 1))
    P = 1.2938893238822775 * EULER["clamped-free"]
    loads = [dr.PointForce((-P, 0, 0), "end", history=loaded), dr.PointForce((0, 0.05 * P, 0), "end", history=aside)]
    result = discrete.solve(dr.Scene([FLAT.straight(KIRCHHOFF)], [dr.Clamp("start")], loads), elements=elements)
    assert result.tip == pytest.approx([0.559395918951176, 0.7194971047313317, 0.0], abs=0.4 / elements**2)
    assert [(row.stable, row.unstable_directions) for row in result.log] == [(True, 0)] * len(result.log)
    if elements == 10:
        λ = np.sort(np.abs(vibrations(result)))
        assert λ[0] < 1e-8
        assert λ[1] > 1.0
