"""The answer does not depend on the number of ranks, nor on which rank owns what."""

from __future__ import annotations

from dataclasses import replace

from mpi4py import MPI

import numpy as np
import pytest

import dolfinrod as dr
from tests.scenes import GENERAL, KIRCHHOFF, SKEW, bend, both_kinematics, cantilever, differences, followed, tip_loaded


def both_communicators(scene: dr.Scene, **options: object) -> tuple[dr.Result, dr.Result]:
    """The same scene on all ranks together and on this rank alone."""
    return dr.solve(scene, comm=MPI.COMM_WORLD, **options), dr.solve(scene, comm=MPI.COMM_SELF, **options)


def assert_same(together: dr.Result, alone: dr.Result) -> None:
    """Equal to 1e-10, step by step, and equal to the last bit on every rank."""
    assert max(differences(together, alone).values()) <= 1e-10
    assert [(row.t, row.cuts) for row in together.log] == [(row.t, row.cuts) for row in alone.log]
    assert together.statistics.newton_iterations == alone.statistics.newton_iterations
    assert together.statistics.dofs == alone.statistics.dofs
    np.testing.assert_allclose(together.energy["strain"], alone.energy["strain"], rtol=1e-10, atol=1e-14)
    for rod in together.rods:
        mine = np.concatenate([getattr(rod, name).ravel() for name in ("s", "r", "frames", "n", "m", "gamma", "kappa")])
        np.testing.assert_array_equal(MPI.COMM_WORLD.bcast(mine), mine)


@both_kinematics
@pytest.mark.parametrize("section", [GENERAL, KIRCHHOFF], ids=["elastic", "rigid"])
@pytest.mark.parametrize("elements", [1, 2, 3, 8])
def test_elastica(elements, section, kinematics):
    """One element on two ranks: one of them owns no cell."""
    assert_same(*both_communicators(tip_loaded(section, 10.0), elements=elements, degree=3, kinematics=kinematics))


def test_bend():
    assert_same(*both_communicators(bend(600.0), elements=8, degree=3))


@both_kinematics
def test_follower_force(kinematics):
    assert_same(*both_communicators(followed(KIRCHHOFF, 10.0), elements=8, degree=3, kinematics=kinematics))


def test_all_kinds_of_loads_and_supports():
    dense = dr.Section(EA=900.0, GA=(400.0, 300.0), GJ=0.7, EI=(1.0, 2.0), rhoA=1.5)
    loads = [
        dr.PointForce((1.0, -2.0, 1.5), 0.5),
        dr.PointMoment((0.4, -0.3, 0.6), 0.25),
        dr.FollowerForce((0.4, 0.9, -0.3), 0.75),
        dr.FollowerMoment((0.3, -0.2, 0.4), "end"),
        dr.LineForce((0.3, 1.0, -0.5), between=(0.25, 0.75)),
        dr.Gravity((0, -1.0, -2.0)),
    ]
    supports = [
        dr.Clamp("start"),
        dr.Pin(0.6),
        dr.Prescribed("end", displacement=(None, 0.1, None), rotation=(0, 0.5, 1)),
    ]
    scene = dr.Scene([SKEW.arc(dense, angle=1.0)], supports, loads, motion=dr.Static(steps=3))
    assert_same(*both_communicators(scene, elements=8, degree=3))


@both_kinematics
@pytest.mark.parametrize("elements", [1, [3, 1, 2, 4]])
def test_several_rods(elements, kinematics):
    rods = [SKEW.straight(GENERAL, start=(0, 0.2 * i, 0), length=1.0 + 0.1 * i) for i in range(4)]
    loads = [dr.PointForce(SKEW.turned((0, 3.0 + i, 0)), "end", rod=i) for i in range(4)]
    scene = dr.Scene(rods, [dr.Clamp("start")], loads)
    assert_same(*both_communicators(scene, elements=elements, degree=3, kinematics=kinematics))


@both_kinematics
def test_start_and_halved_steps(kinematics):
    first = both_communicators(tip_loaded(GENERAL, 5.0), elements=4, degree=2, kinematics=kinematics)
    for result in first:
        # A result found on one communicator starts a solve on the other.
        other = both_communicators(tip_loaded(GENERAL, 8.0), elements=4, degree=2, kinematics=kinematics, start=result)
        assert_same(*other)
    twist = dr.Prescribed("end", rotation=SKEW.turned((0, 0, 4 * np.pi)))
    scene = replace(cantilever(SKEW.straight(GENERAL)), supports=[dr.Clamp("start"), twist])
    assert_same(*both_communicators(scene, elements=16, degree=3, kinematics=kinematics))


def test_every_rank_learns_of_a_failure():
    scene = dr.Scene([SKEW.straight(GENERAL)], [], [dr.FollowerMoment((0, 0, 1.0), "end")])
    with pytest.raises(dr.NotConverged) as caught:
        dr.solve(scene, comm=MPI.COMM_WORLD, elements=1, degree=2, kinematics=dr.Spatial())
    assert len(set(MPI.COMM_WORLD.allgather(caught.value.reason))) == 1


def test_ranks_may_solve_different_scenes_alone():
    """Nothing in a solve on one rank waits for the others."""
    mine = 5.0 + MPI.COMM_WORLD.rank
    result = dr.solve(tip_loaded(GENERAL, mine), comm=MPI.COMM_SELF, elements=4 + MPI.COMM_WORLD.rank, degree=3)
    assert result.converged
    for rank, r in enumerate(MPI.COMM_WORLD.allgather(result.tip)):
        again = dr.solve(tip_loaded(GENERAL, 5.0 + rank), comm=MPI.COMM_SELF, elements=4 + rank, degree=3)
        np.testing.assert_allclose(r, again.tip, rtol=0, atol=1e-12)
