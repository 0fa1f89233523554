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

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np

from discrete.assembly import SingularTangentError, gather, scatter
from discrete.nodes import NodalSystem
from discrete.record import Snapshot, evenly
from discrete.rotation import cross, exp
from discrete.state import Outcome, State
from discrete.unknowns import SPIN, SPIN_I, SPIN_J, X_I, X_J, X
from discrete.watch import ALIASED, WANDERING, Watch

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.loads import LoadLevel, Loads
    from discrete.mesh import Mesh
    from discrete.nodes import Tangent
    from discrete.supports import Supports

    Array = NDArray[np.float64]

__all__ = ["LARGEST_TURN", "Element", "Equilibrium", "chord_spin"]

# Largest turn of a section or chord in one iteration [rad].
LARGEST_TURN = 1.5
# Increments at which the iteration has converged: radians, lengths over L, forces over the largest one or EI/L².
TOLERANCE = 1e-9
MOST_ITERATIONS = 60
SETTLED = "the increments fell below the tolerance"


class Element(Protocol):
    """Law of an element; see `corotation.ChordElement` for arguments and shapes."""

    def chord(self, u: Array, E: Array, F_n: Array) -> Array:
        """Chord of a direction whose elongation obeys Eq. 16."""
        ...

    def axial(self, N: Array, u: Array, E: Array) -> Array:
        """Axial force of a spatial force."""
        ...

    def measure(self, e: Array, E: Array, F_n: Array) -> tuple[Array, Array]:
        """End forces and strain energy."""
        ...

    def respond(self, e: Array, E: Array, F_n: Array) -> tuple[Array, Array]:
        """End forces and their derivative."""
        ...


class Equilibrium:
    """Newton's method for one scene and mesh.

    Args:
        mesh: Nodes and elements.
        element: Law of the elements.
        loads: What acts.
        supports: What holds.
    """

    def __init__(self, mesh: Mesh, element: Element, loads: Loads, supports: Supports) -> None:
        self.mesh, self.element, self.loads, self.supports = mesh, element, loads, supports
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
        """What is kept of an equilibrium at a pseudo-time."""
        E = self.mesh.elements.triads(state.R)
        e = self.element.chord(state.u, E, state.F_n)
        force, energy = self.element.measure(e, E, state.F_n)
        return Snapshot(t, state.x, state.R, force, evenly(self.loads.level(t).line), float(energy.sum()))

    def find(self, state: State, t: float, trust: float = np.inf) -> Outcome:
        """Equilibrium at a pseudo-time.

        Args:
            state: First guess.
            t: Pseudo-time.
            trust: Largest turn that the first iteration may ask for [rad]; beyond it the guess was a bad one.

        Returns:
            Outcome; its state is meaningless where it did not converge.
        """
        level, goal = self.loads.level(t), self.supports.factors(t)
        step, watch = _Step(state, np.inf, np.inf, np.inf, None), Watch(self.mesh.elements, state.R)
        reason = f"no convergence in {MOST_ITERATIONS} iterations"
        for iteration in range(1, MOST_ITERATIONS + 1):
            try:
                # A chord that vanishes has no direction; what is not finite then ends the iteration below.
                with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
                    step = self._iterate(step.state, level, goal, watch)
            except SingularTangentError as error:
                reason = str(error)
                break
            if step.change < TOLERANCE:
                reason = ALIASED if watch.aliased else SETTLED
                break
            if not np.isfinite(step.change):
                reason = "the iteration diverged"
                break
            if watch.wandering:
                reason = ALIASED if watch.aliased else WANDERING
                break
            if iteration == 1 and step.turn > trust:
                reason = "the iteration leads off the extrapolated path"
                break
        turned, strayed = watch.turned, watch.strayed
        return Outcome(step.state, reason == SETTLED, iteration, step.residual, reason, turned, step.tangent, strayed)

    def _iterate(self, state: State, level: LoadLevel, goal: Array, watch: Watch) -> _Step:
        """One Newton iteration."""
        node_i = self.mesh.elements.node_i
        E = self.mesh.elements.triads(state.R)
        e = self.element.chord(state.u, E, state.F_n)
        gap = state.x[node_i + 1] - state.x[node_i] - e
        force, tangent = self.element.respond(e, E, state.F_n)
        force += np.matmul(tangent[:, :, X_J], gap[:, :, None])[:, :, 0]
        end = tangent[:, X_J].copy()
        missing = level.at(state.R) - scatter(force, node_i, len(state.x))
        held = self.supports.increments(state.x, state.factors, goal)
        d, residual, worked_in = self._system.increments(tangent, missing, held, level, self.supports.guides, state.R)
        own = gather(d, node_i)
        N = force[:, X_J] + np.matmul(end, own[:, :, None])[:, :, 0]
        spin = chord_spin(state.u, own[:, X_J] - own[:, X_I] + gap, 0.5 * (own[:, SPIN_I] + own[:, SPIN_J]), e)
        new, turn, bite = self._moved(state, d, spin, N, goal)
        watch.see(bite * d[:, SPIN], new.R)
        scale = max(1.0, float(np.abs(new.F_n).max()))
        change = max(turn, float(np.abs(d[:, X]).max()), float(np.abs(new.F_n - state.F_n).max()) / scale)
        return _Step(new, change, turn, residual, worked_in)

    def tangent(self, state: State, level: LoadLevel) -> Tangent:
        """Tangent of a state whose chords join its nodes.

        Args:
            state: Near an equilibrium.
            level: Loads.

        Returns:
            With all that acts at single nodes.
        """
        node_i = self.mesh.elements.node_i
        e = state.x[node_i + 1] - state.x[node_i]
        force, tangent = self.element.respond(e, self.mesh.elements.triads(state.R), state.F_n)
        missing = level.at(state.R) - scatter(force, node_i, len(state.x))
        held = np.zeros_like(missing)
        return self._system.tangent(tangent, missing, held, level, self.supports.guides, state.R)

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


def chord_spin(u: Array, change: Array, spin: Array, e: Array) -> Array:
    """Spin of a chord: as its ends move across it, u×δe/L, and along it as the sections turn on the mean.

    The second part leaves u as it is when small; without it a large increment would turn chords and sections about
    different axes and tear them apart.
    """
    length = np.sqrt(np.einsum("ni,ni->n", e, e))
    return cross(u, change) / length[:, None] + np.einsum("ni,ni->n", u, spin)[:, None] * u
