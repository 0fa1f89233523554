"""Line loads of rods that strike with damping: in each step a law of the gap alone, as without it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.normallaw import NormalLaw

__all__ = ["Damped", "Law", "elastic", "in_step"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Damped:
    """max(0, p + τ dp/dt) over a step from p₀ on: (1 + k) p(g) − k p₀ with k = τ/Δt, as long as that is above zero.

    So it is a law k + 1 times as stiff that begins at the gap where the elastic one has k p₀/(1 + k) left.

    Args:
        law: Without damping.
        k: τ over the length of the step.
        p_0: Line loads of that law at the start of the step, shape (n,) [N/m].
    """

    law: NormalLaw
    k: float
    p_0: Array

    @property
    def eps_N(self) -> float:
        """See `NormalLaw`."""
        return (1.0 + self.k) * self.law.eps_N

    @cached_property
    def g_0(self) -> Array:
        """Gaps at which the load begins, shape (n,) [m]."""
        return self.law.gap(self.k / (1.0 + self.k) * self.p_0)

    def softened(self, by: float) -> Damped:
        """The same, softer by a factor, from the same gaps on."""
        return replace(self, law=self.law.softened(by), p_0=self.p_0 / by)

    def pressure(self, g: Array, λ: Array) -> tuple[Array, Array]:
        """See `NormalLaw`."""
        end = self.law.pressure(g, λ)
        return _pushing(*self._with_rate(end, end))

    def drawn(self, g: Array, λ: Array) -> tuple[Array, Array]:
        """See `NormalLaw`."""
        end = self.law.drawn(g, λ)
        return self._with_rate(end, end)

    def mean(self, g: Array, h: Array, λ: Array) -> tuple[Array, Array]:
        """See `NormalLaw`."""
        return _pushing(*self._with_rate(self.law.mean(g, h, λ), self.law.pressure(h, λ)))

    def energy(self, g: Array, λ: Array) -> Array:
        """That of the law without damping."""
        return self.law.energy(g, λ)

    def _with_rate(self, acting: tuple[Array, Array], end: tuple[Array, Array]) -> tuple[Array, Array]:
        """Elastic loads that act in the step, and their slopes, with k times what they grow by to its end."""
        return acting[0] + self.k * (end[0] - self.p_0), acting[1] + self.k * end[1]


Law = NormalLaw | Damped


def in_step(law: NormalLaw, start: Array, rate: float) -> Law:
    """The law of a step.

    Args:
        law: Of the contact.
        start: Gaps where the step begins, shape (n,) [m].
        rate: One over its length; zero: nothing moves [1/s].
    """
    k = law.damping * rate
    return law if k == 0.0 else Damped(law, k, law.pressure(start, np.zeros_like(start))[0])


def elastic(law: Law, start: Array, gap: Array, p: Array, *, mean: bool) -> Array:
    """What of the line loads p in a step is not damping: all of it where there is none, shape (n,) [N/m].

    Args:
        law: Of the step.
        start: Gaps where it began, shape (n,) [m].
        gap: Where it ended, shape (n,) [m].
        p: Line loads in it, shape (n,) [N/m].
        mean: Whether mean loads act, else those at its end.
    """
    if not isinstance(law, Damped):
        return p
    none = np.zeros_like(gap)
    return law.law.mean(start, gap, none)[0] if mean else law.law.pressure(gap, none)[0]


def _pushing(p: Array, slope: Array) -> tuple[Array, Array]:
    """No load below zero."""
    return np.maximum(p, 0.0), np.where(p > 0.0, slope, 0.0)
