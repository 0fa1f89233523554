"""The demos run and the two models they compare agree to their discretisation error."""

import runpy
from pathlib import Path

import numpy as np
import pytest

DEMOS = Path(__file__).parents[1] / "demos"


@pytest.mark.serial
def test_first_steps_draws_both_models(tmp_path):
    demo = runpy.run_path(str(DEMOS / "first_steps.py"))
    picture = tmp_path / "first_steps.png"
    demo["main"](picture)
    assert picture.read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(("scene", "value"), [("cantilever", 10.0), ("roll_up", 1.0), ("bend", 600.0)])
def test_models_of_the_demo_agree(scene, value):
    demo = runpy.run_path(str(DEMOS / "first_steps.py"))
    posed = demo[scene](value)
    continuum, paper = demo["both"](posed)
    # The discrete model knows no shear: on the 45° bend it differs by the shear deflection, 2e-4 of the length.
    assert np.abs(continuum.tip - paper.tip).max() < 4e-4 * posed.rods[0].length
