"""How the unknowns of nodes of rods that touch one another depend on each other: products, and blocks of a tangent."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

    from dolfinrod.continuum.everywhere import Everywhere
    from dolfinrod.scene.meeting import Coupling

    Array = NDArray[np.float64]
    Integers = NDArray[np.int64]

__all__ = ["Frames", "Links"]


@dataclass(frozen=True, eq=False)
class Frames:
    """How the unknowns of nodes move and turn them, and what forces and moments on nodes do to the balance of these.

    Args:
        moves: Change of position and rotation vector in space by the unknowns, shape (n_nodes or 1, 3 or 6, n).
        feels: Part of a force and a moment in space in the balance, shape (n_nodes or 1, n, 3 or 6).
        free: One for an unknown that is not held, or zero, shape (n_nodes, n).
    """

    moves: Array
    feels: Array
    free: Array

    def gathered(self, everywhere: Everywhere) -> Frames:
        """Those of the nodes of all ranks, on every rank."""
        free = everywhere.gathered(self.free)
        if len(self.moves) == 1:
            return Frames(self.moves, self.feels, free)
        n, (wide, unknowns) = len(self.free), self.moves.shape[1:]
        moves, feels = (everywhere.gathered(part.reshape(n, -1)) for part in (self.moves, self.feels))
        return Frames(moves.reshape(-1, wide, unknowns), feels.reshape(-1, unknowns, wide), free)

    def at(self, nodes: Integers) -> tuple[Array, Array]:
        """`moves` and `feels` of some nodes."""
        if len(self.moves) == 1:
            return self.moves, self.feels
        return self.moves[nodes], self.feels[nodes]


class Links:
    """Tangent of the balance of nodes by what rods do to one another: with the other sign than forces have.

    Every rank has what its own elements feel. All ranks call each of these together.

    Args:
        couplings: Gradients of forces and moments in space by positions and turns, one a meeting.
        frames: Of this rank's own nodes.
        everywhere: The nodes of all rods.
        turning: What moments that stay put add by rotations, shape (n_own, n_q, n_q); None where nothing rubs.
    """

    def __init__(
        self, couplings: Sequence[Coupling], frames: Frames, everywhere: Everywhere, turning: Array | None
    ) -> None:
        self._couplings, self._frames, self._everywhere = couplings, frames, everywhere
        self._turning = turning

    def times(self, u: Array) -> Array:
        """Change of the balance of this rank's own nodes with unknowns of all of them, shape (n_own, n) both."""
        frames, held = self._frames, u * self._frames.free
        moved = self._everywhere.gathered(np.matmul(frames.moves, held[:, :, None])[:, :, 0])
        dx, dturn = np.ascontiguousarray(moved[:, :3]), np.ascontiguousarray(moved[:, 3:])
        felt = np.zeros_like(moved)
        for coupling in self._couplings:
            for part, change in zip((felt[:, :3], felt[:, 3:]), coupling.times(dx, dturn), strict=True):
                part += change[:, : part.shape[1]]
        own = self._everywhere.summed(felt)[self._everywhere.own]
        balance = -np.matmul(frames.feels, own[:, :, None])[:, :, 0]
        if self._turning is not None:
            n_q = self._turning.shape[1]
            balance[:, -n_q:] -= np.matmul(self._turning, held[:, -n_q:, None])[:, :, 0]
        balance *= frames.free
        return balance

    @cached_property
    def nodal(self) -> Array:
        """Blocks of this rank's own nodes, shape (n_own, n, n)."""
        frames, n_own = self._frames, len(self._everywhere.own)
        wide = frames.moves.shape[1]
        K = np.zeros((self._everywhere.n, wide, wide))
        for coupling in self._couplings:
            part = coupling.nodal()
            for rows, blocks in enumerate(((part.f_x, part.f_turn), (part.m_x, part.m_turn))):
                for columns, block in enumerate(blocks):
                    if block is not None:
                        K[part.nodes, 3 * rows : 3 * rows + 3, 3 * columns : 3 * columns + 3] += block
        own = self._everywhere.summed(K.reshape(len(K), -1))[self._everywhere.own].reshape(n_own, wide, wide)
        nodal = -np.matmul(np.matmul(frames.feels, own), frames.moves)
        if self._turning is not None:
            n_q = self._turning.shape[1]
            nodal[:, -n_q:, -n_q:] -= self._turning
        free = frames.free
        return nodal * (free[:, :, None] * free[:, None, :])

    def blocks(self) -> Iterator[tuple[Integers, Array]]:
        """Blocks that link different nodes.

        Yields:
            Numbers of the nodes of each block, shape (m, M), and its entries among their unknowns, zero where one of
            them meets itself, shape (m, M, n, M, n); one such pair a meeting.
        """
        frames = self._frames.gathered(self._everywhere)
        for coupling in self._couplings:
            yield coupling.nodes, _between(coupling, frames)


def _between(coupling: Coupling, frames: Frames) -> Array:
    nodes, n = coupling.nodes, frames.free.shape[1]
    if not len(nodes):
        return np.zeros((0, nodes.shape[1], n, nodes.shape[1], n))
    K = _whole(coupling)
    moves, feels = frames.at(nodes)
    P, M, m = K.shape[:3]
    rows = (feels @ K.reshape(P, M, m, M * m)).reshape(P, M * n, M, m)
    blocks = np.swapaxes(np.swapaxes(rows, 1, 2) @ moves, 1, 2).reshape(P, M, n, M, n)
    free = frames.free[nodes]
    blocks *= -(free[:, :, :, None, None] * free[:, None, None])
    every = np.arange(M)
    blocks[:, every, :, every] = 0.0
    return blocks


def _whole(coupling: Coupling) -> Array:
    """Gradient of force, and moment where anything rubs, by position and turn, shape (m, M, 3 or 6, M, 3 or 6)."""
    if coupling.f_turn is None:
        return coupling.f_x
    above = np.concatenate([coupling.f_x, coupling.f_turn], axis=4)
    return np.concatenate([above, np.concatenate([coupling.m_x, coupling.m_turn], axis=4)], axis=2)
