"""Pieces of surfaces, large enough for the rods beside them, to draw: points and the quadrilaterals between them."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from dolfinrod.scene.surfaces import Surface

    Array = NDArray[np.float64]
    Cells = NDArray[np.int64]

__all__ = ["patch"]

# Of the size of the rods: by how much a patch reaches beyond them.
MARGIN = 0.1
# Quadrilaterals around a circle, and along each flank of a groove with fillets.
SIDES, STRIPS = 96, 24


def patch(surface: Surface, box: Array) -> tuple[Array, Cells]:
    """A piece of a surface at rest; its points lie on it.

    Args:
        surface: What is touched.
        box: Lowest and highest coordinates of the rods, shape (2, 3) [m].

    Returns:
        Points, shape (n, 3) [m], and the points of each quadrilateral, shape (m, 4).
    """
    corners = np.stack(np.meshgrid(*box.T, indexing="ij"), axis=-1).reshape(-1, 3)
    room = MARGIN * float(np.linalg.norm(box[1] - box[0]))
    points = PATCHES[type(surface).__name__](surface, corners, room)
    rows, n = points.shape[:2]
    i = (np.arange(rows - 1)[:, None] * n + np.arange(n - 1)).ravel()
    return points.reshape(-1, 3), np.stack([i, i + 1, i + 1 + n, i + n], axis=1)


def _plane(plane: Any, corners: Array, room: float) -> Array:
    """The rectangle over which the rods lie."""
    point, normal = np.asarray(plane.point), np.asarray(plane.normal)
    along = _across(normal)
    axes = np.stack([along, np.cross(normal, along)])
    (u, v), (U, V) = _reach((corners - point) @ axes.T, room)
    return np.asarray(point + np.array([[(u, v), (U, v)], [(u, V), (U, V)]]) @ axes)


def _cylinder(cylinder: Any, corners: Array, room: float) -> Array:
    """A tube as long as the rods."""
    point, axis = np.asarray(cylinder.point), np.asarray(cylinder.axis)
    along = np.array(_reach((corners - point) @ axis, room))
    out = _spokes(corners - point, axis, cylinder.radius, room)
    return np.asarray(point + along[:, None, None] * axis + cylinder.radius * out)


def _groove(groove: Any, corners: Array, room: float) -> Array:
    """The section, its end flanks as far as the rods, pulled along them or around the roller."""
    point, axis, up = (np.asarray(v) for v in (groove.point, groove.axis, groove.up))
    right = np.cross(axis, up)
    z, y = _section(groove, (corners - point) @ np.stack([right, up], axis=1), room).T
    # Corners that fillets cut off go to the fillet, whose nearest points they have.
    near = groove.closest(point + z[:, None] * right + y[:, None] * up)
    line = np.stack([z, y], axis=1) - near.distance[:, None] * near.normal @ np.stack([right, up], axis=1)
    if groove.roller is None:
        along = np.array(_reach((corners - point) @ axis, room))
        return np.asarray(point + along[:, None, None] * axis + line @ np.stack([right, up]))
    centre = point - groove.roller * up
    out = _spokes(corners - centre, right, groove.roller, room)
    return np.asarray(centre + (groove.roller + line[:, 1, None]) * out[:, None] + line[:, 0, None] * right)


def _section(groove: Any, corners: Array, room: float) -> Array:
    """Points of the profile, its first and last flanks drawn out beyond the rods, shape (n, 2)."""
    profile = np.array(groove.profile)
    for end, beside in ((0, 1), (-1, -2)):
        along = profile[end] - profile[beside]
        along /= np.linalg.norm(along)
        profile[end] += (max(0.0, float(((corners - profile[end]) @ along).max())) + room) * along
    strips = STRIPS if groove.fillet else 1
    share = np.arange(strips)[:, None] / strips
    flanks = [a + share * (b - a) for a, b in pairwise(profile)]
    return np.concatenate([*flanks, profile[-1:]])


def _spokes(corners: Array, axis: Array, radius: float, room: float) -> Array:
    """Unit vectors all around an axis, of a wheel much larger than the rods towards them only, shape (n, 3)."""
    middle = corners.mean(axis=0)
    beside = middle - (middle @ axis) * axis
    half, far = room + 0.5 * float(np.linalg.norm(corners[-1] - corners[0])), float(np.linalg.norm(beside))
    around = radius < 2.0 * half or far <= half
    e, most = (_across(axis), np.pi) if around else (beside / far, float(np.arcsin(half / far)))
    angles = np.linspace(-most, most, SIDES + 1)[:, None]
    return np.asarray(np.cos(angles) * e + np.sin(angles) * np.cross(axis, e))


def _reach(coordinates: Array, room: float) -> tuple[Array, Array]:
    """From where to where the rods reach, and a little beyond."""
    return coordinates.min(axis=0) - room, coordinates.max(axis=0) + room


def _across(axis: Array) -> Array:
    """Some unit vector at right angles to another."""
    e = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
    return np.asarray(e / np.linalg.norm(e))


# By name of the class.
PATCHES: dict[str, Callable[[Any, Array, float], Array]] = {"Plane": _plane, "Cylinder": _cylinder, "Groove": _groove}
