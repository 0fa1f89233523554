"""Orders and errors of both models against the references."""

from __future__ import annotations

import pytest

from dolfinrod.scene import Planar, Spatial
from verification.case import SKEW
from verification.cases import (
    CASES,
    bar,
    bend45,
    cable,
    elastica,
    follower,
    heavy,
    helix,
    parabola,
    postbuckling,
    rollup,
    spring,
)
from verification.models import Continuum, Discrete
from verification.workprecision import measure, study

pytestmark = pytest.mark.serial

BOTH = (Planar(), Spatial())
NAMES = ("planar", "spatial")
TEN = elastica.inextensible(10.0)
# By how much an order may be off on meshes on which the tip has not yet reached round-off.
NEAR = {1: 0.1, 2: 0.2, 3: 0.25, 4: 0.3}


@pytest.mark.parametrize("kinematics", BOTH, ids=NAMES)
@pytest.mark.parametrize("degree", [1, 2, 3, 4])
def test_tip_of_the_elastica_converges_with_twice_the_degree(degree, kinematics):
    found = study(TEN, Continuum(degree, kinematics), (8, 16, 32) if degree < 4 else (4, 8, 16))
    assert found.tip.observed == pytest.approx(2 * degree, abs=NEAR[degree])


@pytest.mark.parametrize("kinematics", BOTH, ids=NAMES)
@pytest.mark.parametrize("case", [TEN, rollup.rolled(1.0)], ids=lambda case: case.name)
@pytest.mark.parametrize("degree", [1, 2, 3, 4])
def test_centreline_converges_in_l2_with_the_degree_plus_one(degree, case, kinematics):
    found = study(case, Continuum(degree, kinematics), (16, 32))
    assert found.centreline.observed == pytest.approx(degree + 1, abs=0.15)


@pytest.mark.parametrize(
    "case",
    [bend45.bend(600.0), bend45.st_venant(600.0), parabola.bend(), spring.coiled(20.0, -1.0)],
    ids=lambda case: case.name,
)
@pytest.mark.parametrize("degree", [1, 2, 3, 4])
def test_tip_of_the_bend_converges_with_twice_the_degree(degree, case):
    found = study(case, Continuum(degree), (8, 16) if degree < 4 else (4, 8))
    assert found.tip.observed == pytest.approx(2 * degree, abs=NEAR[degree])


@pytest.mark.parametrize("kinematics", BOTH, ids=NAMES)
@pytest.mark.parametrize(
    "case",
    [follower.inextensible(20.0), follower.shearable(50e3), heavy.inextensible(20.0), heavy.shearable(20.0)],
    ids=lambda case: case.name,
)
@pytest.mark.parametrize("degree", [1, 2, 3, 4])
def test_turning_and_distributed_forces_keep_the_order(degree, case, kinematics):
    found = study(case, Continuum(degree, kinematics), (16, 32) if degree < 4 else (8, 16))
    assert found.tip.observed == pytest.approx(2 * degree, abs=NEAR[degree])


@pytest.mark.parametrize("degree", [1, 2, 3])
def test_tip_of_the_helix_converges_with_twice_the_degree(degree):
    """Degree 4 is at the last digit of the reference, 2e-13, before it shows an order."""
    found = study(helix.wound(0.05), Continuum(degree), (8, 16, 32) if degree < 3 else (4, 8, 16))
    assert found.tip.observed == pytest.approx(2 * degree, abs=NEAR[degree])


@pytest.mark.parametrize("case", [cable.hung(1e-2), cable.hung(1e-2, 20.0, level=True)], ids=lambda case: case.name)
@pytest.mark.parametrize("degree", [1, 2, 3])
def test_end_of_the_cable_converges_with_twice_the_degree(degree, case):
    found = study(case, Continuum(degree, Planar()), (4, 8, 16))
    assert found.tip.observed == pytest.approx(2 * degree, abs=NEAR[degree])


@pytest.mark.parametrize("degree", [1, 2])
def test_middle_of_the_spanning_cable_converges_with_twice_the_degree(degree):
    found = study(cable.spanning(1e-3), Continuum(degree, Planar()), (16, 32, 64))
    assert found.tip.observed == pytest.approx(2 * degree, abs=NEAR[degree])


@pytest.mark.parametrize("degree", [1, 2, 3, 4])
def test_uniform_twist_and_bending_gain_two_orders(degree):
    """Of uniform strain the error of two orders vanishes: 2k + 2, in space for twist, in the plane for bending."""
    twisted = study(bar.twisted(2.65, force=20.0, weight=30.0), Continuum(degree), (16, 32) if degree < 4 else (8, 16))
    assert twisted.tip.observed == pytest.approx(2 * degree + 2, abs=0.1)
    if degree < 3:
        bent = study(rollup.rolled(0.25), Continuum(degree, Planar()), (2, 4, 8))
        assert bent.tip.observed == pytest.approx(2 * degree + 2, abs=0.1)


@pytest.mark.parametrize("kinematics", BOTH, ids=NAMES)
@pytest.mark.parametrize(
    "case",
    [follower.inextensible(20.0), heavy.inextensible(20.0), heavy.shearable(20.0)],
    ids=lambda case: case.name,
)
def test_their_centreline_converges_in_l2_with_the_degree_plus_one(case, kinematics):
    assert study(case, Continuum(3, kinematics), (8, 16)).centreline.observed == pytest.approx(4.0, abs=0.15)


@pytest.mark.parametrize(
    "case",
    [
        TEN,
        follower.inextensible(20.0),
        heavy.inextensible(50.0),
        bend45.bend(600.0, kirchhoff=True),
        rollup.rolled(0.25),
        helix.wound(0.05, kirchhoff=True),
        helix.wound(0.1, kirchhoff=True),
        spring.coiled(20.0, -1.0, shear=False),
        cable.hung(1e-4, 20.0),
        cable.hung(1e-2, 20.0, level=True),
        cable.spanning(1e-4),
    ],
    ids=lambda case: case.name,
)
def test_discrete_model_converges_with_order_two(case):
    found = study(case, Discrete(), (20, 40, 80))
    assert found.tip.observed == pytest.approx(2.0, abs=0.1)


def test_discrete_centreline_converges_with_order_two():
    assert study(rollup.rolled(1.0), Discrete(), (40, 80)).centreline.observed == pytest.approx(2.0, abs=0.1)


def marked(case):
    """Ten turns in space on 16 elements a turn take too long for every run."""
    return pytest.param(case, id=case.name, marks=[pytest.mark.slow] if case.turns > 5 else [])


@pytest.mark.parametrize("case", map(marked, CASES))
@pytest.mark.parametrize("model", [Continuum(4, Planar()), Continuum(4), Discrete()], ids=lambda model: model.name)
def test_every_case_is_solved_by_every_model_that_poses_it(model, case):
    if not model.applies_to(case):
        assert model.family not in case.models or not case.planar
        return
    elements, limit = (16 * case.turns, 1e-8) if model.family == "continuum" else (80, 5e-3)
    if case.note == postbuckling.STAND_IN:
        limit = max(limit, 1e-7)
    record = measure(case, model, elements, pose=SKEW)
    assert record.failure is None
    assert record.error < limit
