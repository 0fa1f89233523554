"""The paper's loading to the letter, 2.3.3: one linear solve a load increment, resultants accumulated.

Each increment takes the configuration it finds as the initial one: k = tᵀ k*(F_n) t is set up there (Eq. 15–19), solved
once, positions and sections are moved, and the end forces k* Δ* are added to those the elements carry along in their
own axes. Nothing is iterated. What the elements then lack of the loads enters the next increment; without that the
shear forces, which [k*] does not turn with the element, would leave an error that no number of increments removes.
The error falls with the size of the increments; in the frame of node i, at the angle κ l/2 to the chord along which
[k*] holds, one of order l remains.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from discrete.assembly import gather, scatter
from discrete.element import stiffness
from discrete.frames import direction_cosines, element_frame, transformation
from discrete.nodes import NodalSystem
from discrete.record import Snapshot, evenly
from discrete.rotation import exp
from discrete.unknowns import AXIAL, N_ELEMENT, SPIN, X

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.loads import Loads
    from discrete.mesh import Mesh
    from discrete.supports import Supports

    Array = NDArray[np.float64]

__all__ = ["Carried", "Increments"]

# (x_i, ω_i, x_j, ω_j) among the unknowns of an element.
_ENDS = np.delete(np.arange(N_ELEMENT), AXIAL)


@dataclass(frozen=True, eq=False)
class Carried:
    """Configuration and the end forces that the elements carry along.

    Args:
        x: Positions of the nodes, shape (n_nodes, 3).
        R: Section frames, shape (n_nodes, 3, 3).
        F: End forces in element axes, shape (n, 12).
        factors: Factors of the prescribed motions, shape (n_prescribed,).
    """

    x: Array
    R: Array
    F: Array
    factors: Array


class Increments:
    """Load increments without equilibrium iterations.

    Args:
        mesh: Nodes and elements.
        loads: What acts.
        supports: What holds.
        node_frame: Whether the element axes are those of node i (Eq. 20) instead of those along the chord.

    Attributes:
        mesh: Nodes and elements.
    """

    def __init__(self, mesh: Mesh, loads: Loads, supports: Supports, *, node_frame: bool) -> None:
        self.mesh, self._loads, self._supports, self._node_frame = mesh, loads, supports, node_frame
        self._system = NodalSystem(mesh, supports.held)

    def begin(self) -> Carried:
        """Stress-free configuration."""
        mesh = self.mesh
        return Carried(mesh.x, mesh.R, np.zeros((len(mesh.elements.l), 12)), np.zeros(self._supports.n_factors))

    def take(self, state: Carried, t: float) -> tuple[Carried, float]:
        """One increment, to a pseudo-time.

        Args:
            state: Where it starts.
            t: Pseudo-time whose loads are reached.

        Returns:
            Where it ends, and the largest force or moment that was out of balance before it.

        Raises:
            SingularTangentError: Something is free to move.
        """
        mesh, node_i = self.mesh, self.mesh.elements.node_i
        axes = transformation(direction_cosines(self._axes(state.x, state.R)))
        tangent = np.zeros((len(axes), N_ELEMENT, N_ELEMENT))
        k_star = mesh.elements.k_star + _string(state.F[:, 6] / mesh.elements.l)
        tangent[:, _ENDS[:, None], _ENDS] = np.swapaxes(axes, 1, 2) @ k_star @ axes
        tangent[:, AXIAL, AXIAL] = 1.0
        level, goal = self._loads.level(t), self._supports.factors(t)
        missing = level.at(state.R) - scatter(self.forces(state), node_i, len(state.x))
        held = self._supports.increments(state.x, state.factors, goal)
        d, residual, _ = self._system.increments(tangent, missing, held, level, self._supports.guides, state.R)
        Δ = np.matmul(axes, gather(d, node_i)[:, _ENDS, None])
        F = state.F + np.matmul(mesh.elements.k_star, Δ)[:, :, 0]
        R = exp(d[:, SPIN]) @ state.R
        for section in self._supports.turns:
            R[section.node] = section.frame(goal)
        return Carried(state.x + d[:, X], R, F, goal), residual

    def forces(self, state: Carried) -> Array:
        """End forces of the elements in global axes, the place of F_n empty, shape (n, 13)."""
        axes = transformation(direction_cosines(self._axes(state.x, state.R)))
        force = np.zeros((len(axes), N_ELEMENT))
        force[:, _ENDS] = np.matmul(np.swapaxes(axes, 1, 2), state.F[:, :, None])[:, :, 0]
        return force

    def snapshot(self, state: Carried, t: float) -> Snapshot:
        """What is kept of a state."""
        return Snapshot(t, state.x, state.R, self.forces(state), evenly(self._loads.level(t).line), self._energy(state))

    def _axes(self, x: Array, R: Array) -> Array:
        """Axes of the elements, columns, shape (n, 3, 3)."""
        E = self.mesh.elements.triads(R)
        if self._node_frame:
            return E[:, 0]
        node_i = self.mesh.elements.node_i
        return element_frame(x[node_i + 1] - x[node_i], E).axes

    def _energy(self, state: Carried) -> float:
        """Strain energy ½ F* k*⁻¹ F* of the end forces at j, node i held."""
        k = self.mesh.elements.k_star[:, 6:, 6:]
        at_j = state.F[:, 6:]
        return float(0.5 * np.einsum("ni,ni->", at_j, np.linalg.solve(k, at_j)))


def _string(stress: Array) -> Array:
    """F_n/l of Eq. 15, shape (n, 12, 12)."""
    return stiffness(EA=0.0, GI_p=0.0, EI_v=0.0, EI_w=0.0, l=1.0, F_n=stress)
