"""Size of the load steps where equilibrium is iterated to: the whole load first, halved on failure, grown when easy.

A step fails if the iteration does, and if it steps over a critical point: where the state before was stable, the new
one gives way and the loads push it that way, there is a branch that leads on, and half the step may find it. Where a
symmetry keeps the loads from pushing, as on a perfect column, no step however small would leave the unstable branch.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from discrete.branches import Branches
from discrete.grip import DEEP
from discrete.predictor import Memory
from discrete.statics import StepFailed, corners, targets
from discrete.watch import Watch
from dolfinrod.result import StepLog
from dolfinrod.scene import Static

if TYPE_CHECKING:
    from discrete.neutral import PhaseCondition
    from discrete.stability import Judge, Verdict
    from discrete.state import Outcome, State
    from discrete.statics import Path, Progress
    from dolfinrod.scene import Scene

__all__ = ["Walk"]

# Halvings of an interval after which a step is too small to be taken, and to be taken back over a critical point.
MOST_CUTS = 12
MOST_CUTS_AT_A_CRITICAL_POINT = 8
# A step ends at its target if it comes within this part of the way.
NEAR = 1e-6
# A step is followed by a longer one if it took no more iterations than this.
EASY = 16
# Part of an interval within which a critical point explains that a step could not be taken.
CLOSE = 0.01
# Directions that a round rod loses at once: where more are lost, what pushed the rod at first is not seen any more.
PAIR = 2
# Ways to a critical point over which steps are measured by them, where they are this much shorter than an interval, and
# what of one is tried after all of it: no sum of halves and doubles of that ends where all of it did.
BEHIND, SHORT, LESS = 4.0, 16.0, 0.75
# Turn of a section from the extrapolated state at which an unstable path may have been left [rad].
STRAYED = 0.5


@dataclass
class _Scale:
    """What steps are short beside: an interval of the loads, or the way to a critical point in it, while that is near.

    Fibres whose ends are brought together buckle within a ten-thousandth of the way, which no halving of it finds.
    """

    start: float
    interval: float
    way: float = np.inf
    until: float = -np.inf
    looked: bool = False

    def at(self, t: float) -> float:
        return min(self.way, self.interval) if t < self.until else self.interval


class Walk:
    """A path under growing loads.

    Args:
        phase: Solver of the scene with its free motions.
        judge: Tells stable states.
        scene: The problem.
        path: Where to begin; grows.
        t: Pseudo-time there.
        stable: Whether the state there is stable.
    """

    def __init__(
        self, phase: PhaseCondition, judge: Judge, scene: Scene, path: Path[State], t: float, *, stable: bool | None
    ) -> None:
        self._phase, self._judge, self._scene, self._path = phase, judge, scene, path
        self._memory = Memory(phase.equilibrium, t, path.state)
        self._branches = Branches(phase.equilibrium, judge, scene)
        self._step, self._stable = np.inf, stable

    def follow(self, progress: Progress | None) -> None:
        """Follow the loads to their end.

        Args:
            progress: Called with every accepted step and the final pseudo-time.

        Raises:
            StepFailed: A step could not be taken after `MOST_CUTS` halvings.
        """
        kinks, motion = corners(self._scene), self._scene.motion
        assert isinstance(motion, Static)
        for target in targets(self._scene, self._memory.t, motion.steps or 1):
            self._reach(target, progress)
            if target in kinks:
                self._memory.forget()

    def _reach(self, target: float, progress: Progress | None) -> None:
        """Follow the loads over one interval."""
        scale, cuts = _Scale(self._memory.t, target - self._memory.t), 0
        while self._memory.t < target:
            t = self._memory.t
            trial = min(self._step, target - t)
            t_next = target if trial >= (target - t) * (1.0 - NEAR) else t + trial
            outcome, verdict = self._judged(self._attempt(t_next))
            far = verdict is not None and bool(self._stable) and (verdict.directions or 0) > PAIR
            if (far and t == scale.start and not scale.looked) or self._unwanted(outcome, verdict, t_next):
                near = self._foreseen(scale, trial)
                if near or trial > scale.at(t) / 2**MOST_CUTS_AT_A_CRITICAL_POINT:
                    cuts, self._step = cuts + 1, near or trial / 2.0
                    continue
                outcome, verdict = self._pushed(outcome, verdict, t_next)
            if verdict is None:
                if outcome.reason == DEEP:
                    raise self._failed(trial, outcome.reason, scale.interval)
                cuts, self._step = cuts + 1, trial * (LESS if trial == scale.way else 0.5)
                if self._step <= scale.at(t) / 2**MOST_CUTS:
                    raise self._failed(trial, outcome.reason, scale.interval)
                continue
            self._accept(outcome, verdict, t_next, cuts, progress)
            # A step that the target has cut short says nothing against a longer one.
            grown = 2.0 * trial if cuts == 0 and outcome.iterations <= EASY else trial
            self._step, cuts = max(self._step, grown), 0

    def _foreseen(self, scale: _Scale, trial: float) -> float:
        """Way to the first critical point ahead where it is nearer than a step over it; zero where none is."""
        t = self._memory.t
        if scale.looked or t > scale.start:
            return 0.0
        scale.looked = True
        critical = self._branches.next_critical(self._memory.state, t)
        if not t < critical < t + min(trial, scale.interval / SHORT):
            return 0.0
        scale.way, scale.until = critical - t, t + BEHIND * (critical - t)
        return scale.way

    def _failed(self, step: float, reason: str, interval: float) -> StepFailed:
        """What a step that could not be taken leaves to be known."""
        t, state = self._memory.t, self._memory.state
        critical = self._branches.next_critical(state, t)
        near = critical - t < CLOSE * interval
        turned = Watch(self._phase.equilibrium.mesh.elements, state.R).apart
        return StepFailed(t=t, step=step, reason=reason, critical=critical if near else None, turned=turned)

    def _attempt(self, t: float) -> Outcome:
        """Equilibrium from the extrapolated state if that is a good guess, else from the last one.

        On an unstable path, where other equilibria are close by, only the extrapolated state tells which one leads on;
        but of what comes to touch next it knows nothing.
        """
        guess = self._memory.ahead(t)
        if guess is not None:
            outcome = self._phase.find(guess.state, t, trust=guess.turned)
            self._path.iterations += outcome.iterations
            if outcome.converged or (self._stable is False and self._phase.equilibrium.contacts is None):
                return outcome
        outcome = self._phase.find(self._memory.state, t)
        self._path.iterations += outcome.iterations
        return outcome

    def _judged(self, outcome: Outcome) -> tuple[Outcome, Verdict | None]:
        """An attempt, and how stable its end is; None where there is none."""
        return outcome, self._judge.verdict(outcome.tangent, outcome.state.R) if outcome.converged else None

    def _unwanted(self, outcome: Outcome, verdict: Verdict | None, t: float) -> bool:
        """Whether another branch may lead on: beyond a critical point, or where an unstable path was not kept to."""
        if verdict is None or outcome.strayed or verdict.stable:
            return verdict is not None and outcome.strayed
        if self._stable is False:
            return self._memory.extrapolates and outcome.turned > STRAYED
        return (
            bool(self._stable)
            and verdict.gives_way
            and self._branches.missed(self._memory.state, self._memory.t, outcome, t)
        )

    def _pushed(self, outcome: Outcome, verdict: Verdict | None, t: float) -> tuple[Outcome, Verdict | None]:
        """The stable state that the loads push the rod to from the last one, or else what was found."""
        if not self._stable:
            return outcome, verdict
        for guess in self._branches.sent_ahead(self._memory.state, self._memory.t):
            other = self._phase.find(guess, t)
            self._path.iterations += other.iterations
            _, found = self._judged(other)
            if found is not None and found.stable:
                return other, found
        return outcome, verdict

    def _accept(self, outcome: Outcome, verdict: Verdict, t: float, cuts: int, progress: Progress | None) -> None:
        equilibrium, path = self._phase.equilibrium, self._path
        path.state, self._stable = outcome.state, verdict.stable
        self._memory.add(t, outcome.state)
        equilibrium.accept(outcome.state, t)
        kept = equilibrium.snapshot(outcome.state, t)
        energy = kept.energy * equilibrium.mesh.units.moment
        row = StepLog(t, outcome.iterations, cuts, outcome.residual, energy, verdict.stable, verdict.counted)
        path.accept(kept, row, progress, self._scene.motion.t_end)
