"""What acts at single nodes, worked into the system of the elements: supports, guides, follower loads."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from discrete.assembly import BandedSystem
from discrete.unknowns import AXIAL, N_NODE, SPIN

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.loads import LoadLevel
    from discrete.mesh import Mesh
    from discrete.supports import Guides

    Array = NDArray[np.float64]
    Indices = NDArray[np.int64]

__all__ = ["NodalSystem"]


class NodalSystem:
    """Linear system of the increments of all nodes.

    Args:
        mesh: Nodes and elements.
        held: Held unknowns.
    """

    def __init__(self, mesh: Mesh, held: Indices) -> None:
        node_i = mesh.elements.node_i
        self._band = BandedSystem(len(mesh.x), node_i, mesh.elements.l, held)
        self._begins = np.full(len(mesh.x), -1)
        self._begins[node_i] = np.arange(len(node_i))
        self._ends = np.full(len(mesh.x), -1)
        self._ends[node_i + 1] = np.arange(len(node_i))

    def increments(
        self, tangent: Array, missing: Array, held: Array, level: LoadLevel, guides: Guides, R: Array
    ) -> tuple[Array, float]:
        """Solve for the increments of all nodes.

        Args:
            tangent: Tangents of the elements, overwritten, shape (n, 13, 13).
            missing: Loads minus internal forces, overwritten, shape (n_nodes, 7).
            held: Increments at the supports, shape (n_nodes, 7).
            level: Loads, of which the follower ones add stiffness.
            guides: Sections with one held component of the rotation vector.
            R: Section frames, shape (n_nodes, 3, 3).

        Returns:
            Increments, shape (n_nodes, 7), and the largest free out-of-balance force or moment before them.

        Raises:
            SingularTangentError: There is no solution.
        """
        if len(level.followed):
            self._add(tangent, level.followed, slice(0, AXIAL), level.stiffness(R))
        axes = self._guide(tangent, missing, held, guides, R) if len(guides.nodes) else None
        right = missing.reshape(-1)
        right[self._band.held] = 0.0
        residual = float(np.abs(np.delete(missing, AXIAL, axis=1)).max())
        right[self._band.held] = held.reshape(-1)[self._band.held]
        d = self._band.solve(tangent, right).reshape(-1, N_NODE)
        if axes is not None:
            d[guides.nodes, SPIN] = np.matmul(axes, d[guides.nodes, SPIN, None])[:, :, 0]
        return d, residual

    def _guide(self, tangent: Array, missing: Array, held: Array, guides: Guides, R: Array) -> Array:
        """Turn the spins of guided nodes into axes whose first is the held one.

        The support answers with the moment λ c, c = ∂θ_a/∂ω; it works into the tangent as −λ ∂c/∂ω.

        Returns:
            The axes as columns, shape (m, 3, 3).
        """
        θ_a, c, slope = guides.linearized(R)
        square = np.einsum("mi,mi->m", c, c)
        λ = -np.einsum("mi,mi->m", c, missing[guides.nodes, SPIN]) / square
        self._add(tangent, guides.nodes, SPIN, -λ[:, None, None] * slope)
        axes = _completed(c / np.sqrt(square)[:, None])
        for node, B in zip(guides.nodes, axes, strict=True):
            for element, offset in ((self._begins[node], 0), (self._ends[node], N_NODE)):
                if element >= 0:
                    spin = slice(offset + SPIN.start, offset + SPIN.stop)
                    tangent[element, :, spin] = tangent[element, :, spin] @ B
                    tangent[element, spin] = B.T @ tangent[element, spin]
        missing[guides.nodes, SPIN] = np.matmul(missing[guides.nodes, None, SPIN], axes)[:, 0]
        held[guides.nodes, SPIN.start] = -θ_a / np.sqrt(square)
        return axes

    def _add(self, tangent: Array, nodes: Indices, place: slice, blocks: Array) -> None:
        """Add stiffness of single nodes to one element each that has the node."""
        for node, block in zip(nodes, blocks, strict=True):
            element, offset = (self._begins[node], 0) if self._begins[node] >= 0 else (self._ends[node], N_NODE)
            at = slice(offset + place.start, offset + place.stop)
            tangent[element, at, at] += block


def _completed(first: Array) -> Array:
    """Right-handed orthonormal axes, as columns, with a given first one; shapes (m, 3) and (m, 3, 3)."""
    aside = np.eye(3)[np.argmin(np.abs(first), axis=1)]
    second = np.cross(first, aside)
    second /= np.linalg.norm(second, axis=1)[:, None]
    return np.stack([first, second, np.cross(first, second)], axis=2)
