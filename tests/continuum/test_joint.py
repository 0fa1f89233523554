"""The tangent with what rods do to one another: one matrix until other nodes are linked, and right every time."""

from __future__ import annotations

from dataclasses import replace

from mpi4py import MPI

import numpy as np
import pytest

import dolfinrod as dr
from dolfinrod.continuum.discretization import Discretization
from dolfinrod.continuum.joint import Joint, JointLU
from dolfinrod.continuum.placement import Placement
from dolfinrod.continuum.problem import Problem
from dolfinrod.continuum.spatial import SpatialRods
from tests.continuum.test_pairs import RADIUS, stacked
from tests.scenes import FLAT, largest

WHOLE, PART = (0.0, 1.0), (0.0, 0.3)


def lying(friction: dr.Coulomb | None) -> Problem:
    """A rod on top of another, not pressed yet."""
    scene = stacked(FLAT)
    held = [dr.Clamp("start", rod=k) for k in (0, 1)]
    scene = replace(scene, supports=held, contacts=[replace(scene.contacts[1], friction=friction)])
    d = Discretization(MPI.COMM_WORLD, SpatialRods(), 3, (4, 4), rubbed=friction is not None)
    return Problem(scene, d, Placement.of(scene, dr.Spatial()))


def press(problem: Problem, part: tuple[float, float], by: float) -> None:
    """Let the upper rod lie by a part of the radius within the lower one, over a part of its length, else apart."""
    r = problem.discretization.dofs["r"].reshape(-1, 3)
    x = problem.x[r]
    over = (part[0] <= x[:, 0]) & (x[:, 0] <= part[1])
    x[:, 1] = np.where(x[:, 1] > RADIUS, (2.0 + np.where(over, -by, 0.5)) * RADIUS, x[:, 1])
    problem.x[r] = x
    problem.pairs.begin(1.0)
    problem.assemble_tangent(problem.discretization.matrix)


def off(problem: Problem, J, seed: int) -> float:
    """How far J u is from P u and what points answer, relative."""
    pairs, P, rng = problem.pairs, problem.discretization.matrix, np.random.default_rng(seed)
    u, found, known = P.createVecRight(), P.createVecLeft(), P.createVecLeft()
    u.array[:] = rng.standard_normal(len(u.array))
    J.mult(u, found)
    P.mult(u, known)
    mine = u.array[pairs.at]
    known.array[pairs.at] += pairs.links().times(mine) - np.einsum("nij,nj->ni", pairs.inside, mine)
    size, apart = (
        problem.discretization.comm.allreduce(largest(a), op=MPI.MAX) for a in (known.array, found.array - known.array)
    )
    return apart / size


@pytest.mark.parametrize("friction", [None, dr.Coulomb(0.4)], ids=["smooth", "rough"])
def test_a_pattern_serves_until_other_nodes_are_linked(friction):
    problem = lying(friction)
    joint, P = Joint(problem.pairs), problem.discretization.matrix
    press(problem, PART, 0.3)
    first = joint.filled(P)
    assert off(problem, first, 0) < 1e-12
    press(problem, WHOLE, 0.2)
    second = joint.filled(P)
    assert second is not first
    assert off(problem, second, 1) < 1e-12
    for part, by in ((PART, 0.3), (WHOLE, 0.1)):
        press(problem, part, by)
        assert joint.filled(P) is second
        assert off(problem, second, 2) < 1e-12
    joint.close()


@pytest.mark.parametrize("friction", [None, dr.Coulomb(0.4)], ids=["smooth", "rough"])
def test_factors_of_a_pattern_solve_with_the_values_of_the_day(friction):
    problem = lying(friction)
    solver, P = JointLU(problem.pairs), problem.discretization.matrix
    b, x, left = P.createVecLeft(), P.createVecRight(), P.createVecLeft()
    b.array[:] = np.random.default_rng(3).standard_normal(len(b.array))
    for by in (0.3, 0.1, 0.2):
        press(problem, WHOLE, by)
        solver.factorize(P)
        assert not solver.singular
        solver.apply(b, x)
        joint = Joint(problem.pairs)
        joint.filled(P).mult(x, left)
        left.axpy(-1.0, b)
        assert left.norm() < 1e-8 * b.norm()
        joint.close()
    solver.close()
