"""Law of the elements in each step of a motion: elastic, or with the damping of the sections."""

from __future__ import annotations

from typing import TYPE_CHECKING

from discrete.ends import Ends
from discrete.rows import of_frames, of_vectors

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from discrete.constitution import Element
    from discrete.damping import Damping, Strain
    from discrete.euler import Taken
    from discrete.mesh import Mesh
    from discrete.moving import Moving

    Array = NDArray[np.float64]

__all__ = ["Damped", "Elastic"]


class Elastic:
    """The same law in every step.

    Args:
        mesh: Nodes and elements.
        law: Of the elements.
    """

    def __init__(self, mesh: Mesh, law: Element) -> None:
        self._ends, self._law = Ends(mesh.elements, len(mesh.x)), law

    def begin(self, state: Moving) -> tuple[Array, float]:
        """End forces and strain energy of the state that a motion begins with."""
        force, energy = self._law.measure(*_joined(self._ends, state), state.F_n)
        return force, float(energy.sum())

    def over(self, dt: float) -> Element:
        """Law of a step of length Δt from the last state."""
        return self._law

    def accept(self, taken: Taken, dt: float) -> tuple[float, float]:
        """Strain energy at the end of a step, and what it has dissipated."""
        return taken.energy, 0.0

    def elastic_force(self, state: Moving) -> Array | None:
        """End forces without those of damping; None where there is none."""
        return None


class Damped:
    """A law that remembers the last deformation.

    Args:
        mesh: Nodes and elements.
        damping: Of the sections.
    """

    def __init__(self, mesh: Mesh, damping: Damping) -> None:
        self._ends, self._damping = Ends(mesh.elements, len(mesh.x)), damping
        self._strain: Strain

    def begin(self, state: Moving) -> tuple[Array, float]:
        """End forces and strain energy of the state that a motion begins with, as if it had been at rest."""
        e, E = _joined(self._ends, state)
        self._strain = self._damping.strain(e, E)
        return self._damping.elastic_force(e, E, self._strain), self._damping.energy(self._strain)

    def over(self, dt: float) -> Element:
        """Law of a step of length Δt from the last state."""
        return self._damping.over(dt, self._strain)

    def accept(self, taken: Taken, dt: float) -> tuple[float, float]:
        """Strain energy at the end of a step, and what it has dissipated."""
        before, self._strain = self._strain, self._damping.strain(*_joined(self._ends, taken.state))
        return self._damping.energy(self._strain), self._damping.lost(before, self._strain, dt)

    def elastic_force(self, state: Moving) -> Array | None:
        """End forces without those of damping, at the last state."""
        return self._damping.elastic_force(*_joined(self._ends, state), self._strain)


def _joined(ends: Ends, state: Moving) -> tuple[Array, Array]:
    """Chords and the triads attached to their ends."""
    return ends.chords(of_vectors(state.x)).T, ends.triads(of_frames(state.R)).transpose(3, 2, 0, 1)
