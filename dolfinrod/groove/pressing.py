"""Suction that presses fibres onto the walls above the slot."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dolfinrod.groove.limits import limited
from dolfinrod.scene import Air
from dolfinrod.scene.quantity import assign

__all__ = ["Pressing"]

Array = NDArray[np.float64]

# Fastest flow that is looked for [m/s]: a fibre of 1 µm needs less for the largest pressure allowed.
FASTEST = 1e4


@dataclass(frozen=True)
class Pressing:
    """Pressure that presses a fibre onto the wall, a line load Δp d along the wall's normal, d the fibre's diameter.

    It acts near the wall and near the slot only: it fades by 1 − 3q² + 2q³, q = gap/d, until the gap is a diameter, and
    likewise over a diameter at half the width on either side. Scenes know one load that depends on the place, the drag
    of air: so it is that of a flow onto the wall, as fast as a fibre at rest feels Δp d. An extension of the paper,
    whose equations have no pressure.

    Args:
        pressure: Δp, what of the suction reaches the fibres, 0 to 1e5 Pa; 260 [P, L: 10 % of 2600 Pa; up to 38 %].
        half_width: Of the stretch along Z above the slot, 1e-5 to 1e-2 m; 0.5 mm [I].

    Raises:
        SceneError: A number out of its range.
    """

    pressure: float = 260.0
    half_width: float = 0.5e-3

    def __post_init__(self) -> None:
        assign(
            self,
            pressure=limited(self.pressure, "Pressing.pressure", "Pa", 0.0, 1e5),
            half_width=limited(self.half_width, "Pressing.half_width", "m", 1e-5, 1e-2),
        )

    def speed(self, diameter: float) -> float:
        """Of the flow whose drag across a fibre at rest is Δp d [m/s].

        Args:
            diameter: d [m].
        """
        from scipy.optimize import brentq

        def lacking(u: float) -> float:
            drag = Air().drag(np.array([[0.0, u, 0.0]]), np.array([[1.0, 0.0, 0.0]]), np.array([diameter]))
            return float(drag[0, 1]) - self.pressure * diameter

        return float(brentq(lacking, 0.0, FASTEST)) if self.pressure else 0.0

    def share(self, gap: Array, across: Array, diameter: float) -> Array:
        """Part of the load that acts.

        Args:
            gap: Between fibre and wall, shape (n,) [m].
            across: Distance from the middle of the slot along Z, shape (n,) [m].
            diameter: d [m].

        Returns:
            From 0 to 1, shape (n,).
        """
        beyond = np.abs(across) - (self.half_width - diameter)
        return np.asarray(_fading(gap / diameter) * _fading(beyond / diameter))


def _fading(q: Array) -> Array:
    """1 up to q = 0, 0 from q = 1 on, with a continuous slope."""
    q = np.clip(q, 0.0, 1.0)
    return np.asarray(1.0 - q * q * (3.0 - 2.0 * q))
