"""Factors of the tangent of a step, kept for as many steps as they serve.

The tangent is that of statics with a block of inertia, drag and follower loads at each node. As the sections turn it
turns with them: forces and increments of each node are turned back to where its section was when the factors were made,
so that they wear by deformation only.
"""

from __future__ import annotations

from dataclasses import replace
from math import isfinite
from typing import TYPE_CHECKING

import numpy as np

from discrete.assembly import SingularTangentError
from discrete.coupled import UncoupledError, factorised, joined
from discrete.loose import loose
from discrete.nodes import NodalSystem
from discrete.rows import of_vectors, rotated, turn, turn_back
from discrete.singly import turned_back, turned_on
from discrete.solution import Factors, Increments
from discrete.unknowns import AXIAL, N_NODE, SPIN, SPIN_J, X_J, X
from discrete.wear import Wear

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from discrete.loads import LoadLevel
    from discrete.mesh import Mesh
    from discrete.pace import Pace
    from discrete.supports import Supports
    from discrete.touched import Touched

    Array = NDArray[np.float64]

__all__ = ["Workshop"]

# Change of the length of the step that is but round-off: with others' m/Δt² not even momentum would be kept.
OTHER_STEP = 1e-6


class Workshop:
    """Makes factors and solves with them.

    Args:
        mesh: Nodes and elements.
        supports: What holds.
        m: Masses of the nodes where nothing but they resists the translation of a loose rod, shape (n_nodes,); None:
            something does.

    Attributes:
        factors: Those at hand; None: new ones are due.
        made: How many there have been.
        solved: Linear systems solved with them, those of lost steps included.
        wear: How long they serve.
    """

    def __init__(self, mesh: Mesh, supports: Supports, m: Array | None) -> None:
        self._system, self._supports = NodalSystem(mesh, supports.held), supports
        self.factors: Factors | None = None
        self.made = self.solved = 0
        self.wear = Wear()
        self._node_i = mesh.elements.node_i
        self._last = np.setdiff1d(np.arange(len(mesh.x)), self._node_i)
        self._ends = np.searchsorted(self._node_i, self._last - 1)
        self._held, self._askew = supports.held, supports.askew
        self._whole = None if m is None else loose(mesh, supports, m)
        self._right = np.empty((len(mesh.x), N_NODE))

    def check(self, dt: float) -> None:
        """Give the factors up where they are of another length of the step."""
        if self.factors is not None and abs(self.factors.dt / dt - 1.0) > OTHER_STEP:
            self.factors = None

    def forget(self) -> None:
        """Give the factors up."""
        self.factors = None

    def enough(self, size: float, before: float, goal: float, pace: Pace | None) -> bool:
        """Whether what an increment leaves is below a goal; arguments as for `Pace`, None where no rods may touch."""
        if pace is None:
            return self.wear.enough(size, before, goal)
        return pace.rough * size <= goal and (pace.foretold or self.wear.enough(size, before, goal))

    def go_on(self, pace: Pace) -> float:
        """Give factors up that are too slow; the part of forces that the next increment may leave out of balance."""
        if pace.slow:
            self.factors = None
        return pace.fine(renewed=self.factors is None)

    def make(
        self,
        stiffness: Array,
        blocks: Array,
        drag: Array | None,
        touched: Touched | None,
        dt: float,
        missing: Array,
        level: LoadLevel,
        R: Array,
    ) -> Factors:
        """Factorise, and keep the factors as those at hand.

        Args:
            stiffness: Of the elements, shape (n, 13, 13).
            blocks: Of inertia and air at single nodes, shape (n_nodes, 6, 6).
            drag: The part of the air in it; None where there is none.
            touched: Resistance of surfaces and other rods; None where there are none.
            dt: Length of the step.
            missing: What is out of balance, for the answer of guides, shape (7, n_nodes).
            level: Loads.
            R: Section frames, shape (3, 3, n_nodes).

        Raises:
            SingularTangentError: There are none.
        """
        tangent = self._with_blocks(stiffness, blocks)
        scratch = missing.T.copy(), np.zeros_like(self._right)
        guides, frames = self._supports.guides, R.transpose(2, 0, 1)
        whole = self._system.tangent(tangent, *scratch, level, guides, frames, touched)
        of_elements = np.ascontiguousarray(stiffness.transpose(1, 2, 0))
        of_air = None if drag is None else np.ascontiguousarray(drag[:, X].transpose(1, 2, 0))
        # Surfaces do not turn with the sections that touch them.
        askew = self._askew if touched is None else np.union1d(self._askew, touched.askew)
        at_nodes = of_air, None if touched is None else touched.alone(), askew
        inverse = whole.system.inverse(whole.elements)
        self.factors, self.made = Factors(dt, R, of_elements, *at_nodes, whole, inverse), self.made + 1
        self.wear.renew()
        return self.factors

    def _with_blocks(self, stiffness: Array, blocks: Array) -> Array:
        """Of the elements, with those of nodes at their first ones, and at the last ones of rods."""
        tangent, at_j = stiffness.copy(), slice(X_J.start, SPIN_J.stop)
        tangent[:, :AXIAL, :AXIAL] += blocks[self._node_i]
        tangent[self._ends, at_j, at_j] += blocks[self._last]
        return tangent

    def _join(self, factors: Factors) -> Factors:
        """The same with all that rods do to one another where they were made; kept as those at hand."""
        tangent, touched = factors.tangent, factors.touched
        assert tangent.touched is not None
        assert touched is not None
        links = replace(touched, links=tangent.touched.links)
        self.factors, self.made = replace(factors, touched=links, inverse=factorised(tangent)), self.made + 1
        return self.factors

    def found(
        self, make: Callable[[], Factors], missing: Array, R: Array, touched: Touched | None, fine: float
    ) -> Increments:
        """Increments of all nodes by the factors at hand, by new ones, or by those of all rods together.

        Args:
            make: Makes new factors.
            missing: What is out of balance, shape (7, n_nodes).
            R: Section frames, shape (3, 3, n_nodes).
            touched: What surfaces and other rods answer now; None: as when the factors were made.
            fine: Part that may be left out of balance of what that changes.

        Raises:
            SingularTangentError: There are none.
        """
        if touched is None:
            return self._increments(self.factors or make(), missing, R)
        for better in (lambda: self.factors or make(), make):
            try:
                return self._increments(better(), missing, R, touched, fine)
            except UncoupledError:
                continue
        return self._increments(self._join(make()), missing, R, touched, fine)

    def _increments(
        self, factors: Factors, missing: Array, R: Array, touched: Touched | None = None, fine: float = 0.0
    ) -> Increments:
        """Increments of all nodes; UncoupledError where the factors tell too little of how rods push one another."""
        guided = len(self._supports.guides.nodes) > 0
        Q = np.einsum("ijn,kjn->ikn", R, factors.R)
        if len(factors.askew):
            Q[:, :, factors.askew] = np.eye(3)[:, :, None]
        n, right = len(self._right), self._right
        right[:, :AXIAL] = turn_back(Q, missing[:AXIAL].reshape(2, 3, n)).reshape(AXIAL, n).T
        right[:, AXIAL] = missing[AXIAL]
        if guided:
            self._guide(factors, right, R.transpose(2, 0, 1))
        flat = right.reshape(-1)
        flat[self._held] = 0.0
        free = float(np.abs(right[:, :AXIAL]).max())
        if guided:
            self._turn_guided(factors, right, R.transpose(2, 0, 1))
        d, own = self._solution(factors, flat, Q)
        self.solved += 1
        if touched is not None:
            d, own = self._joined(factors, touched, Q, d, fine)
        if self._whole is not None:
            missing = missing if touched is None else missing + touched.change(d.T).T
            self._whole.move(d, missing, factors.dt)
        size = float(np.abs(d[:AXIAL]).max())
        if not isfinite(size):
            raise SingularTangentError
        return Increments(d, own, Q, size, free, factors, touched)

    def _joined(self, factors: Factors, touched: Touched, Q: Array, d: Array, fine: float) -> tuple[Array, Array]:
        """Increments with what rods do to one another beyond what is in the factors, in space and turned back."""
        known, guided, some = factors.known(Q), len(factors.tangent.guided) > 0, np.zeros(Q.shape[2], dtype=bool)
        for one in (touched, factors.touched):
            if one is not None:
                one.mark(some)
        at = np.flatnonzero(some)

        def answer(force: Array) -> Array:
            right = np.zeros((len(some), N_NODE))
            right[at] = force
            right = turned_back(Q, right)
            flat = factors.tangent.in_axes(right).reshape(-1) if guided else right.reshape(-1)
            flat[self._held] = 0.0
            own = factors.inverse.single(flat).reshape(right.shape)
            return turned_on(Q, factors.tangent.in_space(own) if guided else own)

        def change(d: Array) -> Array:
            return np.asarray(touched.change(d)[at] - known(d)[at])

        found = joined(np.ascontiguousarray(d.T), answer, change, fine)
        if found is None:
            raise UncoupledError
        return found.T, turned_back(Q, found).T

    def _solution(self, factors: Factors, right: Array, Q: Array) -> tuple[Array, Array]:
        """Increments in space and turned back, shapes (7, n_nodes), for a right-hand side."""
        solution = factors.inverse.times(right[:, None]).reshape(self._right.shape)
        own = of_vectors(factors.tangent.in_space(solution) if len(factors.tangent.guided) else solution)
        return rotated(turn, Q, own), own

    def _guide(self, factors: Factors, right: Array, R: Array) -> None:
        """Take the answers λ c of guides off what is out of balance, and turn spins into the axes of the tangent."""
        guides = self._supports.guides
        _, c, _ = guides.linearized(R)
        λ = np.einsum("mi,mi->m", c, right[guides.nodes, SPIN]) / np.einsum("mi,mi->m", c, c)
        right[guides.nodes, SPIN] -= λ[:, None] * c
        right[:] = factors.tangent.in_axes(right)

    def _turn_guided(self, factors: Factors, right: Array, R: Array) -> None:
        """Let guided sections turn by what they are off."""
        guides = self._supports.guides
        θ_a, c, _ = guides.linearized(R)
        right[guides.nodes, SPIN.start] = -θ_a / np.einsum("mi,mi->m", c, factors.tangent.axes[:, :, 0])
