"""Where the elements of this rank lie on their rods."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.continuum.nodes import element_ends

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.continuum.discretization import Discretization
    from dolfinrod.scene import Scene

    Array = NDArray[np.float64]

__all__ = ["Layout"]


@dataclass(frozen=True, eq=False)
class Layout:
    """Elements of this rank.

    Args:
        scene: Its rods.
        length: Unit of length L [m].
        rod: Rod of every local cell.
        ends: Arc length of its ends, in L, shape (cells, 2).
    """

    scene: Scene
    length: float
    rod: NDArray[np.int64]
    ends: Array

    @classmethod
    def of(cls, scene: Scene, d: Discretization, length: float) -> Layout:
        """That of a scene on a discretization."""
        ends = [element_ends(scene, j, n) / length for j, n in enumerate(d.elements)]
        lined_up = np.concatenate([np.stack([s[:-1], s[1:]], axis=1) for s in ends])
        return cls(scene, length, np.repeat(np.arange(len(ends)), d.elements)[d.cell], lined_up[d.cell])

    def along(self, ξ: Array) -> Array:
        """Arc length of the points ξ ∈ [0, 1] of every cell, exact at its ends."""
        return np.asarray(self.ends[:, :1] * (1.0 - ξ) + self.ends[:, 1:] * ξ)

    def on_rods(self, s: Array, quantity: str) -> Array:
        """A quantity of the stress-free rods at arc lengths s (cells, points) in L."""
        shape = {"centerline": (3,), "frames": (3, 3)}[quantity]
        values = np.zeros((*s.shape, *shape))
        for j, rod in enumerate(self.scene.rods):
            mine = self.rod == j
            at = np.clip(s[mine].ravel() * self.length, 0.0, rod.length)
            values[mine] = getattr(rod, quantity)(at).reshape(-1, s.shape[1], *shape)
        return values
