"""Newton's method takes the whole load at once, with nothing tuned for the case at hand."""

from __future__ import annotations

from petsc4py import PETSc

import pytest

import dolfinrod as dr
from dolfinrod.continuum.outcome import words
from tests.scenes import KIRCHHOFF, bend, both_kinematics, followed, rolled_up, round_section, tip_loaded

SECTIONS = {"L/d = 20": round_section(20), "L/d = 200": round_section(200), "L/d = 2000": round_section(2000)}
SECTIONS["inextensible"] = KIRCHHOFF
any_section = pytest.mark.parametrize("section", SECTIONS.values(), ids=SECTIONS.keys())


def iterations_in_one_step(scene: dr.Scene, kinematics: dr.Planar | dr.Spatial | None, **mesh: int) -> int:
    """All Newton iterations of a solve that needs a single load step."""
    result = dr.solve(scene, kinematics=kinematics, **mesh)
    assert result.converged
    assert [(step.t, step.cuts) for step in result.log] == [(1.0, 0)]
    assert result.statistics.newton_iterations == result.log[0].iterations
    return result.statistics.newton_iterations


@both_kinematics
@any_section
@pytest.mark.parametrize("mesh", [{"elements": 8, "degree": 3}, {"elements": 4, "degree": 5}], ids=["8 P3", "4 P5"])
def test_elastica_at_ten(section, kinematics, mesh):
    assert iterations_in_one_step(tip_loaded(section, 10.0), kinematics, **mesh) <= 8


# At 5000 the thick rod is left out: 1 + P/EA − P/GA < 0, where tension shears it out in more than one way.
HARD = [(name, P) for name in SECTIONS for P in (100.0, 500.0, 5000.0) if (name, P) != ("L/d = 20", 5000.0)]


@both_kinematics
@pytest.mark.parametrize(("name", "force"), HARD)
def test_tip_forces_far_beyond_bending(name, force, kinematics):
    elements = 16 if force > 1000.0 else 8
    assert iterations_in_one_step(tip_loaded(SECTIONS[name], force), kinematics, elements=elements, degree=3) <= 12


@both_kinematics
@any_section
@pytest.mark.parametrize(("turns", "limit"), [(0.5, 12), (1, 12), (2, 20), (5, 30)])
def test_roll_up(turns, limit, section, kinematics):
    elements = max(8, 8 * int(turns))
    assert iterations_in_one_step(rolled_up(section, turns), kinematics, elements=elements, degree=3) <= limit


@both_kinematics
@any_section
def test_follower_tip_force(section, kinematics):
    assert iterations_in_one_step(followed(section, 10.0), kinematics, elements=8, degree=3) <= 25


@pytest.mark.parametrize(("elements", "degree"), [(4, 4), (8, 2), (8, 3), (8, 4), (16, 4)])
def test_bend(elements, degree):
    assert iterations_in_one_step(bend(600.0), None, elements=elements, degree=degree) <= 10


def test_a_failure_says_after_how_many_iterations():
    assert words(PETSc.SNES.ConvergedReason.DIVERGED_MAX_IT, 8) == "Newton's method did not settle in 8 iterations"
    assert words(PETSc.SNES.ConvergedReason.CONVERGED_SNORM_RELATIVE, 8) == "converged"
