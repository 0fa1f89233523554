"""A round cylinder, touched from outside or from within."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.errors import SceneError, quoted
from dolfinrod.scene.quantity import VectorLike, assign, direction, positive, vector
from dolfinrod.scene.surfaces.nearest import beside_axis
from dolfinrod.scene.surfaces.polyline import ROUND_OFF
from dolfinrod.scene.surfaces.surface import Closest
from dolfinrod.scene.surfaces.wall import WallMotion, moving

__all__ = ["Cylinder"]

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Cylinder:
    """Cylinder without ends: from outside φ = ρ − radius, from inside φ = radius − ρ, ρ the distance to its axis.

    On the axis, where every direction is as near, the normal points away from or towards the one of x, y and z that is
    farthest from the axis, and the curvature is taken as zero.

    Args:
        point: Any point of its axis [m].
        axis: Along it, of any length.
        radius: [m].
        side: Where the rods are, "outside" or "inside".
        motion: How it moves; None: not at all.

    Raises:
        SceneError: An axis that is zero, a radius that is not positive, an unknown side.
    """

    point: VectorLike
    axis: VectorLike
    radius: float
    side: Literal["outside", "inside"] = "outside"
    motion: WallMotion | None = None

    def __post_init__(self) -> None:
        if not isinstance(self.side, str) or self.side not in ("outside", "inside"):
            raise SceneError(f'must be "outside" or "inside", got {quoted(self.side)}', field="Cylinder.side")
        assign(
            self,
            point=vector(self.point, "Cylinder.point", "m"),
            axis=direction(self.axis, "Cylinder.axis"),
            radius=positive(self.radius, "Cylinder.radius", "m"),
            motion=moving(self.motion, "Cylinder.motion"),
        )

    def closest(self, x: Array) -> Closest:
        """See `Surface.closest`."""
        return Closest(*beside_axis(np.ascontiguousarray(x), *self._given))

    @cached_property
    def _given(self) -> tuple[Array, Array, Array, float, float, float]:
        """What `beside_axis` is told of it."""
        axis = np.asarray(self.axis)
        across = np.eye(3)[np.argmin(np.abs(axis))]
        across = across - (across @ axis) * axis
        sign, norm = 1.0 if self.side == "outside" else -1.0, np.linalg.norm(across)
        return np.asarray(self.point), axis, across / norm, self.radius, sign, ROUND_OFF * self.radius
