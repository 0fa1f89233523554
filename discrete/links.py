"""What rods that touch one another answer when they move: forces on the nodes of both."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from discrete.unknowns import AXIAL, N_NODE
from dolfinrod.scene.compiled import compiled

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from discrete.mesh import Units
    from dolfinrod.scene.meeting import Coupling

__all__ = ["Links"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]


@compiled
def _moved(d: Array, length: float, turning: Array) -> tuple[Array, Array]:
    """What increments displace and turn nodes by, SI units, shape (n_nodes, 3) each."""
    dx, turn = np.empty((len(d), 3)), np.zeros((len(d), 3))
    for n in range(len(d)):
        for i in range(3):
            dx[n, i] = length * d[n, i]
    for n in range(len(turning)):
        for i in range(3):
            turn[n, i] = turning[n, i, 0] * d[n, 3] + turning[n, i, 1] * d[n, 4] + turning[n, i, 2] * d[n, 5]
    return dx, turn


@compiled
def _add(force: Array, moment: Array, unit: float, unit_moment: float, change: Array) -> None:
    """Add forces and moments, shape (n_nodes, 3), divided by their units, to those of shape (n_nodes, 7)."""
    for n in range(len(change)):
        for i in range(3):
            change[n, i] += force[n, i] / unit
            change[n, 3 + i] += moment[n, i] / unit_moment


# Places of three by three values.
_I, _J = np.arange(3)[:, None], np.arange(3)


@dataclass(frozen=True, eq=False)
class Links:
    """Resistance of rods that touch one another, in units of the model.

    Args:
        couplings: What each meeting of the scene answers, SI units.
        units: What is one.
        turning: Θ, by which rotation vectors of the step follow spins, shape (n_nodes, 3, 3); None where nothing rubs.
    """

    couplings: Sequence[Coupling]
    units: Units
    turning: Array | None

    def change(self, d: Array) -> Array:
        """Change of all forces and moments with increments of all nodes, shape (n_nodes, 7) both."""
        d = np.ascontiguousarray(d)
        dx, turn = _moved(d, self.units.length, np.zeros((0, 3, 3)) if self.turning is None else self.turning)
        change = np.zeros(d.shape)
        for coupling in self.couplings:
            _add(*coupling.times(dx, turn), self.units.force, self.units.moment, change)
        return change

    @cached_property
    def nodal(self) -> tuple[Indices, Array]:
        """Nodes that touch, shape (m,), and their resistance to what they do themselves, shape (m, 6, 6)."""
        parts = [coupling.nodal() for coupling in self.couplings]
        nodes = np.unique(np.concatenate([np.zeros(0, dtype=np.int64), *(part.nodes for part in parts)]))
        blocks = np.zeros((len(nodes), 6, 6))
        for part in parts:
            at = np.searchsorted(nodes, part.nodes)
            for a, b, values in self._resistance((part.f_x, part.f_turn, part.m_x, part.m_turn), part.nodes):
                blocks[at, a : a + 3, b : b + 3] += values
        return nodes, blocks

    def beyond(self, d: Array) -> Array:
        """The change without what nodes feel of what they do themselves, shape (n_nodes, 7) both."""
        nodes, blocks = self.nodal
        change = self.change(d)
        change[nodes, :AXIAL] += np.matmul(blocks, d[nodes, :AXIAL, None])[:, :, 0]
        return change

    def entries(self) -> tuple[Indices, Indices, Array]:
        """Resistance of nodes to what others do: rows, columns and values in a matrix; those of one place add up."""
        rows, columns, values = [np.zeros(0, dtype=np.int64)], [np.zeros(0, dtype=np.int64)], [np.zeros(0)]
        for coupling in self.couplings:
            m = coupling.nodes.shape[1]
            row, column = np.repeat(coupling.nodes, m, axis=1).reshape(-1), np.tile(coupling.nodes, (1, m)).reshape(-1)
            other = np.flatnonzero(np.tile(~np.eye(m, dtype=bool).reshape(-1), len(coupling.nodes)))
            row, column = row[other], column[other]
            blocks = (coupling.f_x, coupling.f_turn, coupling.m_x, coupling.m_turn)
            paired = (None if f is None else f.transpose(0, 1, 3, 2, 4).reshape(-1, 3, 3)[other] for f in blocks)
            for a, b, part in self._resistance(paired, column):
                shape = part.shape
                rows.append(np.broadcast_to(N_NODE * row[:, None, None] + a + _I, shape).reshape(-1))
                columns.append(np.broadcast_to(N_NODE * column[:, None, None] + b + _J, shape).reshape(-1))
                values.append(part.reshape(-1))
        return np.concatenate(rows), np.concatenate(columns), np.concatenate(values)

    def _resistance(self, blocks: Iterable[Array | None], column: Indices) -> Iterator[tuple[int, int, Array]]:
        """Blocks, shape (n, 3, 3), to what the nodes `column` do, with where they begin among six components."""
        L, force, moment = self.units.length, self.units.force, self.units.moment
        places = ((0, 0, L / force), (0, 3, 1.0 / force), (3, 0, L / moment), (3, 3, 1.0 / moment))
        for (a, b, unit), block in zip(places, blocks, strict=True):
            if block is not None:
                felt = -unit * block
                yield a, b, felt if b == 0 or self.turning is None else felt @ self.turning[column]
