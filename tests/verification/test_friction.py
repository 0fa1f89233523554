"""What slides, sticks, rolls and rebounds on rough walls: closed forms, the shared law alone, and both models."""

from __future__ import annotations

from dataclasses import replace
from math import atan, cos, pi, radians, sin

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from dolfinrod.scene import Contact, Coulomb, CreepingCoulomb, Penalty, Plane, Static, Touch
from verification.contacts import friction, impacts, rolling
from verification.contacts.bodies import BLOCKS, block, way
from verification.contacts.runs import DISCRETE, PLANE
from verification.references.friction import (
    Bounce,
    Incline,
    Slide,
    creep,
    friction_angle,
    moved_wall,
    restitution,
    swing_time,
    wedge,
)

pytestmark = pytest.mark.serial

frictions = st.floats(0.05, 1.5)
EULERS = pytest.mark.parametrize("stepper", [BLOCKS[0], BLOCKS[2]], ids=["continuum", "discrete"])
CASES = {case.name: case for case in (*friction.CASES, *rolling.CASES, *impacts.CASES)}


# Lv and Lvb of shared/reference: textbook.
def test_inclines_do_what_the_references_say():
    steep, flat = Incline(radians(30.0), 0.2), Incline(radians(20.0), 0.5)
    assert (steep.block, steep.cylinder, steep.spin) == pytest.approx((3.2058581577749314, 3.27, 3.27), rel=1e-14)
    assert (flat.block, flat.cylinder) == pytest.approx((0.0, 2.2368117373498735), rel=1e-14)
    assert Slide(1.0, 0.3).stops == pytest.approx((0.3397893306150187, 0.16989466530750935), rel=1e-14)
    assert Slide(1.0, 0.3).rolls == pytest.approx((0.11326311020500625, 0.09438592517083853, 2.0 / 3.0), rel=1e-14)
    # peers.md, P7b; 5e-6 from the closed form.
    assert Slide(1.0, 0.3).cylinder(1.0) == pytest.approx(0.685539, abs=6e-6)


# process.md 6.8 and Liv of shared/reference.
def test_grooves_and_walls_do_what_process_md_says():
    fibre = 4.83805e-7
    assert Incline(pi / 4.0, 0.64, 0.01 / fibre).block == pytest.approx(5262.0, abs=0.5)
    assert 2.0 * pi / swing_time(1e-6, 0.49e-3, 0.01 / fibre) == pytest.approx(6495.0, abs=0.5)
    assert moved_wall(0.17157, 0.64, 0.01, fibre)[0] == pytest.approx(13e-6, rel=3e-3)
    assert Bounce(1.0, fibre, 2e4).depth == pytest.approx(4.92e-6, rel=1e-3)
    assert Bounce(1.0, fibre, 2e4).time == pytest.approx(15.45e-6, rel=1e-3)
    assert wedge(2.5, 30.0, 0.1) == pytest.approx((2.5, 0.5))


@given(mu=frictions)
def test_rollers_slip_where_friction_is_too_weak(mu):
    edge = atan(3.0 * mu)
    below, above = Incline(edge * (1 - 1e-9), mu), Incline(min(edge * (1 + 1e-9), pi / 2), mu)
    assert below.cylinder == pytest.approx(above.cylinder, rel=1e-6)
    assert below.spin == pytest.approx(above.spin, rel=1e-6)


@settings(max_examples=20)
@given(ratio=st.floats(0.01, 5.0) | st.just(1.0))
def test_restitution_is_that_of_a_spring_and_a_dashpot_that_never_pull(ratio):
    """Integrated until their force 2 ζ ẋ + x is zero again."""

    def force(_t: float, y: np.ndarray) -> float:
        return float(2.0 * ratio * y[1] + y[0])

    force.terminal, force.direction = True, -1.0
    path = solve_ivp(
        lambda t, y: (y[1], -force(t, y)),
        (0.0, 100.0),
        (0.0, 1.0),
        events=force,
        method="DOP853",
        rtol=1e-11,
        atol=1e-13,
    )
    assert -path.y_events[0][0, 1] == pytest.approx(restitution(ratio), rel=1e-8)


def test_an_impact_that_ends_its_sliding_is_refused():
    with pytest.raises(ValueError, match="to slide on"):
        Bounce(1.0, 1.0, 1e4).slides(0.3, 1.0)


def one_point(law_friction, x: float) -> Touch:
    """A point pressed 1e-6 m into a plane, its forces at the end of steps."""
    touch = Touch(Contact(Plane((0, 0, 0), (0, 1, 0)), Penalty(1e6), law_friction), np.array([0.01]), Static())
    touch.place(np.array([[x, 0.01 - 1e-6, 0.0]]), 0.0)
    return touch


@settings(max_examples=20)
@given(mu=frictions, part=st.floats(0.01, 0.99))
def test_a_point_that_sticks_never_creeps(mu, part):
    """Pulled to and fro below the limit, its anchor stays: slip is zero to the last digit."""
    touch, reach = one_point(Coulomb(mu), 0.0), mu * 1e-6
    for step in range(1, 20):
        touch.begin(0.01 * step)
        touch.respond(np.array([[(-1) ** step * part * reach, 0.01 - 1e-6, 0.0]]), np.zeros((1, 3)))
        touch.accept()
    assert touch.memory()["slip"][0] == 0.0


@given(mu=frictions, part=st.floats(0.1, 0.9))
def test_the_literal_rule_creeps_at_its_speed(mu, part):
    """At the closed form's speed friction is in balance with the load."""
    v_0, N = 1e-3, 1.0
    v = creep(v_0, mu, N, part * mu * N)
    touch = one_point(CreepingCoulomb(mu, v_0), 0.0)
    touch.begin(0.01)
    reply = touch.respond(np.array([[0.01 * v, 0.01 - 1e-6, 0.0]]), np.zeros((1, 3)))
    assert -reply.traction[0, 0] == pytest.approx(part * mu * N, rel=1e-9)


@pytest.mark.parametrize(("model", "elements"), [(PLANE, 2), (DISCRETE, 4)], ids=["continuum", "discrete"])
@pytest.mark.parametrize("degrees", [0.0, 20.0, None])
def test_threshold_slope_is_that_of_friction(model, elements, degrees):
    phi = friction_angle(0.64) if degrees is None else radians(degrees)
    found = friction.slope_found(model.solve(friction.pushed(phi, 0.64), elements), phi)
    assert found == pytest.approx(np.full(2, 0.64), abs=1e-9)


@EULERS
@pytest.mark.parametrize("beyond", [-1e-6, 1e-6])
def test_a_block_gains_speed_beyond_the_threshold_only(stepper, beyond):
    """Let go at once, its anchors overshoot and it slips: it gains speed then, or loses it, by a millionth."""
    phi, t = friction_angle(0.5) * (1.0 + beyond), 0.05
    result = stepper.solve(block(stepper.motion(t, 50, (0.5 * t, t)), phi=phi, friction=Coulomb(0.5)))
    _, v = way(result, phi)
    expected = 9.81 * (sin(phi) - 0.5 * cos(phi)) * 0.5 * t
    assert np.sign(expected) == np.sign(beyond)
    assert v[-1] - v[-2] == pytest.approx(expected, abs=0.05 * abs(expected))


@EULERS
def test_what_has_settled_slips_no_more(stepper):
    """C10: slip is the same number at every later time; the paper's literal rule creeps beside it."""
    scene = block(stepper.motion(1e-2, 50, (0.0, 5e-3, 1e-2)), phi=radians(15.0), friction=Coulomb(0.64))
    found = stepper.solve(scene).contacts[0].rods[0]
    assert np.array_equal(found.slip[1], found.slip[2])
    literal = replace(scene, contacts=[replace(scene.contacts[0], friction=CreepingCoulomb(0.64, 1e-3))])
    s, v = way(stepper.solve(literal), radians(15.0))
    assert s[-1] > s[1] > 0.0
    assert v[-1] == pytest.approx(creep(1e-3, 0.64, cos(radians(15.0)), sin(radians(15.0))), rel=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["impact-drop", "impact-oblique"])
def test_restitution_tends_to_one_with_the_order_of_the_scheme(name):
    case = CASES[name]
    for run in case.runs:
        coarse, fine = (case.error(run.solve(level)) for level in run.levels[:2])
        assert np.log2(coarse / fine) > (1.8 if "midpoint" in run.label else 0.85)


@pytest.mark.slow
def test_rebound_from_a_rough_cylinder_gains_no_energy():
    case = CASES["impact-cylinder"]
    for run in case.runs:
        assert case.error(run.solve(run.levels[0])) < 1e-9


@pytest.mark.slow
@pytest.mark.parametrize("name", [n for n in CASES if n.startswith("friction-") and "threshold" not in n])
def test_cases_come_within_their_limits(name):
    """On their last levels; those with an order as well."""
    case = CASES[name]
    for run in case.runs:
        error = case.error(run.solve(run.levels[-1]))
        assert run.limit is None or error <= run.limit, (run.label, error)
