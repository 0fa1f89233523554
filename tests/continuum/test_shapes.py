"""Stress-free shapes are stress free on every mesh, and curvature and pretwist act as they should under load."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import dolfinrod as dr
from tests.scenes import FLAT, GENERAL, KIRCHHOFF, SKEW, both_kinematics, cantilever, differences, largest, orders

THREE = st.tuples(*[st.floats(-4.0, 4.0)] * 3)
KNOTTED = ((0, 0, 0), (0.5, 0.3, 0.1), (0.8, -0.1, 0.6), (0.2, -0.5, 0.9), (0.4, 0.4, 1.2))


def helix(section: dr.Section = GENERAL, pretwist: float = 0.0) -> dr.Rod:
    """A turn and a half of a helix."""
    return dr.Rod.curved(
        2.0, section, (2.0, 1.0, 4.0), start=SKEW.placed((0, 0, 0)), direction=SKEW.turned((1, 0, 0)), pretwist=pretwist
    )


RODS = {
    "straight": SKEW.straight(GENERAL),
    "arc": SKEW.arc(GENERAL, angle=2.0),
    "helix": helix(),
    "through": dr.Rod.through(KNOTTED, GENERAL),
    "pretwisted": dr.Rod.straight(1.0, GENERAL, pretwist=7.0),
    "pretwisted helix": helix(pretwist=3.0),
    "pretwisted through": dr.Rod.through(KNOTTED, GENERAL, pretwist=-4.0),
    "Kirchhoff through": dr.Rod.through(KNOTTED, KIRCHHOFF, pretwist=-4.0),
}
any_rod = pytest.mark.parametrize("rod", RODS.values(), ids=RODS.keys())


def assert_stress_free(result: dr.Result) -> None:
    """Nothing has moved and nothing is strained, in units of L, EI/L² and EI/L."""
    for rod, history in zip(result.scene.rods, result.rods, strict=True):
        L, EI = rod.length, min(rod.section.EI)
        np.testing.assert_allclose(history.r[-1], rod.centerline(history.s), rtol=0, atol=1e-12 * L)
        np.testing.assert_allclose(history.frames[-1], rod.frames(history.s), rtol=0, atol=1e-12)
        assert largest(history.n[-1]) <= 1e-12 * EI / L**2 * stiffness_ratio(rod)
        assert largest(history.m[-1]) <= 1e-12 * EI / L * 10
        assert largest(history.gamma[-1]) <= 1e-12
        assert largest(history.kappa[-1]) <= 1e-12 / L * 10


def stiffness_ratio(rod: dr.Rod) -> float:
    """EA L²/EI: round-off of a length, as a force in units of EI/L²."""
    EA = rod.section.EA if np.isfinite(rod.section.EA) else 1.0
    return max(EA * rod.length**2 / min(rod.section.EI), 10.0)


@any_rod
@pytest.mark.parametrize(("elements", "degree"), [(1, 1), (1, 3), (2, 2), (3, 4)])
def test_no_load_no_stress(elements, degree, rod):
    assert_stress_free(dr.solve(cantilever(rod), elements=elements, degree=degree, kinematics=dr.Spatial()))


@pytest.mark.parametrize(("elements", "degree"), [(1, 1), (2, 3)])
def test_no_load_no_stress_in_a_plane(elements, degree):
    result = dr.solve(cantilever(SKEW.arc(GENERAL, angle=2.0)), elements=elements, degree=degree)
    assert result.formulation.kinematics == "planar"
    assert_stress_free(result)


@settings(max_examples=8)
@given(curvature=THREE, pretwist=st.floats(-8, 8), direction=THREE.filter(lambda v: np.linalg.norm(v) > 0.1))
def test_any_helix_is_stress_free(curvature, pretwist, direction):
    rod = dr.Rod.curved(1.5, GENERAL, curvature, direction=direction, pretwist=pretwist)
    assert_stress_free(dr.solve(cantilever(rod), elements=2, degree=2, kinematics=dr.Spatial()))


def test_rods_that_meet_at_a_kink_are_stress_free():
    corner = (1.0, 0.0, 0.0)
    rods = [dr.Rod.straight(1.0, GENERAL), dr.Rod.straight(0.7, GENERAL, start=corner, direction=(-1, 2, 0))]
    scene = dr.Scene(rods, [dr.Clamp("start", rod=0), dr.Clamp("start", rod=1)])
    for kinematics in (None, dr.Spatial()):
        assert_stress_free(dr.solve(scene, elements=2, degree=3, kinematics=kinematics))


LOADS = (dr.PointForce((0.4, -0.6, 0.5), "end"), dr.FollowerMoment((0.2, 0.1, -0.3), "end"))
SMOOTH = {name: rod for name, rod in RODS.items() if rod.breakpoints == ()}


@cache
def finest_tip(rod: dr.Rod) -> np.ndarray:
    """Tip of a loaded rod, to round-off beside the errors measured."""
    return dr.solve(cantilever(rod, *LOADS), elements=24, degree=5).tip


@pytest.mark.parametrize("rod", SMOOTH.values(), ids=SMOOTH.keys())
@pytest.mark.parametrize(("degree", "meshes"), [(1, (32, 64)), (2, (12, 24)), (3, (10, 20))])
def test_loaded_shapes_converge_at_the_order_of_the_element(degree, meshes, rod):
    scene, exact = cantilever(rod, *LOADS), finest_tip(rod)
    errors = [np.linalg.norm(dr.solve(scene, elements=n, degree=degree).tip - exact) for n in meshes]
    assert orders(meshes, errors)[-1] >= 2 * degree - 0.3


def test_a_rod_through_points_converges():
    """Its curvature has kinks at the points, which the elements do not know."""
    scene = cantilever(RODS["pretwisted through"], *LOADS)
    exact = dr.solve(scene, elements=96, degree=4).tip
    errors = [np.linalg.norm(dr.solve(scene, elements=n, degree=3).tip - exact) for n in (8, 16, 32)]
    assert errors[-1] <= 1e-6
    assert orders((8, 32), [errors[0], errors[-1]])[-1] >= 3.0


@both_kinematics
@pytest.mark.parametrize("angle", [0.5, 2.0, 7.0])
def test_an_arc_is_unbent_to_a_straight_rod(angle, kinematics):
    section = dr.Section(EA=900.0, GA=(400.0, 300.0), GJ=0.7, EI=2.0)
    scene = cantilever(
        SKEW.arc(section, radius=1 / angle, angle=angle), dr.PointMoment(SKEW.turned((0, 0, -2 * angle)), "end")
    )
    rod = dr.solve(scene, elements=16, degree=4, kinematics=kinematics).rods[0]
    np.testing.assert_allclose(SKEW.back(rod.r[-1]), rod.s[:, None] * [1.0, 0, 0], rtol=0, atol=1e-8 * angle**2)
    np.testing.assert_allclose(rod.kappa[-1], [[0, 0, -angle]] * len(rod.s), rtol=0, atol=1e-4 * angle)


@pytest.mark.parametrize("moment", [(0.0, 0.0, 6.0), (2.0, 0.0, 5.0), (3.0, -2.0, 4.0)])
def test_a_follower_moment_winds_a_helix(moment):
    """With GJ = EI a moment fixed to the end section bends and twists a rod uniformly by M/EI."""
    section = dr.Section(EA=900.0, GA=400.0, GJ=1.0, EI=1.0)
    scene = cantilever(FLAT.straight(section), dr.FollowerMoment(moment, "end"))
    rod = dr.solve(scene, elements=16, degree=4, kinematics=dr.Spatial()).rods[0]
    wound = dr.Rod.curved(1.0, section, moment)
    np.testing.assert_allclose(rod.r[-1], wound.centerline(rod.s), rtol=0, atol=1e-7)
    np.testing.assert_allclose(rod.frames[-1], wound.frames(rod.s), rtol=0, atol=1e-6)
    np.testing.assert_allclose(rod.m[-1], [moment] * len(rod.s), rtol=0, atol=1e-4)


def test_pretwist_of_a_round_section_changes_nothing():
    section = dr.Section(EA=900.0, GA=400.0, GJ=0.7, EI=1.0)
    load = dr.PointForce((1.0, -6.0, 3.0), "end")
    plain, twisted = (dr.solve(cantilever(helix(section, p), load), elements=6, degree=3) for p in (0.0, 9.0))
    np.testing.assert_allclose(twisted.rods[0].r[-1], plain.rods[0].r[-1], rtol=0, atol=1e-11)


def test_a_pretwisted_strip_deflects_askew():
    """Small deflections by Mohr's integral, with the principal axes of bending turning along the rod."""
    EI2, EI3, τ, F = 1.0, 5.0, 4.0, 1e-5
    section = dr.Section(GJ=0.7, EI=(EI2, EI3), rigid={"shear", "extension"})
    rod = dr.Rod.straight(1.0, section, pretwist=τ)
    tip = dr.solve(cantilever(rod, dr.PointForce((0, F, 0), "end")), elements=12, degree=4).tip
    x, w = np.polynomial.legendre.leggauss(40)
    s, w = (x + 1) / 2, w / 2
    c, d = np.cos(τ * s), np.sin(τ * s)
    y = F * w @ ((1 - s) ** 2 * (c * c / EI3 + d * d / EI2))
    z = -F * w @ ((1 - s) ** 2 * c * d * (1 / EI2 - 1 / EI3))
    np.testing.assert_allclose(tip[1:], [y, z], rtol=1e-7)


@both_kinematics
def test_a_straight_rod_through_points_is_a_straight_rod(kinematics):
    points = [SKEW.placed((x, 0, 0)) for x in (0.0, 0.3, 0.7, 1.0)]
    load = dr.PointForce(SKEW.turned((0.0, 5.0, 0.0)), "end")
    rods = SKEW.straight(GENERAL), dr.Rod.through(points, GENERAL, d2=SKEW.turned((0, 1, 0)))
    a, b = (dr.solve(cantilever(rod, load), elements=4, degree=3, kinematics=kinematics) for rod in rods)
    assert max(differences(a, b).values()) <= 1e-9
