"""How a surface pushes back: line load against gap, Eq. 27 of the paper, smoothed, or up to a penetration."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.quantity import assign, nonnegative, number, positive

__all__ = ["AugmentedLagrangian", "Penalty", "SmoothPenalty"]

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Penalty:
    """Line load that grows in proportion to how far a rod has come within g_0, p = ε_N (g_0 − g), Eq. 27.

    g is the gap between the surface of the rod and the wall. A wall under a line load q is met at g = g_0 − q/ε_N.
    With damping a rod in motion feels max(0, p + τ dp/dt), which never pulls: it leaves slower than it came.

    Args:
        eps_N: ε_N, the paper's c [N/m²].
        g_0: The paper's ε_0, where contact begins [m].
        damping: Retardation time τ in motions, 0: none; a mass m that strikes has the damping ratio ½ τ √(ε_N/m) [s].

    Raises:
        SceneError: A stiffness that is not positive, a time below zero.

    Source: Schwager & Pöschel, Granular Matter 9, 2007, DOI 10.1007/s10035-007-0065-z (the coefficient of restitution).
    """

    eps_N: float
    g_0: float = 0.0
    damping: float = 0.0

    def __post_init__(self) -> None:
        assign(
            self,
            eps_N=positive(self.eps_N, "Penalty.eps_N", "N/m²"),
            g_0=number(self.g_0, "Penalty.g_0", "m"),
            damping=nonnegative(self.damping, "Penalty.damping", "s"),
        )

    @classmethod
    def paper(cls) -> Penalty:
        """The numbers of the paper read in SI, c = 2e4 N/m² and ε_0 = 75 µm: a halo of nearly four diameters."""
        return cls(2e4, 7.5e-5)

    @classmethod
    def tight(cls) -> Penalty:
        """A halo of 1 µm, ε_N = 4e5 N/m²: for fibres of some 20 µm that lie against each other."""
        return cls(4e5, 1e-6)

    def softened(self, by: float) -> Penalty:
        """See `NormalLaw`."""
        return replace(self, eps_N=self.eps_N / by)

    def gap(self, p: Array) -> Array:
        """See `NormalLaw`."""
        return self.g_0 - p / self.eps_N

    def pressure(self, g: Array, λ: Array) -> tuple[Array, Array]:
        """See `NormalLaw`; λ has no part in it."""
        p = self.eps_N * np.maximum(self.g_0 - g, 0.0)
        return p, np.where(p > 0.0, -self.eps_N, 0.0)

    def drawn(self, g: Array, λ: Array) -> tuple[Array, Array]:
        """See `NormalLaw`."""
        return self.eps_N * (self.g_0 - g), np.full(g.shape, -self.eps_N)

    def mean(self, g: Array, h: Array, λ: Array) -> tuple[Array, Array]:
        """See `NormalLaw`."""
        (p, _), (q, slope) = self.pressure(g, λ), self.pressure(h, λ)
        one_side = ((p > 0.0) != (q > 0.0)) & (g != h)
        way = np.where(one_side, h - g, 1.0)
        mean = 0.5 * (p + q) * np.where(one_side, (p - q) / (self.eps_N * way), 1.0)
        return mean, np.where(one_side, (q - mean) / way, 0.5 * slope)

    def energy(self, g: Array, λ: Array) -> Array:
        """See `NormalLaw`."""
        return np.asarray(0.5 * self.eps_N * np.maximum(self.g_0 - g, 0.0) ** 2)


@dataclass(frozen=True)
class SmoothPenalty:
    """The same with a round foot: with δ = g_0 − g, p = ε_N δ²/2w up to δ = w, then ε_N (δ − w/2).

    Its slope has no jump, so that Newton's method is quadratic where contact begins, too.

    Args:
        eps_N: Slope beyond the foot [N/m²].
        foot: w, the width of the foot [m].
        g_0: Gap where contact begins [m].
        damping: Retardation time τ in motions, as of `Penalty` [s].

    Raises:
        SceneError: A stiffness or width that is not positive, a time below zero.
    """

    eps_N: float
    foot: float
    g_0: float = 0.0
    damping: float = 0.0

    def __post_init__(self) -> None:
        assign(
            self,
            eps_N=positive(self.eps_N, "SmoothPenalty.eps_N", "N/m²"),
            foot=positive(self.foot, "SmoothPenalty.foot", "m"),
            g_0=number(self.g_0, "SmoothPenalty.g_0", "m"),
            damping=nonnegative(self.damping, "SmoothPenalty.damping", "s"),
        )

    def softened(self, by: float) -> SmoothPenalty:
        """See `NormalLaw`."""
        return replace(self, eps_N=self.eps_N / by)

    def gap(self, p: Array) -> Array:
        """See `NormalLaw`."""
        δ = p / self.eps_N
        return self.g_0 - np.where(δ < 0.5 * self.foot, np.sqrt(2.0 * self.foot * δ), δ + 0.5 * self.foot)

    def pressure(self, g: Array, λ: Array) -> tuple[Array, Array]:
        """See `NormalLaw`; λ has no part in it."""
        δ = np.maximum(self.g_0 - g, 0.0)
        bent = np.minimum(δ, self.foot)
        return self.eps_N * (0.5 * bent**2 / self.foot + δ - bent), -self.eps_N * (bent / self.foot)

    def drawn(self, g: Array, λ: Array) -> tuple[Array, Array]:
        """The law itself: a smooth foot has no branch to go on with."""
        return self.pressure(g, λ)

    def mean(self, g: Array, h: Array, λ: Array) -> tuple[Array, Array]:
        """See `NormalLaw`; by Simpson's rule on each piece of the law, which is exact for its parabolas."""
        way = h - g
        least, most = np.minimum(way, 0.0), np.maximum(way, 0.0)
        met = [np.clip(joint - g, least, most) for joint in (self.g_0, self.g_0 - self.foot)]
        pieces = np.sort([0.0 * g, *(part / np.where(way == 0.0, 1.0, way) for part in met), 0.0 * g + 1.0], axis=0)
        a, b = pieces[:-1], pieces[1:]
        mean, slope = np.zeros_like(a), np.zeros_like(a)
        for s, weight in ((a, 1.0), (0.5 * (a + b), 4.0), (b, 1.0)):
            p, p_g = self.pressure(g + s * way, λ)
            mean += weight * p
            slope += weight * s * p_g
        return (mean * (b - a)).sum(axis=0) / 6.0, (slope * (b - a)).sum(axis=0) / 6.0

    def energy(self, g: Array, λ: Array) -> Array:
        """See `NormalLaw`."""
        δ = np.maximum(self.g_0 - g, 0.0)
        bent = np.minimum(δ, self.foot)
        beyond = δ - bent
        return self.eps_N * (bent**3 / (6.0 * self.foot) + 0.5 * beyond * (beyond + self.foot))


@dataclass(frozen=True)
class AugmentedLagrangian:
    """No penetration but a tolerance: p = max(0, λ − ε_N g), λ renewed by p until no rod is deeper than that.

    ε_N then only decides how many renewals it takes, not the answer.

    Args:
        eps_N: Slope in each of them [N/m²].
        tolerance: Largest penetration, and largest gap under load [m].

    Raises:
        SceneError: A stiffness or tolerance that is not positive.

    Source: Simo & Laursen, Computers & Structures 42, 1992, DOI 10.1016/0045-7949(92)90540-G.
    """

    eps_N: float
    tolerance: float
    g_0: ClassVar[float] = 0.0
    damping: ClassVar[float] = 0.0

    def __post_init__(self) -> None:
        assign(
            self,
            eps_N=positive(self.eps_N, "AugmentedLagrangian.eps_N", "N/m²"),
            tolerance=positive(self.tolerance, "AugmentedLagrangian.tolerance", "m"),
        )

    def softened(self, by: float) -> AugmentedLagrangian:
        """See `NormalLaw`."""
        return replace(self, eps_N=self.eps_N / by)

    def gap(self, p: Array) -> Array:
        """See `NormalLaw`."""
        return -p / self.eps_N

    def pressure(self, g: Array, λ: Array) -> tuple[Array, Array]:
        """See `NormalLaw`."""
        p = np.maximum(λ - self.eps_N * g, 0.0)
        return p, np.where(p > 0.0, -self.eps_N, 0.0)

    def drawn(self, g: Array, λ: Array) -> tuple[Array, Array]:
        """See `NormalLaw`."""
        return λ - self.eps_N * g, np.full(g.shape, -self.eps_N)

    def mean(self, g: Array, h: Array, λ: Array) -> tuple[Array, Array]:
        """The pressure at h: multipliers hold at the end of a step."""
        return self.pressure(h, λ)

    def energy(self, g: Array, λ: Array) -> Array:
        """None is stored but what penetration is left."""
        return np.zeros_like(g)
