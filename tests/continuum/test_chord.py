"""Laws of the solver of steps in time: what it finds does not depend on how old its tangents are."""

from __future__ import annotations

from mpi4py import MPI

import numpy as np
import pytest

import dolfinrod as dr
from dolfinrod.continuum import chord
from dolfinrod.continuum.discretization import Discretization
from dolfinrod.continuum.moving import Moving
from dolfinrod.continuum.placement import Placement
from dolfinrod.continuum.predictor import MOST_STATES, Predictor
from dolfinrod.continuum.schemes import MIDPOINT
from dolfinrod.continuum.spatial import SpatialRods
from dolfinrod.scene import in_time
from tests.scenes import both_kinematics

SECTION = dr.Section(EA=1200.0, GA=400.0, GJ=0.8, EI=1.0, rhoA=1.0, rhoI=(2 / 1200, 1 / 1200, 1 / 1200))
MESH = {"elements": 4, "degree": 3}
CLAMP = dr.Clamp("start")


def swinging(steps: int, scheme: object, t_end: float = 0.1, support: object = CLAMP) -> dr.Scene:
    """A rod that falls from the horizontal."""
    motion = dr.Dynamic(t_end, t_end / steps, scheme, output=t_end)
    loads = [dr.Gravity((0.0, -9.81, 0.0))]
    return dr.Scene([dr.Rod.straight(1.0, SECTION)], [support], loads, motion=motion)


@pytest.mark.parametrize("scheme", [dr.ImplicitEuler(), dr.Midpoint()], ids=["Euler", "midpoint"])
@both_kinematics
def test_kept_tangents_lead_to_the_same_motion(kinematics, scheme, monkeypatch):
    """A tangent for every iteration, which is Newton's method, gives what kept ones give, and needs more of them."""
    scene = swinging(20, scheme)
    kept = dr.solve(scene, **MESH, kinematics=kinematics)
    monkeypatch.setattr(chord, "SLOW", 0.0)
    monkeypatch.setattr(chord, "TOLERANCE", 0.0)
    fresh = dr.solve(scene, **MESH, kinematics=kinematics)
    assert np.abs(kept.rods[0].r - fresh.rods[0].r).max() <= 1e-11
    assert np.abs(kept.rods[0].v - fresh.rods[0].v).max() <= 1e-9
    assert kept.statistics.factorizations < 0.7 * fresh.statistics.factorizations


@pytest.mark.parametrize("scheme", [dr.ImplicitEuler(), dr.Midpoint()], ids=["Euler", "midpoint"])
@both_kinematics
def test_a_tangent_that_does_for_one_increment_is_asked_for_no_more(kinematics, scheme):
    """A rod that turns in each step: one increment by the tangent before, one by a new one, and one that ends it."""
    steps = 40
    scene = swinging(steps, scheme, t_end=0.2, support=dr.Pin("start"))
    statistics = dr.solve(scene, elements=1, degree=5, kinematics=kinematics).statistics
    # Waves that the steps do not resolve, and the start from rest, take a few more.
    assert statistics.factorizations <= 1.1 * steps
    assert statistics.newton_iterations <= 3.5 * steps


@pytest.mark.serial
def test_smooth_motion_is_foreseen():
    """A motion that is a cubic polynomial in time is met exactly once its states are known, at uneven steps too."""
    scene = in_time(swinging(20, dr.Midpoint()))
    problem = Moving(
        scene, Discretization(MPI.COMM_SELF, SpatialRods(), 3, (4,)), Placement.of(scene, dr.Spatial()), MIDPOINT
    )
    predictor, r = Predictor(problem, 0.0), np.setdiff1d(problem.lumped.r, problem.constraints.dofs)
    start, shape = problem.x.copy(), np.random.default_rng(0).normal(size=(3, len(r)))
    problem.h = 0.0
    for t in np.cumsum([0.1, 0.12, 0.1, 0.07, 0.1, 0.1]):
        moved = shape.T @ [t, t**2, t**3]
        error = np.abs(predictor.guess(t)[r] - start[r] - moved).max()
        problem.x[r] = start[r] + moved
        predictor.learn(t)
    assert MOST_STATES == 4
    assert error <= 1e-12


@pytest.mark.parametrize("rigid", [(), ("shear", "extension")], ids=["elastic", "rigid"])
@both_kinematics
def test_round_off_in_the_forces_of_thin_fibres_is_accepted(kinematics, rigid):
    """A fibre 2000 times as long as thick, at 1 μs: round-off of its nodes is 1e-8 of its forces, iterate or not."""
    fibre = dr.Rod.straight(0.04, dr.Section.ramie(rigid=rigid))
    spin = [dr.Velocity(omega=(0.0, 0.0, 20.0))]
    motion = dr.Dynamic(2e-5, 1e-6, dr.Midpoint(), output=2e-5)
    scene = dr.Scene([fibre], [dr.Clamp("start")], [dr.Gravity((0.0, -9.81, 0.0))], velocities=spin, motion=motion)
    result = dr.solve(scene, elements=8, kinematics=kinematics)
    assert len(result.log) == 20
    assert result.statistics.newton_iterations <= 6 * 20
