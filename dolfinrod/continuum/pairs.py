"""Rods on rods: forces and moments on the nodes of all rods, and how these depend on each other.

Every rank has the positions of all nodes and evaluates the contact of its own elements with all others; the forces are
added up over the ranks. The tangent has blocks of single nodes, as that of surfaces, and links of nodes of two rods.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from mpi4py import MPI

import numpy as np

from dolfinrod.continuum.everywhere import Everywhere
from dolfinrod.continuum.links import Frames, Links
from dolfinrod.continuum.meetings import led_past, meetings
from dolfinrod.continuum.met import kept, remembered
from dolfinrod.continuum.working import working
from dolfinrod.scene.meeting import PASSED

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from dolfinrod.continuum.problem import Block, Problem
    from dolfinrod.continuum.readout import State

    Array = NDArray[np.float64]
    Memory = tuple[float, Array, list[dict[str, Array]]]

__all__ = ["Pairs"]


class Pairs:
    """All contacts of rods with rods in a scene.

    Args:
        problem: Owner of the state.
        level: Where in a step forces act.

    Attributes:
        inside: Blocks of single nodes at the last call of `blocks`, shape (n, d + n_q or d, d + n_q or d).
        at: Dofs of this rank's own nodes that these are of, shape (n, d + n_q or d).
        everywhere: The nodes of all rods.
        meetings: One for each contact of rods in the scene.
        met: Whether any rods pushed each other in the last answer.
        r: Centreline dofs of this rank's own nodes, shape (n, d).
        q: Their rotation dofs, shape (n, n_q).
    """

    inside: Array
    _seen: Array | None = None
    _links: Links | None = None

    def __init__(self, problem: Problem, level: float = 1.0) -> None:
        self._problem, self._level, self.everywhere = problem, level, Everywhere(problem)
        self.r, self.q = self.everywhere.r, self.everywhere.q
        self.meetings, self._neared = meetings(problem, self.everywhere, level), False
        self.turns = any(meeting.turns for meeting in self.meetings)
        self.at = np.concatenate([self.r, self.q], axis=1) if self.turns else self.r
        self.place(0.0)

    def place(self, t: float) -> None:
        """The rods are where the state has them; nothing is remembered."""
        self.t, self._q_0 = t, self._problem.x[self.q]
        self._acting = self._q_0
        x, self._seen = self._positions(), None
        for meeting in self.meetings:
            meeting.place(x, t)
        self._respond()

    def begin(self, t: float) -> None:
        """A step from where the rods were last accepted leads to time t."""
        self.t, self._seen, self._neared = t, None, False
        for meeting in self.meetings:
            meeting.begin(t)

    def _positions(self) -> Array:
        """Of all nodes in space, shape (n_nodes, 3) [m]."""
        problem = self._problem
        return self.everywhere.gathered(problem.placement.to_space(problem.x[self.r]))

    def _respond(self) -> None:
        """See to it that the answers are those to the present state."""
        problem, place = self._problem, self._problem.placement
        r, q = place.to_space(problem.x[self.r]), problem.x[self.q] if self.turns else np.zeros((len(self.q), 0))
        now = self.everywhere.gathered(np.concatenate([r, q], axis=1))
        if self._seen is not None and np.array_equal(self._seen, now):
            return
        turn = np.zeros((len(now), 3))
        if self.turns:
            turned = problem.kinematics.rotation_vector(self._q_0, problem.x[self.q])
            turn = self.everywhere.gathered(turned @ place.spin_axes.T)
        felt = [meeting.respond(now[:, :3], turn) for meeting in self.meetings]
        force = self.everywhere.summed(np.sum([one.force for one in felt], axis=0))
        moment = np.sum([one.moment for one in felt], axis=0)
        self._force, self.met = force[self.everywhere.own], bool(force.any())
        self._neared = self._neared or any(meeting.near for meeting in self.meetings)
        self._moment = (self.everywhere.summed(moment) if self.turns else moment)[self.everywhere.own]
        self._seen, self._links = now, None

    def add_residual(self, b: Array, q: Array) -> None:
        """Add what the rods do to each other to a residual.

        Args:
            b: This rank's local residual.
            q: Rotations of its own nodes in whose spins the moments do work, shape (n, n_q).
        """
        self._respond()
        self._acting = q
        place, kin = self._problem.placement, self._problem.kinematics
        b[self.r] -= self._force @ place.axes / place.force
        if self.turns:
            spin = kin.spin(self._working(q)[0])
            b[self.q] -= np.einsum("nij,ni->nj", spin, self._moment @ place.spin_axes / place.moment)

    def _working(self, q: Array) -> tuple[Array, Array]:
        return working(q, self._q_0, self._problem.x[self.q], self._level)

    def blocks(self, q: Array) -> Sequence[Block]:
        """Those of single nodes in the tangent by the state after the step; q as above, all ranks together."""
        self._respond()
        self._acting, self._links = q, None
        self.inside = self.links().nodal
        return [(self.at, self.at, self.inside)]

    def links(self) -> Links:
        """Tangent at the present state, with rotations as they were given last; all ranks call this together."""
        self._respond()
        if self._links is None:
            frames, turning = self._frames(self._acting), self._turning(self._acting) if self.turns else None
            gradients = [meeting.gradient() for meeting in self.meetings]
            self._links = Links(gradients, frames, self.everywhere, turning)
        return self._links

    def _turning(self, q: Array) -> Array:
        """What moments that stay put add to the tangent by rotations, shape (n, n_q, n_q)."""
        place, kin = self._problem.placement, self._problem.kinematics
        n, n_q = q.shape
        if n_q == 1:
            return np.zeros((n, 1, 1))
        spins = kin.spin(np.repeat(np.eye(n_q), n, axis=0)).reshape(n_q, n, -1, n_q)
        moment = self._moment @ place.spin_axes / place.moment
        return np.einsum("knij,ni->njk", spins, moment) @ self._working(q)[1]

    def _frames(self, q: Array) -> Frames:
        """Of this rank's own nodes."""
        problem, place = self._problem, self._problem.placement
        free = 1.0 - problem.excluded[self.at]
        moves, feels = place.length * place.axes, place.axes.T / place.force
        if not self.turns:
            return Frames(moves[None], feels[None], free)
        kin, (d, n) = problem.kinematics, (self.r.shape[1], self.at.shape[1])
        all_moves, all_feels = np.zeros((len(q), 6, n)), np.zeros((len(q), n, 6))
        all_moves[:, :3, :d], all_feels[:, :d, :3] = moves, feels
        all_moves[:, 3:, d:] = place.spin_axes @ kin.rotation_vector_gradient(self._q_0, problem.x[self.q])
        all_feels[:, d:, 3:] = np.swapaxes(kin.spin(self._working(q)[0]), 1, 2) @ place.spin_axes.T / place.moment
        return Frames(all_moves, all_feels, free)

    @property
    def changed(self) -> bool:
        """Whether anything has come to touch, stick or slide, or ceased to, since the answer before the last one."""
        return self._on_any_rank(any(meeting.changed for meeting in self.meetings))

    @property
    def near(self) -> bool:
        """Whether any rods came so near each other in the step that they may touch."""
        return self._on_any_rank(self._neared)

    @property
    def pierced(self) -> str:
        """What the step has led a rod through, into, or past so far that contact wins energy; empty: nothing."""
        self._respond()
        # Of words any comes after none.
        words = str(self.everywhere.comm.allreduce(max(meeting.pierces() for meeting in self.meetings), op=MPI.MAX))
        return words or (PASSED if led_past(self.meetings, self.everywhere) else "")

    def _on_any_rank(self, mine: bool) -> bool:
        return bool(self._problem.discretization.comm.allreduce(mine, op=MPI.LOR))

    @property
    def stiffness(self) -> float:
        """That of the stiffest law, in EI/L⁴."""
        place = self._problem.placement
        return float(max(c.law.eps_N for c in self._problem.scene.meetings) * place.length**4 / place.stiffness)

    def soften(self, by: float) -> None:
        """Let all rods be softer by a factor where they touch, until the next step begins."""
        self._seen = None
        for meeting in self.meetings:
            meeting.soften(by)

    renews = False

    def glide(self) -> None:
        """Rods that slid are seen to slide on by their anchors alone."""

    @property
    def pattern(self) -> bytes:
        """What touches, sticks and slides among this rank's elements."""
        return b"".join(meeting.pattern for meeting in self.meetings)

    def foresee(self, r: Array) -> bool:
        """No long step is taken anew: what rods press against moves with them."""
        return False

    def renew(self) -> bool:
        """No law of rods has multipliers."""
        return True

    def accept(self) -> list[float]:
        """The step counts; energies rubbed off among this rank's elements, none given by walls, and lost by damping."""
        self._respond()
        self._q_0 = self._problem.x[self.q]
        booked = np.array([meeting.accept() for meeting in self.meetings]).sum(axis=0) / self._problem.placement.moment
        return [float(booked[1]), 0.0, float(booked[2])]

    def stored(self) -> float:
        """Energy that this rank's elements store, in EI/L."""
        return sum(meeting.stored() for meeting in self.meetings) / self._problem.placement.moment

    def memory(self) -> Memory:
        """What this rank remembers."""
        return self.t, self._q_0, [meeting.memory() for meeting in self.meetings]

    def take_back(self, memory: Memory) -> None:
        """Be what `memory` said earlier, at the state of that time."""
        self.t, self._q_0, remembered = memory
        self._recall(remembered)

    def _recall(self, remembered: Sequence[dict[str, Array]]) -> None:
        self._seen, x = None, self._positions()
        for meeting, one in zip(self.meetings, remembered, strict=True):
            meeting.recall(one, x, self.t)

    def kept(self) -> State:
        """What all ranks remember, and where rods touch, the same on every rank."""
        self._respond()
        comm, spots = self._problem.discretization.comm, [meeting.met() for meeting in self.meetings]
        return kept(comm, self.t, self.memory()[2], spots)

    def recall(self, state: Mapping[str, Array], t: float | None = None) -> None:
        """Go back, or on, to what a state holds, if it does; at another time, if one is given."""
        if (found := remembered(state, len(self.meetings))) is None:
            return
        self.t, self._q_0 = found[0] if t is None else t, self._problem.x[self.q]
        self._recall(found[1])
        self._respond()
