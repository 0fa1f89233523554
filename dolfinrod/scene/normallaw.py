"""What the laws of contact have in common."""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

__all__ = ["NormalLaw"]

Array = NDArray[np.float64]


class NormalLaw(Protocol):
    """Contract: a line load p(g) that falls with the gap g, zero from g_0 on."""

    @property
    def eps_N(self) -> float:
        """Largest slope −dp/dg [N/m²]."""
        ...

    @property
    def g_0(self) -> float:
        """Gap at which contact begins [m]."""
        ...

    @property
    def damping(self) -> float:
        """τ with which a rod in motion feels p + τ dp/dt, none where that is below zero [s]."""
        ...

    def softened(self, by: float) -> NormalLaw:
        """The same, softer by a factor."""
        ...

    def gap(self, p: Array) -> Array:
        """The gap under a line load without multipliers, shape (n,) [m]; g_0 under none."""
        ...

    def pressure(self, g: Array, λ: Array) -> tuple[Array, Array]:
        """p and dp/dg, shapes (n,) [N/m, N/m²], at gaps g [m] and multipliers λ [N/m]."""
        ...

    def drawn(self, g: Array, λ: Array) -> tuple[Array, Array]:
        """The same for points that an iteration keeps pressed though they have left the wall: there p is below zero."""
        ...

    def mean(self, g: Array, h: Array, λ: Array) -> tuple[Array, Array]:
        """Mean of p over gaps from g to h, with which work is the difference of energies; and its slope in h."""
        ...

    def energy(self, g: Array, λ: Array) -> Array:
        """∫ p dg from g to g_0, shape (n,) [N]."""
        ...
