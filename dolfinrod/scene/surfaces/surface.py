"""A rigid surface as rods meet it: the signed distance of points, and how its normal turns from place to place."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from dolfinrod.scene.surfaces.wall import WallMotion

__all__ = ["Closest", "Surface"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Closest:
    """What a surface is to points near it.

    Args:
        distance: Signed distance φ, positive on the free side, shape (n,) [m].
        normal: Unit normal ∂φ/∂x, towards the free side, shape (n, 3).
        curvature: ∂²φ/∂x², shape (n, 3, 3) [1/m].
    """

    distance: Array
    normal: Array
    curvature: Array


class Surface(Protocol):
    """Contract of a surface at rest; `motion` moves it as a rigid body."""

    @property
    def motion(self) -> WallMotion | None:
        """How it moves; None: not at all."""
        ...

    def closest(self, x: Array) -> Closest:
        """Signed distance of points from the surface at rest.

        Args:
            x: Points, shape (n, 3) [m].

        Returns:
            Distances, normals and curvatures.
        """
        ...
