"""Air that is sucked through the bottom of the groove."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, pi

import numpy as np
from numpy.typing import NDArray

from dolfinrod.groove.limits import limited
from dolfinrod.scene.quantity import assign

__all__ = ["LineSink"]

Array = NDArray[np.float64]


@dataclass(frozen=True)
class LineSink:
    """Flow towards a line along X, u = −U₀ s(ρ) ρ̂ with s = a/ρ outside and ρ/a within a core of radius a.

    ρ is the distance from the line. The core stands for a slot or holes as wide as that, in which the flow turns
    away from the fibres. The flow goes around walls and fibres as if they were not there. The paper names a pressure,
    −2600 Pa, and puts no air into any equation: everything here is an assumption, written [I] below; [L] is an order
    of magnitude from the literature on suction slots.

    Args:
        speed: U₀ at the distance a, 0 to 200 m/s; 20 [L: 10 to 25 % of 2600 Pa reach the fibres, 21 to 33 m/s].
        radius: a, 1e-5 to 1e-2 m; 0.5 mm [I].
        ramp: Time in which the flow grows in proportion, 0 to 1 s; 0.5 ms [I].
        holes: m, how much the flow swells at holes, 1 + m cos(2π X/pitch), 0 to 1; 0 [I].
        pitch: Distance of holes, 1e-4 to 0.1 m; 3 mm [I].
        backward: Speed of the flow against X, −100 to 100 m/s; 0 [I; L: drums show some].
        bottom: y and z of the line, which a `Scenario` lays along the bottom of its groove [m].
        between: X from and to where air is sucked [m]; everywhere [I].

    Raises:
        SceneError: A number out of its range.
    """

    speed: float = 20.0
    radius: float = 0.5e-3
    ramp: float = 0.5e-3
    holes: float = 0.0
    pitch: float = 3e-3
    backward: float = 0.0
    bottom: tuple[float, float] = (0.0, 0.0)
    between: tuple[float, float] = (-inf, inf)

    def __post_init__(self) -> None:
        assign(
            self,
            speed=limited(self.speed, "LineSink.speed", "m/s", 0.0, 200.0),
            radius=limited(self.radius, "LineSink.radius", "m", 1e-5, 1e-2),
            ramp=limited(self.ramp, "LineSink.ramp", "s", 0.0, 1.0),
            holes=limited(self.holes, "LineSink.holes", "", 0.0, 1.0),
            pitch=limited(self.pitch, "LineSink.pitch", "m", 1e-4, 0.1),
            backward=limited(self.backward, "LineSink.backward", "m/s", -100.0, 100.0),
        )

    def __call__(self, x: Array, t: float) -> Array:
        """Velocity of the air.

        Args:
            x: Points, shape (n, 3) [m].
            t: Time [s].

        Returns:
            Shape (n, 3) [m/s].
        """
        away = x[:, 1:] - np.asarray(self.bottom)
        ρ2 = np.maximum(np.einsum("ni,ni->n", away, away), self.radius**2)
        swell = 1.0 + self.holes * np.cos(2.0 * pi * x[:, 0] / self.pitch) if self.holes else 1.0
        # Rods end where the suction does but for round-off, on either side of it.
        slack = 1e-9 * self.pitch
        on = (x[:, 0] >= self.between[0] - slack) & (x[:, 0] <= self.between[1] + slack)
        u = np.empty_like(x)
        u[:, 0] = -self.backward
        u[:, 1:] = -(self.speed * self.radius * swell / ρ2)[:, None] * away
        return np.asarray((self.grown(t) * on)[:, None] * u)

    def grown(self, t: float) -> float:
        """Part of the flow that there is at a time [s]."""
        return min(t / self.ramp, 1.0) if self.ramp > 0.0 else 1.0
