"""Orders and errors of both models against the references."""

from __future__ import annotations

import pytest

from dolfinrod.scene import Planar, Spatial
from verification.case import SKEW
from verification.cases import CASES, bend45, elastica, follower, heavy, parabola, rollup
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


@pytest.mark.parametrize("case", [bend45.bend(600.0), parabola.bend()], ids=lambda case: case.name)
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
    [TEN, follower.inextensible(20.0), heavy.inextensible(50.0), bend45.bend(600.0, kirchhoff=True)],
    ids=lambda case: case.name,
)
def test_discrete_model_converges_with_order_two(case):
    found = study(case, Discrete(), (20, 40, 80))
    assert found.tip.observed == pytest.approx(2.0, abs=0.1)


def test_discrete_centreline_converges_with_order_two():
    assert study(rollup.rolled(1.0), Discrete(), (40, 80)).centreline.observed == pytest.approx(2.0, abs=0.1)


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
@pytest.mark.parametrize("model", [Continuum(4, Planar()), Continuum(4), Discrete()], ids=lambda model: model.name)
def test_every_case_is_solved_by_every_model_that_poses_it(model, case):
    if not model.applies_to(case):
        assert model.family not in case.models or not case.planar
        return
    elements, limit = (16 * case.turns, 1e-8) if model.family == "continuum" else (80, 5e-3)
    record = measure(case, model, elements, pose=SKEW)
    assert record.failure is None
    assert record.error < limit
