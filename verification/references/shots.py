"""Rods that hit rods: what they exchange, how deep and how long, parallel and crosswise, without friction.

Two bodies on one line that part without loss exchange momentum as m₁ and m₂ say, whatever pushes them apart. Parallel
rods push by ε_N a length, so that they touch for half a period of their reduced mass. Stiff rods that cross at right
angles in their middles push by the lens that both directions of the search share, of the energy

    U(d) = ½ ε_N ∫ (D₀ − √(s² + d²))² ds over |s| < a = √(D₀² − d²)
         = ½ ε_N (2 a D₀² − 2 D₀ (a D₀ + d² asinh(a/d)) + 2 a³/3 + 2 a d²),

and touch for 2 ∫ dd/√(w² − 2U/m) from where U is half of m w², m their reduced mass.

Source: textbook mechanics; the integral is our own.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import asinh, pi, sqrt

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq

__all__ = ["Exchange", "Lens"]


@dataclass(frozen=True)
class Exchange:
    """Two bodies on one line, the second ahead of the first.

    Args:
        first: Mass, or mass per length [kg, kg/m].
        second: Likewise.
        v: Speed of the first, at which it comes up to the second [m/s].
        w: Speed of the second [m/s].
    """

    first: float
    second: float
    v: float
    w: float = 0.0

    @property
    def reduced(self) -> float:
        """m₁ m₂/(m₁ + m₂)."""
        return self.first * self.second / (self.first + self.second)

    @property
    def after(self) -> tuple[float, float]:
        """Speeds afterwards, 2 u − v with the speed u of both together [m/s]."""
        u = (self.first * self.v + self.second * self.w) / (self.first + self.second)
        return 2.0 * u - self.v, 2.0 * u - self.w

    def time(self, eps_N: float) -> float:
        """π √(m/ε) of parallel rods [s]."""
        return pi * sqrt(self.reduced / eps_N)

    def depth(self, eps_N: float) -> float:
        """w √(m/ε) of parallel rods [m]."""
        return (self.v - self.w) * sqrt(self.reduced / eps_N)


@dataclass(frozen=True)
class Lens:
    """What straight rods store that cross at right angles.

    Args:
        eps_N: [N/m²].
        reach: D₀, the distance of the axes at which contact begins [m].
    """

    eps_N: float
    reach: float

    def energy(self, d: float) -> float:
        """U at a distance of the axes [J]."""
        D = self.reach
        if d >= D:
            return 0.0
        a = sqrt((D - d) * (D + d))
        if a < 0.05 * D:
            # Its series: the terms of the closed form cancel.
            return 0.5 * self.eps_N * self._series(a)
        return 0.5 * self.eps_N * (2 * a * D**2 - 2 * D * (a * D + d**2 * asinh(a / d)) + 2 * a**3 / 3 + 2 * a * d**2)

    def _series(self, a: float) -> float:
        """∫ (D₀ − √(s² + d²))² ds by Gauss's rule, of a parabola squared and little more."""
        points, weights = np.polynomial.legendre.leggauss(12)
        short = (a**2 * (1.0 - points**2)) / (self.reach + np.sqrt(self.reach**2 - a**2 * (1.0 - points**2)))
        return float(a * weights @ short**2)

    def deepest(self, mass: float, speed: float) -> float:
        """How far axes come within D₀ that meet at a speed, with a reduced mass [m]."""
        kinetic = 0.5 * mass * speed**2
        return float(brentq(lambda δ: self.energy(self.reach - δ) - kinetic, 0.0, 0.5 * self.reach, xtol=1e-18))

    def time(self, mass: float, speed: float) -> float:
        """How long they touch [s]."""
        δ = self.deepest(mass, speed)

        # δ sin φ takes the root at the deepest point out of the integrand.
        def rate(φ: float) -> float:
            left = speed**2 - 2.0 * self.energy(self.reach - δ * np.sin(φ)) / mass
            return float(δ * np.cos(φ) / sqrt(left)) if left > 0.0 else 0.0

        return float(2.0 * quad(rate, 0.0, 0.5 * pi - 1e-9, epsabs=0.0, epsrel=1e-10, limit=200)[0])
