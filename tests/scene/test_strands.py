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


@pytest.mark.parametrize("k", [1, 2, 3, 4])
def test_elements_are_polynomials_through_their_nodes(k):
    places = 0.5 - 0.5 * np.cos(np.pi * np.arange(k + 1) / k)
    nodes = np.arange(3)[:, None] * k + np.arange(k + 1)
    s = np.unique((np.arange(3)[:, None] + places).ravel().round(12))
    ends = np.stack([np.arange(3.0), np.arange(3.0) + 1.0], axis=1)
    spans = Spans(Strands.lagrange(np.zeros(3, dtype=int), ends, nodes, places, np.array([RADIUS])))
    assert len(spans.rod) == 3 * k
    curve = np.random.default_rng(0).normal(size=(k + 1, 3))
    at = sampled(spans, 5)
    exact = spans.along(*at)[:, None] ** np.arange(k + 1) @ curve
    assert largest(spans.course(s[:, None] ** np.arange(k + 1) @ curve).place(*at) - exact) <= 1e-10 * largest(exact)
    assert largest(spans.weights(*at).sum(axis=1) - 1.0) <= 1e3 * EPS


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
