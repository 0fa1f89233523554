"""The demos run and the two models they compare agree to their discretisation error."""

import runpy
from pathlib import Path

import numpy as np
import pytest

import dolfinrod as dr

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


@pytest.mark.serial
def test_a_rope_round_a_bollard_holds_what_euler_says(tmp_path, capsys):
    """Its own thickness and stiffness are of order 1e-6, and so is what it stretches by."""
    demo = runpy.run_path(str(DEMOS / "capstan.py"))
    picture = tmp_path / "capstan.png"
    demo["main"](picture)
    assert picture.read_bytes().startswith(b"\x89PNG")
    rows = [line.split() for line in capsys.readouterr().out.splitlines()[1:]]
    assert [row[0] for row in rows] == ["90°", "180°", "270°"]
    for wrap, taken, limit, error in rows:
        assert float(limit) == pytest.approx(np.exp(0.3 * np.radians(float(wrap.rstrip("°")))), abs=1e-7)
        assert float(taken) == pytest.approx(float(limit), rel=3e-6)
        assert abs(float(error)) < 3e-6


def test_the_rope_of_the_demo_slides_at_one_force():
    """Pulled on, it takes no more: a limit load, not a solver that has failed."""
    demo = runpy.run_path(str(DEMOS / "capstan.py"))
    taken = demo["pulls"](dr.solve(demo["capstan"](90), elements=15, degree=2))
    assert (np.diff(taken) >= -1e-9).all()
    np.testing.assert_allclose(taken[-5:], taken[-1], rtol=1e-9)
    assert taken[0] < taken[3] < taken[-1]
