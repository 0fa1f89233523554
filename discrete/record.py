"""From states of the model to the result record: SI units, section frames, values at the nodes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from discrete.unknowns import SPIN_I, SPIN_J, X_J
from dolfinrod.result import RodHistory

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from discrete.mesh import Mesh
    from dolfinrod.scene import Section

    Array = NDArray[np.float64]

__all__ = ["Snapshot", "histories"]


@dataclass(frozen=True, eq=False)
class Snapshot:
    """What is kept of an accepted state, in the units of the model.

    Args:
        t: Pseudo-time.
        x: Positions of the nodes, shape (n_nodes, 3).
        R: Section frames, shape (n_nodes, 3, 3).
        force: End forces of the elements, global axes, shape (n, 13).
        line: Dead force on each element, shape (n, 3).
        energy: Strain energy.
    """

    t: float
    x: Array
    R: Array
    force: Array
    line: Array
    energy: float


def histories(mesh: Mesh, sections: Sequence[Section], path: Sequence[Snapshot]) -> tuple[RodHistory, ...]:
    """One history per rod.

    Args:
        mesh: Nodes and elements.
        sections: Section of each rod.
        path: Accepted states, in order.

    Returns:
        Histories in SI units.
    """
    n, m = _resultants(mesh, path)
    r = np.stack([state.x for state in path]) * mesh.units.length + mesh.origin
    R = np.stack([state.R for state in path])
    rods = []
    for j, section in enumerate(sections):
        own = slice(mesh.first[j], mesh.first[j + 1])
        rods.append(
            RodHistory(
                s=mesh.s[j],
                r=r[:, own],
                frames=R[:, own],
                gamma=n[:, own] * (section.compliance_n[0], 0.0, 0.0),
                kappa=m[:, own] * np.array(section.compliance_m),
                n=n[:, own],
                m=m[:, own],
            )
        )
    return tuple(rods)


def _resultants(mesh: Mesh, path: Sequence[Snapshot]) -> tuple[Array, Array]:
    """Forces and moments in the section frames, averaged over the elements at a node, shapes (n_t, n_nodes, 3).

    The force of an element is that at its middle; the line load of half of it lies between there and its ends.
    """
    node_i = mesh.elements.node_i
    force = np.stack([state.force for state in path])
    half = 0.5 * np.stack([state.line for state in path])
    N = force[..., X_J]
    shape = (len(path), len(mesh.x), 3)
    n, m, count = np.zeros(shape), np.zeros(shape), np.zeros(len(mesh.x))
    for nodes, N_end, M_end in ((node_i, N + half, -force[..., SPIN_I]), (node_i + 1, N - half, force[..., SPIN_J])):
        n[:, nodes] += N_end
        m[:, nodes] += M_end
        count[nodes] += 1.0
    R = np.stack([state.R for state in path])
    local = np.einsum("tkji,tkj->tki", R, n), np.einsum("tkji,tkj->tki", R, m)
    share = 1.0 / count[None, :, None]
    return local[0] * share * mesh.units.force, local[1] * share * mesh.units.moment
