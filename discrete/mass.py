"""Masses of the nodes, Eq. 1–10: half of each element to either end, with the inertia of that half about the node.

A node between two elements of length l carries m = ρA l and, across the rod, the rotary inertia ρI l + m l²/12 of the
paper's J_v and J_w; an end node half of both, (m/2)(l/2)²/3, so that the total mass is that of the rod.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from discrete.frames import direction_cosines, inertia
from discrete.unknowns import AXIAL, N_ELEMENT, N_NODE, SPIN_I, SPIN_J, X_I, X_J
from dolfinrod.scene import SceneError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from discrete.mesh import Mesh
    from discrete.nodes import Tangent
    from dolfinrod.scene import Section

    Array = NDArray[np.float64]

__all__ = ["Masses", "at_nodes", "densities", "masses", "node_masses", "uniform"]

# Inertia about its own axis of a node without any, over that across: something must resist the spin of a free rod.
SPINNING = 1e-3


@dataclass(frozen=True, eq=False)
class Masses:
    """Mass and rotary inertia at either end of each element, in units of the model; time is in seconds.

    Args:
        m: Shape (n,).
        J_star: About d1, d2, d3, shape (n, 3).
    """

    m: Array
    J_star: Array

    def elements(self, R: Array, tangent: Tangent) -> Array:
        """Mass matrices of the elements, block by block, in the axes in which the tangent holds its spins.

        Args:
            R: Section frames, shape (n_nodes, 3, 3).
            tangent: Says which spins stand in axes of their own.

        Returns:
            Shape (n, 13, 13).
        """
        node_i = tangent.system.node_i
        M = np.zeros((len(self.m), N_ELEMENT, N_ELEMENT))
        axes = np.tile(np.eye(3), (len(R), 1, 1))
        axes[tangent.guided] = tangent.axes
        A = direction_cosines(R) @ axes
        for place, spin, nodes in ((X_I, SPIN_I, node_i), (X_J, SPIN_J, node_i + 1)):
            M[:, place, place] = self.m[:, None, None] * np.eye(3)
            M[:, spin, spin] = inertia(self.J_star[:, :, None] * np.eye(3), A[nodes])
        return M


def at_nodes(elements: Array, tangent: Tangent) -> Array:
    """Mass matrices of the nodes from those of the elements, shape (n_nodes, 7, 7)."""
    system = tangent.system
    M = np.zeros((system.n_unknowns // N_NODE, N_NODE, N_NODE))
    M[system.node_i] = elements[:, :N_NODE, :N_NODE]
    M[system.node_i + 1, :AXIAL, :AXIAL] += elements[:, N_NODE:, N_NODE:]
    return M


def masses(mesh: Mesh, ρA: Array, ρI: Array) -> Masses:
    """Masses of given densities.

    Args:
        mesh: Nodes and elements.
        ρA: Mass per length of each rod [kg/m].
        ρI: Rotary inertia per length of each rod, shape (n_rods, 3) [kg m].

    Returns:
        In units of the model.
    """
    of, l = mesh.elements.rod, mesh.elements.l * mesh.units.length
    J_star = ρI[of] * (0.5 * l)[:, None]
    J_star[:, 1:] += (ρA[of] * l**3 / 24.0)[:, None]
    return Masses(0.5 * ρA[of] * l * mesh.units.length / mesh.units.force, J_star / mesh.units.moment)


def node_masses(mesh: Mesh, sections: Sequence[Section], *, whole_ends: bool) -> tuple[Array, Array]:
    """Masses of the nodes for motion in time.

    Args:
        mesh: Nodes and elements.
        sections: Section of each rod.
        whole_ends: Whether end nodes are like all others, which makes a rod too heavy by a part 1/n.

    Returns:
        m, shape (n_nodes,), and J* about d1, d2, d3, shape (n_nodes, 3), in units of the model. Where a section has no
        rotary inertia about its normal, a thousandth of that of the node across it stands in.

    Raises:
        SceneError: A section without mass.
    """
    of = masses(mesh, *densities(sections))
    node_i = mesh.elements.node_i
    m, J_star = np.zeros(len(mesh.x)), np.zeros((len(mesh.x), 3))
    m[node_i], J_star[node_i] = of.m, of.J_star
    m[node_i + 1] += of.m
    J_star[node_i + 1] += of.J_star
    if whole_ends:
        ends = np.concatenate([mesh.first[:-1], mesh.first[1:] - 1])
        m[ends] *= 2.0
        J_star[ends] *= 2.0
    J_star[:, 0] = np.where(J_star[:, 0] > 0.0, J_star[:, 0], SPINNING * J_star[:, 1])
    return m, J_star


def densities(sections: Sequence[Section]) -> tuple[Array, Array]:
    """Mass and rotary inertia per length of each rod, the latter zero where it is not given.

    Raises:
        SceneError: A section without mass.
    """
    for k, section in enumerate(sections):
        if section.rhoA is None:
            raise SceneError(f"rods[{k}].section.rhoA (or a density) is needed for frequencies, got None")
    return (
        np.array([section.rhoA for section in sections], dtype=float),
        np.array([section.rhoI or (0.0, 0.0, 0.0) for section in sections], dtype=float),
    )


def uniform(mesh: Mesh, gyration: float = 0.0) -> Masses:
    """The same mass per length everywhere, and a radius of gyration beside that of the nodes; in units of the model."""
    n, ρA = len(mesh.s), mesh.units.force / mesh.units.length**2
    return masses(mesh, np.full(n, ρA), np.full((n, 3), ρA * (gyration * mesh.units.length) ** 2))
