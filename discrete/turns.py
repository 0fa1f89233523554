"""Rotation vectors of sections over a step, worked out once for all that ask: surfaces, and other rods."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from discrete.rotation import log, turning

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["Turns"]


class Turns:
    """The last ones that were asked for; arrays are the same if they are one object."""

    def __init__(self) -> None:
        self._over: tuple[Array, Array, Array] | None = None
        self._following: tuple[Array, Array] | None = None

    def over(self, R: Array, R_0: Array) -> Array:
        """log(R R₀ᵀ), shapes (n_nodes, 3, 3) → (n_nodes, 3)."""
        if self._over is None or self._over[0] is not R or self._over[1] is not R_0:
            self._over = R, R_0, log(R @ np.swapaxes(R_0, 1, 2))
        return self._over[2]

    def following(self, θ: Array) -> Array:
        """Change of rotation vectors with spins, Θ(θ), shapes (n_nodes, 3) → (n_nodes, 3, 3)."""
        if self._following is None or self._following[0] is not θ:
            self._following = θ, turning(θ)
        return self._following[1]
