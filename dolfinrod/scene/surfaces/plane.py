"""A plane wall."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene.quantity import VectorLike, assign, direction, vector
from dolfinrod.scene.surfaces.surface import Closest
from dolfinrod.scene.surfaces.wall import WallMotion, moving

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["Plane"]


@dataclass(frozen=True)
class Plane:
    """Half space below a plane, φ = (x − point)·normal.

    Args:
        point: Any of its points [m].
        normal: Towards the free side, of any length.
        motion: How it moves; None: not at all.

    Raises:
        SceneError: A normal that is zero.
    """

    point: VectorLike = (0.0, 0.0, 0.0)
    normal: VectorLike = (0.0, 0.0, 1.0)
    motion: WallMotion | None = None

    def __post_init__(self) -> None:
        assign(
            self,
            point=vector(self.point, "Plane.point", "m"),
            normal=direction(self.normal, "Plane.normal"),
            motion=moving(self.motion, "Plane.motion"),
        )

    def closest(self, x: NDArray[np.float64]) -> Closest:
        """See `Surface.closest`."""
        n = np.asarray(self.normal)
        return Closest((x - np.asarray(self.point)) @ n, np.full(x.shape, n), np.zeros((len(x), 3, 3)))
