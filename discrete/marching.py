"""Marching in time: steps that land on the kinks of histories and on output times, halved where they are lost.

Steps of free length keep the error of each below a tolerance. Backward Euler and the trapezoidal rule, of order two,
differ by ½ Δt (v₁ − v₀) in the positions, which is the leading part of the error ½ Δt² a of the former.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, sqrt
from typing import TYPE_CHECKING

import numpy as np

from discrete.statics import StepFailed, corners
from discrete.step import StepLostError
from dolfinrod.scene import Dynamic

if TYPE_CHECKING:
    from collections.abc import Callable

    from discrete.euler import Taken
    from discrete.moving import Moving
    from discrete.trajectory import Entry
    from dolfinrod.scene import Scene

__all__ = ["March", "Mark", "landings"]

# Halvings of a step after which it is lost.
MOST_CUTS = 16
# Parts of a step that round-off makes of it.
NEAR = 1e-9
TOLERANCE = 1e-6
# First step of a free choice in t_end, and the shortest one.
FIRST, SHORTEST = 1e-4, 1e-14
# What a step may become of the last one, and what of the step that would just meet the tolerance.
SAFETY, GROWTH, SHRINKAGE = 0.9, 2.0, 0.1
# Growth for which steps are not changed: factors serve for steps of one length.
WORTH_IT = 1.2


@dataclass(frozen=True, eq=False)
class Mark:
    """Where a march stands at the end of a step, whatever comes after it.

    Args:
        state: There.
        step: Length of the next step [s].
        entry: How far its trajectory had come.
        goals: Times still to be reached on the way from one even step to the next, the last one first [s].
        rested: Whether the motion has ended there, its nodes being slow enough.
    """

    state: Moving
    step: float
    entry: Entry
    goals: tuple[float, ...] = ()
    rested: bool = False


class March:
    """Way through time.

    Args:
        scene: The problem, its motion in time.
        state: Where it begins.
        entry: What is kept at the start.
        take: Takes a step from a state to a time, or raises `StepLostError`.
        accept: Called with the state before, the step, the attempts lost before it and whether to store its end; tells
            what is kept then.
        unit: Of velocities [m/s].

    Attributes:
        mark: The last state that counts.
    """

    _after: Callable[[], None]

    def __init__(
        self,
        scene: Scene,
        state: Moving,
        entry: Entry,
        take: Callable[[Moving, float], Taken],
        accept: Callable[[Moving, Taken, int, bool], Entry],
        unit: float,
    ) -> None:
        assert isinstance(scene.motion, Dynamic)
        self._motion, self._take, self._accept, self._unit = scene.motion, take, accept, unit
        self._kinks, self._stored = landings(scene)
        self.take_up(Mark(state, self._motion.dt or FIRST * self._motion.t_end, entry))

    def take_up(self, mark: Mark) -> None:
        """Go on from there."""
        self.mark, self.state, self.step, self._goals = mark, mark.state, mark.step, list(mark.goals)

    def follow(self, after: Callable[[], None]) -> None:
        """March to the end.

        Args:
            after: Called at the end of every step.

        Raises:
            StepFailed: A step could not be taken however short.
        """
        self._after, before = after, 0.0
        for target in sorted(self._kinks | self._stored):
            if self._motion.dt is None:
                self._reach_freely(target, self._motion.tol or TOLERANCE)
            else:
                self._reach(before, target, self._motion.dt)
            if target in self._kinks and self.state.t == target:
                self.state = self.state.without_trend()
            before = target

    def _rests(self, before: Moving, after: Moving) -> bool:
        """Whether the fastest node has become slow enough for the motion to end."""
        if self._motion.rest is None:
            return False
        was, now = (self._unit * float(np.linalg.norm(state.v, axis=1).max()) for state in (before, after))
        return was >= self._motion.rest > now

    def _reach(self, start: float, target: float, dt: float) -> None:
        """Equal steps from one time to another, those that are still ahead."""
        n = max(1, ceil((target - start) / dt * (1.0 - NEAR)))
        h = (target - start) / n
        for k in range(1, n + 1):
            t = target if k == n else start + k * (target - start) / n
            if t > self.state.t + NEAR * h and not self.mark.rested:
                self._advance(t)

    def _advance(self, t: float) -> None:
        """One step, or as many shorter ones as it takes."""
        goals, cuts = self._goals, 0
        goals[:] = [t, *(goal for goal in goals if goal < t)]
        while goals and not self.mark.rested:
            now, self.step = self.state, goals[-1] - self.state.t
            try:
                taken = self._take(now, goals[-1])
            except StepLostError as error:
                cuts += 1
                if len(goals) > MOST_CUTS:
                    raise StepFailed(t=now.t, step=self.step, reason=str(error)) from error
                goals.append(0.5 * (now.t + goals[-1]))
                continue
            goals.pop()
            self._go_on(taken, cuts)
            cuts = 0

    def _reach_freely(self, target: float, tol: float) -> None:
        """Steps as long as the tolerance lets them be, up to a time."""
        cuts, reason = 0, ""
        while self.state.t < target and not self.mark.rested:
            now, left = self.state, target - self.state.t
            # The last two steps share what is left, so that none is much shorter than the one before.
            trial = left if self.step >= left * (1.0 - NEAR) else min(self.step, max(0.5 * left, 0.5 * self.step))
            if trial < SHORTEST * self._motion.t_end:
                raise StepFailed(t=now.t, step=trial, reason=reason)
            try:
                taken = self._take(now, target if trial == left else now.t + trial)
            except StepLostError as error:
                cuts, reason, self.step = cuts + 1, str(error), 0.5 * trial
                continue
            ratio = SAFETY * sqrt(tol / max(_error(now, taken), 1e-300))
            if ratio < SAFETY:
                cuts, reason = cuts + 1, "the error of a step exceeds the tolerance"
                self.step = trial * max(ratio, SHRINKAGE)
                continue
            if not 1.0 <= ratio < WORTH_IT:
                # A step that the target has cut short says nothing against a longer one.
                self.step = max(self.step, trial * min(ratio, GROWTH)) if ratio > 1.0 else trial * ratio
            self._go_on(taken, cuts)
            cuts = 0

    def _go_on(self, taken: Taken, cuts: int) -> None:
        """Accept a step."""
        before, self.state = self.state, taken.state
        rested = self._rests(before, taken.state)
        entry = self._accept(before, taken, cuts, rested or self._motion.output is None or self.state.t in self._stored)
        self.mark = Mark(self.state, self.step, entry, tuple(self._goals), rested)
        self._after()


def landings(scene: Scene) -> tuple[set[float], set[float]]:
    """Times that steps end at.

    Args:
        scene: The problem, its motion in time.

    Returns:
        Kinks of histories, and times whose states are stored if not all are, the end among them.
    """
    assert isinstance(scene.motion, Dynamic)
    t_end, output = scene.motion.t_end, scene.motion.output
    if output is None:
        stored: set[float] = set()
    elif isinstance(output, float):
        n = int(t_end / output * (1.0 + NEAR))
        stored = {min(k * output, t_end) for k in range(1, n + 1)}
    else:
        stored = set(output)
    if stored and t_end - max(stored) <= NEAR * t_end:
        stored.discard(max(stored))
    stored.add(t_end)
    # Times that differ by round-off are one: no step is to lead from one to the other.
    ends = np.array(sorted(stored))
    inside = [t for t in corners(scene) if 0.0 < t < t_end]
    near = {t: float(ends[np.argmin(np.abs(ends - t))]) for t in inside}
    return {other if abs(other - t) <= NEAR * t_end else t for t, other in near.items()}, stored


def _error(before: Moving, taken: Taken) -> float:
    """Error of the step in L and radians."""
    after = taken.state
    changes = (np.abs(after.v - before.v).max(), np.abs(after.ω - before.ω).max())
    return 0.5 * (after.t - before.t) * float(max(changes))
