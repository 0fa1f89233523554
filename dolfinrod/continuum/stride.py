"""How long load steps are: halved where no equilibrium is found, longer again after easy ones."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

__all__ = ["EASY", "Scale", "Stride"]

# A step that took at most so many iterations was easy, and the next may be longer by this factor.
EASY, GROWTH = 6, 1.5
# Easy steps before a length that failed is tried again.
PATIENCE = 4
# Ways to a critical point over which steps are measured by them, where they are this much shorter than an interval.
BEHIND, SHORT = 4.0, 16.0


@dataclass
class Stride:
    """Length of the next step, from how the last ones went.

    Args:
        length: That Newton's method is trusted with.
        failed: Shortest that did not succeed.
        successes: Steps taken since then.
        cuts: Failed attempts at the present step.
        easy: Most iterations of a step that was easy.
    """

    length: float = np.inf
    failed: float = np.inf
    successes: int = 0
    cuts: int = 0
    easy: int = EASY

    def fail(self, tried: float) -> None:
        """Half of what was tried comes next."""
        self.length, self.failed, self.successes = tried / 2, tried, 0
        self.cuts += 1

    def succeed(self, tried: float, iterations: int) -> None:
        """The same comes next, or more after an easy step, up to what failed not long ago."""
        self.successes += 1
        grown = GROWTH * tried
        if self.cuts == 0 and iterations <= self.easy and (grown < self.failed or self.successes >= PATIENCE):
            self.length = max(self.length, grown)
        elif self.cuts:
            self.length = tried
        self.cuts = 0

    def next(self, distance: float) -> float:
        """Length of the next step on the way to a target, the rest being cut into equal parts."""
        return float(distance / np.ceil(distance / self.length * (1 - 1e-9))) if self.length < distance else distance


@dataclass
class Scale:
    """What steps are short beside: the way from one target to the next, or to a critical point that lies on it.

    Slender rods whose ends are brought together buckle within a ten-thousandth of that way: no halving finds that.

    Args:
        start: Pseudo-time of the last target.
        interval: From there to the next one.
        way: To the critical point.
        until: Pseudo-time up to which that counts.
        looked: Whether it has been looked for.
    """

    start: float
    interval: float
    way: float = np.inf
    until: float = -np.inf
    looked: bool = False

    def near(self, t: float, critical: float) -> bool:
        """A critical point is seen from t: whether it is so near that halved intervals would not find it."""
        if not t < critical < t + self.interval / SHORT:
            return False
        self.way, self.until = critical - t, t + BEHIND * (critical - t)
        return True

    def at(self, t: float) -> float:
        """The scale at a pseudo-time."""
        return min(self.way, self.interval) if t < self.until else self.interval
