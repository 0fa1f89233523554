"""What acts at single nodes, worked into the system of the elements: supports, guides, follower loads, surfaces."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from discrete.assembly import BandedSystem, Inverse
from discrete.coupled import factorised, solved
from discrete.rotation import skew
from discrete.unknowns import AXIAL, N_NODE, SPIN

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.coupled import CoupledInverse
    from discrete.loads import LoadLevel
    from discrete.mesh import Mesh
    from discrete.supports import Guides
    from discrete.touched import Touched

    Array = NDArray[np.float64]
    Indices = NDArray[np.int64]

__all__ = ["NodalSystem", "Tangent"]


@dataclass(frozen=True, eq=False)
class Tangent:
    """Tangent of a state with all that acts at single nodes worked in.

    Args:
        system: Where its unknowns stand and which of them are held.
        elements: Of the elements, shape (n, 13, 13).
        guided: Nodes whose spins stand in axes of their own, shape (m,).
        axes: These axes as columns, shape (m, 3, 3).
        touched: The part of surfaces in it, in the axes of the unknowns; None where there is none.
    """

    system: BandedSystem
    elements: Array
    guided: Indices
    axes: Array
    touched: Touched | None = None

    def inverse(self) -> Inverse | CoupledInverse:
        """Its factors; SingularTangentError where there are none."""
        return factorised(self) if self.coupled else self.system.inverse(self.elements)

    @property
    def coupled(self) -> bool:
        """Whether rods that touch one another are in it."""
        return self.touched is not None and self.touched.links is not None

    def times(self, vectors: Array) -> Array:
        """Products with several vectors, shape (n_unknowns, m)."""
        node_i = self.system.node_i
        v = vectors.reshape(len(vectors) // N_NODE, N_NODE, vectors.shape[1])
        own = np.concatenate([v[node_i], v[node_i + 1, :AXIAL]], axis=1)
        product, total = np.matmul(self.elements, own), np.zeros_like(v)
        total[node_i] = product[:, :N_NODE]
        total[node_i + 1, :AXIAL] += product[:, N_NODE:]
        if self.touched is not None and self.touched.links is not None:
            for k in range(vectors.shape[1]):
                total[:, :, k] -= self.in_axes(self.touched.links.beyond(self.in_space(v[:, :, k])))
        return total.reshape(vectors.shape)

    def in_space(self, unknowns: Array) -> Array:
        """Unknowns with all spins in global axes, shape (n_nodes, 7)."""
        turned = unknowns.copy()
        turned[self.guided, SPIN] = np.matmul(self.axes, turned[self.guided, SPIN, None])[:, :, 0]
        return turned

    def in_axes(self, unknowns: Array) -> Array:
        """The reverse of `in_space`."""
        turned = unknowns.copy()
        turned[self.guided, SPIN] = np.matmul(turned[self.guided, None, SPIN], self.axes)[:, 0]
        return turned


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
        self,
        tangent: Array,
        missing: Array,
        held: Array,
        level: LoadLevel,
        guides: Guides,
        R: Array,
        touched: Touched | None = None,
    ) -> tuple[Array, float, Tangent]:
        """Solve for the increments of all nodes.

        Args:
            tangent: Tangents of the elements, overwritten, shape (n, 13, 13).
            missing: Loads minus internal forces, overwritten, shape (n_nodes, 7).
            held: Increments at the supports, shape (n_nodes, 7).
            level: Loads, of which the follower ones add stiffness.
            guides: Sections with one held component of the rotation vector.
            R: Section frames, shape (n_nodes, 3, 3).
            touched: Resistance of surfaces.

        Returns:
            Increments, shape (n_nodes, 7), the largest free out-of-balance force or moment before them, the tangent.

        Raises:
            SingularTangentError: There is no solution.
        """
        worked_in = self.tangent(tangent, missing, held, level, guides, R, touched)
        right = missing.reshape(-1)
        right[self._band.held] = 0.0
        residual = float(np.abs(np.delete(missing, AXIAL, axis=1)).max())
        right[self._band.held] = held.reshape(-1)[self._band.held]
        d = (solved(worked_in, right) if worked_in.coupled else self._band.solve(tangent, right)).reshape(-1, N_NODE)
        return worked_in.in_space(d), residual, worked_in

    def tangent(
        self,
        elements: Array,
        missing: Array,
        held: Array,
        level: LoadLevel,
        guides: Guides,
        R: Array,
        touched: Touched | None = None,
    ) -> Tangent:
        """Work what acts at single nodes into tangent and right-hand sides; arguments as for `increments`."""
        if len(level.followed):
            self._add(elements, level.followed, slice(0, AXIAL), level.stiffness(R))
        if touched is not None:
            touched.enter(elements, self._band.node_i)
        axes = np.zeros((0, 3, 3))
        if len(guides.nodes):
            axes = self._guide(elements, missing, held, guides, R)
            touched = None if touched is None else touched.in_axes(guides.nodes, axes)
        return Tangent(self._band, elements, guides.nodes, axes, touched)

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
        axes = _completed(c / np.sqrt(square)[:, None], guides.axis)
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


def _completed(first: Array, axis: Indices) -> Array:
    """Orthonormal axes, as columns, with a given first one: coordinate axes turned the shortest way from e_a to it.

    They turn as smoothly as the first does, so that tangents of neighbouring states can be compared.

    Args:
        first: Unit vectors, shape (m, 3).
        axis: The component a of each, shape (m,).

    Returns:
        Axes, shape (m, 3, 3).
    """
    order = (axis[:, None] + np.arange(3)) % 3
    e = np.eye(3)[order]
    v = np.cross(e[:, 0], first)
    turning = skew(v)
    cosine = np.einsum("mi,mi->m", e[:, 0], first)
    Q = np.eye(3) + turning + turning @ turning / (1.0 + cosine)[:, None, None]
    return np.asarray(Q @ np.swapaxes(e, 1, 2))
