"""Stress-free shapes: r′ = d1 and R′ = R·skew(κ) on every kind of rod; lines, arcs and helices in closed form."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from math import pi

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from dolfinrod.scene import Rod, SceneError, Section
from dolfinrod.scene.shape import skew

Array = NDArray[np.float64]
SECTION = Section(EA=1.0, GA=1.0, GJ=1.0, EI=1.0)
POINTS = [(1.0, 0.0, 0.0), (0.0, 1.0, 1.0), (-1.0, 0.0, 2.0), (0.0, -1.0, 3.0)]

numbers = st.floats(-3.0, 3.0)
vectors = st.tuples(numbers, numbers, numbers)
directions = vectors.filter(lambda v: np.linalg.norm(v) > 0.1)


def slope(f: Callable[[Array], Array], s: Array, h: float) -> Array:
    """f′ by central differences of sixth order."""
    weights = {1: 45.0, 2: -9.0, 3: 1.0}
    return sum(w * (f(s + k * h) - f(s - k * h)) for k, w in weights.items()) / (60.0 * h)


def assert_laws(rod: Rod, s: Array, h: float, tolerance: float) -> None:
    """r′ = d1, R′ = R·skew(κ), RᵀR = 1 and det R = 1."""
    R = rod.frames(s)
    np.testing.assert_allclose(slope(rod.centerline, s, h), R[..., 0], atol=tolerance)
    np.testing.assert_allclose(slope(rod.frames, s, h), R @ skew(rod.curvature(s)), atol=tolerance / rod.length)
    np.testing.assert_allclose(np.swapaxes(R, 1, 2) @ R, np.broadcast_to(np.eye(3), R.shape), atol=1e-13)
    np.testing.assert_allclose(np.linalg.det(R), 1.0, atol=1e-13)


@given(direction=directions, curvature=vectors, start=vectors, length=st.floats(0.1, 3.0), pretwist=numbers)
def test_laws_on_lines_arcs_and_helices(
    direction: tuple[float, ...], curvature: tuple[float, ...], start: tuple[float, ...], length: float, pretwist: float
) -> None:
    rod = Rod.curved(length, SECTION, curvature, start, direction, pretwist=pretwist)
    h = 0.02 / (1.0 / length + np.linalg.norm(curvature) + abs(pretwist))
    assert_laws(rod, np.linspace(0.1, 0.9, 7) * length, h, 1e-8)
    np.testing.assert_allclose(rod.centerline(0.0), start)


@settings(max_examples=20, deadline=None)
@given(points=st.lists(directions, min_size=2, max_size=7), pretwist=numbers)
def test_laws_on_curves_through_points(points: list[tuple[float, ...]], pretwist: float) -> None:
    chords = np.linalg.norm(np.diff(points, axis=0), axis=1)
    assume(np.all(chords > 0.3))
    try:
        rod = Rod.through(points, SECTION, pretwist=pretwist)
    except SceneError:
        assume(False)  # the curve turns back on the spot
    knots = np.array([0.0, *rod.breakpoints, rod.length])
    middles = (knots[1:] + knots[:-1]) / 2
    bend = np.abs(rod.curvature(np.linspace(0.0, rod.length, 200))).max()
    assume(bend * rod.length < 100.0)
    h = 1e-3 * min(np.diff(knots).min(), 1.0 / (1.0 + bend))
    assert_laws(rod, middles, h, 1e-6)


def test_a_straight_curve_through_points_is_the_straight_rod() -> None:
    s = np.linspace(0.0, 3.0, 11)
    through = Rod.through([(0, 0, 0), (1, 2, 2)], SECTION, pretwist=1.5)
    straight = Rod.straight(3.0, SECTION, direction=(1, 2, 2), pretwist=1.5)
    assert through.breakpoints == straight.breakpoints == ()
    np.testing.assert_allclose(through.centerline(s), straight.centerline(s), atol=1e-14)
    np.testing.assert_allclose(through.frames(s), straight.frames(s), atol=1e-14)
    np.testing.assert_allclose(through.curvature(s), straight.curvature(s), atol=1e-14)


def test_an_arc_is_a_circle_about_the_centre_on_the_side_it_bends_to() -> None:
    rod = Rod.arc(radius=2.0, angle=3 * pi, section=SECTION, start=(1, 1, 1), direction=(0, 0, 1), towards=(1, 0, 1))
    s = np.linspace(0.0, rod.length, 50)
    centre = np.array([3.0, 1.0, 1.0])
    np.testing.assert_allclose(np.linalg.norm(rod.centerline(s) - centre, axis=1), 2.0, rtol=1e-14)
    np.testing.assert_allclose(rod.centerline(s) + 2.0 * rod.frames(s)[..., 1], np.tile(centre, (50, 1)), atol=1e-13)
    np.testing.assert_array_equal(rod.curvature(s), np.tile([0.0, 0.0, 0.5], (50, 1)))
    assert rod.length == 6 * pi


def test_the_arc_of_the_45_degree_bend() -> None:
    rod = Rod.arc(radius=100.0, angle=pi / 4, section=SECTION)
    end = 100.0 * np.array([np.sin(pi / 4), 1 - np.cos(pi / 4), 0.0])
    np.testing.assert_allclose(rod.centerline(rod.length), end, rtol=1e-14)


@pytest.mark.parametrize("κ", [1e-3, 1e-8, 1e-12, 1e-160, 0.0])
def test_the_sag_of_a_slight_arc_keeps_its_digits(κ: float) -> None:
    sag = Rod.curved(1.0, SECTION, (0.0, 0.0, κ)).centerline(1.0)[1]
    assert sag == pytest.approx(κ / 2 - κ**3 / 24, rel=1e-14, abs=0.0)


@pytest.mark.parametrize(
    ("direction", "d2"),
    [((1, 0, 0), (0, 1, 0)), ((0, 5, 0), (-1, 0, 0)), ((0, 0, 1), (0, 1, 0)), ((0, 0, -2), (0, 1, 0))],
)
def test_the_second_axis_is_chosen_horizontal(direction: tuple[float, ...], d2: tuple[float, ...]) -> None:
    rod = Rod.straight(1.0, SECTION, direction=direction)
    np.testing.assert_allclose(rod.frames(0.0)[:, 1], d2, atol=0.0)


@given(direction=directions, d2=directions, scale=st.floats(1e-3, 1e3))
def test_only_the_way_of_direction_and_d2_matters(
    direction: tuple[float, ...], d2: tuple[float, ...], scale: float
) -> None:
    assume(np.linalg.norm(np.cross(direction, d2)) > 1e-3)
    rod = Rod.straight(1.0, SECTION, direction=direction, d2=d2)
    long = Rod.straight(1.0, SECTION, direction=scale * np.array(direction), d2=scale * np.array(d2) + direction)
    np.testing.assert_allclose(rod.frames(0.0), long.frames(0.0), atol=1e-12)
    # Built again from what it holds it is the same, digit for digit.
    assert Rod.straight(1.0, SECTION, direction=rod.shape.direction, d2=rod.shape.d2) == rod


def test_shapes_follow_the_shape_of_s() -> None:
    for rod in (Rod.curved(1.0, SECTION, (1, 2, 3), pretwist=1.0), Rod.through(POINTS, SECTION, pretwist=1.0)):
        for shape in ((), (4,), (0,)):
            s = np.full(shape, 0.3)
            assert rod.centerline(s).shape == rod.curvature(s).shape == (*shape, 3)
            assert rod.frames(s).shape == (*shape, 3, 3)


def test_rods_compare_by_what_they_are() -> None:
    rod, same = Rod.through(POINTS, SECTION), Rod.through(np.array(POINTS), SECTION)
    rod.frames(1.0)
    assert rod == same
    assert hash(rod) == hash(same)
    assert rod != Rod.through(POINTS[:-1], SECTION)
    assert pickle.loads(pickle.dumps(rod)) == rod
    assert Rod.straight(1, SECTION, start=np.zeros(3)) == Rod.straight(1.0, SECTION)


@pytest.mark.parametrize("s", [-0.01, 1.01, [0.5, 7.0]])
def test_off_the_rod_is_nothing(s: object) -> None:
    with pytest.raises(ValueError, match=r"s must lie on the rod, between 0 and 1\.0 m, got"):
        Rod.straight(1.0, SECTION).centerline(s)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Rod.straight(0.0, SECTION), r"Rod\.length must be positive, got 0\.0 m"),
        (lambda: Rod.straight(float("nan"), SECTION), r"Rod\.length must be a finite number \[m\], got nan m"),
        (lambda: Rod.straight(1.0, "steel"), r"Rod\.section must be a Section, got 'steel'"),
        (lambda: Rod.straight(1.0, SECTION, start=(0, 0)), r"Rod\.start must have 3 entries \[m\], got \(0, 0\)"),
        (lambda: Rod.straight(1.0, SECTION, direction=(0, 0, 0)), r"Rod\.direction must point somewhere"),
        (lambda: Rod.straight(1.0, SECTION, d2=(2, 0, 0)), r"Rod\.d2 must not be along the rod, got \(2, 0, 0\)"),
        (
            lambda: Rod.straight(1.0, SECTION, pretwist=np.inf),
            r"Rod\.pretwist must be a finite number \[rad/m\], got inf",
        ),
        (lambda: Rod.arc(-1.0, 1.0, SECTION), r"Rod\.radius must be positive, got -1\.0 m"),
        (lambda: Rod.arc(1.0, 0.0, SECTION), r"Rod\.angle must be positive, got 0\.0 rad"),
        (
            lambda: Rod.curved(1.0, SECTION, (0, 0, "x")),
            r"Rod\.curvature\[2\] must be a finite number \[1/m\], got 'x'",
        ),
        (
            lambda: Rod.through([(0, 0, 0)], SECTION),
            r"Rod\.points must be at least two points \[m\], got \[\(0, 0, 0\)\]",
        ),
        (lambda: Rod.through(3.0, SECTION), r"Rod\.points must be at least two points \[m\], got 3\.0"),
        (
            lambda: Rod.through([(0, 0, 0), (1, 0, 0), (1, 0, 0)], SECTION),
            r"Rod\.points\[2\] must lie apart from the point before, got \(1\.0, 0\.0, 0\.0\) m",
        ),
        (
            lambda: Rod.through([(0, 0, 0), (1, 0, 0), (0, 0, 0)], SECTION),
            r"Rod\.points must lead along a smooth curve, got points that turn back on the spot",
        ),
        (lambda: Rod.through([(0, 0, 0), (0, 1, 0)], SECTION, d2=(0, 1, 0)), r"Rod\.d2 must not be along the rod"),
    ],
)
def test_what_cannot_be_is_refused_in_words(make: Callable[[], Rod], message: str) -> None:
    with pytest.raises(SceneError, match=message):
        make()
