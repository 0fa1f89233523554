"""The nodes that one contact of a scene concerns."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.mesh import Units
    from dolfinrod.scene import Contact, Touch
    from dolfinrod.scene.reply import Reply

    Array = NDArray[np.float64]

__all__ = ["Pair"]


@dataclass(eq=False)
class Pair:
    """The nodes that one contact concerns.

    Args:
        contact: The surface and its laws.
        mine: These nodes.
        share: Length for which each stands, shape (n,) [m].
        touch: What the surface does to them.
    """

    contact: Contact
    mine: slice
    share: Array
    touch: Touch

    def __post_init__(self) -> None:
        self.rubs, self.turn = self.touch.turns, np.zeros((len(self.share), 3))
        self.reply: Reply

    def respond(self, x: Array, turns: Array) -> Reply:
        """What acts at positions in SI units, rotation vectors over the step being known."""
        if self.rubs:
            self.turn = turns[self.mine]
        self.reply = self.touch.respond(x[self.mine], self.turn)
        return self.reply

    def resist(self, total: Array, Θ: Array | None, units: Units) -> NDArray[np.intp]:
        """Add the resistance in the last answer to blocks of all nodes.

        Args:
            total: In units of the model, shape (n_nodes, 6, 6).
            Θ: By which rotation vectors of the step follow spins, shape (n_nodes, 3, 3); None where nothing rubs.
            units: Of the model.

        Returns:
            The nodes that touch.
        """
        slope = self.touch.gradient()
        nodes, share = slope.points + self.mine.start, self.share[slope.points, None, None]
        total[nodes, :3, :3] -= share * (units.length / units.force) * slope.f_x
        if self.rubs and Θ is not None:
            total[nodes, :3, 3:] -= share / units.force * (slope.f_turn @ Θ[nodes])
            total[nodes, 3:, :3] -= share * (units.length / units.moment) * slope.m_x
            total[nodes, 3:, 3:] -= share / units.moment * (slope.m_turn @ Θ[nodes])
        return nodes
