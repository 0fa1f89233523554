"""Two rods under tension that cross at right angles and press on each other by a lens of contact: a pair of elasticas.

By symmetry each rod lies in its own plane and is its own mirror image, x from the crossing, h towards its own side:

    x′ = λ cos θ, h′ = λ sin θ, λ = 1 + N/EA, θ′ = m/EI, n′ = −f, m′ = λ (n_x sin θ − n_h cos θ), N = n·t.

Contact is looked for from either rod, by halves. Seen from one, the nearest point of the other is its middle, at −c in
h, so that with D = √(x² + (h + c)²) one rod carries f = ½ p(D) (x, h + c)/D along its lens, D < r_A + r_B + g_0, and
the other P = ∫ f_h ds at its middle; and the other way round. Pulled along by dead forces, ends held at a height and
free to turn. Neither model is read.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

__all__ = ["ANGLE", "EDGE", "LENS", "MIDDLE", "N_H", "N_X", "OTHER", "PARTS", "Crossing", "H", "M", "Q", "Strand", "X"]

Array = NDArray[np.float64]

# Of each rod: its state, ∫ f_h ds, (D/D₀)² − 1 where its lens ends, half the length of that, how high the other rod's
# middle is on its own side, and the force at its own.
X, H, ANGLE, N_X, N_H, M, Q, EDGE, LENS, OTHER, MIDDLE = range(11)
PARTS = 11


@dataclass(frozen=True)
class Strand:
    """One of the rods.

    Args:
        length: Of the whole rod [m].
        EA: Axial stiffness [N].
        EI: Bending stiffness [N m²].
        pull: Of each end, away from the crossing [N].
        height: Of its ends over the plane between the rods, towards its own side [m].
    """

    length: float
    EA: float
    EI: float
    pull: float
    height: float

    @property
    def compliance(self) -> float:
        """Lift of the middle per force across, in linear theory, (ℓ − tanh(kℓ)/k)/2T with ℓ = length/2 [m/N]."""
        ℓ, k = 0.5 * self.length, np.sqrt(self.pull / self.EI)
        return float((ℓ - np.tanh(k * ℓ) / k) / (2.0 * self.pull))

    def slope(self, u: Array, f_x: Array, f_h: Array) -> Array:
        """u′ of the state under a line load, shape (..., 7)."""
        c, s = np.cos(u[..., ANGLE]), np.sin(u[..., ANGLE])
        λ = 1.0 + (u[..., N_X] * c + u[..., N_H] * s) / self.EA
        m = λ * (u[..., N_X] * s - u[..., N_H] * c)
        return np.stack([λ * c, λ * s, u[..., M] / self.EI, -f_x, -f_h, m, f_h], axis=-1)

    def sketch(self, force: float, s: Array) -> Array:
        """State in linear theory under a force across the middle, shape (n, 7)."""
        ℓ, k, T = 0.5 * self.length, np.sqrt(self.pull / self.EI), self.pull
        θ = -0.5 * force / T * (1.0 - np.cosh(k * (ℓ - s)) / np.cosh(k * ℓ))
        h = self.height + 0.5 * force / T * (ℓ - s - np.sinh(k * (ℓ - s)) / (k * np.cosh(k * ℓ)))
        m = -0.5 * force / T * self.EI * k * np.sinh(k * (ℓ - s)) / np.cosh(k * ℓ)
        one = np.ones_like(s)
        return np.stack([s, h, θ, T * one, -0.5 * force * one, m, 0.25 * force * one], axis=-1)


@dataclass(frozen=True)
class Crossing:
    """Both of them and what they press on each other with.

    Args:
        strands: The rods.
        eps_N: ε_N of the line load p = ε_N (g_0 − g) [N/m²].
        apart: r_A + r_B, the distance of the axes where g = 0 [m].
        g_0: Gap where contact begins [m].
    """

    strands: tuple[Strand, Strand]
    eps_N: float
    apart: float
    g_0: float = 0.0

    @property
    def reach(self) -> float:
        """Distance of the axes where contact begins [m]."""
        return self.apart + self.g_0

    def load(self, u: Array) -> tuple[Array, Array]:
        """½ p n on a rod within its lens [N/m]."""
        up = u[..., H] + u[..., OTHER]
        D = np.sqrt(u[..., X] ** 2 + up**2)
        half = 0.5 * self.eps_N * (self.reach - D) / D
        return half * u[..., X], half * up

    def lens(self, force: float) -> tuple[float, float]:
        """Depth and half length at which straight rods press with a force: F = 4/3 ε_N δ a, a = √(2 D δ) [m]."""
        δ = (0.75 * force / (self.eps_N * np.sqrt(2.0 * self.reach))) ** (2.0 / 3.0)
        return float(δ), float(np.sqrt(2.0 * self.reach * δ))

    @property
    def linear(self) -> float:
        """Force in linear theory [N]."""
        compliance, below = sum(s.compliance for s in self.strands), sum(s.height for s in self.strands)
        pressed = self.reach - below
        return float(brentq(lambda f: pressed - self.lens(f)[0] - f * compliance, 0.0, pressed / compliance))

    def moved(self, way: float) -> Crossing:
        """With its ends on the way from where the rods only just touch."""
        first, second = (replace(s, height=0.5 * self.reach * (1 - way) + way * s.height) for s in self.strands)
        return replace(self, strands=(first, second))
