"""How a solve starts, what it refuses, what it keeps when it fails and what its record tells."""

from __future__ import annotations

import numpy as np
import pytest

import discrete
import dolfinrod as dr
from tests.scenes import GENERAL, KIRCHHOFF, SKEW, both_kinematics, cantilever, differences, rolled_up, tip_loaded

MESH = {"elements": 8, "degree": 3}


@both_kinematics
def test_a_solve_may_start_where_another_ended(kinematics):
    options = {"kinematics": kinematics, **MESH}
    there = dr.solve(tip_loaded(GENERAL, 10.0), **options)
    near = dr.solve(tip_loaded(GENERAL, 10.1), start=there, **options)
    far = dr.solve(tip_loaded(GENERAL, 10.1), **options)
    assert near.statistics.newton_iterations < far.statistics.newton_iterations
    assert max(differences(near, far).values()) <= 1e-10
    np.testing.assert_array_equal(near.rods[0].r[0], there.rods[0].r[-1])


def test_a_start_is_read_in_its_own_directions_and_units():
    """The flat scene is solved in the directions of its plane, the pushed one in those of space, with other units."""
    options = {"kinematics": dr.Spatial(), **MESH}
    there = dr.solve(tip_loaded(GENERAL, 10.0), **options)
    twice = dr.Section(**{name: 2.0 * np.asarray(getattr(GENERAL, name)) for name in ("EA", "GA", "GJ", "EI")})
    flat = tip_loaded(GENERAL, 10.0).loads[0]
    pushed = dr.PointForce(2.02 * np.asarray(flat.force) + 0.02 * np.asarray(SKEW.turned((0, 0, 1.0))), "end")
    scene = cantilever(SKEW.straight(twice), pushed)
    near, far = dr.solve(scene, start=there, **options), dr.solve(scene, **options)
    assert near.statistics.newton_iterations < far.statistics.newton_iterations
    np.testing.assert_allclose(near.rods[0].r[0], there.rods[0].r[-1], rtol=0, atol=1e-14)
    assert np.abs(near.rods[0].r[-1] - far.rods[0].r[-1]).max() <= 1e-10


def test_a_start_on_other_elements_is_refused():
    there = dr.solve(tip_loaded(GENERAL, 1.0), elements=4, degree=2)
    for options in (
        {"elements": 5, "degree": 2},
        {"elements": 4, "degree": 3},
        {"kinematics": dr.Spatial(), "elements": 4, "degree": 2},
    ):
        with pytest.raises(dr.SceneError, match="start must be a result on the same elements, degree and kinematics"):
            dr.solve(tip_loaded(GENERAL, 1.0), start=there, **options)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"elements": 0}, "elements must be a whole number of at least 1, got 0"),
        ({"elements": [4, 4]}, "one for each of the 1 rods"),
        ({"elements": 2.5}, "elements must"),
        ({"degree": 0}, "degree must be 1, 2, 3, 4 or 5, got 0"),
        ({"degree": 6}, "degree must be 1, 2, 3, 4 or 5, got 6"),
    ],
)
def test_options_that_cannot_be(options, words):
    with pytest.raises(dr.SceneError, match=words):
        dr.solve(tip_loaded(GENERAL, 1.0), **options)


def test_more_places_than_elements_are_refused():
    loads = [dr.PointForce((0, 1, 0), s) for s in (0.3, 0.5, 0.7)]
    with pytest.raises(dr.SceneError, match=r"elements must be more than 3: rods\[0\]"):
        dr.solve(cantilever(SKEW.straight(GENERAL), *loads), elements=3)


@both_kinematics
def test_nothing_holds_the_rod(kinematics):
    scene = dr.Scene([SKEW.straight(GENERAL)], [], [dr.FollowerMoment((0, 0, 1.0), "end")])
    with pytest.raises(dr.NotConverged, match=r"push a rod along a motion.*rods\[0\] is held nowhere") as caught:
        dr.solve(scene, kinematics=kinematics, elements=2, degree=2)
    failure = caught.value
    assert failure.t == 0.0
    assert not failure.result.converged
    np.testing.assert_array_equal(failure.result.t, [0.0])


CHORD = 2 / np.pi


def pulled_arc() -> dr.Scene:
    """Half a circle of an inextensible rod of length 1, its ends pulled apart to 1.2."""
    pull = dr.Prescribed("end", displacement=SKEW.turned((0, 1.2 - CHORD, 0)))
    return dr.Scene([SKEW.arc(KIRCHHOFF, radius=1 / np.pi, angle=np.pi)], [dr.Clamp("start"), pull])


@both_kinematics
def test_beyond_the_last_equilibrium_nothing_that_converged_is_lost(kinematics):
    seen = []
    with pytest.raises(dr.NotConverged) as caught:
        dr.solve(pulled_arc(), kinematics=kinematics, elements=4, degree=2, progress=lambda row, _: seen.append(row))
    failure, result = caught.value, caught.value.result
    straight = (1 - CHORD) / (1.2 - CHORD)
    # Four elements that turn at the clamp do not quite reach a straight line; steps below 1/4096 are not tried.
    assert straight - 0.1 < failure.t < straight
    assert 1e-4 < failure.step < 0.01
    assert failure.reason
    assert failure.advice
    assert not result.converged
    assert result.t[-1] == failure.t
    assert result.log == tuple(seen)
    assert result.statistics.load_steps == len(result.log) == len(result.t) - 1
    assert result.statistics.newton_iterations > sum(row.iterations for row in result.log)
    chord = CHORD + failure.t * (1.2 - CHORD)
    assert np.linalg.norm(result.tip - result.rods[0].r[-1, 0]) == pytest.approx(chord, abs=1e-12)


@both_kinematics
def test_the_record_tells_what_was_solved(kinematics):
    result = dr.solve(rolled_up(GENERAL, 0.5), kinematics=kinematics, **MESH)
    rod = result.rods[0]
    assert result.scene == rolled_up(GENERAL, 0.5)
    assert rod.s.shape == (25,)
    assert rod.r.shape == rod.n.shape == rod.m.shape == rod.gamma.shape == rod.kappa.shape == (2, 25, 3)
    assert rod.frames.shape == (2, 25, 3, 3)
    np.testing.assert_allclose(
        np.einsum("tsij,tsik->tsjk", rod.frames, rod.frames), np.tile(np.eye(3), (2, 25, 1, 1)), atol=1e-14
    )
    np.testing.assert_allclose(rod.n[-1], rod.gamma[-1] * [900.0, 400.0, 300.0], atol=1e-12)
    np.testing.assert_allclose(rod.m[-1], rod.kappa[-1] * [0.7, 1.0, 2.0], atol=1e-12)
    assert result.formulation.model == "continuum"
    assert sum(result.formulation.unknowns.values()) == result.statistics.dofs
    assert result.statistics.factorizations == result.statistics.newton_iterations


def arch() -> dr.Scene:
    """Shallow, between hinges, pressed down at its middle beyond what it bears."""
    section = dr.Section(EA=1e4, GJ=1.0, EI=1.0, rigid={"shear"})
    along, up = (np.cos(0.25), np.sin(0.25), 0.0), (np.sin(0.25), -np.cos(0.25), 0.0)
    rod = dr.Rod.arc(radius=2.0, angle=0.5, section=section, direction=along, towards=up)
    hinges = [dr.Guide("start", free={"rz"}), dr.Guide("end", free={"rz"})]
    return dr.Scene([rod], hinges, [dr.PointForce((0.0, -20.0, 0.0), at=0.5)])


@pytest.mark.slow
def test_a_limit_load_is_named_as_the_cause():
    """Both models give up where the load has its maximum, and say where that is."""
    critical = []
    for solve, mesh in ((dr.solve, {"elements": 16}), (discrete.solve, {"elements": 80})):
        with pytest.raises(
            dr.NotConverged, match="Likely a critical point was passed: the loads are critical at"
        ) as it:
            solve(arch(), **mesh)
        critical.append(float(it.value.advice.split("critical at t = ")[1].split(",")[0]))
        assert it.value.t <= critical[-1] <= 1.01 * it.value.t
    assert critical[0] == pytest.approx(critical[1], rel=1e-3)
