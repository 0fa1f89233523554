"""The spots at which rods touch, as a result tells of them."""

from __future__ import annotations

from dataclasses import fields

import numpy as np
from numpy.typing import NDArray

from dolfinrod.meetings import Meetings
from dolfinrod.scene.meeting.curves import Spans
from dolfinrod.scene.meeting.pressed import Pressed
from dolfinrod.scene.meeting.spots import GAUSS

__all__ = ["least", "record"]

Array = NDArray[np.float64]
Integers = NDArray[np.intp]

# Between Gauss points the least gap is looked for along the polynomial through all of them, at so many places.
LOOKS, POWERS = 33, np.arange(len(GAUSS[0]))
THROUGH = np.linspace(GAUSS[0][0], GAUSS[0][-1], LOOKS)[:, None] ** POWERS @ np.linalg.inv(GAUSS[0][:, None] ** POWERS)


def _gather(nodes: Integers, values: Array, n_nodes: int) -> Array:
    """Sums at nodes, shape (n_nodes, 3), of values of shape (..., 3) given for nodes of shape (...)."""
    at, rows = nodes.ravel(), values.reshape(-1, 3)
    return np.stack([_sums(at, rows[:, i], n_nodes) for i in range(3)], axis=1)


def _sums(at: Integers, values: Array, n: int) -> Array:
    """Of values, shape (m,), at each of n places."""
    return np.bincount(at, values, n).astype(float, copy=False)


def record(spans: Spans, pressed: Pressed, x: Array, traction: Array, state: NDArray[np.int8]) -> Meetings:
    """Points summed up span by span of the one rod and rod by rod of the other, weighted by their loads.

    Args:
        spans: The rods.
        pressed: Points in contact.
        x: Nodes where the loads act, shape (n_nodes, 3) [m].
        traction: Friction at the points, shape (n, 3) [N/m].
        state: 1 sticking or 2 sliding, shape (n,).

    Returns:
        One row a spot under load: one that damping alone keeps from any is left out.
    """
    a, b = pressed.a, pressed.b
    _, first, spot = np.unique(a * len(spans.radius) + spans.rod[b], return_index=True, return_inverse=True)
    n, weight = int(spot.max(initial=-1)) + 1, pressed.length * pressed.p
    load = _sums(spot, weight, n)
    share = np.divide(weight, load[spot], out=np.zeros_like(weight), where=load[spot] > 0.0)

    def mean(values: Array) -> Array:
        return _sums(spot, share * values, n)

    normal = _gather(spot, weight[:, None] * pressed.facing.normal, n)
    rubs = _gather(spot, pressed.length[:, None] * traction, n)
    slides = np.zeros(n, dtype=np.int8)
    np.maximum.at(slides, spot, state)
    met = Meetings(
        spans.rod[a[first]],
        mean(spans.along(a, pressed.u)),
        spans.rod[b[first]],
        mean(spans.along(b, pressed.v)),
        _gather(spot, share[:, None] * _between(pressed, x), n),
        least(pressed, spot, n),
        _sums(spot, 2.0 * pressed.length, n),
        normal + rubs,
        _units(normal),
        rubs,
        slides,
    )
    return met if (load > 0.0).all() else _only(met, load > 0.0)


def _units(vectors: Array) -> Array:
    """Of length one, but for those of none."""
    size = np.linalg.norm(vectors, axis=1)
    return np.asarray(vectors / np.where(size > 0.0, size, 1.0)[:, None])


def _only(met: Meetings, spots: NDArray[np.bool_]) -> Meetings:
    return Meetings(**{column.name: getattr(met, column.name)[spots] for column in fields(met)})


def _between(pressed: Pressed, x: Array) -> Array:
    """Half-way between the surfaces, shape (n, 3) [m]."""
    facing, M = pressed.facing, pressed.facing.h.shape[1] // 2
    x_B = -np.einsum("nm,nmi->ni", facing.h[:, M:], x[facing.nodes[:, M:]])
    arm = 0.5 * (facing.distance - pressed.radius_a + pressed.radius_b)
    return np.asarray(x_B + arm[:, None] * facing.normal)


def least(pressed: Pressed, spot: Integers, n: int) -> Array:
    """Least gaps: at points and, where all between two marks are pressed, between them.

    Args:
        pressed: The points.
        spot: To which of n spots each belongs.
        n: How many there are.

    Returns:
        One for each spot, infinite for one without points [m].
    """
    gap, m, last = np.full(n, np.inf), len(GAUSS[0]), len(GAUSS[0]) - 1
    np.minimum.at(gap, spot, pressed.gap)
    first, index = np.arange(max(len(spot) - last, 0)), pressed.index
    whole = (index[first] % m == 0) & (index[first + last] == index[first] + last)
    first = first[whole & (pressed.a[first] == pressed.a[first + last])]
    np.minimum.at(gap, spot[first], (pressed.gap[first[:, None] + POWERS] @ THROUGH.T).min(axis=1, initial=np.inf))
    return gap
