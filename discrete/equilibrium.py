"""Equilibrium of all rods at one load level: Newton's method with the chord and F_n as unknowns of their own.

Positions enter an element through the direction of its chord, and that is what ruins Newton's method: after a large
increment the chord no longer fits the sections at its ends. So every element keeps its own direction u and axial force
F_n, the chord e(u, F_n) need not join the nodes while the iteration runs, and the gap x_j − x_i − e is closed to first
order by the same linear system (its unknowns are condensed, no equation is added but that of F_n). Then

* positions and forces enter linearly: they take their full increment,
* everything that turns, sections and chords alike, turns by an exponential, and all by the same fraction of it when
  any would turn by more than `LARGEST_TURN`,
* F_n is the projection of the new force vector, exact under dead loads after one iteration, on the new direction.

The limit of the iteration is that of the displacement form; only the way there differs.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from discrete.assembly import SingularTangentError, gather, scatter
from discrete.grip import ROUGH, Grip, gripped
from discrete.nodes import NodalSystem
from discrete.record import Snapshot, evenly, halved
from discrete.rotation import exp
from discrete.state import Outcome, State
from discrete.turning import LARGEST_TURN, chord_spin
from discrete.unknowns import SPIN, SPIN_I, SPIN_J, X_I, X_J, X
from discrete.watch import ALIASED, VANISHED, WANDERING, Watch

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from discrete.constitution import Element
    from discrete.loads import LoadLevel, Loads
    from discrete.mesh import Mesh
    from discrete.nodes import Tangent
    from discrete.supports import Supports
    from discrete.surroundings import Surroundings

    Array = NDArray[np.float64]

__all__ = ["LARGEST_TURN", "Element", "Equilibrium"]

# Increments at which the iteration has converged: radians, lengths over L, forces over the largest one or EI/L².
TOLERANCE = 1e-9
MOST_ITERATIONS = 60
SETTLED = "the increments fell below the tolerance"
# An increment, in L and radians, after which no surface is found again.
RUNAWAY = 1e6
CIRCLING = "rods touched and left surfaces, stuck and slid, again and again"


class Equilibrium:
    """Newton's method for one scene and mesh.

    Args:
        mesh: Nodes and elements.
        element: Law of the elements.
        loads: What acts.
        supports: What holds.
        contacts: What the rods touch; None: nothing.
    """

    def __init__(
        self, mesh: Mesh, element: Element, loads: Loads, supports: Supports, contacts: Surroundings | None = None
    ) -> None:
        self.mesh, self.element, self.loads, self.supports = mesh, element, loads, supports
        self.contacts = contacts
        self.hold(np.zeros(0, dtype=np.int64))

    def hold(self, unknowns: NDArray[np.int64]) -> None:
        """Hold these unknowns where they are, on top of the supports, until the next call."""
        self._system = NodalSystem(self.mesh, np.union1d(self.supports.held, unknowns))

    def begin(self) -> State:
        """Stress-free state."""
        mesh = self.mesh
        node_i = mesh.elements.node_i
        u = (mesh.x[node_i + 1] - mesh.x[node_i]) / mesh.elements.l_0[:, None]
        return State(mesh.x, mesh.R, u, np.zeros(len(u)), np.zeros(self.supports.n_factors))

    def snapshot(self, state: State, t: float) -> Snapshot:
        """What is kept of an equilibrium that counts, at a pseudo-time."""
        E = self.mesh.elements.triads(state.R)
        e = self.element.chord(state.u, E, state.F_n)
        force, energy = self.element.measure(e, E, state.F_n)
        kept = Snapshot(t, state.x, state.R, force, evenly(self.loads.level(t).line), float(energy.sum()))
        if self.contacts is None:
            return kept
        halves = kept.halves + halved(self.contacts.force(state.x, state.R)[:, X], self.mesh)
        return replace(kept, halves=halves, touching=self.contacts.record(), met=self.contacts.meetings())

    def acting(self, state: State, t: float) -> tuple[Array, ...]:
        """Loads, and what surfaces answer at the pseudo-time t of the last attempt, shapes (n_nodes, 7)."""
        loads = self.loads.level(t).at(state.R)
        return (loads,) if self.contacts is None else (loads, self.contacts.force(state.x, state.R))

    def place(self, state: State, t: float, arrays: Mapping[str, Array]) -> None:
        """Begin at a state, of which surfaces remember what `arrays` in SI units tell, if anything."""
        if self.contacts is not None:
            self.contacts.recall(arrays, state.x, state.R, t)

    def memory(self) -> dict[str, Array]:
        """What surfaces remember of the last state that counts."""
        return {} if self.contacts is None else self.contacts.memory()

    def accept(self, state: State, t: float) -> None:
        """An equilibrium counts: the next attempts lead on from there."""
        if self.contacts is not None:
            self.contacts.accept(state.x, state.R, t)

    def find(self, state: State, t: float, trust: float = np.inf) -> Outcome:
        """Equilibrium at a pseudo-time.

        Args:
            state: First guess.
            t: Pseudo-time.
            trust: Largest turn that the first iteration may ask for [rad]; beyond it the guess was a bad one.

        Returns:
            Outcome; its state is meaningless where it did not converge.
        """
        if self.contacts is None:
            return self._found(t, trust, None, state, MOST_ITERATIONS, TOLERANCE)
        contacts = self.contacts

        def find(state: State, most: int, fine: float, trust: float = np.inf) -> Outcome:
            return self._found(t, trust, Grip(contacts, most, fine), state, most, fine)

        return gripped(contacts, state, t, trust, find, MOST_ITERATIONS, TOLERANCE)

    def _found(self, t: float, trust: float, grip: Grip | None, state: State, most: int, fine: float) -> Outcome:
        """Newton's method: most iterations, and increments at which it is done; other arguments as for `find`."""
        level, goal = self.loads.level(t), self.supports.factors(t)
        step, watch = _Step(state, np.inf, np.inf, np.inf, None), Watch(self.mesh.elements, state.R)
        reason = f"no convergence in {most} iterations"
        for iteration in range(1, most + 1):
            try:
                # A chord that vanishes has no direction; what is not finite then ends the iteration below.
                with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
                    step = self._iterate(step.state, level, goal, watch, grip)
            except SingularTangentError as error:
                reason = str(error)
                break
            if step.change < fine:
                reason = VANISHED if self.mesh.elements.gone(step.state.F_n) else ALIASED if watch.aliased else SETTLED
                break
            if not np.isfinite(step.change):
                reason = "the iteration diverged"
                break
            if watch.wandering:
                reason = ALIASED if watch.aliased else WANDERING
                break
            if grip is not None and (grip.lost or step.change > RUNAWAY):
                reason = CIRCLING
                break
            if iteration == 1 and step.turn > trust:
                reason = "the iteration leads off the extrapolated path"
                break
        turned, strayed = watch.turned, watch.strayed
        return Outcome(step.state, reason == SETTLED, iteration, step.residual, reason, turned, step.tangent, strayed)

    def _iterate(self, state: State, level: LoadLevel, goal: Array, watch: Watch, grip: Grip | None) -> _Step:
        """One Newton iteration."""
        node_i = self.mesh.elements.node_i
        E = self.mesh.elements.triads(state.R)
        e = self.element.chord(state.u, E, state.F_n)
        gap = state.x[node_i + 1] - state.x[node_i] - e
        force, tangent = self.element.respond(e, E, state.F_n)
        force += np.matmul(tangent[:, :, X_J], gap[:, :, None])[:, :, 0]
        end = tangent[:, X_J].copy()
        missing = level.at(state.R) - scatter(force, node_i, len(state.x))
        touched = None
        if grip is not None:
            missing += grip.press(state)
            touched = grip.touched
        held, guides = self.supports.increments(state.x, state.factors, goal), self.supports.guides
        d, residual, worked_in = self._system.increments(tangent, missing, held, level, guides, state.R, touched)
        d = d if grip is None else grip.pivoted(state, d, worked_in)
        own = gather(d, node_i)
        N = force[:, X_J] + np.matmul(end, own[:, :, None])[:, :, 0]
        spin = chord_spin(state.u, own[:, X_J] - own[:, X_I] + gap, 0.5 * (own[:, SPIN_I] + own[:, SPIN_J]), e)
        new, turn, bite = self._moved(state, d, spin, N, goal)
        if grip is not None and grip.foresees(new.x, turn):
            return _Step(state, turn, turn, residual, worked_in)
        scale = max(1.0, float(np.abs(new.F_n).max()))
        change = max(turn, float(np.abs(d[:, X]).max()), float(np.abs(new.F_n - state.F_n).max()) / scale)
        if grip is not None and (part := grip.part(change, d)) < 1.0:
            (short, _, bite), d = self._moved(state, part * d, part * spin, N, goal), part * d
            new = replace(short, F_n=state.F_n + part * (new.F_n - state.F_n))
        watch.see(bite * d[:, SPIN], new.R)
        if grip is not None and change < grip.fine < ROUGH:
            change = max(change, grip.surprise(d, new) / scale)
        return _Step(new, change, turn, residual, worked_in)

    def tangent(self, state: State, level: LoadLevel, t: float | None = None) -> Tangent:
        """Tangent of a state whose chords join its nodes.

        Args:
            state: Near an equilibrium.
            level: Loads.
            t: Pseudo-time at which walls are where they are; None: that of the last attempt.

        Returns:
            With all that acts at single nodes.
        """
        node_i = self.mesh.elements.node_i
        e = state.x[node_i + 1] - state.x[node_i]
        force, tangent = self.element.respond(e, self.mesh.elements.triads(state.R), state.F_n)
        missing = level.at(state.R) - scatter(force, node_i, len(state.x))
        touched = None
        if self.contacts is not None:
            missing += self.contacts.at(state.x, state.R, t)
            touched = self.contacts.blocks()
        held = np.zeros_like(missing)
        return self._system.tangent(tangent, missing, held, level, self.supports.guides, state.R, touched)

    def _moved(self, state: State, d: Array, spin: Array, N: Array, goal: Array) -> tuple[State, float, float]:
        """State after an increment, the largest turn asked for, and the part of it that was granted."""
        turn = np.sqrt(max(_largest(d[:, SPIN]), _largest(spin)))
        bite = min(1.0, LARGEST_TURN / turn) if turn > 0.0 else 1.0
        R = exp(bite * d[:, SPIN]) @ state.R
        factors = state.factors + bite * (goal - state.factors)
        for section in self.supports.turns:
            R[section.node] = section.frame(factors)
        u = np.matmul(exp(bite * spin), state.u[:, :, None])[:, :, 0]
        u /= np.sqrt(np.einsum("ni,ni->n", u, u))[:, None]
        F_n = self.element.axial(N, u, self.mesh.elements.triads(R))
        return State(state.x + d[:, X], R, u, F_n, factors), float(turn), float(bite)


@dataclass(frozen=True, eq=False)
class _Step:
    """State after an iteration, its largest increment, the largest turn asked for, the residual and tangent before."""

    state: State
    change: float
    turn: float
    residual: float
    tangent: Tangent | None


def _largest(vectors: Array) -> float:
    """Largest square of the length."""
    return float(np.einsum("ni,ni->n", vectors, vectors).max())
