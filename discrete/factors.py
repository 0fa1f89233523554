"""Factors of the tangent of a step, kept for as many steps as they serve.

The tangent is that of statics with a block of inertia, drag and follower loads at each node. Increments by old factors
shrink by about the same part from one iteration and from one step to the next; that decides when new ones would pay and
when a further iteration would change nothing.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import log
from typing import TYPE_CHECKING

import numpy as np

from discrete.assembly import SingularTangentError, gather
from discrete.nodes import NodalSystem
from discrete.unknowns import AXIAL, N_NODE, SPIN, SPIN_J, X_J

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.assembly import Inverse
    from discrete.loads import LoadLevel
    from discrete.mesh import Mesh
    from discrete.nodes import Tangent
    from discrete.supports import Supports

    Array = NDArray[np.float64]

__all__ = ["Factors", "Workshop"]

# Iterations that new factors cost as much as.
WORTH = 5.0
# Change of the length of the step that is but round-off: with others' m/Δt² not even momentum would be kept.
OTHER_STEP = 1e-6
# Part of an increment that the next one will hardly be below, however much smaller it was than the one before.
STEADY = 0.1
# Steps in a row that begin with new factors after one in which they did not last.
EAGER = 8
# Iterations that no step takes.
MANY = 1000


@dataclass(frozen=True, eq=False)
class Factors:
    """A factorised tangent.

    Args:
        dt: Length of the step it was made for.
        stiffness: Of the elements alone, shape (n, 13, 13).
        drag: Blocks of the air, shape (n_nodes, 6, 6); None where there is none.
        tangent: Everything.
        inverse: Its factors.
    """

    dt: float
    stiffness: Array
    drag: Array | None
    tangent: Tangent
    inverse: Inverse

    def stretched(self, d: Array) -> Array:
        """Change of the end forces by increments, shape (n, 13)."""
        return np.matmul(self.stiffness, gather(d, self.tangent.system.node_i)[:, :, None])[:, :, 0]

    def slowed(self, d: Array) -> Array | float:
        """Change of the drag by increments, shape (n_nodes, 3)."""
        return 0.0 if self.drag is None else -np.einsum("nij,nj->ni", self.drag[:, :3], d[:, :AXIAL])


class Workshop:
    """Makes factors and says how long they serve.

    Args:
        mesh: Nodes and elements.
        supports: What holds.

    Attributes:
        factors: Those at hand; None: new ones are due.
        made: How many there have been.
        solved: Linear systems solved with them, those of lost steps included.
    """

    def __init__(self, mesh: Mesh, supports: Supports) -> None:
        self._system, self._supports = NodalSystem(mesh, supports.held), supports
        self.factors: Factors | None = None
        self.made = self.solved = 0
        self._eager, self._least, self._excess = 0, MANY, 0
        self._node_i = mesh.elements.node_i
        self._last = np.setdiff1d(np.arange(len(mesh.x)), self._node_i)
        self._ends = np.searchsorted(self._node_i, self._last - 1)
        self._held = supports.held

    def check(self, dt: float) -> None:
        """Give the factors up where they are of another length of the step."""
        if self.factors is not None and abs(self.factors.dt / dt - 1.0) > OTHER_STEP:
            self.factors = None

    def make(
        self, stiffness: Array, blocks: Array, drag: Array | None, dt: float, missing: Array, level: LoadLevel, R: Array
    ) -> Factors:
        """Factorise.

        Args:
            stiffness: Of the elements, shape (n, 13, 13).
            blocks: Of all that acts at single nodes but follower loads and guides, shape (n_nodes, 6, 6).
            drag: The part of the air in it.
            dt: Length of the step.
            missing: What is out of balance, for the answer of guides, shape (n_nodes, 7).
            level: Loads.
            R: Section frames, shape (n_nodes, 3, 3).

        Returns:
            Also kept as those at hand.

        Raises:
            SingularTangentError: There are none.
        """
        tangent = stiffness.copy()
        at_j = slice(X_J.start, SPIN_J.stop)
        tangent[:, :AXIAL, :AXIAL] += blocks[self._node_i]
        tangent[self._ends, at_j, at_j] += blocks[self._last]
        scratch = missing.copy(), np.zeros_like(missing)
        whole = self._system.tangent(tangent, *scratch, level, self._supports.guides, R)
        self.factors, self.made = Factors(dt, stiffness, drag, whole, whole.inverse()), self.made + 1
        self._least, self._excess = MANY, 0
        return self.factors

    def increments(self, factors: Factors, missing: Array, R: Array) -> tuple[Array, float]:
        """Increments of all nodes, shape (n_nodes, 7), and the largest force or moment out of balance where free.

        Raises:
            SingularTangentError: They are not finite.
        """
        guides = self._supports.guides
        right = missing.copy() if not len(guides.nodes) else self._guided(factors, missing, R)
        flat = right.reshape(-1)
        flat[self._held] = 0.0
        free = float(np.abs(right[:, :AXIAL]).max())
        if len(guides.nodes):
            θ_a, c, _ = guides.linearized(R)
            right[guides.nodes, SPIN.start] = -θ_a / np.einsum("mi,mi->m", c, factors.tangent.axes[:, :, 0])
        d = factors.inverse.times(flat[:, None]).reshape(-1, N_NODE)
        self.solved += 1
        if not np.isfinite(d).all():
            raise SingularTangentError
        return (factors.tangent.in_space(d) if len(guides.nodes) else d), free

    def enough(self, size: float, before: float, goal: float) -> bool:
        """Whether what an increment leaves is below a goal."""
        return size * min(1.0, max(size / before, STEADY)) <= goal

    def slow(self, size: float, before: float, goal: float) -> bool:
        """Whether increments shrink so slowly that new factors would pay in this step."""
        if size >= before or log(goal / size) < WORTH * log(size / before):
            self._eager = EAGER
            return True
        return False

    def wear(self, iterations: int) -> None:
        """Give the factors up once steps have cost as much more than their shortest one as new factors would.

        Where they did not last for one step, the next few begin with new ones.
        """
        self._eager -= 1
        if self._eager > 0:
            self.factors = None
        self._least = min(self._least, max(2, iterations))
        self._excess += max(0, iterations - self._least)
        if self._excess > WORTH:
            self.factors = None

    def _guided(self, factors: Factors, missing: Array, R: Array) -> Array:
        """What is out of balance without the answers λ c of guides, spins in the axes of the tangent."""
        guides, right = self._supports.guides, missing.copy()
        _, c, _ = guides.linearized(R)
        λ = np.einsum("mi,mi->m", c, right[guides.nodes, SPIN]) / np.einsum("mi,mi->m", c, c)
        right[guides.nodes, SPIN] -= λ[:, None] * c
        return factors.tangent.in_axes(right)
