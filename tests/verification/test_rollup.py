"""Ten turns by both models with nothing but their defaults, in any units."""

from __future__ import annotations

import numpy as np
import pytest

from dolfinrod.scene import Clamp, Planar, PointMoment, Rod, Scene, Section
from verification.case import SKEW
from verification.cases import rollup
from verification.models import Continuum, Discrete
from verification.workprecision import measure

pytestmark = pytest.mark.serial

# Elements a turn; with four of degree 4 in space the tip misses by 8e-10.
MODELS = ((Continuum(4, Planar()), 4), (Continuum(4), 4), (Discrete(), 8))


@pytest.mark.parametrize(("model", "per_turn"), MODELS, ids=[model.name for model, _ in MODELS])
def test_ten_turns_close(model, per_turn):
    record = measure(rollup.rolled(10.0), model, 10 * per_turn, pose=SKEW)
    assert record.failure is None
    assert record.error < 1e-8


@pytest.mark.parametrize(("model", "per_turn"), [MODELS[0], MODELS[2]], ids=["continuum", "discrete"])
@pytest.mark.parametrize(("length", "EI"), [(1e-12, 1e12), (1e6, 1e-12), (0.04, 2.7e-10)])
def test_no_unit_is_too_small_or_large(model, per_turn, length, EI):
    """No tolerance is absolute: other units change nothing but the last digits."""
    section = Section(EA=1e6 * EI / length**2, GA=4e5 * EI / length**2, GJ=0.8 * EI, EI=EI)
    moment = 20.0 * np.pi * EI / length
    scene = Scene(
        rods=[Rod.straight(length=length, section=section)],
        supports=[Clamp(at="start")],
        loads=[PointMoment((0.0, 0.0, moment), at="end")],
    )
    result = model.solve(scene, 10 * per_turn)
    assert np.linalg.norm(result.tip) < 1e-9 * length
