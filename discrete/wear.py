"""How long factors of a tangent serve, and how far an iteration with them has come.

Increments by old factors shrink by about the same part from one iteration and from one step to the next; that decides
when new ones would pay and when a further iteration would change nothing.
"""

from __future__ import annotations

from math import log

__all__ = ["Wear"]

# Iterations that new factors cost as much as.
WORTH = 3.0
# Part of an increment that the next one will hardly be below, however much smaller it was than the one before.
STEADY = 0.1
# Factors twice as old have worn, at most with the square of the way that the deformation has gone, four times as much.
AGED = 4.0
# Steps in a row that begin with new factors after one in which they did not last.
EAGER = 8
# Iterations that no step takes.
MANY = 1000


class Wear:
    """What is known of the factors at hand by the steps that were taken with them."""

    def __init__(self) -> None:
        self._eager = 0
        self.renew()

    def renew(self) -> None:
        """Forget the last factors: there are new ones."""
        self._least, self._excess = MANY, 0
        self._age, self._learned, self._pace = 0, 0, STEADY

    def enough(self, size: float, before: float, goal: float) -> bool:
        """Whether what an increment leaves is below a goal."""
        pace = STEADY if self._learning else self._pace
        return size * min(1.0, max(size / before, pace)) <= goal

    def slow(self, size: float, before: float, goal: float) -> bool:
        """Whether increments shrink so slowly that new factors would pay in this step."""
        if size >= before or log(goal / size) < WORTH * log(size / before):
            self._eager = EAGER
            return True
        return False

    def see(self, iterations: int, left: float) -> bool:
        """Take note of what a step has cost.

        New factors pay once steps have cost as much more than their shortest one as these would. Where the old ones did
        not last for one step, the next few begin with new ones.

        Args:
            iterations: That the step took.
            left: Largest part that was left of its increments but the first; zero: not seen.

        Returns:
            Whether new factors are due.
        """
        if left > 0.0:
            if self._learning:
                # The iteration by which it is seen is not the fault of the factors.
                iterations -= 1
            self._pace, self._learned = min(STEADY, AGED * left), self._age + 1
        self._age += 1
        self._eager -= 1
        self._least = min(self._least, max(2, iterations))
        self._excess += max(0, iterations - self._least)
        return self._eager > 0 or self._excess > WORTH

    @property
    def _learning(self) -> bool:
        """Whether the factors are twice as old as when they were last seen to leave a small part of an increment."""
        return self._age >= 2 * self._learned
