"""Damping of the sections: end forces k (Δ + τ Δ̇), Δ̇ the change of the deformation over the step by its length."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from discrete.corotation import ChordElement

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from discrete.mesh import Elements
    from dolfinrod.scene import Section

    Array = NDArray[np.float64]

__all__ = ["Damping", "Strain"]


@dataclass(frozen=True, eq=False)
class Strain:
    """Deformation of all elements.

    Args:
        θ: Rotations of the ends relative to the element, shape (n, 2, 3).
        ε: Elongations, shape (n,).
    """

    θ: Array
    ε: Array


class Damping:
    """Kelvin–Voigt elements along the chord.

    Args:
        elements: Natural lengths and stiffness of the elements.
        sections: Section of each rod.
        paper_strain: As for `ChordElement`.
    """

    def __init__(self, elements: Elements, sections: Sequence[Section], *, paper_strain: bool) -> None:
        self._elements = elements
        self._elastic = ChordElement(elements, paper_strain=paper_strain)
        self._τ = np.array([section.damping for section in sections])[elements.rod]

    def over(self, dt: float, before: Strain) -> ChordElement:
        """The law of a step that begins at a strain: stiffness (1 + τ/Δt) k, minus (τ/Δt) k Δ₀."""
        ratio = self._τ / dt
        behind = ratio[:, None, None] * self._elastic.moments(before.θ)
        return self._elastic.changed(1.0 + ratio, self._elements.l_0 + ratio / (1.0 + ratio) * before.ε, behind)

    def strain(self, e: Array, E: Array) -> Strain:
        """Deformation; arguments as for `ChordElement.measure`."""
        return Strain(*self._elastic.strains(e, E))

    def energy(self, strain: Strain) -> float:
        """½ Δ·k Δ."""
        return 0.5 * self._work(strain, np.ones_like(strain.ε))

    def lost(self, before: Strain, after: Strain, dt: float) -> float:
        """Energy that the step dissipates, (τ/Δt) (Δ₁ − Δ₀)·k (Δ₁ − Δ₀)."""
        return self._work(Strain(after.θ - before.θ, after.ε - before.ε), self._τ / dt)

    def elastic_force(self, e: Array, E: Array, strain: Strain) -> Array:
        """End forces without their viscous part, shape (n, 13)."""
        return self._elastic.measure(e, E, strain.ε / self._elements.compliance)[0]

    def _work(self, strain: Strain, weight: Array) -> float:
        """Sum over the elements of weight · Δ·k Δ."""
        own = np.einsum("ian,ian->n", strain.θ.T, self._elastic.moments(strain.θ).T)
        return float(weight @ (own + strain.ε**2 / self._elements.compliance))
