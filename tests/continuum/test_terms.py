"""Every term: its tangent is the derivative of its residual, and symmetric where the load has a potential."""

from __future__ import annotations

from collections.abc import Callable

from mpi4py import MPI

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

import dolfinrod as dr
from dolfinrod.continuum import quaternion
from dolfinrod.continuum.discretization import Discretization
from dolfinrod.continuum.placement import Placement
from dolfinrod.continuum.planar import PlanarRods
from dolfinrod.continuum.problem import Problem
from dolfinrod.continuum.spatial import SpatialRods
from dolfinrod.continuum.terms.point import DeadForces, DeadMoments, FollowerForces, FollowerMoments
from tests.scenes import GENERAL, KIRCHHOFF, SKEW, largest

Array = NDArray[np.float64]
KINEMATICS = {"planar": (PlanarRods(), dr.Planar(SKEW.turned((0, 0, 1)))), "spatial": (SpatialRods(), dr.Spatial())}
STEPS = np.array([1e-2, 5e-3, 2.5e-3])


def slope(residual: Callable[[float], Array], tangent: Array) -> float:
    """Order at which b(ε) − b(0) − ε b′(0) vanishes; infinite where b is linear."""
    remainders = np.array([largest(residual(ε) - residual(0.0) - ε * tangent) for ε in STEPS])
    if remainders.max() <= 1e-12 * max(largest(residual(0.0)), largest(tangent), 1.0):
        return np.inf
    return float(np.polyfit(np.log(STEPS), np.log(remainders), 1)[0])


def free_problem(name: str, section: dr.Section) -> Problem:
    """An arc that nothing holds or loads, in a state far from rest."""
    rods, chosen = KINEMATICS[name]
    scene = dr.Scene([SKEW.arc(section, angle=1.0)])
    problem = Problem(scene, Discretization(MPI.COMM_SELF, rods, 2, (3,)), Placement.of(scene, chosen))
    problem.x[:] += np.random.default_rng(5).normal(size=len(problem.x), scale=0.3)
    return problem


def residual_of(problem: Problem, x: Array) -> Array:
    """Residual of the weak form at a state, before supports."""
    problem.x[:] = x
    b = np.zeros_like(x)
    problem.add_residual(b)
    return b


def tangent_of(problem: Problem, x: Array) -> Array:
    """Dense tangent of the weak form at a state."""
    problem.x[:] = x
    A = problem.discretization.tangent.matrix()
    problem.assemble_tangent(A)
    return A.convert("dense").getDenseArray().copy()


FIELDS = [(name, field) for name, (rods, _) in KINEMATICS.items() for field in rods.fields]


@pytest.mark.parametrize("section", [GENERAL, KIRCHHOFF], ids=["elastic", "rigid"])
@pytest.mark.parametrize(("name", "field"), FIELDS)
def test_tangent_of_elasticity_and_gauge_is_consistent(name, field, section):
    problem = free_problem(name, section)
    x = problem.x.copy()
    v = np.zeros_like(x)
    dofs = problem.discretization.dofs[field]
    v[dofs] = np.random.default_rng(7).normal(size=dofs.shape)
    assert slope(lambda ε: residual_of(problem, x + ε * v), tangent_of(problem, x) @ v) >= 1.9


@pytest.mark.parametrize("section", [GENERAL, KIRCHHOFF], ids=["elastic", "rigid"])
@pytest.mark.parametrize("name", KINEMATICS)
def test_tangent_of_elasticity_and_gauge_is_symmetric(name, section):
    problem = free_problem(name, section)
    K = tangent_of(problem, problem.x.copy())
    assert largest(K) > 0.1
    assert largest(K - K.T) <= 1e-13 * largest(K)


def quaternions_and_spins(rods: PlanarRods | SpatialRods, seed: int) -> tuple[Array, Array]:
    """Rotation unknowns of three sections and a change of them, as spins."""
    rng = np.random.default_rng(seed)
    q = turned(rods, rods.at_rest(3), rng.normal(size=(3, rods.n_spin)))
    return q, rng.normal(size=(3, rods.n_spin))


def turned(rods: PlanarRods | SpatialRods, q: Array, θ: Array) -> Array:
    """Rotation unknowns after spins θ in space: exp(½ θ) p or φ + θ, independent of how Newton does it."""
    return quaternion.multiply(quaternion.exponential(θ), q) if rods.n_spin == 3 else q + θ


def rate(rods: PlanarRods | SpatialRods, q: Array, θ: Array) -> Array:
    """Change of the rotation unknowns at the spins θ, ½ θ p or θ itself."""
    ε = 1e-6
    return (turned(rods, q, ε * θ) - turned(rods, q, -ε * θ)) / (2 * ε)


@settings(max_examples=10)
@given(seed=st.integers(0, 10_000))
@pytest.mark.parametrize("kind", [FollowerForces, DeadMoments, FollowerMoments])
@pytest.mark.parametrize("name", KINEMATICS)
def test_tangent_of_a_point_load_is_consistent(name, kind, seed):
    rods = KINEMATICS[name][0]
    q, θ = quaternions_and_spins(rods, seed)
    places = np.arange(q.size).reshape(q.shape)
    centreline = q.size + np.arange(3 * rods.dim).reshape(3, rods.dim)
    values = np.random.default_rng(seed + 1).normal(size=(3, 3))
    if kind is FollowerForces:
        load = kind(rods, centreline, places, values[:, : rods.dim])
    else:
        load = kind(rods, places, values[:, : rods.n_spin])
    padding = np.zeros(3 * rods.dim)

    def residual(ε: float) -> Array:
        return load.residual(np.concatenate([turned(rods, q, ε * θ).ravel(), padding]))[1]

    block = load.tangent(np.concatenate([q.ravel(), padding]))
    tangent = np.zeros_like(residual(0.0)) if block is None else np.einsum("nij,nj->ni", block[2], rate(rods, q, θ))
    assert slope(residual, tangent) >= 1.9


@pytest.mark.parametrize("name", KINEMATICS)
def test_work_of_a_moment_is_moment_times_spin(name):
    rods = KINEMATICS[name][0]
    q, θ = quaternions_and_spins(rods, 3)
    places = np.arange(q.size).reshape(q.shape)
    M = np.random.default_rng(4).normal(size=(3, rods.n_spin))
    dead, follower = (kind(rods, places, M).residual(q.ravel())[1] for kind in (DeadMoments, FollowerMoments))
    body = rods.rotate(q, M) if rods.n_spin == 3 else M
    δq = rate(rods, q, θ)
    np.testing.assert_allclose(-(dead * δq).sum(axis=1), (M * θ).sum(axis=1), atol=1e-8)
    np.testing.assert_allclose(-(follower * δq).sum(axis=1), (body * θ).sum(axis=1), atol=1e-8)


@pytest.mark.parametrize("name", KINEMATICS)
def test_work_of_a_force_is_force_times_displacement(name):
    rods = KINEMATICS[name][0]
    q, _ = quaternions_and_spins(rods, 3)
    places, r = np.arange(q.size).reshape(q.shape), np.arange(3 * rods.dim).reshape(3, rods.dim)
    F = np.random.default_rng(4).normal(size=(3, rods.dim))
    rows, values = DeadForces(r, F).residual(q.ravel())
    np.testing.assert_array_equal(rows, r)
    np.testing.assert_array_equal(values, -F)
    np.testing.assert_allclose(FollowerForces(rods, r, places, F).residual(q.ravel())[1], -rods.rotate(q, F))


@pytest.mark.parametrize("name", KINEMATICS)
def test_a_turn_follows_the_great_circle_of_its_spin(name):
    rods = KINEMATICS[name][0]
    q, θ = quaternions_and_spins(rods, 11)
    v = np.random.default_rng(12).normal(size=(3, rods.dim))
    np.testing.assert_allclose(rods.rotate_back(q, rods.rotate(q, v)), v, atol=1e-14)
    increment = rods.increment(q, rate(rods, q, θ))
    np.testing.assert_allclose(increment, rate(rods, q, θ), atol=1e-8)
    np.testing.assert_allclose(rods.turn(q, increment), turned(rods, q, θ), atol=1e-8)
    np.testing.assert_allclose(rods.angles(increment), np.linalg.norm(θ, axis=1), atol=1e-8)
