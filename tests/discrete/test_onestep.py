"""Whole loads in one step, in few iterations, whatever the slenderness and the mesh."""

from __future__ import annotations

import numpy as np
import pytest

import discrete
from dolfinrod.scene import PointForce, PointMoment, Section
from tests.scenes import (
    FLAT,
    KIRCHHOFF,
    SKEW,
    bend,
    cantilever,
    followed,
    largest,
    rolled_up,
    round_section,
    tip_loaded,
)

every_form = pytest.mark.parametrize(
    ("frame", "axial"), [("element", "chord"), ("element", "paper"), ("node_i", "chord"), ("node_i", "paper")]
)
sections = pytest.mark.parametrize(
    "section", [*map(round_section, (20.0, 200.0, 2000.0)), KIRCHHOFF], ids=["20", "200", "2000", "rigid"]
)


def assert_one_step(result, most: int) -> None:
    assert result.converged
    assert result.statistics.load_steps == 1
    assert result.statistics.newton_iterations <= most


@sections
@every_form
def test_elastica_at_ten(section: Section, frame, axial):
    assert_one_step(discrete.solve(tip_loaded(section, 10.0), frame=frame, axial=axial), 7)


@pytest.mark.parametrize("elements", [5, 20, 320])
@pytest.mark.parametrize("force", [100.0, 500.0, 5000.0])
def test_large_tip_loads_on_any_mesh(force, elements):
    assert_one_step(discrete.solve(tip_loaded(KIRCHHOFF, force), elements=elements), 9)


def test_thousands_of_elements_do_not_drown_in_round_off():
    """12EI/l³ reaches 8e11 EI/L³; the clamp still answers with the load and no more."""
    result = discrete.solve(tip_loaded(round_section(200.0), 10.0, FLAT), elements=4000)
    assert_one_step(result, 7)
    assert result.rods[0].n[-1, 0] == pytest.approx([0.0, 10.0, 0.0], abs=1e-9)


@pytest.mark.parametrize(("turns", "most", "pose"), [(1, 8, SKEW), (2, 12, SKEW), (5, 24, FLAT)])
def test_end_moments_close_the_circle_exactly(turns, most, pose):
    """Constant curvature is represented exactly: the polygon closes at every number of elements.

    Beyond two turns the circle is so unstable in space that round-off out of the plane, which only an axis-aligned
    pose is free of, grows faster than the iteration converges.
    """
    for section in (round_section(200.0), KIRCHHOFF):
        result = discrete.solve(rolled_up(section, turns, pose))
        assert_one_step(result, most)
        assert pose.back(result.tip) == pytest.approx(np.zeros(3), abs=1e-10)
        assert result.rods[0].m[-1] == pytest.approx(np.tile([0, 0, 2 * np.pi * turns], (81, 1)), abs=1e-8)


def test_follower_force_reaches_the_branch_of_the_reference():
    """Case C1, inextensible, Jacobi functions: P L²/EI = 10."""
    result = discrete.solve(followed(KIRCHHOFF, 10.0, FLAT), elements=160)
    assert_one_step(result, 10)
    assert result.tip[:2] == pytest.approx([-0.09212318118936638, 0.5469632645937142], abs=5e-5)


@every_form
def test_bend_at_600(frame, axial):
    assert_one_step(discrete.solve(bend(600.0), frame=frame, axial=axial), 8)


def test_bent_and_twisted_at_once():
    moment = SKEW.turned((0.3 * np.pi, 0.0, np.pi))
    loads = PointForce(SKEW.turned((5.0, 0.0, 3.5)), "end"), PointMoment(moment, "end")
    assert_one_step(discrete.solve(cantilever(SKEW.straight(round_section(200.0)), *loads), elements=40), 10)


def test_no_shear_is_stated_and_largest_residual_is_small():
    result = discrete.solve(tip_loaded(KIRCHHOFF, 10.0))
    assert "no shear: GA ignored, as in the paper" in result.formulation.notes
    assert "rigid extension: EA = 1e+08·EI/L²" in result.formulation.notes
    assert result.formulation.unknowns == {"x": 243, "rotation": 243, "F_n": 80}
    assert largest([row.residual for row in result.log]) < 1e-7
