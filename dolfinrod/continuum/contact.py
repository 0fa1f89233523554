"""Rods on rigid surfaces: a line load at the nodes, which are the points of the Gauss-Lobatto rule.

The rule is exact for loads that vary along a rod like polynomials of degree k − 1, and it couples no node with another:
its blocks, like those of inertia and drag, are of single nodes.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from mpi4py import MPI

import numpy as np

from dolfinrod.continuum import backend
from dolfinrod.continuum.lumped import node_lengths
from dolfinrod.continuum.rubbing import rubs
from dolfinrod.continuum.side import Side
from dolfinrod.continuum.touched import COLUMNS, packed, unpacked
from dolfinrod.scene import AugmentedLagrangian, Touch

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from dolfinrod.continuum.problem import Problem
    from dolfinrod.scene.reply import Reply

    Array = NDArray[np.float64]
    Memory = tuple[float, Array, list[tuple[dict[str, Array], Reply]]]
    Block = tuple[NDArray[np.int32], NDArray[np.int32], Array]

__all__ = ["Contacts", "Memory"]


class Contacts:
    """All surfaces of a scene against this rank's own nodes.

    Args:
        problem: Owner of the state.
        level: Where in a step forces act.

    Attributes:
        renews: Whether any law has multipliers.
        sides: The surfaces, each with the nodes that it may touch.
        r: Centreline dofs of this rank's own nodes, shape (n, d).
    """

    def __init__(self, problem: Problem, level: float = 1.0) -> None:
        self._problem, d, scene = problem, problem.discretization, problem.scene
        self._rubs, self.renews = rubs(scene), any(isinstance(c.law, AugmentedLagrangian) for c in scene.walls)
        self.r, self.q = d.owned_nodes("r"), d.owned_nodes("q")
        first = self.r[:, 0]
        lengths = node_lengths(problem)[first] * problem.placement.length
        rods = np.zeros(len(problem.x), dtype=np.int64)
        rods[d.dofs["r"][:, :, 0]] = problem.rod[:, None]
        rod, radii = rods[first], np.array([section.radius or 0.0 for section in (r.section for r in scene.rods)])
        self.sides = []
        for contact in scene.walls:
            nodes = np.flatnonzero(rod == contact.rod) if contact.rod is not None else np.arange(len(rod))
            touch = Touch(contact, radii[rod[nodes]], scene.motion, level)
            self.sides.append(Side(touch, nodes, lengths[nodes]))
        self.place(0.0)

    def place(self, t: float) -> None:
        """The rods are where the state has them; nothing is remembered."""
        x = self._problem.placement.to_space(self._problem.x[self.r])
        self.t, self._q_0 = t, self._problem.x[self.q]
        for side in self.sides:
            side.touch.place(x[side.nodes], t)
        self._seen: Array | None = None
        self._respond()

    def begin(self, t: float) -> None:
        """A step from where the rods were last accepted leads to time t."""
        self.t, self._seen = t, None
        for side in self.sides:
            side.touch.begin(t)
            side.touch.cling()

    def glide(self) -> None:
        """Begin the iteration with what slid in the last step sliding on; right after `begin`."""
        for side in self.sides:
            side.touch.glide()

    def _respond(self) -> None:
        """See to it that the answers are those to the present state."""
        state, place, kin = self._problem.x, self._problem.placement, self._problem.kinematics
        now = np.concatenate([state[self.r].ravel(), state[self.q].ravel()])
        if self._seen is not None and np.array_equal(self._seen, now):
            return
        turned = kin.rotation_vector(self._q_0, state[self.q]) if self._rubs else np.zeros((len(self.q), kin.n_spin))
        x, turn = place.to_space(state[self.r]), turned @ place.spin_axes.T
        for side in self.sides:
            side.reply = side.touch.respond(x[side.nodes], turn[side.nodes])
        self._seen = now

    def add_residual(self, b: Array, q: Array) -> None:
        """Add what the surfaces do to the rods to a residual.

        Args:
            b: This rank's local residual.
            q: Rotations of its own nodes in whose spins the moments do work, shape (n, n_q).
        """
        self._respond()
        place, kin = self._problem.placement, self._problem.kinematics
        for side in self.sides:
            reply, nodes, on = side.reply, side.nodes, np.flatnonzero(side.reply.state)
            if not len(on):
                continue
            b[self.r[nodes[on]]] -= side.share[on] * (reply.force[on] @ place.axes) / place.force
            if side.touch.turns:
                moment = side.share[on] * (reply.moment[on] @ place.spin_axes) / place.moment
                b[self.q[nodes[on]]] -= np.einsum("nij,ni->nj", kin.spin(q[nodes[on]]), moment)

    def blocks(self, q: Array) -> Iterator[Block]:
        """Rows, columns and entries of the tangent by the state after the step; q as for `add_residual`."""
        self._respond()
        place = self._problem.placement
        for side in self.sides:
            change = side.touch.gradient()
            at = side.nodes[change.points]
            if not len(at):
                continue
            share = side.share[change.points][:, :, None]
            f_r = place.axes.T @ change.f_x @ place.axes
            yield self.r[at], self.r[at], -share * f_r * (place.length / place.force)
            if side.touch.turns:
                yield from self._turning_blocks(side, change.points, change.f_turn, change.m_x, change.m_turn, q[at])

    def _turning_blocks(
        self, side: Side, points: NDArray[np.intp], f_turn: Array, m_x: Array, m_turn: Array, q: Array
    ) -> Iterator[Block]:
        """Those of rotations."""
        place, kin = self._problem.placement, self._problem.kinematics
        at = side.nodes[points]
        r, rows, share = self.r[at], self.q[at], side.share[points][:, :, None]
        turned = kin.rotation_vector_gradient(self._q_0[at], self._problem.x[rows])
        spin = np.swapaxes(kin.spin(q), 1, 2)
        f_q = place.axes.T @ f_turn @ place.spin_axes @ turned
        m_r = place.spin_axes.T @ m_x @ place.axes * place.length
        m_q = place.spin_axes.T @ m_turn @ place.spin_axes @ turned
        yield r, rows, -share * f_q / place.force
        yield rows, r, -share * (spin @ m_r) / place.moment
        yield rows, rows, -share * (spin @ m_q) / place.moment
        if q.shape[1] > 1:
            moment = side.share[points] * (side.reply.moment[points] @ place.spin_axes) / place.moment
            units = np.repeat(np.eye(q.shape[1]), len(at), axis=0)
            spins = kin.spin(units).reshape(q.shape[1], len(at), -1, q.shape[1])
            yield rows, rows, -np.einsum("knij,ni->njk", spins, moment)

    @property
    def pattern(self) -> bytes:
        """Which of this rank's nodes touch, and which of these stick."""
        return b"".join(side.reply.state.tobytes() for side in self.sides)

    @property
    def changed(self) -> bool:
        """Whether any node has come to touch, stick or slide, or ceased to, since the answer before the last one."""
        return self._on_any_rank(any(side.touch.changed for side in self.sides))

    @property
    def pierced(self) -> bool:
        """Whether the step has led a rod into or through a wall."""
        return self._on_any_rank(any(side.touch.pierces() for side in self.sides))

    def _on_any_rank(self, mine: bool) -> bool:
        return bool(self._problem.discretization.comm.allreduce(mine, op=MPI.LOR))

    @property
    def stiffness(self) -> float:
        """That of the stiffest law, in EI/L⁴."""
        place, laws = self._problem.placement, [side.touch.contact.law for side in self.sides]
        return float(max(law.eps_N for law in laws) * place.length**4 / place.stiffness)

    def soften(self, by: float) -> None:
        """Let all walls be softer by a factor, until the next step begins."""
        self._seen = None
        for side in self.sides:
            side.touch.soften(by)

    def foresee(self, r: Array) -> bool:
        """Whether a linear step of the rank's own nodes to r changes what is pressed; the next answer is with that."""
        each = [side.touch.foresee(self._problem.placement.to_space(r[side.nodes])) for side in self.sides]
        changed = self._on_any_rank(any(each))
        if changed:
            self._seen = None
            for side in self.sides:
                side.touch.adopt()
        return changed

    def renew(self) -> bool:
        """Renew multipliers; whether penetrations were within their tolerances already."""
        self._respond()
        self._seen = None
        done = [side.touch.renew() for side in self.sides]
        return not self._on_any_rank(not all(done))

    def accept(self) -> list[float]:
        """The step counts; energies that this rank's nodes have rubbed off, were given by walls and lost by damping."""
        self._respond()
        self._q_0, total = self._problem.x[self.q], np.zeros(3)
        for side in self.sides:
            booked = side.touch.accept()
            total += [float(side.share[:, 0] @ part) for part in (booked.rubbed, booked.pushed, booked.damped)]
        return [float(part) / self._problem.placement.moment for part in total]

    def stored(self) -> float:
        """Energy that this rank's nodes store, in EI/L."""
        total = sum(float(side.share[:, 0] @ side.touch.stored()) for side in self.sides)
        return total / self._problem.placement.moment

    def memory(self) -> Memory:
        """What this rank's nodes remember."""
        return self.t, self._q_0, [(side.touch.memory(), side.reply) for side in self.sides]

    def take_back(self, memory: Memory) -> None:
        """Be what `memory` said earlier."""
        self.t, self._q_0, sides = memory
        self._seen = None
        for side, (remembered, reply) in zip(self.sides, sides, strict=True):
            side.touch.recall(remembered, self.t)
            side.reply = reply

    def kept(self) -> Array:
        """What the nodes remember and feel, by local cell, shape (cells, k + 1, contacts · n_columns)."""
        d, n = self._problem.discretization, sum(COLUMNS.values())
        table = np.zeros((len(self.r), len(self.sides) * n))
        for k, side in enumerate(self.sides):
            table[side.nodes, k * n : (k + 1) * n] = packed(self.t, side.touch.memory(), side.reply)
        carrier, by_cell = backend.function(d.space), []
        for column in table.T:
            carrier.x.array[self.r[:, 0]] = column
            carrier.x.scatter_forward()
            by_cell.append(carrier.x.array[d.dofs["r"][:, :, 0]])
        return np.stack(by_cell, axis=-1)

    def recall(self, kept: Array, t: float | None = None) -> None:
        """Go back, or on, to what `kept` said, for this rank's cells; at another time, if one is given."""
        d = self._problem.discretization
        local, n = np.zeros((len(self._problem.x), kept.shape[2])), sum(COLUMNS.values())
        local[d.dofs["r"][:, :, 0]] = kept
        table = local[self.r[:, 0]]
        self._q_0, self._seen = self._problem.x[self.q], None
        last = float(self._problem.discretization.comm.allreduce(kept[..., :1].max(initial=0.0), op=MPI.MAX))
        self.t = last if t is None else t
        for k, side in enumerate(self.sides):
            side.touch.recall(unpacked(table[side.nodes, k * n : (k + 1) * n]), self.t)
        self._respond()
