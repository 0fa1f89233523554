"""Centrelines between nodes, their closest points, and which of them are near each other."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from dolfinrod.scene.meeting import Strands
from dolfinrod.scene.meeting.curves import Spans
from dolfinrod.scene.meeting.neighbours import Neighbours
from dolfinrod.scene.meeting.projection import closest, opposite
from tests.scenes import largest

Array = NDArray[np.float64]
EPS = float(np.finfo(float).eps)

RADIUS, HALO = 0.05, 0.01
# No two elements alike.
S = np.array([0.0, 0.11, 0.25, 0.42, 0.5, 0.68, 0.83, 1.0])
every_degree = pytest.mark.parametrize("k", [1, 2, 3, 4, 5])
PARABOLA = np.random.default_rng(0).normal(size=(3, 3))


def bundle(seed: int, n_rods: int) -> tuple[Strands, Array]:
    """Bent rods anywhere in a ball."""
    rng = np.random.default_rng(seed)
    along, aside, place = rng.normal(size=(3, n_rods, 1, 3)) * np.array([1.0, 0.3, 0.1])[:, None, None, None]
    along = along / np.linalg.norm(along, axis=-1, keepdims=True)
    s = (S - 0.5)[:, None]
    return Strands.smooth([S] * n_rods, np.full(n_rods, RADIUS)), (place + s * along + s**2 * aside).reshape(-1, 3)


def sampled(spans: Spans, n: int) -> tuple[NDArray[np.intp], Array]:
    """Points of all spans."""
    every = np.arange(len(spans.rod))
    return np.repeat(every, n), np.tile(np.linspace(0.0, 1.0, n), len(every))


def test_cubics_have_no_kinks_and_follow_parabolas():
    spans = Spans(Strands.smooth([S], np.array([RADIUS])))
    at = sampled(spans, 5)
    exact = spans.along(*at)[:, None] ** np.arange(3) @ PARABOLA
    assert largest(spans.course(S[:, None] ** np.arange(3) @ PARABOLA).place(*at) - exact) <= 100 * EPS
    course = spans.course(np.random.default_rng(1).normal(size=(len(S), 3)))
    cells, none = np.arange(len(S) - 1), np.zeros(len(S) - 1)
    long = np.diff(S)[:, None]
    end, start = course.place(cells, none + 1.0), course.place(cells, none)
    slope_end, slope = (opposite(course.curves, cells, none + at, cells, none + at)[3] for at in (1.0, 0.0))
    assert largest(end[:-1] - start[1:]) <= 100 * EPS
    assert largest((slope_end / long)[:-1] - (slope / long)[1:]) <= 1e4 * EPS


def elements(k: int, ends: Array) -> tuple[Strands, Array]:
    """One rod of elements of degree k between some ends, and the arc lengths of its nodes."""
    places, n = 0.5 - 0.5 * np.cos(np.pi * np.arange(k + 1) / k), len(ends) - 1
    cells = np.stack([ends[:-1], ends[1:]], axis=1)
    nodes = k * np.arange(n)[:, None] + np.arange(k + 1)
    s = np.empty(n * k + 1)
    s[nodes] = ends[:-1, None] + np.diff(ends)[:, None] * places
    return Strands.lagrange(np.zeros(n, dtype=int), cells, nodes, places, np.array([RADIUS])), s


@every_degree
def test_elements_are_polynomials_through_their_nodes(k):
    lines, s = elements(k, S)
    spans = Spans(lines)
    assert len(spans.rod) == (len(S) - 1) * k
    curve = np.random.default_rng(0).normal(size=(k + 1, 3))
    at = sampled(spans, 5)
    exact = spans.along(*at)[:, None] ** np.arange(k + 1) @ curve
    assert largest(spans.course(s[:, None] ** np.arange(k + 1) @ curve).place(*at) - exact) <= 1e-10 * largest(exact)
    assert largest(spans.weights(*at).sum(axis=1) - 1.0) <= 1e3 * EPS


@every_degree
def test_elements_have_no_kinks_where_they_meet(k):
    lines, s = elements(k, S)
    x = np.random.default_rng(1).normal(size=(len(s), 3))
    c, long = np.einsum("caq,cai->cqi", lines.shape, x[lines.nodes]), np.diff(S)[:, None]
    power = np.arange(c.shape[1])
    np.testing.assert_allclose(c.sum(axis=1), x[k::k], atol=1e3 * EPS)
    slope, slope_end = c[:, 1] / long, np.einsum("q,cqi->ci", power, c) / long
    np.testing.assert_allclose(slope_end[:-1], slope[1:], atol=1e-11 * largest(slope))
    # At the ends of the rod there is nothing beside them to agree with.
    first = elements(k, S[:2])[0]
    alone = np.einsum("caq,cai->cqi", first.shape, x[first.nodes])
    np.testing.assert_allclose(c[0, 1], alone[0, 1], atol=1e-11 * largest(slope))


@every_degree
@pytest.mark.parametrize("power", [0, 1], ids=["even", "growing evenly"])
def test_a_load_is_dealt_out_as_by_the_elements_alone(k, power):
    """Weights of the nodes in ∫ ξ^power x ds over each: those of one element by itself, added up over all."""
    lines, s = elements(k, S)
    alone = [elements(k, S[i : i + 2])[0] for i in range(len(S) - 1)]
    found, exact = np.zeros((2, len(s)))
    moment = 1.0 / (1.0 + power + np.arange(lines.shape.shape[2]))
    np.add.at(found, lines.nodes, np.diff(S)[:, None] * (lines.shape @ moment))
    for i, one in enumerate(alone):
        np.add.at(exact, one.nodes[0] + k * i, (S[i + 1] - S[i]) * (one.shape[0] @ moment))
    np.testing.assert_allclose(found, exact, atol=1e3 * EPS)


@pytest.mark.parametrize("k", [1, 3, 5])
def test_tangents_where_odd_elements_meet_are_an_order_better_than_theirs(k):
    """Those of a curve one degree higher are exact there."""
    lines, s = elements(k, S)
    c = np.einsum("caq,ca->cq", lines.shape, (s ** (k + 1))[lines.nodes])
    np.testing.assert_allclose(c[1:, 1] / np.diff(S)[1:], (k + 1) * S[1:-1] ** k, atol=1e-11)


def test_closest_points_are_the_closest():
    lines, x = bundle(2, 1)
    spans = Spans(lines)
    course, points = spans.course(x), np.random.default_rng(3).normal(scale=0.3, size=(200, 3))
    every = course.place(*sampled(spans, 401))
    nearest = np.linalg.norm(points[:, None] - every, axis=2)
    begin = nearest.argmin(axis=1)
    spots = zip(points, sampled(spans, 401)[0][begin], sampled(spans, 401)[1][begin], strict=True)
    span, ξ, _ = (
        np.array(part) for part in zip(*(closest(course.curves, tuple(x), *at) for x, *at in spots), strict=True)
    )
    found = np.linalg.norm(points - course.place(span, ξ), axis=1)
    assert (found <= nearest.min(axis=1) + 100 * EPS).all()
    assert largest(found - nearest.min(axis=1)) <= 1e-3


@pytest.mark.parametrize("seed", range(3))
def test_neighbours_are_all_that_may_touch(seed):
    lines, x = bundle(seed, 8)
    spans = Spans(lines)
    every = np.ones(len(spans.rod), dtype=bool)
    near = Neighbours(spans, HALO, every, every)
    near.renew(x)
    points = spans.course(x).place(*sampled(spans, 21)).reshape(len(every), 21, 3)
    apart = np.linalg.norm(points[:, None, :, None] - points[None, :, None], axis=-1).min(axis=(2, 3))
    touch = (apart < 2 * RADIUS + HALO) & (spans.rod[:, None] != spans.rod)
    listed = np.zeros_like(touch)
    listed[near.a, near.b] = True
    assert not (touch & ~listed).any()
    assert touch.any()
    assert not (listed & (apart > 2 * RADIUS + HALO + near.skin + 0.05)).any()
