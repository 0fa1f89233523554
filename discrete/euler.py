"""One step of backward Euler, 2.3.2 and Eq. 26: v₁ = v₀ + Δt a₁, x₁ = x₀ + Δt v₁, every force at the end of the step.

Velocities are iterated on and configurations follow from them: a difference of positions would lose the digits of v in
short steps.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from discrete.approach import approach
from discrete.assembly import SingularTangentError, scatter
from discrete.factors import Workshop
from discrete.rotation import tangents
from discrete.step import Step, StepLostError
from discrete.unknowns import SPIN, X

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.drag import Drag
    from discrete.equilibrium import Element
    from discrete.factors import Factors
    from discrete.loads import LoadLevel, Loads
    from discrete.mesh import Mesh
    from discrete.momentum import Inertia
    from discrete.moving import Moving
    from discrete.supports import Supports

    Array = NDArray[np.float64]

__all__ = ["BackwardEuler", "Taken"]

# What the last increment leaves of the largest motion in a step.
TOLERANCE = 1e-9
# Increments, in L and radians, below which only round-off keeps them from shrinking.
ROUND_OFF = 1e-11
MOST_ITERATIONS = 30
# An increment, in L and radians, beyond which positions and turns as unknowns lead anywhere.
RUNAWAY = 0.5


@dataclass(frozen=True, eq=False)
class Taken:
    """A step and all that acted in it, in units of the model.

    Args:
        state: At its end.
        iterations: Linear systems solved.
        residual: Largest force or moment out of balance before the last increment.
        force: End forces of the elements, shape (n, 13).
        internal: The same at the nodes, shape (n_nodes, 7).
        energy: Strain energy by the law of the step.
        level: Loads at its end.
        acting: The same at the nodes, shape (n_nodes, 7).
        drag: Forces of the air, shape (n_nodes, 3).
        missing: Loads, drag and inertia minus internal forces: what supports answer with a minus, shape (n_nodes, 7).
    """

    state: Moving
    iterations: int
    residual: float
    force: Array
    internal: Array
    energy: float
    level: LoadLevel
    acting: Array
    drag: Array
    missing: Array


@dataclass(frozen=True, eq=False)
class _Balance:
    """Forces in a configuration; names and shapes as in `Taken`, `moment` is that of inertia."""

    x: Array
    R: Array
    e: Array
    E: Array
    force: Array
    internal: Array
    energy: float
    drag: Array
    moment: Array
    missing: Array


class BackwardEuler:
    """Steps in time of one scene and mesh.

    Args:
        mesh: Nodes and elements.
        loads: What acts.
        supports: What holds.
        inertia: Of the nodes.
        drag: Of the air; None where there is none.
        added: Whether rotation vectors are added up, R₁ = exp(Σ Δt ω) R at the start: no rotation once the axis of the
            spin changes, and lost at a full turn.
    """

    def __init__(
        self, mesh: Mesh, loads: Loads, supports: Supports, inertia: Inertia, drag: Drag | None, *, added: bool
    ) -> None:
        self.mesh, self.loads, self.supports, self.inertia = mesh, loads, supports, inertia
        self._drag, self._added = drag, added
        self._workshop = Workshop(mesh, supports)
        self._still = np.zeros_like(mesh.x)

    @property
    def factorizations(self) -> int:
        """Tangents factorised so far."""
        return self._workshop.made

    @property
    def iterations(self) -> int:
        """Linear systems solved so far."""
        return self._workshop.solved

    def take(self, now: Moving, t: float, law: Element) -> Taken:
        """Step to a time.

        Args:
            now: Where the step begins.
            t: Where it ends.
            law: Of the elements in this step.

        Returns:
            The step.

        Raises:
            StepLostError: It could not be taken.
        """
        level = self.loads.level(t)
        # Chords that vanish on the way to nowhere have no direction; what is not finite ends the iteration.
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            try:
                return self._iterated(self._begun(now, t, staying=False), law, level, 0)
            except (SingularTangentError, StepLostError):
                self._workshop.factors = None
            try:
                step = self._begun(now, t, staying=True)
                spent = approach(step, self.mesh, law, lambda *at: self._increments(level, *at))
                self._workshop.factors = None
                return self._iterated(step, law, level, spent)
            except (SingularTangentError, StepLostError) as error:
                self._workshop.factors = None
                raise StepLostError(str(error)) from error

    def _begun(self, now: Moving, t: float, *, staying: bool) -> Step:
        """First guess of a step."""
        self._workshop.check(t - now.t)
        return Step(self.mesh, self.supports, now, t, added=self._added, staying=staying)

    def _iterated(self, step: Step, law: Element, level: LoadLevel, spent: int) -> Taken:
        """Newton's method with factors that may be old, after some iterations of another kind."""
        workshop, before = self._workshop, np.inf
        for iteration in range(1, MOST_ITERATIONS + 1):
            balance = self._balance(step, law, level)
            factors, fresh = workshop.factors, workshop.factors is None
            if factors is None:
                _, stiffness = law.respond(balance.e, balance.E, step.F_n)
                at = balance.x, balance.R, balance.moment, balance.missing
                factors = self._factors(step, stiffness, level, at)
            d, free = workshop.increments(factors, balance.missing, balance.R)
            size = max(float(np.abs(d[:, X]).max()), float(np.abs(d[:, SPIN]).max()))
            if size >= RUNAWAY:
                raise StepLostError("the iteration diverged")
            step.move(d)
            goal = TOLERANCE * step.motion()
            done = np.isfinite(before) and workshop.enough(size, before, goal)
            if done or size == 0.0 or (size < ROUND_OFF and size > 0.25 * before):
                workshop.wear(iteration)
                return self._taken(step, factors, d, balance, level, (spent + iteration, free))
            if not fresh and np.isfinite(before) and workshop.slow(size, before, goal):
                workshop.factors = None
            before = size
        raise StepLostError(f"no convergence in {MOST_ITERATIONS} iterations")

    def _balance(self, step: Step, law: Element, level: LoadLevel) -> _Balance:
        """All forces as far as the iteration has come."""
        x, R = step.configuration()
        node_i = self.mesh.elements.node_i
        e, E = x[node_i + 1] - x[node_i], self.mesh.elements.triads(R)
        force, energy = law.measure(e, E, step.F_n)
        internal = scatter(force, node_i, len(x))
        missing, drag, moment = self._outer(step, x, R, level)
        missing -= internal
        return _Balance(x, R, e, E, force, internal, float(energy.sum()), drag, moment, missing)

    def _outer(self, step: Step, x: Array, R: Array, level: LoadLevel) -> tuple[Array, Array, Array]:
        """Loads, drag and inertia together, the drag alone and the moment that inertia takes."""
        outer, drag = level.at(R), self._still
        if self._drag is not None:
            drag = self._drag.force(x, R, step.v, step.t)
            outer[:, X] += drag
        moment = self.inertia.moment(R, step.Ω, step.ΔΩ, step.dt)
        outer[:, X] -= self.inertia.force(step.Δv, step.dt)
        outer[:, SPIN] -= moment
        return outer, drag, moment

    def _increments(self, level: LoadLevel, step: Step, force: Array, tangent: Array, R: Array) -> Array:
        """Increments by new factors for given end forces and their derivative."""
        x, _ = step.configuration()
        missing, _, moment = self._outer(step, x, R, level)
        missing -= scatter(force, self.mesh.elements.node_i, len(x))
        factors = self._factors(step, tangent, level, (x, R, moment, missing))
        return self._workshop.increments(factors, missing, R)[0]

    def _factors(
        self, step: Step, stiffness: Array, level: LoadLevel, at: tuple[Array, Array, Array, Array]
    ) -> Factors:
        """New factors of the tangent at a configuration, moment of inertia and what is out of balance there."""
        x, R, moment, missing = at
        Θ, _ = tangents(step.θ, self._still)
        blocks, drag = self.inertia.blocks(R, step.ω, step.Ω, moment, Θ, step.dt), None
        if self._drag is not None:
            drag = self._drag.blocks(x, R, step.v, step.t, step.dt)
            blocks += drag
        return self._workshop.make(stiffness, blocks, drag, step.dt, missing, level, R)

    def _taken(
        self, step: Step, factors: Factors, d: Array, at: _Balance, level: LoadLevel, row: tuple[int, float]
    ) -> Taken:
        """The step, what acted before its last increment carried on along it."""
        change = factors.stretched(d)
        added = scatter(change, self.mesh.elements.node_i, len(d))
        energy = at.energy + float(np.vdot(at.internal + 0.5 * added, d))
        state = step.end()
        return Taken(
            state=state,
            iterations=row[0],
            residual=row[1],
            force=at.force + change,
            internal=at.internal + added,
            energy=energy,
            level=level,
            acting=level.at(state.R),
            drag=at.drag + factors.slowed(d),
            missing=at.missing - added,
        )
