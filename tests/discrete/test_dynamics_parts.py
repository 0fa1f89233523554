"""Parts of the motion in time: damping, several rods, scenes that modes are asked of."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import discrete
from discrete.damping import Damping
from dolfinrod.result import Result
from dolfinrod.scene import Clamp, Dynamic, FollowerForce, PointForce, Rod, Scene, Section, Static
from tests.discrete.laws import N, moved, some_elements, some_state
from tests.scenes import FLAT, SKEW

HEAVY = Section(EA=900.0, GA=400.0, GJ=0.7, EI=(2.0, 1.0), rhoA=1.0, rhoI=(0.003, 0.002, 0.001))


def test_the_tangent_of_a_damped_step_agrees_with_central_differences():
    rng = np.random.default_rng(5)
    elements = some_elements(rng)
    damping = Damping(elements, [replace(HEAVY, damping=0.3)], paper_strain=False)
    law = damping.over(0.2, damping.strain(*some_state(rng)[:2]))
    state = some_state(rng)
    force, tangent = law.respond(*state)
    assert law.measure(*state)[0] == pytest.approx(force, abs=1e-11)
    for k, unit in enumerate(np.eye(13)):
        d = np.tile(1e-6 * unit, (N, 1))
        slope = (law.respond(*moved(*state, d))[0] - law.respond(*moved(*state, -d))[0]) / 2e-6
        assert tangent[:, :, k] == pytest.approx(slope, abs=1e-6)


def test_damped_forces_are_those_of_stiffness_and_of_its_rate():
    """k (Δ₁ + τ (Δ₁ − Δ₀)/Δt): nothing moves, nothing resists; F_n as Eq. 16 has it then."""
    rng = np.random.default_rng(6)
    elements = some_elements(rng)
    damping = Damping(elements, [replace(HEAVY, damping=0.3)], paper_strain=False)
    e, E, _ = some_state(rng)
    rest = damping.strain(e, E)
    F_n = rest.ε / elements.compliance
    still = damping.over(0.2, rest).measure(e, E, F_n)[0]
    assert still == pytest.approx(damping.elastic_force(e, E, rest), abs=1e-12)
    assert still[:, 6] == pytest.approx(0.0, abs=1e-12)
    begun = replace(rest, θ=0 * rest.θ, ε=0 * rest.ε)
    rushed = damping.over(0.2, begun).measure(e, E, (1 + 0.3 / 0.2) * F_n)[0]
    assert rushed == pytest.approx((1 + 0.3 / 0.2) * damping.elastic_force(e, E, rest), abs=1e-11)
    assert damping.lost(begun, rest, 0.2) == pytest.approx(2 * 0.3 / 0.2 * damping.energy(rest))


def test_rods_that_do_not_meet_move_as_if_alone():
    rods = [FLAT.straight(HEAVY), SKEW.straight(replace(HEAVY, rhoA=2.0), length=0.7)]
    loads = [PointForce((0.2, 1.0, -0.5), "end"), FollowerForce((0, 0.3, 0.1), 0.35)]
    motion, n = Dynamic(0.2, 0.02), [5, 7]
    both = discrete.solve(Scene(rods, [Clamp("start")], loads, motion=motion), elements=n)
    for k, rod in enumerate(rods):
        alone = discrete.solve(Scene([rod], [Clamp("start")], loads, motion=motion), elements=n[k])
        assert both.rods[k].r == pytest.approx(alone.rods[0].r, abs=1e-9)
        assert both.rods[k].omega == pytest.approx(alone.rods[0].omega, abs=1e-6)


def test_modes_of_a_scene_that_moves_are_those_under_its_steady_loads():
    taut = Scene([FLAT.straight(HEAVY)], [Clamp("start")], [PointForce((10.0, 0, 0), "end")], motion=Dynamic(0.1, 0.1))
    still = replace(taut, motion=Static())
    moving = discrete.modes(taut, elements=10)
    assert moving.omega == pytest.approx(discrete.modes(still, at=discrete.solve(still, elements=10)).omega, rel=1e-6)


def test_a_motion_is_written_and_read_back(tmp_path):
    rod = Rod.straight(1.0, HEAVY, start=(0, 0, 0), direction=(1, 0, 0))
    scene = Scene([rod], [Clamp("start")], [PointForce((0, 1.0, 0), "end")], motion=Dynamic(0.2, 0.02))
    result = discrete.solve(scene, elements=4)
    result.write(tmp_path)
    again = Result.load(tmp_path)
    assert (again.rods[0].v == result.rods[0].v).all()
    assert (again.state["omega"] == result.state["omega"]).all()
    longer = replace(scene, motion=Dynamic(0.3, 0.02))
    assert discrete.solve(longer, elements=4, start=again).t[0] == 0.0


def test_factors_outlast_steps_while_they_serve():
    """Small steps need one factorisation for hundreds, large ones about one each; none costs an iteration more."""
    fibre = Rod.straight(0.04, Section.ramie(), start=(0, 0, 0), direction=(1, 0, 0))
    load = PointForce((0, 1e-7, 0), "end")
    counts = {}
    for dt in (1e-6, 1e-3):
        scene = Scene([fibre], [Clamp("start")], [load], motion=Dynamic(60 * dt, dt, output=60 * dt))
        counts[dt] = discrete.solve(scene, elements=20).statistics
    assert counts[1e-6].factorizations == 1
    assert counts[1e-6].newton_iterations <= 2.1 * 60
    assert counts[1e-3].newton_iterations <= 4 * 60
