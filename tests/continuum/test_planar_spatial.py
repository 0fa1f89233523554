"""A scene in a plane has one answer, found with an angle or with a quaternion up to the error of the elements."""

from __future__ import annotations

import numpy as np
import pytest

import dolfinrod as dr
from tests.scenes import GENERAL, SKEW, cantilever, differences, orders, tip_loaded


def gap(scene: dr.Scene, elements: int, degree: int) -> float:
    """Distance between the tips found in the plane and in space."""
    tips = [dr.solve(scene, elements=elements, degree=degree, kinematics=k).tip for k in (dr.Planar(), dr.Spatial())]
    return float(np.linalg.norm(tips[0] - tips[1]))


def loaded_arc() -> dr.Scene:
    """An arc bent open, a support inside, its tip force following."""
    return dr.Scene(
        [SKEW.arc(GENERAL, angle=1.2)],
        [dr.Clamp("start"), dr.Pin(0.6)],
        [dr.FollowerForce((0, -4, 0), "end"), dr.PointForce(SKEW.turned((3, 2, 0)), 0.3)],
    )


ELASTICA = tip_loaded(GENERAL, 10.0)
# Meshes with nodes under all supports and loads, their gaps well above round-off.
CASES = [
    *((ELASTICA, degree, meshes) for degree, meshes in {1: (16, 32), 2: (8, 16), 3: (4, 8), 4: (4, 8)}.items()),
    *((loaded_arc(), degree, meshes) for degree, meshes in {1: (16, 32), 2: (8, 16), 3: (4, 8)}.items()),
]


@pytest.mark.parametrize(("scene", "degree", "meshes"), CASES)
def test_difference_falls_at_the_order_of_the_element(scene, degree, meshes):
    gaps = [gap(scene, n, degree) for n in meshes]
    assert orders(meshes, gaps)[-1] >= 2 * degree - 0.3


def test_kinematics_follow_from_the_scene():
    assert dr.solve(tip_loaded(GENERAL, 1.0), elements=2, degree=1).formulation.kinematics == "planar"
    out_of_plane = cantilever(SKEW.straight(GENERAL), dr.PointForce(SKEW.turned((0, 1, 1)), "end"))
    assert dr.solve(out_of_plane, elements=2, degree=1).formulation.kinematics == "spatial"


@pytest.mark.parametrize("axis", [1, 2])
def test_a_plane_is_found_on_either_side_of_the_rod(axis):
    """Bending about d2 is bending about d3 of the rod turned by a right angle."""
    across = dr.Section(EA=900.0, GA=(300.0, 400.0), GJ=0.7, EI=(2.0, 1.0))
    force = np.eye(3)[axis] * 6.0
    load = dr.PointForce(SKEW.turned(force), "end")
    section = GENERAL if axis == 1 else across
    d2 = SKEW.turned(np.eye(3)[1])
    rod = dr.Rod.straight(1.0, section, start=SKEW.placed((0, 0, 0)), direction=SKEW.turned((1, 0, 0)), d2=d2)
    results = [dr.solve(cantilever(rod, load), elements=8, degree=4, kinematics=k) for k in (None, dr.Spatial())]
    assert results[0].formulation.kinematics == "planar"
    assert max(differences(*results).values()) <= 1e-5
    assert SKEW.back(results[0].tip)[axis] == pytest.approx(SKEW.back(solved_in_xy(6.0).tip)[1], abs=1e-12)


def solved_in_xy(force: float) -> dr.Result:
    """The reference of the turned rod."""
    return dr.solve(tip_loaded(GENERAL, force), elements=8, degree=4, kinematics=dr.Planar())


def test_planar_refuses_what_leaves_the_plane():
    scene = cantilever(SKEW.straight(GENERAL), dr.PointForce(SKEW.turned((0, 1, 1)), "end"))
    with pytest.raises(dr.SceneError, match="plane"):
        dr.solve(scene, kinematics=dr.Planar())
    with pytest.raises(dr.SceneError, match=r"loads\[0\] acts out of the plane"):
        dr.solve(scene, kinematics=dr.Planar(normal=SKEW.turned((0, 0, 1))))
