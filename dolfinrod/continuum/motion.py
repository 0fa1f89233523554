"""How the nodes move at one moment."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["Motion"]


@dataclass(frozen=True, eq=False)
class Motion:
    """Velocities and momenta of a rank's own nodes, and how they came about.

    Args:
        v: Velocities, in L per unit of time, shape (n, d).
        π: Moments of momentum of the sections in working directions, shape (n, n_spin).
        a: Mean acceleration in the last step; None: there was none.
        h: That step.
    """

    v: Array
    π: Array
    a: Array | None = None
    h: float = np.inf

    @property
    def speed(self) -> float:
        """Of the fastest node of this rank, in L per unit of time."""
        return float(np.linalg.norm(self.v, axis=1).max(initial=0.0))

    def error(self, before: Motion, order: int) -> float:
        """Error of the step that led here, in L: ½ h² a of a scheme of order 1, h³ a′/12 of the midpoint rule.

        Args:
            before: Motion at its start.
            order: Of the scheme.
        """
        if self.a is None:
            return 0.0
        if order == 1 or before.a is None:
            return float(0.5 * self.h**2 * np.abs(self.a).max(initial=0.0))
        jerk = 2.0 * (self.a - before.a) / (self.h + before.h)
        return float(self.h**3 / 12.0 * np.abs(jerk).max(initial=0.0))
