"""From where to look at rods: straight onto the plane they lie in, or from a corner of space."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["View", "view"]

# Of the size of all: what is nearer to a plane lies in it.
FLAT = 1e-6


@dataclass(frozen=True, eq=False)
class View:
    """Axes to draw along.

    Args:
        axes: Two orthonormal directions of a plane or the three of space, shape (2 or 3, 3).
        names: One a direction.
    """

    axes: Array
    names: tuple[str, ...]

    def seen(self, points: Array) -> Array:
        """Coordinates along the axes.

        Args:
            points: Shape (n, 3).

        Returns:
            Shape (2 or 3, n).
        """
        return np.asarray(self.axes @ points.T)


def view(points: Array) -> View:
    """The plane of coordinates that holds all points, else any plane that does, else space.

    Args:
        points: Everything to draw, shape (n, 3).

    Returns:
        Where to draw it.
    """
    spread = np.ptp(points, axis=0)
    for normal, plane in ((2, (0, 1)), (1, (0, 2)), (0, (1, 2))):
        if spread[normal] <= FLAT * spread.max():
            return View(np.eye(3)[list(plane)], tuple("xyz"[i] for i in plane))
    _, sizes, directions = np.linalg.svd(points - points.mean(axis=0), full_matrices=False)
    if sizes[2] > FLAT * sizes[0]:
        return View(np.eye(3), ("x", "y", "z"))
    # The axis of space that lies nearest to the plane goes to the right, what is above it up.
    normal = directions[2]
    right = np.eye(3)[np.argmin(np.abs(normal))]
    right = right - (right @ normal) * normal
    right /= np.linalg.norm(right)
    up = np.cross(normal, right)
    up *= np.sign(up[np.argmax(np.abs(up))])
    return View(np.stack([right, up]), tuple(f"along {_spoken(axis)}" for axis in (right, up)))


def _spoken(axis: Array) -> str:
    return "(" + ", ".join(f"{x:.2f}".replace("-0.00", "0.00") for x in axis) + ")"
