"""Curves through points: true arc length, and frames that do not twist."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline

from dolfinrod.scene import Rod, Section

Array = NDArray[np.float64]
SECTION = Section(EA=1.0, GA=1.0, GJ=1.0, EI=1.0)


def helix(n: int, radius: float = 1.0, pitch: float = 1.0, angle: float = 6.0) -> Array:
    """Points on a helix about z."""
    φ = np.linspace(0.0, angle, n)
    return np.stack([radius * np.cos(φ), radius * np.sin(φ), pitch * φ], axis=-1)


def test_a_curve_passes_through_its_points_at_its_breakpoints() -> None:
    points = np.random.default_rng(3).normal(size=(9, 3))
    rod = Rod.through(points, SECTION)
    np.testing.assert_allclose(rod.centerline([0.0, *rod.breakpoints, rod.length]), points, atol=1e-13)


def test_arc_length_of_a_parabola_is_exact() -> None:
    # Three points make a parabola; equal chords make it y = x², of length √5 + asinh(2)/2 between −1 and 1.
    rod = Rod.through([(-1, 1, 0), (0, 0, 0), (1, 1, 0)], SECTION)
    half = np.sqrt(5) / 2 + np.arcsinh(2) / 4
    assert rod.length == pytest.approx(2 * half, rel=1e-15)
    np.testing.assert_allclose(rod.centerline(half), 0.0, atol=1e-15)
    np.testing.assert_allclose(rod.curvature(half), [0.0, 0.0, 2.0], atol=1e-13)


def test_arc_length_and_frames_agree_with_their_differential_equations() -> None:
    # s′ = |c′| and d2′ = −(d2·t′)t along the same cubic, stepped by an eighth-order method to near round-off.
    points = helix(5)
    cubic = CubicSpline(np.append(0.0, np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))), points)

    def carried(u: float, state: Array) -> Array:
        c_u, c_uu = cubic(u, 1), cubic(u, 2)
        speed = np.linalg.norm(c_u)
        t = c_u / speed
        return np.append(-(state[:3] @ c_uu) / speed * t, speed)

    rod = Rod.through(points, SECTION, d2=(0.0, 0.0, 1.0))
    state = np.append(rod.frames(0.0)[:, 1], 0.0)
    for (a, b), s in zip(pairwise(cubic.x), (*rod.breakpoints, rod.length), strict=True):
        state = solve_ivp(carried, (a, b), state, method="DOP853", rtol=1e-13, atol=1e-14).y[:, -1]
        assert s == pytest.approx(state[3], rel=1e-12)
        np.testing.assert_allclose(rod.frames(s)[:, 1], state[:3], atol=1e-12)


def test_frames_on_a_helix_turn_against_its_normal_by_the_torsion() -> None:
    # The frame without twist turns about the tangent of a helix by −τ relative to the principal normal,
    # τ = p/(r² + p²) (Bishop 1975). Curves through more and more points approach it at fourth order.
    r, p, angle = 1.0, 0.5, 3.0
    w = np.hypot(r, p)
    normal = -np.array([np.cos(angle), np.sin(angle), 0.0])
    tangent = np.array([-r * np.sin(angle), r * np.cos(angle), p]) / w
    φ = -p / w**2 * w * angle
    exact = np.cos(φ) * normal + np.sin(φ) * np.cross(tangent, normal)

    def error(n: int) -> float:
        # As far again before and after: the ends of a cubic are less accurate.
        rod = Rod.through(helix(n, r, p, 2 * angle), SECTION, d2=(-1.0, 0.0, 0.0))
        return float(np.linalg.norm(rod.frames(rod.length / 2)[:, 1] - exact))

    assert error(401) < 1e-9
    assert np.log2(error(101) / error(201)) == pytest.approx(4.0, abs=0.1)


def test_a_plane_curve_keeps_its_normal() -> None:
    x = np.linspace(0.0, 10.0, 30)
    across = np.array([2.0, -1.0, 2.0]) / 3.0
    one, two = np.array([1.0, 2.0, 0.0]) / np.sqrt(5), np.cross(across, np.array([1.0, 2.0, 0.0]) / np.sqrt(5))
    rod = Rod.through(np.outer(x, one) + np.outer(np.sin(x), two), SECTION, d2=two)
    s = np.linspace(0.0, rod.length, 301)
    np.testing.assert_allclose(rod.frames(s)[..., 2], np.broadcast_to(across, (301, 3)), atol=1e-13)
    np.testing.assert_allclose(rod.curvature(s)[:, :2], 0.0, atol=1e-12)


def test_s_is_the_arc_length() -> None:
    rod = Rod.through(helix(7), SECTION)
    knots = np.array([0.0, *rod.breakpoints, rod.length])
    x, w = np.polynomial.legendre.leggauss(20)
    for a, b in pairwise(knots):
        s = (a + b) / 2 + (b - a) / 2 * x
        chord = (b - a) / 2 * w @ rod.frames(s)[..., 0]
        np.testing.assert_allclose(chord, rod.centerline(b) - rod.centerline(a), atol=1e-13)


def test_sharp_bends_are_resolved() -> None:
    # A spike 1e-3 wide: the panels there are halved until Gauss's rule is exact.
    rod = Rod.through([(0, 0, 0), (1, 0, 0), (1.001, 1, 0), (1.002, 0, 0), (2, 0, 0)], SECTION)
    u = rod.shape._cubic.x
    fine = np.unique(np.concatenate([np.linspace(a, b, 20001) for a, b in pairwise(u)]))
    x, w = np.polynomial.legendre.leggauss(3)
    half = np.diff(fine)[:, None] / 2
    speed = np.linalg.norm(rod.shape._cubic(fine[:-1, None] + half * (1 + x), 1), axis=-1)
    assert rod.length == pytest.approx(float(np.sum(half * speed * w)), rel=1e-13)
