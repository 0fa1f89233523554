"""Ibrahimbegović's helix: the same equilibrium however the load is cut into steps, and the path up to ten turns."""

from __future__ import annotations

import numpy as np
import pytest

from verification.case import SKEW, UPRIGHT
from verification.cases import helix
from verification.models import Continuum, Discrete
from verification.workprecision import measure, study

pytestmark = pytest.mark.serial


@pytest.mark.parametrize("factor", [0.05, 0.1])
def test_ten_and_forty_steps_lead_to_the_same_helix(factor):
    """A dead moment about z is not conservative in space, and still no step leaves the path."""
    few, many = (helix.wound(factor, steps=n) for n in (10, 40))
    tips = [Continuum(4).solve(case.scene(UPRIGHT), 16).tip for case in (few, many)]
    assert np.linalg.norm(tips[0] - few.reference.value) < 1e-6
    assert np.linalg.norm(tips[1] - few.reference.value) < 1e-6
    assert np.linalg.norm(tips[0] - tips[1]) < 1e-9


def test_equal_stiffness_in_stretch_and_shear_only_shifts_the_helix_along_the_force():
    """u − u_Kirchhoff = λ F s/EA all along the rod, whatever it has wound itself into."""
    sheared, rigid = (
        Continuum(4).solve(helix.wound(0.05, kirchhoff=k).scene(UPRIGHT), 16).rods[0] for k in (False, True)
    )
    shift = np.outer(0.05 * helix.FORCE / helix.STIFFNESS * rigid.s, (0.0, 0.0, 1.0))
    assert sheared.r[-1] - rigid.r[-1] == pytest.approx(shift, abs=1e-10)


@pytest.mark.slow
@pytest.mark.parametrize("case", helix.BEYOND, ids=lambda case: case.name)
def test_path_beyond_is_followed_in_steps_of_a_hundredth(case):
    record = measure(case, Continuum(4), max(16, 5 * case.turns), pose=SKEW)
    assert record.failure is None
    assert record.error < 1e-8


@pytest.mark.slow
@pytest.mark.parametrize("case", [c for c in helix.BEYOND if "discrete" in c.models], ids=lambda case: case.name)
def test_discrete_model_follows_the_path_with_order_two(case):
    found = study(case, Discrete(), (20 * case.turns, 40 * case.turns))
    assert found.tip.observed == pytest.approx(2.0, abs=0.1)
    assert found.records[-1].error < 2e-3
