"""Errors fall at the order of the element: 2k at the tip, k + 1 along the rod."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

import dolfinrod as dr
from tests.scenes import FLAT, SKEW, bend, both_kinematics, interpolated, orders, tip_loaded

SECTION = dr.Section(EA=1200.0, GA=384.6153846153846, GJ=0.7, EI=1.0)
# Meshes on which the error is neither far from its asymptote nor at round-off.
ELASTICA_MESHES = {1: (32, 64, 128), 2: (8, 16, 32), 3: (8, 12, 16), 4: (6, 8, 10)}
BEND_MESHES = {1: (16, 32, 64), 2: (4, 8, 16), 3: (4, 6, 8), 4: (3, 4, 5)}
every_degree = pytest.mark.parametrize("degree", [1, 2, 3, 4])


@cache
def finest(scene: dr.Scene, kinematics: dr.Planar | dr.Spatial | None) -> dr.RodHistory:
    """The rod on a mesh whose error is round-off beside those measured."""
    return dr.solve(scene, elements=32, degree=5, kinematics=kinematics).rods[0]


def centreline_errors(
    scene: dr.Scene, meshes: tuple[int, ...], degree: int, kinematics: dr.Planar | dr.Spatial | None = None
) -> list[float]:
    """L2 distances of the centreline from that of the finest mesh."""
    points, weights = np.polynomial.legendre.leggauss(8)
    # Edges of all meshes, so that every piece of the integrand is smooth.
    edges = np.linspace(0.0, scene.rods[0].length, 96 + 1)
    s = (edges[:-1, None] + np.diff(edges)[:, None] * (points + 1) / 2).ravel()
    w = (np.diff(edges)[:, None] * weights / 2).ravel()
    best = finest(scene, kinematics)
    exact = interpolated(best.s, best.r[-1], 5, s)
    errors = []
    for n in meshes:
        rod = dr.solve(scene, elements=n, degree=degree, kinematics=kinematics).rods[0]
        errors.append(float(np.sqrt(w @ ((interpolated(rod.s, rod.r[-1], degree, s) - exact) ** 2).sum(axis=1))))
    return errors


@both_kinematics
@every_degree
def test_tip_of_the_elastica(degree, kinematics):
    meshes = ELASTICA_MESHES[degree]
    # Exact quadrature of Reissner's rod, 12 digits.
    exact = np.array([1 - 0.5570591126983754, 0.8225115858920052, 0.0])
    tips = [
        SKEW.back(dr.solve(tip_loaded(SECTION, 10.0), elements=n, degree=degree, kinematics=kinematics).tip)
        for n in meshes
    ]
    errors = [np.linalg.norm(tip - exact) for tip in tips]
    assert orders(meshes, errors)[-1] == pytest.approx(2 * degree, abs=0.3)


@every_degree
def test_tip_of_the_bend(degree):
    meshes = BEND_MESHES[degree]
    exact = finest(bend(600.0), None).r[-1, -1]
    errors = [np.linalg.norm(dr.solve(bend(600.0), elements=n, degree=degree).tip - exact) for n in meshes]
    assert orders(meshes, errors)[-1] == pytest.approx(2 * degree, abs=0.3)


@both_kinematics
@every_degree
def test_centreline_of_the_elastica(degree, kinematics):
    errors = centreline_errors(tip_loaded(SECTION, 10.0, FLAT), (16, 24), degree, kinematics)
    assert orders((16, 24), errors)[-1] == pytest.approx(degree + 1, abs=0.2)


@every_degree
def test_centreline_of_the_bend(degree):
    errors = centreline_errors(bend(600.0), (8, 16), degree)
    assert orders((8, 16), errors)[-1] == pytest.approx(degree + 1, abs=0.2)
