"""What the supports give back balances all loads, at the deformed shape."""

from __future__ import annotations

import numpy as np
import pytest

import dolfinrod as dr
from tests.scenes import GENERAL, KIRCHHOFF, SKEW, both_kinematics, cantilever, orders, rolled_up

DENSE = dr.Section(EA=900.0, GA=(400.0, 300.0), GJ=0.7, EI=(1.0, 2.0), rhoA=1.5)
MOMENT = (0.4, -0.3, 0.6)


def resultants_at(rod: dr.RodHistory, node: int) -> tuple[np.ndarray, np.ndarray]:
    """Force and moment in space that the section at a node transmits from the part beyond it."""
    frame = rod.frames[-1, node]
    return frame @ rod.n[-1, node], frame @ rod.m[-1, node]


def load_on(result: dr.Result, about: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Force and moment about a point of all loads of a scene with one rod, at its deformed shape."""
    rod, force, moment = result.rods[0], np.zeros(3), np.zeros(3)
    for load in result.scene.loads:
        if isinstance(load, dr.Gravity | dr.LineForce):
            per_length, arms = distributed(load, result)
            force += per_length.sum(axis=0)
            moment += np.cross(arms - about, per_length).sum(axis=0)
            continue
        ((_, s),) = result.scene.location(load.at, load.rod)
        node = int(np.argmin(np.abs(rod.s - s)))
        turn = rod.frames[-1, node] if isinstance(load, dr.FollowerForce | dr.FollowerMoment) else np.eye(3)
        if isinstance(load, dr.PointForce | dr.FollowerForce):
            F = turn @ load.force
            force += F
            moment += np.cross(rod.r[-1, node] - about, F)
        else:
            moment += turn @ load.moment
    return force, moment


def distributed(load: dr.Gravity | dr.LineForce, result: dr.Result, degree: int = 3) -> tuple[np.ndarray, np.ndarray]:
    """A line load lumped to the nodes by Simpson's rule for cubics, exact for what is integrated; and the nodes."""
    rod = result.rods[0]
    ends = rod.s[::degree]
    inside = np.ones(len(ends) - 1)
    if isinstance(load, dr.LineForce) and load.between is not None:
        inside = (ends[:-1] >= load.between[0] - 1e-9) & (ends[1:] <= load.between[1] + 1e-9)
    density = DENSE.rhoA * np.array(load.g) if isinstance(load, dr.Gravity) else np.array(load.force)
    # Weights of the Gauss-Lobatto rule on the four nodes of a cubic.
    weights = np.array([1, 5, 5, 1]) / 12
    lumped = np.zeros(len(rod.s))
    for cell, length in enumerate(np.diff(ends)):
        lumped[cell * degree : cell * degree + degree + 1] += inside[cell] * length * weights
    return lumped[:, None] * density, rod.r[-1]


def everything() -> dr.Scene:
    """All kinds of loads at once on a curved rod."""
    return cantilever(
        SKEW.arc(DENSE, radius=0.8, angle=1.25),
        dr.PointForce(SKEW.turned((1.0, -2.0, 1.5)), "end"),
        dr.PointForce(SKEW.turned((-1.0, 1.0, 3.0)), 0.5),
        dr.PointMoment(SKEW.turned(MOMENT), 0.25),
        dr.FollowerForce((0.4, 0.9, -0.3), 0.75),
        dr.FollowerMoment((0.3, -0.2, 0.4), "end"),
        dr.LineForce(SKEW.turned((0.3, 1.0, -0.5)), between=(0.25, 0.75)),
        dr.Gravity(SKEW.turned((0, -1.0, -2.0))),
    )


def flat() -> dr.Scene:
    """The same in a plane."""
    return cantilever(
        SKEW.arc(DENSE, radius=0.8, angle=1.25),
        dr.PointForce(SKEW.turned((1.0, -2.0, 0)), "end"),
        dr.PointForce(SKEW.turned((-1.0, 1.0, 0)), 0.5),
        dr.PointMoment(SKEW.turned((0, 0, 0.6)), 0.25),
        dr.FollowerForce((0.4, 0.9, 0), 0.75),
        dr.FollowerMoment((0, 0, 0.4), "end"),
        dr.LineForce(SKEW.turned((0.3, 1.0, 0)), between=(0.25, 0.75)),
        dr.Gravity(SKEW.turned((0, -1.0, 0))),
    )


SCENES = [
    pytest.param(flat(), dr.Planar(), id="planar"),
    pytest.param(flat(), dr.Spatial(), id="planar scene in space"),
    pytest.param(everything(), dr.Spatial(), id="spatial"),
]


@pytest.mark.parametrize(("scene", "kinematics"), SCENES)
def test_forces_balance(scene, kinematics):
    result = dr.solve(scene, elements=8, degree=3, kinematics=kinematics)
    force, _ = load_on(result, result.rods[0].r[-1, 0])
    np.testing.assert_allclose(resultants_at(result.rods[0], 0)[0], force, rtol=0, atol=1e-10 * np.linalg.norm(force))


@pytest.mark.parametrize(("scene", "kinematics"), SCENES)
def test_moments_balance(scene, kinematics):
    result = dr.solve(scene, elements=8, degree=3, kinematics=kinematics)
    rod = result.rods[0]
    _, moment = load_on(result, rod.r[-1, 0])
    np.testing.assert_allclose(resultants_at(rod, 0)[1], moment, rtol=0, atol=1e-10 * np.linalg.norm(moment))


@both_kinematics
@pytest.mark.parametrize(("degree", "elements"), [(1, (16, 32, 64)), (2, (8, 16, 32)), (3, (8, 16, 32))])
def test_the_moment_at_the_clamp_is_as_accurate_as_the_tip(degree, elements, kinematics):
    """Elastica P L²/EI = 10: M(0) L/EI = 4.450044022462487 (reference A1, elliptic integrals)."""
    scene = cantilever(SKEW.straight(KIRCHHOFF), dr.PointForce(SKEW.turned((0, 10.0, 0)), "end"))
    errors = []
    for n in elements:
        rod = dr.solve(scene, elements=n, degree=degree, kinematics=kinematics).rods[0]
        errors.append(abs(rod.m[-1, 0, 2] - 4.450044022462487))
        assert np.abs(rod.m[-1, -1]).max() <= 1e-10
    assert orders(elements, errors).min() >= 2 * degree - 0.3


@both_kinematics
def test_reactions_of_two_clamps_balance_the_load(kinematics):
    F = np.array(SKEW.turned((1.0, -30.0, 0)))
    supports = [dr.Clamp("start"), dr.Clamp("end")]
    scene = dr.Scene([SKEW.straight(GENERAL)], supports, [dr.PointForce(F, 0.25)])
    rod = dr.solve(scene, elements=8, degree=3, kinematics=kinematics).rods[0]
    left, right = resultants_at(rod, 0)[0], -resultants_at(rod, -1)[0]
    np.testing.assert_allclose(left - F, -right, rtol=0, atol=1e-10 * 30)


@both_kinematics
@pytest.mark.parametrize("force", [1.0, 40.0])
def test_the_force_jumps_by_the_load_at_its_section(force, kinematics):
    F = np.array(SKEW.turned((force / 2, force, 0)))
    scene = cantilever(SKEW.straight(GENERAL), dr.PointForce(F, 0.5), dr.PointForce(-F / 3, "end"))
    rod = dr.solve(scene, elements=8, degree=3, kinematics=kinematics).rods[0]
    before, after = (
        np.einsum("sij,sj->si", rod.frames[-1, part], rod.n[-1, part]) for part in (rod.s < 0.49, rod.s > 0.51)
    )
    np.testing.assert_allclose(before, [2 * F / 3] * len(before), rtol=0, atol=1e-10 * force)
    np.testing.assert_allclose(after, [-F / 3] * len(after), rtol=0, atol=1e-10 * force)


@both_kinematics
def test_strain_energy_is_the_work_of_a_dead_load(kinematics):
    """Along a conservative path dU = F·dr: Gauss's rule over the load against the ledger."""
    x, w = np.polynomial.legendre.leggauss(8)
    levels = (x + 1) / 2
    F = np.array(SKEW.turned((0, 4.0, 0)))
    table = [(0.0, 0.0), *zip(levels, levels, strict=True), (1.0, 1.0)]
    scene = cantilever(SKEW.straight(GENERAL), dr.PointForce(F, "end", history=table))
    result = dr.solve(scene, elements=8, degree=3, kinematics=kinematics)
    np.testing.assert_allclose(result.t[1:-1], levels)
    moved = (result.rods[0].r[:, -1] - result.rods[0].r[0, -1]) @ F
    # ∫ F·dr = F·r at the full load less ∫ r·dF over the load factor.
    work = moved[-1] - w @ moved[1:-1] / 2
    assert result.energy["strain"][-1] == pytest.approx(work, rel=1e-7)


@both_kinematics
def test_strain_energy_of_a_full_circle(kinematics):
    result = dr.solve(rolled_up(GENERAL, 1), elements=8, degree=4, kinematics=kinematics)
    assert result.energy["strain"][-1] == pytest.approx(2 * (2 * np.pi) ** 2 / 2, rel=1e-8)
