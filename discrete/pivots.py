"""Which nodes surfaces press where a linear step leads, found with the factors of its tangent."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from discrete.unknowns import N_NODE, X
from dolfinrod.scene.pivoting import joined, pivoted

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.assembly import Inverse
    from discrete.contact import Contacts
    from discrete.coupled import CoupledInverse
    from discrete.mesh import Units
    from discrete.nodes import Tangent
    from dolfinrod.scene.pivoting import Outlook

    Array = NDArray[np.float64]
    Flags = NDArray[np.bool_]
    Indices = NDArray[np.int64]

__all__ = ["completed"]


def completed(walls: Contacts, x: Array, tangent: Tangent, units: Units) -> Array | float | None:
    """What a linear step to x lacks that presses other nodes than it should.

    Args:
        walls: Which are told what it presses.
        x: Where it leads, shape (n_nodes, 3).
        tangent: With which it was taken.
        units: Of the model.

    Returns:
        Increments, shape (n_nodes, 7) or 0; None where it is not the way to any set of nodes.
    """
    pairs, place = walls.pairs, walls.in_space(x)
    ahead = [pair.touch.ahead(place[pair.mine], pair.share) for pair in pairs]
    nodes = np.concatenate([np.arange(pair.mine.start, pair.mine.stop)[: pair.touch.open] for pair in pairs])
    found = _missing(joined(ahead), nodes, tangent, units)
    if found is None:
        return None
    pressed, d = found
    ends = np.cumsum([len(one.pressed) for one in ahead])[:-1]
    for pair, those in zip(pairs, np.split(pressed, ends), strict=True):
        pair.touch.settle(those)
    return d


def _missing(ahead: Outlook, nodes: Indices, tangent: Tangent, units: Units) -> tuple[Flags, Array | float] | None:
    """What a linear step lacks if it presses other points of nodes than it should.

    Args:
        ahead: Where it leads.
        nodes: Of the points, shape (n,).
        tangent: With which it was taken.
        units: Of the model.

    Returns:
        The points that are pressed, and the increments, shape (n_nodes, 7) or 0; None where it is not the way to any.
    """
    factors: list[Inverse | CoupledInverse] = []

    def solved(q: Array) -> Array:
        """Increments under forces q along the normals, shape (n_nodes, 7)."""
        if not factors:
            factors.append(tangent.inverse())
        right = np.zeros((len(tangent.system.scale) // N_NODE, N_NODE))
        np.add.at(right[:, X], nodes, ahead.normal * (q / units.force)[:, None])
        right = right.reshape(-1, 1)
        right[tangent.system.held] = 0.0
        return tangent.in_space(factors[0].times(right).reshape(-1, N_NODE))

    def moved(point: int) -> Array:
        way = solved((np.arange(len(nodes)) == point).astype(float))[nodes, X]
        return np.asarray(units.length * np.einsum("ni,ni->n", ahead.normal, way))

    found = pivoted(ahead, moved)
    if found is None:
        return None
    return found[0], solved(found[1]) if found[1].any() else 0.0
