"""Where walls begin to push rods in a plane, for the boundary-value problems of `contactrod`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

__all__ = ["Flat", "Round", "Wall"]

Array = NDArray[np.float64]


class Wall(Protocol):
    """Contract: where a wall begins to push."""

    def gap(self, x: Array, y: Array) -> tuple[Array, Array, Array]:
        """g and its derivatives by x and y; analytic."""
        ...


@dataclass(frozen=True)
class Flat:
    """Below y = height the wall pushes up; with side −1, above it down.

    Args:
        height: [m].
        side: 1 or −1.
    """

    height: float = 0.0
    side: float = 1.0

    def gap(self, x: Array, y: Array) -> tuple[Array, Array, Array]:
        """See `Wall`."""
        return self.side * (y - self.height), 0.0 * x, self.side + 0.0 * y


@dataclass(frozen=True)
class Round:
    """Within a distance from the point (0, height) the wall pushes out.

    Args:
        radius: That distance [m].
        height: [m].
    """

    radius: float
    height: float

    def gap(self, x: Array, y: Array) -> tuple[Array, Array, Array]:
        """See `Wall`."""
        up = y - self.height
        distance = np.sqrt(x * x + up * up)
        return distance - self.radius, x / distance, up / distance
