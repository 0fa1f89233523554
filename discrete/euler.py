"""One step of backward Euler, 2.3.2 and Eq. 26: v₁ = v₀ + Δt a₁, x₁ = x₀ + Δt v₁, every force at the end of the step.

Velocities are iterated on and configurations follow from them: a difference of positions would lose the digits of v in
short steps.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from discrete.approach import approach
from discrete.ends import Ends
from discrete.factors import Workshop
from discrete.pace import FINE, Pace
from discrete.rotation import tangents
from discrete.step import Step, StepLostError
from discrete.taken import Balance, Taken
from discrete.unknowns import SPIN, X
from discrete.walls import Walls
from discrete.ways import Ways

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.constitution import Element
    from discrete.drag import Drag
    from discrete.loads import LoadLevel, Loads
    from discrete.mesh import Mesh
    from discrete.momentum import Inertia
    from discrete.moving import Moving
    from discrete.solution import Factors, Increments
    from discrete.supports import Supports
    from discrete.surroundings import Surroundings

    Array = NDArray[np.float64]

__all__ = ["BackwardEuler", "Taken"]

# What the last increment leaves of the largest motion in a step.
TOLERANCE = 1e-9
# The same in L and radians: what steps leave adds up, in 1e4 of them to 1e-8.
FINEST = 1e-12
# Increments, in L and radians, below which only round-off keeps them from shrinking.
ROUND_OFF = 1e-11
MOST_ITERATIONS = 30
# Iterations after which increments are halved that do not shrink: rods that touch in one and not in the next.
PATIENT = 4
# An increment, in L and radians, beyond which positions and turns as unknowns lead anywhere.
RUNAWAY = 0.5


class BackwardEuler:
    """Steps in time of one scene and mesh.

    Args:
        mesh: Nodes and elements.
        loads: What acts.
        supports: What holds.
        inertia: Of the nodes.
        drag: Of the air; None where there is none.
        contacts: What the rods touch; None: nothing.
        added: Whether rotation vectors are added up, R₁ = exp(Σ Δt ω) R at the start: no rotation once the axis of the
            spin changes, and lost at a full turn.
    """

    def __init__(
        self,
        mesh: Mesh,
        loads: Loads,
        supports: Supports,
        inertia: Inertia,
        drag: Drag | None,
        contacts: Surroundings | None = None,
        *,
        added: bool,
    ) -> None:
        self.mesh, self.loads, self.supports, self.inertia = mesh, loads, supports, inertia
        self._drag, self._added = drag, added
        self._ends = Ends(mesh.elements, len(mesh.x))
        self._walls = None if contacts is None else Walls(contacts)
        self.contacts = contacts
        alone = drag is None and (contacts is None or contacts.walls is None)
        self._workshop = Workshop(mesh, supports, inertia.m if alone else None)
        self._still = np.zeros_like(mesh.x)
        self._ways = Ways(meet=contacts is not None and contacts.others is not None)

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
        level, workshop = self.loads.level(t), self._workshop

        def straight() -> Taken:
            return self._iterated(self._begun(now, t, staying=False), law, level, 0)

        def approached() -> Taken:
            step = self._begun(now, t, staying=True)
            spent = approach(step, self.mesh, law, lambda *at: self._increments(level, *at))
            workshop.forget()
            return self._iterated(step, law, level, spent)

        # Chords that vanish on the way to nowhere have no direction; what is not finite ends the iteration.
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            return self._ways.taken(straight, approached, workshop.forget)

    def _begun(self, now: Moving, t: float, *, staying: bool) -> Step:
        """First guess."""
        self._workshop.check(t - now.t)
        if self._walls is not None:
            self._walls.begin(t)
        return Step(self.mesh, self.supports, now, t, added=self._added, staying=staying)

    def _iterated(self, step: Step, law: Element, level: LoadLevel, spent: int) -> Taken:
        """Newton's method with factors that may be old, after some iterations of another kind."""
        workshop, walls, before, left = self._workshop, self._walls, np.inf, 0.0
        iteration, stirred, settled, fine, age = 0, 0, True, FINE, np.inf
        while iteration < MOST_ITERATIONS * (1 if walls is None else 1 + walls.renewals):
            iteration += 1
            balance = self._balance(step, law, level)
            if walls is not None and walls.foreign:
                workshop.factors = None
            fresh = workshop.factors is None
            age = 0.0 if fresh else age + 1.0
            make, touched = partial(self._factors_at, step, law, level, balance), None
            if walls is not None:
                touched, settled = walls.coupled(), walls.contacts.settled
                stirred += not settled
            found = workshop.found(make, balance.missing, balance.R, touched, fine)
            if found.size >= RUNAWAY:
                raise StepLostError("the iteration diverged")
            step.move(found.d if settled or iteration < PATIENT or found.size < 0.5 * before else 0.5 * found.d)
            goal = min(TOLERANCE * step.motion(), FINEST)
            exact = found.size == 0.0 or (found.size < ROUND_OFF and found.size > 0.25 * before)
            pace = None if touched is None else Pace(found.size, before, goal, age, fine)
            done = exact or (iteration > 1 and workshop.enough(found.size, before, goal, pace))
            if iteration > 2 and not fresh and settled:
                left = max(left, found.size / before)
            if done and (walls is None or walls.agree(step, exact=exact)):
                if workshop.wear.see(iteration - stirred, left) and (touched is None or not touched.meets):
                    workshop.factors = None
                return self._taken(step, found, balance, level, spent + iteration)
            if pace is not None:
                fine = workshop.go_on(pace)
            elif iteration > 1 and not fresh and workshop.wear.slow(found.size, before, goal):
                workshop.factors = None
            before = found.size
        raise StepLostError(f"no convergence in {MOST_ITERATIONS} iterations")

    def _balance(self, step: Step, law: Element, level: LoadLevel) -> Balance:
        """All forces as far as the iteration has come."""
        x, R = step.configuration()
        e, E = self._ends.chords(x).T, self._ends.triads(R).transpose(3, 2, 0, 1)
        force, energy = law.measure(e, E, step.F_n)
        internal = self._ends.scatter(force.T)
        missing, drag, pressed, moment = self._outer(step, x, R, level)
        missing -= internal
        return Balance(x, R, e, E, force, energy, internal, drag, pressed, moment, missing)

    def _outer(self, step: Step, x: Array, R: Array, level: LoadLevel) -> tuple[Array, Array, Array | None, Array]:
        """Loads, drag, surfaces and inertia together by rows; of these drag, surfaces and the moment of inertia."""
        frames = R.transpose(2, 0, 1)
        outer, drag = level.at(frames).T.copy(), self._still
        if self._drag is not None:
            drag = self._drag.force(x.T, frames, step.v.T, step.t)
            outer[X] += drag.T
        pressed = None
        if self._walls is not None:
            pressed = self._walls.press(x, frames)
            outer += pressed
        moment = self.inertia.moment(frames, step.Ω.T, step.ΔΩ.T, step.dt)
        outer[X] -= self.inertia.force(step.Δv.T, step.dt).T
        outer[SPIN] -= moment.T
        return outer, drag, pressed, moment

    def _increments(self, level: LoadLevel, step: Step, force: Array, tangent: Array) -> Array:
        """Increments by new factors for given end forces and their derivative, shape (7, n_nodes)."""
        x, R = step.configuration()
        missing, _, _, moment = self._outer(step, x, R, level)
        missing -= self._ends.scatter(force.T)
        touched = None if self._walls is None else self._walls.coupled()
        make, self._workshop.factors = partial(self._factors, step, tangent, level, (x, R, moment, missing)), None
        return self._workshop.found(make, missing, R, touched, FINE).d

    def _factors_at(self, step: Step, law: Element, level: LoadLevel, at: Balance) -> Factors:
        """New factors where the iteration has come to, of small matrices that lie one after the other."""
        _, stiffness = law.respond(np.ascontiguousarray(at.e), np.ascontiguousarray(at.E), step.F_n)
        return self._factors(step, stiffness, level, (at.x, at.R, at.moment, at.missing))

    def _factors(
        self, step: Step, stiffness: Array, level: LoadLevel, at: tuple[Array, Array, Array, Array]
    ) -> Factors:
        """New factors of the tangent at a configuration, moment of inertia and what is out of balance there."""
        x, R, moment, missing = at
        frames, (Θ, _) = R.transpose(2, 0, 1), tangents(step.θ.T, self._still)
        blocks, drag = self.inertia.blocks(frames, step.ω.T, step.Ω.T, moment, Θ, step.dt), None
        if self._drag is not None:
            drag = self._drag.blocks(x.T, frames, step.v.T, step.t, step.dt)
            blocks += drag
        touched = None if self._walls is None else self._walls.touched()
        return self._workshop.make(stiffness, blocks, drag, touched, step.dt, missing, level, R)

    def _taken(self, step: Step, found: Increments, at: Balance, level: LoadLevel, iterations: int) -> Taken:
        """The step, what acted before its last increment carried on along it."""
        change, yielded = found.stretched(self._ends), found.pressed()
        added = self._ends.scatter(change)
        energy = float(at.energy.sum()) + float(np.vdot(at.internal + 0.5 * added, found.d))
        state = step.end()
        return Taken(
            state=state,
            iterations=iterations,
            residual=found.free,
            force=at.force + change.T,
            internal=(at.internal + added).T,
            energy=energy,
            level=level,
            acting=level.at(state.R),
            drag=at.drag + found.slowed(),
            missing=(at.missing - added).T + yielded,
            pressed=None if at.pressed is None else at.pressed.T + yielded,
        )
