"""Drag of air at the nodes: force per length times the length that belongs to a node."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from discrete.rotation import skew

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from discrete.mesh import Mesh
    from dolfinrod.scene import Air, Section

    Array = NDArray[np.float64]

__all__ = ["Drag"]


class Drag:
    """Air around the nodes of all rods, F = f(u_air − v, d1) l with l half of the elements at a node.

    Args:
        air: The flow.
        mesh: Nodes and elements.
        sections: Section of each rod, their radii known.
    """

    def __init__(self, air: Air, mesh: Mesh, sections: Sequence[Section]) -> None:
        self._air, self._unit, self._origin = air, mesh.units.length, mesh.origin
        self._share = mesh.share * mesh.units.length / mesh.units.force
        self._d = np.repeat([2.0 * (section.radius or 0.0) for section in sections], np.diff(mesh.first))

    def force(self, x: Array, R: Array, v: Array, t: float) -> Array:
        """Forces on the nodes.

        Args:
            x: Positions, shape (n_nodes, 3).
            R: Section frames, shape (n_nodes, 3, 3).
            v: Velocities, shape (n_nodes, 3).
            t: Time [s].

        Returns:
            Shape (n_nodes, 3).
        """
        return self._share[:, None] * self._air.drag(self._wind(x, v, t), R[:, :, 0], self._d)

    def blocks(self, x: Array, R: Array, v: Array, t: float, dt: float) -> Array:
        """Resistance to displacement and spin of a node at the end of a step Δt; arguments as for `force`.

        The flow is taken to be the same where the node moves to.

        Returns:
            Shape (n_nodes, 6, 6).
        """
        _, by_v, by_tangent = self._air.linearized_drag(self._wind(x, v, t), R[:, :, 0], self._d)
        blocks = np.zeros((len(x), 6, 6))
        blocks[:, :3, :3] = by_v * self._unit / dt
        blocks[:, :3, 3:] = by_tangent @ skew(R[:, :, 0])
        blocks *= self._share[:, None, None]
        return blocks

    def _wind(self, x: Array, v: Array, t: float) -> Array:
        """Velocity of the air against the rod, shape (n_nodes, 3) [m/s]."""
        wind = v * -self._unit
        wind += self._air.velocity(x * self._unit + self._origin, t) if callable(self._air.field) else self._air.field
        return wind
