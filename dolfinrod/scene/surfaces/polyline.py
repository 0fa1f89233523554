"""The polyline that a cross-section is given as: read, and refused where it bounds no wall."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.errors import SceneError, quoted
from dolfinrod.scene.quantity import entries, listed, number

__all__ = ["ROUND_OFF", "Points", "corners", "cross", "dot", "points", "refuse_axis", "refuse_crossings"]

Array = NDArray[np.float64]
Numbers = NDArray[np.intp]
Points = tuple[tuple[float, float], ...]
ROUND_OFF = 16 * float(np.finfo(float).eps)


def points(value: object) -> Points:
    """Two or more pairs of finite numbers.

    Raises:
        SceneError: Anything else.
    """
    given = listed(value)
    if len(given) < 2:
        raise SceneError(f"must have at least 2 points (z, y) [m], got {quoted(value)}", field="Groove.profile")
    fields = [f"Groove.profile[{i}]" for i in range(len(given))]
    pairs = [entries(pair, field, "m", 2) for pair, field in zip(given, fields, strict=True)]
    return tuple(
        (number(z, f"{field}[0]", "m"), number(y, f"{field}[1]", "m"))
        for (z, y), field in zip(pairs, fields, strict=True)
    )


def corners(polyline: Array) -> tuple[Array, Numbers]:
    """Both ends of a polyline and its corners; points on straight flanks are left out.

    Args:
        polyline: Its points, shape (n, 2) [m].

    Returns:
        The points left, shape (m, 2) [m], and their numbers, shape (m,).

    Raises:
        SceneError: Points that coincide, a flank that turns back on the one before.
    """
    edges = np.diff(polyline, axis=0)
    size = np.hypot(edges[:, 0], edges[:, 1])
    if not size.all():
        i = int(np.argmin(size)) + 1
        raise SceneError(f"must not repeat the point before, got {_spoken(polyline[i])}", field=f"Groove.profile[{i}]")
    along = edges / size[:, None]
    straight = np.abs(cross(along[:-1], along[1:])) <= ROUND_OFF
    back = straight & (dot(along[:-1], along[1:]) < 0.0)
    if back.any():
        i = int(np.argmax(back)) + 1
        raise SceneError(f"must not turn straight back, got {_spoken(polyline[i])}", field=f"Groove.profile[{i}]")
    kept = np.flatnonzero(np.hstack([True, ~straight, True]))
    return polyline[kept], kept


def refuse_crossings(start: Array, along: Array, size: Array, numbers: Numbers) -> None:
    """No flank meets another but its neighbours, the endless ones included.

    Args:
        start: First point of each, shape (m, 2) [m].
        along: Unit vectors, shape (m, 2).
        size: Lengths, shape (m,) [m].
        numbers: Of the points at their ends, shape (m + 1,).

    Raises:
        SceneError: Two that do.
    """
    first, last = np.zeros(len(size)), size.copy()
    first[0], last[-1] = -np.inf, np.inf
    i, j = np.triu_indices(len(size), 2)
    aslant = np.abs(cross(along[i], along[j])) > ROUND_OFF
    i, j = i[aslant], j[aslant]
    sine, apart = cross(along[i], along[j]), start[j] - start[i]
    s, u = cross(apart, along[j]) / sine, cross(apart, along[i]) / sine
    (meet,) = np.nonzero((s >= first[i]) & (s <= last[i]) & (u >= first[j]) & (u <= last[j]))
    if len(meet):
        a, b = i[meet[0]], j[meet[0]]
        message = (
            f"must not meet itself, got {_spoken(start[a] + s[meet[0]] * along[a])} on the flanks from point"
            f" {numbers[a]} to {numbers[a + 1]} and from {numbers[b]} to {numbers[b + 1]}; the first and the last"
            " flank go on without end"
        )
        raise SceneError(message, field="Groove.profile")


def refuse_axis(polyline: Points, roller: float) -> None:
    """A section around a roller stays off its axis, however far its end flanks go on.

    Raises:
        SceneError: It does not.
    """
    for i, (_, y) in enumerate(polyline):
        if y <= -roller:
            message = f"must be above {-roller!r} m, where the axis of the roller is, got {y!r} m"
            raise SceneError(message, field=f"Groove.profile[{i}][1]")
    for end, beside, way in ((0, 1, -1.0), (-1, -2, 1.0)):
        falls, leads = polyline[end][1] < polyline[beside][1], polyline[end][0] - polyline[beside][0]
        if falls and way * leads > 0.0:
            message = (
                "must not fall outwards at its ends, whose flanks would go on to the axis of the roller, got"
                f" {polyline[end]} m beside {polyline[beside]} m"
            )
            raise SceneError(message, field="Groove.profile")


def dot(a: Array, b: Array) -> Array:
    """a · b in the plane."""
    return np.asarray(a[..., 0] * b[..., 0] + a[..., 1] * b[..., 1])


def cross(a: Array, b: Array) -> Array:
    """a × b in the plane."""
    return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])


def _spoken(point: Array) -> str:
    """A point as it is quoted in a complaint."""
    return f"({point[0]:.6g}, {point[1]:.6g}) m"
