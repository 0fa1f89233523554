"""Errors against solutions found without finite elements."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

import dolfinrod as dr
from tests.scenes import (
    KIRCHHOFF,
    SKEW,
    bend,
    both_kinematics,
    cantilever,
    followed,
    rolled_up,
    round_section,
    tip_loaded,
)


def tip_error(result: dr.Result, tip: Sequence[float]) -> float:
    """Distance of the tip from where it belongs, in rod lengths."""
    return float(np.linalg.norm(SKEW.back(result.tip) - tip)) / result.rods[0].s[-1]


def tip_angle(result: dr.Result) -> float:
    """Turn of the last section in the scene's own plane [rad], between −π and π."""
    d1 = SKEW.Q.T @ result.rods[0].frames[-1, -1, :, 0]
    return float(np.arctan2(d1[1], d1[0]))


def clamp_moment(result: dr.Result) -> float:
    """Bending moment at the clamp [N m]."""
    return float(result.rods[0].m[-1, 0, 2])


# Elastica, P L²/EI: shortening, deflection, tip angle, clamp moment. Elliptic integrals, 14 digits; confirmed by an
# independent integration of the differential equation and by Mattiasson 1981 (IJNME 17, 145) to five digits.
ELASTICA = {
    1.0: (0.05643323628337688, 0.30172077379981355, 0.461351949711879, 0.9435667637166231),
    2.0: (0.16064172082516723, 0.49345748039671183, 0.7817498315565431, 1.6787165583496655),
    5.0: (0.38762836072442985, 0.7137915236119128, 1.215368117611681, 3.061858196377851),
    10.0: (0.5549955977537513, 0.8106090248802964, 1.4302855388038576, 4.450044022462487),
}


@both_kinematics
@pytest.mark.parametrize("force", ELASTICA)
@pytest.mark.parametrize(("elements", "degree", "limit"), [(8, 3, 2e-7), (8, 4, 1e-8), (4, 5, 1e-8)])
def test_elastica(elements, degree, limit, force, kinematics):
    u, w, angle, moment = ELASTICA[force]
    result = dr.solve(tip_loaded(KIRCHHOFF, force), elements=elements, degree=degree, kinematics=kinematics)
    assert tip_error(result, (1 - u, w, 0.0)) <= limit
    assert tip_angle(result) == pytest.approx(angle, abs=limit)
    assert clamp_moment(result) == pytest.approx(moment, rel=1e-3)


# The same with stretch and shear, L/h = 10 and 5: exact quadrature of Reissner's rod, 12 digits; confirmed by shooting.
STRETCHED = [
    (1200.0, 384.6153846153846, 0.5570591126983754, 0.8225115858920052, 1.4266876577568632),
    (300.0, 150.0, 0.5588991524076881, 0.8507138467978513, 1.423401136338314),
]


@both_kinematics
@pytest.mark.parametrize(("EA", "GA", "u", "w", "angle"), STRETCHED)
@pytest.mark.parametrize(("elements", "degree", "limit"), [(8, 3, 2e-7), (8, 4, 1e-8), (4, 5, 1e-8)])
def test_elastica_of_a_thick_rod(elements, degree, limit, EA, GA, u, w, angle, kinematics):
    section = dr.Section(EA=EA, GA=GA, GJ=0.7, EI=1.0)
    result = dr.solve(tip_loaded(section, 10.0), elements=elements, degree=degree, kinematics=kinematics)
    assert tip_error(result, (1 - u, w, 0.0)) <= limit
    assert tip_angle(result) == pytest.approx(angle, abs=limit)


@both_kinematics
@pytest.mark.parametrize("slenderness", [20, 2000])
@pytest.mark.parametrize("turns", [0.5, 1, 2, 5])
def test_roll_up(turns, slenderness, kinematics):
    scene = rolled_up(round_section(slenderness), turns)
    result = dr.solve(scene, elements=max(8, 8 * int(turns)), degree=3, kinematics=kinematics)
    rod, angle = result.rods[0], 2 * np.pi * turns
    circle = np.stack([np.sin(angle * rod.s), 1 - np.cos(angle * rod.s), 0 * rod.s], axis=1) / angle
    assert tip_error(result, circle[-1]) <= 1e-7
    assert np.abs(SKEW.back(rod.r[-1]) - circle).max() <= 3e-5
    np.testing.assert_allclose(rod.m[-1], [[0, 0, angle]] * len(rod.s), atol=1e-4 * angle)
    assert result.energy["strain"][-1] == pytest.approx(angle**2 / 2, rel=1e-7)


# 45° bend, F: tip position. Shooting in space by two integrators (section torsion constant 1/6, GA = 5e6).
BEND = {
    300.0: (58.779122489682884, 22.244780945367324, 40.19189167015043),
    600.0: (47.15043857362926, 15.684800534038683, 53.47485879182503),
}


@pytest.mark.parametrize("force", BEND)
@pytest.mark.parametrize(("elements", "degree", "limit"), [(8, 3, 3e-8), (8, 4, 1e-10)])
def test_bend(elements, degree, limit, force):
    result = dr.solve(bend(force), elements=elements, degree=degree)
    error = np.linalg.norm(SKEW.back(result.tip) - BEND[force])
    assert error <= limit * np.linalg.norm(BEND[force])


# Bend of a rod with shear factor 5/6 instead: m0 is the moment at the clamp, in space. Same source.
def test_bend_clamp_moment():
    result = dr.solve(bend(600.0, GA=25e6 / 6), elements=16, degree=4)
    rod = result.rods[0]
    tip = (47.15009624034236, 15.684689478979587, 53.47547799822499)
    np.testing.assert_allclose(SKEW.back(result.tip), tip, rtol=1e-10)
    moment = -SKEW.Q.T @ rod.frames[-1, 0] @ rod.m[-1, 0]
    np.testing.assert_allclose(moment, [-9410.81368738775, 28290.05774420541, 0.0], atol=0.1)


# Follower tip force, P L²/EI: tip position and angle. Jacobi functions, 10 digits; confirmed by integration from the
# tip (differences below 3e-13).
FOLLOWED = {
    2.0: (0.767362191534651, 0.573839062560944, 0.968238802517163),
    5.0: (0.17227787539910586, 0.7806901427781046, 2.0981572399409765),
    10.0: (-0.09212318118936638, 0.5469832645937142, 2.992714816235378),
    20.0: (0.2757101230900874, 0.33015765978121386, 2.850579901035627),
}


@both_kinematics
@pytest.mark.parametrize("force", FOLLOWED)
def test_follower_force(force, kinematics):
    x, y, angle = FOLLOWED[force]
    result = dr.solve(followed(KIRCHHOFF, force), elements=16, degree=4, kinematics=kinematics)
    assert tip_error(result, (x, y, 0.0)) <= 1e-8
    assert tip_angle(result) == pytest.approx(angle, abs=1e-8)


@both_kinematics
def test_follower_force_of_argyris_and_symeonidis(kinematics):
    # The whole path up to P = 130 kN (Simo & Vu-Quoc 1986, CMAME 58, sec. 5.2); numbers by integration from the tip.
    section = dr.Section(EA=4.2e8, GA=1.61538e8, GJ=3.5e7, EI=3.5e7)
    load = dr.FollowerForce((0, 130e3, 0), "end")
    scene = cantilever(SKEW.straight(section, length=100.0), load, motion=dr.Static(steps=13))
    rod = dr.solve(scene, elements=16, degree=4, kinematics=kinematics).rods[0]
    tips = SKEW.back(rod.r[:, -1]) - [100.0, 0.0, 0.0]
    known = {
        1: (-41.692809823184945, 71.10951872666071),
        5: (-97.99151017476566, 44.80064090145051),
        10: (-50.75237983062348, -11.628824903089484),
        13: (-75.92823760154431, -47.82771698979732),
    }
    np.testing.assert_allclose(tips[list(known), :2], list(known.values()), atol=1e-6 * 100)
