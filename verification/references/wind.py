"""A fibre in air by ordinary differential equations: how fast it falls, and how a wind bends it between two pins.

The drag of Marheineke and Wegener is written out here again, from its source, up to w = |v_n| d/ν = 100; nothing of the
scene's is read.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_bvp, solve_ivp
from scipy.optimize import brentq

__all__ = ["Fibre"]

Array = NDArray[np.float64]

# Air of 20 °C: density [kg/m³], kinematic viscosity [m²/s].
DENSITY, VISCOSITY = 1.204, 1.81e-5 / 1.204
G = 9.81
# Beyond which the polynomials of the middle range hold.
SLOW = 0.1


@dataclass(frozen=True)
class Fibre:
    """A round fibre in air.

    Args:
        diameter: d [m].
        mass: ρA [kg/m].
        EA: [N].
        EI: [N m²].
        length: [m].
    """

    diameter: float
    mass: float
    EA: float
    EI: float
    length: float

    def drag(self, across: Array, along: Array) -> tuple[Array, Array]:
        """Force per length across and along a fibre that air passes at these speeds [N/m].

        f = ρ_a d |v_n| (c_n v_n + c_t v_t).
        """
        w = np.maximum(np.abs(across) * self.diameter / VISCOSITY, 1e-300)
        S, L = 2.0022 - np.log(w), np.log(np.maximum(w, SLOW))
        slow_n = 4 * np.pi / (S * w) * (1 - w**2 * (S**2 - S / 2 + 5 / 16) / (32 * S))
        slow_t = 4 * np.pi / ((2 * S - 1) * w) * (1 - w**2 * (2 * S**2 - 2 * S + 1) / (16 * (2 * S - 1)))
        c_n = np.where(w < SLOW, slow_n, np.exp(1.6911 - 0.67222 * L + 0.033287 * L**2 + 0.0035015 * L**3))
        c_t = np.where(w < SLOW, slow_t, np.exp(1.1552 - 0.68479 * L + 0.014884 * L**2 + 0.00074966 * L**3))
        strength = DENSITY * self.diameter * np.abs(across)
        return strength * c_n * across, strength * c_t * along

    def terminal_speed(self) -> float:
        """At which the drag across bears the weight [m/s]."""
        return float(brentq(lambda v: self._pull(v), 1e-3, 10.0, xtol=1e-15))

    def speed(self, t: float, *, begun: float) -> float:
        """Of a level fibre that falls since t = 0 from a speed [m/s]."""
        found = solve_ivp(
            lambda _, v: [self._pull(float(v[0])) / self.mass], (0.0, t), (begun,), "DOP853", rtol=1e-12, atol=1e-15
        )
        return float(found.y[0, -1])

    def sag(self, wind: float) -> float:
        """How far a wind across it moves the middle of a fibre that is pinned at both ends [m].

        x′ = (1 + N/EA) cos θ, y′ = (1 + N/EA) sin θ, EI θ′ = m, m′ = −(1 + N/EA) Q and n′ = −f, on half of the fibre.
        """

        def slope(_: Array, y: Array) -> Array:
            θ, m, n_x, n_y = y[2:]
            c, d = np.cos(θ), np.sin(θ)
            stretch = 1.0 + (n_x * c + n_y * d) / self._EA
            f_n, f_t = self.drag(wind * c, wind * d)
            f = self.length**3 / self.EI
            return np.stack(
                [
                    stretch * c,
                    stretch * d,
                    m,
                    stretch * (n_x * d - n_y * c),
                    f * (f_n * d - f_t * c),
                    -f * (f_n * c + f_t * d),
                ]
            )

        def ends(a: Array, b: Array) -> Array:
            return np.array([a[0], a[1], a[3], b[0] - 0.5, b[2], b[5]])

        s = np.linspace(0.0, 0.5, 201)
        line = float(self.drag(np.array([wind]), np.array([0.0]))[0][0]) * self.length**3 / self.EI
        middle = (3.0 * line / (64.0 * self._EA)) ** (1.0 / 3.0)
        tension = line / (8.0 * middle)
        y = 4.0 * middle * s * (1.0 - s)
        guess = np.stack(
            [s, y, 4.0 * middle * (1.0 - 2.0 * s), 0.0 * s - 8.0 * middle, 0.0 * s + tension, line * (0.5 - s)]
        )
        found = solve_bvp(slope, ends, s, guess, tol=1e-8, max_nodes=100_000)
        if not found.success:
            raise ArithmeticError(found.message)
        return float(found.y[1, -1] * self.length)

    @property
    def _EA(self) -> float:
        """In units of EI/L²."""
        return self.EA * self.length**2 / self.EI

    def _pull(self, v: float) -> float:
        """Weight less drag per length [N/m]."""
        return self.mass * G - float(self.drag(np.array([v]), np.array([0.0]))[0][0])
