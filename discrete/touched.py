"""What surfaces and other rods answer at the nodes that touch them: resistance, and energies of a step."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from discrete.singly import resisted
from discrete.unknowns import AXIAL, N_NODE, SPIN

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.links import Links

    Array = NDArray[np.float64]
    Indices = NDArray[np.int64]

__all__ = ["Booking", "Touched"]


@dataclass(frozen=True, eq=False)
class Touched:
    """Resistance of surfaces, and of other rods, at the nodes that touch them.

    Args:
        nodes: Each once, shape (m,).
        blocks: To their own displacement and spin, shape (m, 6, 6); unsymmetric where there is friction.
        links: All that rods do to one another, `blocks` holding its part at single nodes; None where there is nothing.
        firm: What surfaces do of it; None: all.
    """

    nodes: Indices
    blocks: Array
    links: Links | None = None
    firm: Touched | None = None

    @property
    def stiffest(self) -> float:
        """Largest of them all; a tiny number where nothing touches."""
        return float(np.abs(self.blocks).max(initial=float(np.finfo(float).tiny)))

    def enter(self, elements: Array, node_i: Indices, sign: float = 1.0) -> None:
        """Add them to the tangents of elements, shape (n, 13, 13), that begin at nodes node_i: to one each."""
        at = np.searchsorted(node_i, self.nodes).clip(0, len(node_i) - 1)
        begins = node_i[at] == self.nodes
        elements[at[begins], :AXIAL, :AXIAL] += sign * self.blocks[begins]
        ends = np.searchsorted(node_i, self.nodes[~begins] - 1)
        elements[ends, N_NODE:, N_NODE:] += sign * self.blocks[~begins]

    def change(self, d: Array) -> Array:
        """Change of forces and moments with increments of all nodes, shape (n_nodes, 7) both."""
        d = np.ascontiguousarray(d)
        if self.links is not None:
            change = self.links.change(d)
            if self.firm is not None:
                resisted(self.firm.nodes, self.firm.blocks, d, change)
            return change
        change = np.zeros_like(d)
        resisted(self.nodes, self.blocks, d, change)
        return change

    def mark(self, some: NDArray[np.bool_]) -> None:
        """Mark all nodes of these, shape (n_nodes,), that answer."""
        some[self.nodes] = True
        if self.firm is not None:
            some[self.firm.nodes] = True
        for coupling in () if self.links is None else self.links.couplings:
            some[coupling.nodes] = True

    @property
    def askew(self) -> Indices:
        """Nodes whose resistance does not turn with their sections: surfaces stay where they are."""
        return self.nodes if self.firm is None else self.firm.nodes

    @property
    def meets(self) -> bool:
        """Whether any rods touch one another."""
        return self.links is not None and len(self.links.couplings) > 0

    def alone(self) -> Touched:
        """What nodes do to themselves only."""
        return replace(self, links=None)

    def in_axes(self, nodes: Indices, axes: Array) -> Touched:
        """The same with the spins of some nodes in axes of their own, shapes (k,) and (k, 3, 3)."""
        blocks = self.blocks.copy()
        _, mine, theirs = np.intersect1d(self.nodes, nodes, assume_unique=True, return_indices=True)
        B = axes[theirs]
        blocks[mine, :, SPIN] = blocks[mine, :, SPIN] @ B
        blocks[mine, SPIN] = np.swapaxes(B, 1, 2) @ blocks[mine, SPIN]
        return replace(self, blocks=blocks)


@dataclass(frozen=True)
class Booking:
    """Energies of a step, in units of the model.

    Args:
        stored: What contact stores at its end.
        rubbed: What friction took.
        pushed: Work of moving walls on the rods.
        damped: What damping of contact took.
    """

    stored: float = 0.0
    rubbed: float = 0.0
    pushed: float = 0.0
    damped: float = 0.0
