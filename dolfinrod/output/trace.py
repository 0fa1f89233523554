"""Surfaces in the picture of the rods: cut by the plane of planar rods, the solid side shaded, or in space, pale."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from dolfinrod.output.surfaces import beside_rods, poses

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.output.view import View
    from dolfinrod.result import Result
    from dolfinrod.scene import Contact

    Array = NDArray[np.float64]

__all__ = ["COLOR", "draw_surfaces"]

# Points of the picture, to each side, at which distances are looked up.
FINE = 301
COLOR = "0.35"


def draw_surfaces(axes: Any, result: Result, seen: View, origin: Array, factor: float) -> bool:
    """Draw every surface that meets the picture, where it is at the last stored state.

    Args:
        axes: With its limits set.
        result: What was found.
        seen: From where.
        origin: Any point of the plane in view, shape (3,) [m].
        factor: What metres are drawn with.

    Returns:
        Whether there was any.
    """
    if len(seen.axes) == 3:
        drawn = [_draw_pieces(axes, contact, result, factor) for contact in result.scene.walls]
        return any(drawn)
    (left, right), (bottom, top) = axes.get_xlim(), axes.get_ylim()
    x, y = np.linspace(left, right, FINE), np.linspace(bottom, top, FINE)
    normal = np.cross(*seen.axes)
    flat = np.stack(np.meshgrid(x, y), axis=-1) / factor
    points = flat @ seen.axes + (origin @ normal) * normal
    drawn = [_draw_cut(axes, contact, result, (x, y, points)) for contact in result.scene.walls]
    return any(drawn)


def _draw_cut(axes: Any, contact: Contact, result: Result, places: tuple[Array, Array, Array]) -> bool:
    """Outline in the plane in view, its solid side shaded."""
    x, y, points = places
    pose = poses(contact, result)[-1]
    # Row by row: a profile of a thousand flanks asks for as much memory for every point.
    distance = np.stack([contact.surface.closest(pose.back(row)).distance for row in points])
    if not distance.min() < 0.0 < distance.max():
        return False
    axes.contourf(x, y, distance, levels=[distance.min(), 0.0], colors=[COLOR], alpha=0.12)
    axes.contour(x, y, distance, levels=[0.0], colors=[COLOR], linewidths=1.3)
    return True


def _draw_pieces(axes: Any, contact: Contact, result: Result, factor: float) -> bool:
    """The pieces of a surface in space whose middles lie in the picture."""
    points, cells = beside_rods(contact, result)
    pieces = factor * poses(contact, result)[-1].out(points)[cells]
    low, high = np.array([axes.get_xlim(), axes.get_ylim(), axes.get_zlim()]).T
    middles = pieces.mean(axis=1)
    pieces = pieces[((middles >= low) & (middles <= high)).all(axis=1)]
    if not len(pieces):
        return False
    axes.add_collection3d(Poly3DCollection(pieces, facecolor=COLOR, edgecolor="none", alpha=0.15))
    return True
