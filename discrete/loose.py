"""Rods that are loose: held nowhere in some direction, in which all that acts moves them as a whole."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from discrete.unknowns import X

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.mesh import Mesh
    from discrete.supports import Supports

    Array = NDArray[np.float64]
    Counts = NDArray[np.int64]

__all__ = ["Loose", "loose"]


@dataclass(frozen=True, eq=False)
class Loose:
    """Masses of loose rods.

    Factors that turn node by node keep the balance of a rod as a whole to their own accuracy only; its momentum is to
    be kept to round-off.

    Args:
        m: Masses of the nodes, shape (n_nodes,).
        first: First node of each rod, shape (n_rods,).
        rod: Rod of each node, shape (n_nodes,).
        per_mass: One over the mass of each rod in the directions in which it is loose, zero else, shape (3, n_rods).
    """

    m: Array
    first: Counts
    rod: Counts
    per_mass: Array

    def move(self, d: Array, missing: Array, dt: float) -> None:
        """Move loose rods in addition by what their increments leave out of balance on the whole.

        Args:
            d: Increments, shape (7, n_nodes); change.
            missing: What they are to balance, shape (7, n_nodes).
            dt: Length of the step.
        """
        left = missing[X] * dt**2
        left -= self.m * d[X]
        whole = np.add.reduceat(left, self.first, axis=1)
        whole *= self.per_mass
        d[X] += whole.take(self.rod, axis=1)


def loose(mesh: Mesh, supports: Supports, m: Array) -> Loose | None:
    """The loose rods of a scene; None where there are none.

    Args:
        mesh: Nodes and elements.
        supports: What holds.
        m: Masses of the nodes, shape (n_nodes,).
    """
    first = mesh.first[:-1]
    free = ~np.logical_or.reduceat(supports.firm[:, X], first, axis=0)
    if not free.any():
        return None
    rod = np.repeat(np.arange(len(first)), np.diff(mesh.first))
    return Loose(m, first, rod, free.T / np.add.reduceat(m, first))
