"""What set-up solves so that no first solve waits: all kinds of contact are in it."""

from __future__ import annotations

import numpy as np
import pytest

from dolfinrod.groove.precompile import BLINK, compiled
from dolfinrod.groove.scenario import MODELS


@pytest.mark.parametrize("model", MODELS)
def test_fibres_press_walls_and_one_another_in_the_wind(model):
    result = BLINK.run(model)
    assert BLINK.air is not None
    assert all(law is not None for law in (BLINK.wall_friction, BLINK.fibre_friction))
    assert all(np.abs(result.contacts[0].rods[fibre].force[0]).max() > 0.0 for fibre in range(BLINK.fibres))
    assert len(result.meetings[0].times[-1].rod_a) > 0
    assert np.abs(result.meetings[0].times[-1].traction).max() > 0.0


def test_a_line_is_told_of_each_model():
    told = list(compiled())
    assert len(told) == len(MODELS)
    assert all(model in line for model, line in zip(("discrete", "continuum"), told, strict=True))
