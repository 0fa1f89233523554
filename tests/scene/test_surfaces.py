"""Surfaces: distances, normals and curvatures by laws that hold for all of them and by brute force; what cannot be."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from math import cos, pi, sin, tan

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.typing import ArrayLike, NDArray

import dolfinrod as dr
from dolfinrod.scene.surfaces import Closest, Surface
from tests.scenes import Pose, poses

Array = NDArray[np.float64]

# Of coordinates of some ten metres.
ROUND_OFF = 1e-12
STEP = 1e-6
LIP = dr.Groove([(-1, 0), (0, 0), (0, -1)])
CORNER = dr.Groove([(0, 1), (0, 0), (1, 0)])
# A ledge, an overhang, sharp and blunt corners, a point on a straight flank.
RUGGED = (
    *((-4, 0), (-3, 0), (-1.5, 0), (-1.2, -0.4), (-0.2, -0.4)),
    *((-0.4, -1), (0.3, -1.2), (0.9, 0.3), (1.5, 0.2), (4, 0.2)),
)
# Its tip is near the first corner.
HOOK = ((-3, 0), (0, 0), (0, 3), (-2, 3), (-0.6, 0.8), (-3, 4))
MUSHROOM = ((-3, 0), (-1, 0), (-2, 1), (2, 1), (1, 0), (3, 0))
# A land beside a rib, a groove, a ledge and a deeper groove: what goes on straight comes out of the wall again.
TWO_GROOVES = (
    *((-5, 0), (-4.5, 0), (-4.5, 0.5), (-4, 0.5), (-4, 0), (-3, 0)),
    *((-2, -0.5), (-1, 0), (0, 0), (0, -2), (1, -2), (1, 0), (3, 0)),
)

few = settings(max_examples=30)
seeds = st.integers(0, 2**32 - 1)
vectors = st.tuples(*[st.floats(-3.0, 3.0)] * 3)
places = arrays(float, (10, 3), elements=st.floats(-2.5, 2.5))


def wavy(heights: list[float]) -> dr.Groove:
    """Flanks over equal widths between two lands."""
    inner = zip(np.linspace(-1.5, 1.5, len(heights)), heights, strict=True)
    return dr.Groove([(-3, 0), (-2, 0), *inner, (2, 0), (3, 0)])


def sections() -> st.SearchStrategy[dr.Groove]:
    """Straight grooves along x, of order one, their mouths towards y."""
    slope, size, height = st.floats(0.2, 1.0), st.floats(0.5, 1.5), st.floats(-0.8, 0.8)
    fillet = st.one_of(st.just(0.0), st.floats(0.01, 0.1))
    filleted = st.builds(dr.Groove.v, slope, slope, size, fillet=fillet)
    rugged = st.builds(dr.Groove, st.sampled_from((RUGGED, TWO_GROOVES)), fillet=fillet)
    round_ = st.builds(dr.Groove.round, size, size)
    return st.one_of(st.builds(wavy, st.lists(height, min_size=1, max_size=7)), filleted, rugged, round_)


def rollers() -> st.SearchStrategy[float | None]:
    return st.one_of(st.none(), st.floats(3.0, 30.0))


def at(groove: dr.Groove, pose: Pose, roller: float | None) -> dr.Groove:
    """The same somewhere else, around a roller or not."""
    axes = {"axis": pose.turned((1, 0, 0)), "up": pose.turned((0, 1, 0))}
    return replace(groove, point=pose.placed((0, 0, 0)), roller=roller, **axes)


def surfaces() -> st.SearchStrategy[Surface]:
    """Every kind, anywhere."""
    cylinders = st.builds(
        lambda pose, radius, side: dr.Cylinder(pose.placed((0, 0, 0)), pose.turned((1, 0, 0)), radius, side),
        poses(),
        st.floats(0.5, 3.0),
        st.sampled_from(["outside", "inside"]),
    )
    grooves = st.builds(at, sections(), poses(), rollers())
    return st.one_of(cylinders, grooves, grooves.flatmap(lambda groove: st.sampled_from(groove.faces())))


def scattered(seed: int, surface: Surface, n: int) -> Array:
    """Points around that of a surface."""
    return np.asarray(surface.point) + np.random.default_rng(seed).uniform(-2.5, 2.5, (n, 3))


def assert_close(a: Closest, b: Closest, tolerance: float = ROUND_OFF) -> None:
    for name in ("distance", "normal", "curvature"):
        np.testing.assert_allclose(getattr(a, name), getattr(b, name), atol=tolerance, rtol=tolerance)


def in_section(groove: dr.Groove, points: ArrayLike) -> Closest:
    """What a straight groove along x is to points (z, y)."""
    z, y = np.asarray(points, dtype=float).T
    return groove.closest(np.stack([np.zeros(len(z)), y, z], axis=1))


def outline(groove: dr.Groove, spacing: float, beyond: float) -> Array:
    """Points along a section and beyond its ends, no farther apart, corners rounded by bisectors, shape (n, 2)."""
    corners = np.asarray(groove.profile)
    legs = np.diff(corners, axis=0)
    legs /= np.linalg.norm(legs, axis=1)[:, None]
    knots = [corners[0] - beyond * legs[0]]
    for corner, u, v in zip(corners[1:-1], legs, legs[1:], strict=False):
        knots.append(corner)
        if groove.fillet > 0.0 and u[0] * v[1] - u[1] * v[0] > 1e-9:
            half = 0.5 * np.arccos(np.clip(-u @ v, -1.0, 1.0))
            centre = corner + groove.fillet / np.sin(half) * (v - u) / np.linalg.norm(v - u)
            angles = np.arctan2(-u[0], u[1]) + np.linspace(0.0, pi - 2.0 * half, 40)
            knots[-1:] = list(centre + groove.fillet * np.stack([np.cos(angles), np.sin(angles)], axis=1))
    knots.append(corners[-1] + beyond * legs[-1])
    return np.concatenate([np.linspace(a, b, 2 + int(np.linalg.norm(b - a) / spacing)) for a, b in pairwise(knots)])


@few
@given(surface=surfaces(), places=places)
def test_distance_is_signed_and_the_normal_leads_to_the_wall(surface: Surface, places: Array) -> None:
    x = np.asarray(surface.point) + places
    found = surface.closest(x)
    apart = np.linalg.norm(x[:, None] - x, axis=2)
    assert (np.abs(found.distance[:, None] - found.distance) <= apart + ROUND_OFF).all()
    np.testing.assert_allclose(np.linalg.norm(found.normal, axis=1), 1.0, atol=ROUND_OFF)
    foot = surface.closest(x - found.distance[:, None] * found.normal)
    np.testing.assert_allclose(foot.distance, 0.0, atol=ROUND_OFF)
    limit = ROUND_OFF * (1.0 + np.abs(found.curvature).max(axis=(1, 2)))
    assert (np.abs(found.curvature - found.curvature.transpose(0, 2, 1)).max(axis=(1, 2)) <= limit).all()
    assert (np.abs(np.einsum("nij,nj->ni", found.curvature, found.normal)).max(axis=1) <= limit).all()


@few
@given(surface=surfaces(), seed=seeds)
def test_normal_and_curvature_are_derivatives(surface: Surface, seed: int) -> None:
    x = scattered(seed, surface, 60)
    here = surface.closest(x)
    size = 1.0 + np.abs(here.curvature).max(axis=(1, 2))
    gradient, hessian, smooth = np.zeros((60, 3)), np.zeros((60, 3, 3)), np.ones(60, dtype=bool)
    for i, e in enumerate(STEP * np.eye(3)):
        ahead, behind = surface.closest(x + e), surface.closest(x - e)
        gradient[:, i] = (ahead.distance - behind.distance) / (2 * STEP)
        hessian[:, :, i] = (ahead.normal - behind.normal) / (2 * STEP)
        for beside in (ahead, behind):
            smooth &= np.abs(beside.normal - here.normal).max(axis=1) <= 2 * STEP * size
            smooth &= np.abs(beside.curvature - here.curvature).max(axis=(1, 2)) <= 1e-3 * size
    # The others are within a step of where two pieces are as near, or hardly farther from a lip than that.
    assert smooth.mean() >= 0.9
    np.testing.assert_allclose(gradient[smooth], here.normal[smooth], atol=1e-7)
    assert (np.abs(hessian - here.curvature).max(axis=(1, 2)) <= 1e-6 * size**2)[smooth].all()


@few
@given(groove=sections(), roller=rollers(), seed=seeds)
def test_distance_is_that_to_points_all_over_the_wall(groove: dr.Groove, roller: float | None, seed: int) -> None:
    spacing, R = 0.05, roller or np.inf
    x = np.random.default_rng(seed).uniform(-1.0, 1.0, (12, 3)) * [1.0, 1.2, 2.5]
    z, y = outline(groove, spacing, 6.0).T
    X = np.arange(-1.7, 1.7, spacing)[:, None]
    wall = np.stack(np.broadcast_arrays(X, y, z), axis=-1)
    above = x[:, 1]
    if roller is not None:
        # The map of the design notes, from the unrolled surface to the arc.
        wall = np.stack(np.broadcast_arrays((R + y) * np.sin(X / R), (R + y) * np.cos(X / R) - R, z), axis=-1)
        above = np.hypot(x[:, 0], x[:, 1] + R) - R
    nearest = np.linalg.norm(x[:, None] - wall.reshape(-1, 3), axis=2).min(axis=1)
    found = replace(groove, roller=roller).closest(x).distance
    sagitta, reach = 0.5 * groove.fillet * (pi / 39) ** 2, 0.5 * spacing * (2.0 + max(0.0, y.max()) / R)
    assert (np.abs(found) <= nearest + sagitta).all()
    assert (nearest <= np.abs(found) + reach + sagitta).all()
    sure = nearest > sagitta
    crossed = (z[:-1] <= x[:, 2:]) != (z[1:] <= x[:, 2:])
    run = np.where(z[1:] == z[:-1], 1.0, z[1:] - z[:-1])
    over = crossed & (y[:-1] + (x[:, 2:] - z[:-1]) / run * (y[1:] - y[:-1]) > above[:, None])
    np.testing.assert_array_equal((found > 0.0)[sure], (over.sum(axis=1) % 2 == 0)[sure])


@few
@given(groove=sections(), roller=rollers(), places=places, θ=vectors, way=vectors)
def test_a_moved_groove_is_one_built_there(
    groove: dr.Groove, roller: float | None, places: Array, θ: tuple[float, ...], way: tuple[float, ...]
) -> None:
    resting = replace(groove, roller=roller)
    moved = dr.WallMotion(way, θ, dr.Steady(), about=(1, 0, -1)).pose(1.0, 1.0)
    x = moved.out(places)
    here, there = resting.closest(places), at(groove, Pose(moved.Q, moved.c), roller).closest(x)
    np.testing.assert_allclose(there.distance, here.distance, atol=ROUND_OFF)
    foot = moved.back(x - there.distance[:, None] * there.normal)
    np.testing.assert_allclose(resting.closest(foot).distance, 0.0, atol=ROUND_OFF)


@few
@given(groove=sections(), roller=rollers(), places=places, way=st.floats(-7.0, 7.0))
def test_a_groove_runs_in_itself(groove: dr.Groove, roller: float | None, places: Array, way: float) -> None:
    if roller is None:
        motion = dr.WallMotion((way, 0, 0), history=dr.Steady())
    else:
        motion = dr.WallMotion(rotation=(0, 0, way), about=(0, -roller, 0), history=dr.Steady())
    resting = replace(groove, roller=roller)
    before, after = resting.closest(places), resting.closest(motion.pose(1.0, 1.0).out(places))
    np.testing.assert_allclose(after.distance, before.distance, atol=ROUND_OFF)


@few
@given(seed=seeds, fillet=st.floats(0.0, 1e-3), roller=st.one_of(st.none(), st.floats(1e-3, 1.0)))
def test_the_intermediate_groove_is_its_mirror_image(seed: int, fillet: float, roller: float | None) -> None:
    groove, flip = dr.Groove.intermediate(fillet=fillet, roller=roller), np.array([1.0, 1.0, -1.0])
    x = 1e-3 * scattered(seed, groove, 30)
    here, there = groove.closest(x), groove.closest(x * flip)
    np.testing.assert_allclose(there.distance, here.distance, atol=1e-15)
    np.testing.assert_allclose(there.normal, here.normal * flip, atol=1e-6)


@pytest.mark.parametrize(
    ("groove", "inner"),
    [
        (dr.Groove.intermediate(), [(-1.5, 0), (0, -0.402), (1.5, 0)]),
        (dr.Groove.lateral(), [(-1.5, 0), (0, -0.402), (0.108, 0)]),
        (dr.Groove.lateral_steep(), [(-1.108, 0), (-1.0, -0.402), (0, -0.402), (0.108, 0)]),
    ],
)
def test_grooves_of_the_design_notes(groove: dr.Groove, inner: list[tuple[float, float]]) -> None:
    """Their section 6.2, where numbers are rounded to 1 µm."""
    np.testing.assert_allclose(groove.profile[1:-1], 1e-3 * np.asarray(inner), atol=5e-7)
    assert groove.profile[0][1] == groove.profile[-1][1] == 0.0


@given(β=st.floats(0.1, 1.4), half_width=st.floats(1e-4, 1e-2))
def test_a_lateral_groove_with_equal_flanks_is_an_intermediate_one(β: float, half_width: float) -> None:
    assert dr.Groove.lateral(β, β, half_width) == dr.Groove.intermediate(β, half_width)
    assert dr.Groove.v(β, β, half_width, half_width * tan(β)) == dr.Groove.intermediate(β, half_width)


@few
@given(places=places, pose=poses())
def test_a_flat_groove_is_a_plane_and_around_a_roller_a_cylinder(places: Array, pose: Pose) -> None:
    x, flat = pose.origin + places @ pose.Q.T, dr.Groove([(-1, 0), (0, 0), (2, 0)])
    plane = dr.Plane(pose.placed((0, 0, 0)), pose.turned((0, 1, 0)))
    assert_close(at(flat, pose, None).closest(x), plane.closest(x))
    roller = dr.Cylinder(pose.placed((0, -5, 0)), pose.turned((0, 0, 1)), 5.0)
    assert_close(at(flat, pose, 5.0).closest(x), roller.closest(x))


@few
@given(places=places, pose=poses(), radius=st.floats(1e3, 1e6))
def test_a_plane_is_the_limit_of_wide_cylinders_and_rollers(places: Array, pose: Pose, radius: float) -> None:
    x, up = pose.origin + places @ pose.Q.T, pose.turned((0, 1, 0))
    plane = dr.Plane(pose.placed((0, 0, 0)), up).closest(x)
    below, above = (pose.placed((0, y, 0)) for y in (-radius, radius))
    for wide in (
        dr.Cylinder(below, pose.turned((0, 0, 1)), radius),
        dr.Cylinder(above, pose.turned((0, 0, 1)), radius, side="inside"),
        at(dr.Groove([(-1, 0), (1, 0)]), pose, radius),
    ):
        found = wide.closest(x)
        # The sagitta over the farthest point, and the normal there.
        np.testing.assert_allclose(found.distance, plane.distance, atol=10.0 / radius + 1e-15 * radius)
        np.testing.assert_allclose(found.normal, plane.normal, atol=5.0 / radius)
        np.testing.assert_allclose(found.curvature, 0.0, atol=1.1 / radius)


@few
@given(radius=st.floats(0.5, 2.0), depth=st.floats(0.1, 3.0), part=st.floats(-0.99, 0.99), height=st.floats(0.01, 1.5))
def test_a_round_groove_is_a_cylinder_from_within(radius: float, depth: float, part: float, height: float) -> None:
    groove = dr.Groove.round(radius, depth)
    tube = dr.Cylinder((0, radius - depth, 0), (1, 0, 0), radius, side="inside")
    half = np.arccos(max(0.0, 1.0 - depth / radius))
    x = np.array([[0.3, radius - depth, 0.0]]) + height * radius * np.array([[0, -cos(part * half), sin(part * half)]])
    assert_close(groove.closest(x), tube.closest(x), 1e-10)


@pytest.mark.parametrize(
    ("groove", "point", "distance", "normal", "curvature"),
    [
        (LIP, (3, 4), 5.0, (0.6, 0.8), 0.2),
        (LIP, (-3, 4), 4.0, (0, 1), 0.0),
        (LIP, (2, -9), 2.0, (1, 0), 0.0),
        (LIP, (-0.5, -0.2), -0.2, (0, 1), 0.0),
        (CORNER, (2, 1), 1.0, (0, 1), 0.0),
        (CORNER, (1, 2), 1.0, (1, 0), 0.0),
        (CORNER, (-3, -4), -5.0, (0.6, 0.8), -0.2),
        (replace(CORNER, fillet=2.0), (2, 2), 2.0, None, None),
        (replace(CORNER, fillet=2.0), (1, 1), 2 - 2**0.5, (0.5**0.5, 0.5**0.5), -(0.5**0.5)),
        (replace(CORNER, fillet=2.0), (-1, -2), -3.0, (0.6, 0.8), -0.2),
    ],
)
def test_lips_and_corners(
    groove: dr.Groove,
    point: tuple[float, float],
    distance: float,
    normal: tuple[float, float] | None,
    curvature: float | None,
) -> None:
    found = in_section(groove, [point])
    np.testing.assert_allclose(found.distance, distance, rtol=ROUND_OFF)
    if normal is not None:
        np.testing.assert_allclose(found.normal[0, [2, 1]], normal, atol=ROUND_OFF)
        np.testing.assert_allclose(np.trace(found.curvature[0]), curvature, atol=ROUND_OFF)


def test_a_thin_fibre_feels_a_smooth_wall_in_a_filleted_corner() -> None:
    """Where it lies against the wall from lip to lip the normal turns by |Δn| ≤ |Δx|/(fillet − radius) at most."""
    fillet, radius, jumps = 1.5e-4, 1e-5, {}
    for groove in (dr.Groove.lateral(), dr.Groove.lateral(fillet=fillet)):
        wall = outline(groove, 2e-6, 0.0)
        bottom = wall[(wall[:, 1] < -5e-5) & (np.abs(wall[:, 0]) < 1.4e-3)]
        near = in_section(groove, bottom)
        x = bottom + (radius - near.distance)[:, None] * near.normal[:, [2, 1]]
        lying = in_section(groove, x)
        turn = np.linalg.norm(np.diff(lying.normal, axis=0), axis=1)
        way = np.linalg.norm(np.diff(x, axis=0), axis=1)
        jumps[groove.fillet] = (turn - way / (fillet - radius)).max()
    np.testing.assert_allclose(lying.distance, radius, rtol=1e-9)
    assert jumps[fillet] <= 1e-9
    assert jumps[0.0] >= 1.0


@pytest.mark.parametrize(
    "surface",
    [
        dr.Cylinder((1, 2, 3), (0, 1, 0), 2.0),
        dr.Cylinder((1, 2, 3), (1, 1, 1), 2.0, side="inside"),
        dr.Groove([(-1, 0), (1, 0)], point=(1, 2 + 4.0, 3), roller=4.0),
        dr.Groove.round(2.0, point=(1, 2, 3)),
        dr.Groove([(-1, 0), (0, 0), (0, -1)], point=(1, 2, 3)),
        dr.Groove([(0, 1), (0, 0), (1, 0)], point=(1, 2, 3)),
    ],
)
def test_axes_lips_and_centres_have_a_normal(surface: Surface) -> None:
    x = np.array([[1.0, 2.0, 3.0]]) + np.array([0.0, 1e-300, -1e-17])[:, None]
    found = surface.closest(x)
    np.testing.assert_allclose(np.linalg.norm(found.normal, axis=1), 1.0, atol=ROUND_OFF)
    np.testing.assert_array_equal(found.curvature, 0.0)


@few
@given(places=places, roller=rollers())
def test_points_on_straight_flanks_change_nothing(places: Array, roller: float | None) -> None:
    few_points, more = [(-2, 0), (-1, 0), (0, -1), (3, 2)], [(-2, 0), (-1.5, 0), (-1, 0), (0, -1), (1, 0), (3, 2)]
    assert_close(*(dr.Groove(points, fillet=0.2, roller=roller).closest(places) for points in (few_points, more)))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"axis": (0, 0, 0)}, r"^Cylinder\.axis must not be zero, got \(0, 0, 0\)"),
        ({"radius": -2.0}, r"^Cylinder\.radius must be positive, got -2\.0 m"),
        ({"side": "left"}, r'^Cylinder\.side must be "outside" or "inside", got \'left\''),
        ({"side": ["inside"]}, r'^Cylinder\.side must be "outside" or "inside", got \[\'inside\'\]'),
        ({"motion": 3}, r"^Cylinder\.motion must be WallMotion or None, got 3"),
    ],
)
def test_cylinders_that_cannot_be(changes: dict[str, object], message: str) -> None:
    with pytest.raises(dr.SceneError, match=message):
        dr.Cylinder(**{"point": (0, 0, 0), "axis": (0, 0, 1), "radius": 1.0, **changes})


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"profile": "V"}, r"^Groove\.profile must have at least 2 points \(z, y\) \[m\], got 'V'"),
        ({"profile": [(0, 0)]}, r"^Groove\.profile must have at least 2 points"),
        ({"profile": [(0, 0), (1, 0, 0)]}, r"^Groove\.profile\[1\] must have 2 entries \[m\], got \(1, 0, 0\)"),
        ({"profile": [(0, 0), (1, np.nan)]}, r"^Groove\.profile\[1\]\[1\] must be a finite number \[m\], got nan m"),
        (
            {"profile": [(0, 0), (1, 0), (1, 0)]},
            r"^Groove\.profile\[2\] must not repeat the point before, got \(1, 0\)",
        ),
        ({"profile": [(0, 0), (2, 0), (1, 0)]}, r"^Groove\.profile\[1\] must not turn straight back, got \(2, 0\) m"),
        (
            {"profile": [(0, 0), (1, 0), (1, 1), (0.5, -1)]},
            r"^Groove\.profile must not meet itself, got \(0\.75, 0\) m on the flanks from point 0 to 1 and",
        ),
        ({"profile": [(0, 0), (1, 0), (1, 1), (0.9, 0.5)]}, r"got \(0\.8, 0\) m .* go on without end"),
        ({"fillet": -1}, r"^Groove\.fillet must not be negative, got -1\.0 m"),
        (
            {"fillet": 1.0},
            r"^Groove\.fillet must be at most 0\.75 m for the flank from point 2 to 3 of the profile, got 1\.0 m",
        ),
        ({"fillet": 0.5, "profile": HOOK}, r"^Groove\.fillet must leave room at point 1 of the profile, got 0\.5 m"),
        ({"roller": 0}, r"^Groove\.roller must be positive, got 0\.0 m"),
        (
            {"roller": 0.5},
            r"^Groove\.profile\[2\]\[1\] must be above -0\.5 m, where the axis of the roller is, got -1\.0",
        ),
        ({"roller": 9, "profile": [(0, -1), (1, 0), (2, 0)]}, r"^Groove\.profile must not fall outwards at its ends"),
        ({"up": (2, 0, 0)}, r"^Groove\.up must not be along Groove\.axis \(1\.0, 0\.0, 0\.0\), got \(2, 0, 0\)"),
        ({"axis": (0, 0, 0)}, r"^Groove\.axis must not be zero"),
        ({"point": (0, 0)}, r"^Groove\.point must have 3 entries \[m\], got \(0, 0\)"),
        ({"motion": (0, 0, 1)}, r"^Groove\.motion must be WallMotion or None, got \(0, 0, 1\)"),
    ],
)
def test_grooves_that_cannot_be(changes: dict[str, object], message: str) -> None:
    with pytest.raises(dr.SceneError, match=message):
        dr.Groove(**{"profile": [(-2, 0), (-1, 0), (-1, -1), (0.5, -1), (0.5, 0), (2, 0)], **changes})


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((15, 1, 1), r"^Groove\.beta_left must be above 0 and at most π/2 rad, got 15\.0 rad"),
        ((1, 0, 1), r"^Groove\.beta_right must be above 0 and at most π/2 rad, got 0\.0 rad"),
        ((1, 1, -1), r"^Groove\.half_width must be positive, got -1\.0 m"),
        ((1, 1, 1, 2), r"^Groove\.depth must be at most 1\.55741 m, where the flanks meet, got 2\.0 m"),
        ((pi / 2, 1, 1), r"^Groove\.depth is missing"),
    ],
)
def test_sections_that_cannot_be(arguments: tuple[float, ...], message: str) -> None:
    with pytest.raises(dr.SceneError, match=message):
        dr.Groove.v(*arguments)


def test_a_box_has_upright_walls() -> None:
    found = in_section(dr.Groove.v(pi / 2, pi / 2, 2.0, 1.0), [(-1.75, -0.5), (-0.125, -0.5), (-1.0, -0.75)])
    np.testing.assert_allclose(found.distance, 0.25 * np.array([1.0, 0.5, 1.0]))


def test_up_need_not_be_across_the_groove() -> None:
    leaning = dr.Groove.lateral(axis=(0, 0, 2), up=(1e-3, 0, 5))
    np.testing.assert_allclose([leaning.axis, leaning.up], [(0, 0, 1), (1, 0, 0)], atol=1e-16)


@few
@given(groove=sections(), roller=rollers(), places=places)
def test_the_nearest_of_its_faces_is_the_groove(groove: dr.Groove, roller: float | None, places: Array) -> None:
    """Where rods may be, the least distance of all; and what is behind the wall is behind one of them."""
    sharp = replace(groove, fillet=0.0, roller=roller)
    whole, faces = sharp.closest(places), [face.closest(places) for face in sharp.faces()]
    distances = np.sort([face.distance for face in faces], axis=0)
    free = whole.distance > 0.0
    np.testing.assert_allclose(distances[0, free], whole.distance[free], atol=ROUND_OFF)
    assert (distances[0, ~free] <= ROUND_OFF).all()
    alone = free & (distances[1] > distances[0] + ROUND_OFF) if len(faces) > 1 else free
    near = np.argmin([face.distance for face in faces], axis=0)
    for i in np.flatnonzero(alone):
        np.testing.assert_allclose(faces[near[i]].normal[i], whole.normal[i], atol=1e-6)


@few
@given(groove=sections(), roller=rollers(), places=places)
def test_rods_thicker_than_a_fillet_do_not_feel_it(groove: dr.Groove, roller: float | None, places: Array) -> None:
    rounded, sharp = (replace(groove, fillet=fillet, roller=roller) for fillet in (groove.fillet, 0.0))
    distance = sharp.closest(places).distance
    thick = distance >= groove.fillet
    np.testing.assert_allclose(rounded.closest(places).distance[thick], distance[thick], atol=ROUND_OFF)
    assert [face.profile for face in rounded.faces()] == [face.profile for face in sharp.faces()]


def test_faces_are_cut_where_the_wall_turns_to_its_free_side() -> None:
    motion = dr.WallMotion(velocity=(1.0, 0.0, 0.0))
    groove = dr.Groove([(-2, 0), (-1, 0), (0, -1), (1, -1), (1, 0), (2, 0)], fillet=0.1, motion=motion)
    left, bottom, right = groove.faces()
    assert left == dr.Groove([(-2, 0), (-1, 0), (0, -1)], motion=motion)
    assert bottom == dr.Groove([(0, -1), (1, -1)], motion=motion)
    assert right == dr.Groove([(1, -1), (1, 0), (2, 0)], motion=motion)
    assert LIP.faces() == (LIP,)


@pytest.mark.parametrize(("profile", "flank"), [(HOOK, "2 to 3"), (MUSHROOM, "1 to 4")])
def test_faces_that_cannot_be(profile: tuple[tuple[float, float], ...], flank: str) -> None:
    with pytest.raises(dr.SceneError, match=f"^Groove.profile must have faces .* from point {flank} does not"):
        dr.Groove(profile).faces()


def in_corner(groove: dr.Groove, surfaces: Sequence[Surface], law: dr.Penalty | dr.AugmentedLagrangian) -> dr.Scene:
    """A rod that lies in its deepest corner, just touching both flanks, pressed down by 3 N/m and free across."""
    corner, radius = int(np.argmin([y for _, y in groove.profile])), 0.01
    before, at, after = np.asarray(groove.profile)[corner - 1 : corner + 2]
    normals = [np.array([-y, z]) / np.hypot(z, y) for z, y in (at - before, after - at)]
    z, y = at + np.linalg.solve(normals, [radius + law.g_0] * 2)
    section = dr.Section(EA=4e3, GA=1.5e3, GJ=0.8, EI=1.0, radius=radius)
    return dr.Scene(
        [dr.Rod.straight(1.0, section, start=(0.0, y, z), direction=(1, 0, 0))],
        [dr.Guide("start", free={"y", "z", "ry", "rz"})],
        [dr.LineForce((0.0, -3.0, 0.0))],
        [dr.Contact(surface, law) for surface in surfaces],
    )


@pytest.mark.parametrize("law", [dr.Penalty(2e4, 1e-3), dr.AugmentedLagrangian(2e4, 1e-9)])
@pytest.mark.parametrize(("left", "right"), [(pi / 12, pi / 12), (pi / 12, 5 * pi / 12), (0.4, 0.9)])
def test_each_flank_of_a_corner_carries_its_part(
    left: float, right: float, law: dr.Penalty | dr.AugmentedLagrangian
) -> None:
    """C4 of the design notes for any slopes: N₁ sin β₁ = N₂ sin β₂, N₁ cos β₁ + N₂ cos β₂ = q."""
    groove = dr.Groove.v(left, right, 0.1)
    result = dr.solve(in_corner(groove, groove.faces(), law), elements=2, kinematics=dr.Spatial())
    first, second = (contact.rods[0].pressure[-1] for contact in result.contacts)
    np.testing.assert_allclose(first, 3.0 * sin(right) / sin(left + right), rtol=1e-8)
    np.testing.assert_allclose(second, 3.0 * sin(left) / sin(left + right), rtol=1e-8)
    if left == right:
        np.testing.assert_allclose(first, 3.0 / (2.0 * cos(left)), rtol=1e-8)


def test_a_corner_too_sharp_for_its_rod_is_refused() -> None:
    """Radius 1 cm, contact from a gap of 1 mm on: both flanks are met at once where the corner is no wider."""
    law, sharp = dr.Penalty(2e4, 1e-3), dr.Groove.v(0.4, 0.9, 0.1)
    for groove in (sharp, replace(sharp, fillet=0.011)):
        with pytest.raises(dr.SceneError) as caught:
            in_corner(sharp, [groove], law)
        assert caught.value.field == "contacts[0].surface.fillet"
        assert caught.value.message == (
            "must be above 0.011 m, since a rod of radius 0.01 m at a gap of 0.001 m touches both flanks of a sharper"
            f" corner, got {groove.fillet!r} m: give Groove(fillet=…), or one Contact for each of its faces()"
        )
    ridge = replace(LIP, point=(0.0, -2.0, 0.0))
    assert in_corner(sharp, [replace(sharp, fillet=0.0111), ridge, *sharp.faces()], law)


def test_each_flank_carries_its_part_around_a_roller() -> None:
    """A rope in a corner, a quarter round, pulled by 1 N at both ends: sin β₁ ∫N₁ = sin β₂ ∫N₂, and √2 N in all."""
    left, right, radius = 0.4, 0.9, 1e-3
    groove = dr.Groove.v(left, right, 0.02, axis=(1, 0, 0), up=(0, 1, 0), roller=1.0)
    normals = [(sin(left), cos(left)), (-sin(right), cos(right))]
    z, y = np.asarray(groove.profile[2]) + np.linalg.solve(normals, [radius] * 2)
    section, ρ, c = dr.Section(EA=1e4, GA=4e3, GJ=1e-3, EI=1e-3, radius=radius), 1.0 + y, cos(pi / 4)
    rope = dr.Rod.arc(ρ, pi / 2, section, start=(-ρ * c, ρ * c - 1.0, z), direction=(c, c, 0), towards=(c, -c, 0))
    scene = dr.Scene(
        [rope],
        [dr.Guide(rope.length / 2, free={"y", "z", "ry", "rz"})],
        [dr.PointForce((-c, -c, 0), "start"), dr.PointForce((c, -c, 0), "end")],
        [dr.Contact(face, dr.Penalty(1e5)) for face in groove.faces()],
    )
    result = dr.solve(scene, elements=8, kinematics=dr.Spatial())
    first, second = (contact.rods[0].share @ contact.rods[0].pressure[-1] for contact in result.contacts)
    assert first * sin(left) == pytest.approx(second * sin(right), rel=1e-8)
    np.testing.assert_allclose(sum(contact.force[-1] for contact in result.contacts), (0, 2 * c, 0), atol=1e-8)
