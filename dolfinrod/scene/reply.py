"""What a surface does to points of rods, and how that changes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["OPEN", "SLIDES", "STICKS", "Booked", "Gradient", "Reply"]

Array = NDArray[np.float64]

OPEN, STICKS, SLIDES = 0, 1, 2


@dataclass(frozen=True, eq=False)
class Reply:
    """What a surface does to points, in space.

    Args:
        gap: g between surface and surface of the rod at the end of the step, shape (n,) [m].
        pressure: Line load along the normal, shape (n,) [N/m].
        normal: Shape (n, 3).
        traction: Friction, shape (n, 3) [N/m].
        moment: That of friction about the centreline, −r n × t, shape (n, 3) [N].
        state: OPEN, STICKS or SLIDES, shape (n,); what touches without friction slides.
    """

    gap: Array
    pressure: Array
    normal: Array
    traction: Array
    moment: Array
    state: NDArray[np.int8]

    @property
    def force(self) -> Array:
        """p n + t, shape (n, 3) [N/m]."""
        return self.pressure[:, None] * self.normal + self.traction


@dataclass(frozen=True, eq=False)
class Gradient:
    """How force and moment of the points that touch change.

    Args:
        points: Their numbers, shape (m,).
        f_x: ∂f/∂x, shape (m, 3, 3) [N/m²].
        f_turn: ∂f by the rotation vector of the step, shape (m, 3, 3) [N/m].
        m_x: ∂m/∂x, shape (m, 3, 3) [N/m].
        m_turn: Likewise, shape (m, 3, 3) [N].
    """

    points: NDArray[np.intp]
    f_x: Array
    f_turn: Array
    m_x: Array
    m_turn: Array


@dataclass(frozen=True, eq=False)
class Booked:
    """Energies per length at a step's points, shape (n,) [J/m].

    Args:
        stored: What contact stores at the end of the step, in penetrations and anchors.
        rubbed: What friction took in the step.
        pushed: Work of the moving wall on the rods.
        damped: What damping of the contact took.
    """

    stored: Array
    rubbed: Array
    pushed: Array
    damped: Array
