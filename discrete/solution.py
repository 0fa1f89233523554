"""Factors of the tangent of a step, and increments found with them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from discrete.rows import turn
from discrete.singly import turned_back, turned_blocks, turned_on
from discrete.touched import Touched
from discrete.unknowns import AXIAL

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from discrete.assembly import Inverse
    from discrete.coupled import CoupledInverse
    from discrete.ends import Ends
    from discrete.nodes import Tangent

    Array = NDArray[np.float64]

__all__ = ["Factors", "Increments"]


@dataclass(frozen=True, eq=False)
class Factors:
    """A factorised tangent.

    Args:
        dt: Length of the step it was made for.
        R: Section frames where it was made, shape (3, 3, n_nodes).
        stiffness: Of the elements alone, shape (13, 13, n).
        drag: Resistance of the air, shape (3, 6, n_nodes); None where there is none.
        touched: Resistance of surfaces and other rods in the factors; None where there are none.
        askew: Nodes whose forces and increments are not turned back.
        tangent: Everything.
        inverse: Its factors.
    """

    dt: float
    R: Array
    stiffness: Array
    drag: Array | None
    touched: Touched | None
    askew: NDArray[np.int64]
    tangent: Tangent
    inverse: Inverse | CoupledInverse

    def known(self, Q: Array) -> Callable[[Array], Array]:
        """What surfaces and other rods answer as far as it is in the factors: forces to increments, (n_nodes, 7) both.

        Args:
            Q: What sections have turned by since, shape (3, 3, n_nodes).
        """
        touched = self.touched
        if touched is None:
            return np.zeros_like
        if touched.links is not None:
            return lambda d: turned_on(Q, touched.change(turned_back(Q, d)))
        return Touched(touched.nodes, turned_blocks(Q, touched.nodes, touched.blocks)).change


@dataclass(frozen=True, eq=False)
class Increments:
    """A solution with factors, by rows.

    Args:
        d: Increments, shape (7, n_nodes).
        own: The same turned back to where the sections were when the factors were made.
        Q: What they have turned by, shape (3, 3, n_nodes).
        size: Largest displacement or spin.
        free: Largest force or moment out of balance where free.
        factors: By which it was found.
        touched: What surfaces and other rods answer to it; None: as when the factors were made.
    """

    d: Array
    own: Array
    Q: Array
    size: float
    free: float
    factors: Factors
    touched: Touched | None = None

    def stretched(self, ends: Ends) -> Array:
        """Change of the end forces, shape (13, n)."""
        return ends.turned(self.Q, np.einsum("abn,bn->an", self.factors.stiffness, ends.gather(self.own)))

    def pressed(self) -> Array | float:
        """Change of what surfaces and other rods do, shape (n_nodes, 7)."""
        touched = self.touched or self.factors.touched
        return 0.0 if touched is None else touched.change(self.d.T)

    def slowed(self) -> Array | float:
        """Change of the drag, shape (n_nodes, 3)."""
        if self.factors.drag is None:
            return 0.0
        change = -np.einsum("abn,bn->an", self.factors.drag, self.own[:AXIAL])
        return turn(self.Q, change[None])[0].T
