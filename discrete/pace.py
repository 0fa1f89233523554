"""How far an iteration has come in which rods touch one another, and what its next increment is to be worth.

By factors made where an increment is taken it is one of Newton's method, which leaves C e² of an error e; older factors
leave a part ρ of it, ρ ≈ C e where they were made e away. Increments of size s₀ and s, one after the other, tell
C ≤ s/s₀², or ρ ≈ s/s₀.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, log
from sys import float_info

__all__ = ["FINE", "FINEST", "Pace"]

# Part of forces between rods left out of balance where increments shrink slowly, and at best.
FINE, FINEST = 1e-2, 1e-6
# Iterations that new factors cost as much as: one, as each of them looks for all that touches.
WORTH = 1.0
# Part of what may be left at last that forces left out of balance take up.
SPARE = 0.1


@dataclass(frozen=True)
class Pace:
    """Two increments of a step.

    Args:
        size: Of the last one.
        before: Of the one before it; infinite: none.
        goal: For what the last increment of the step leaves.
        age: How many increments were taken by the factors before the last one; infinite: they are of an earlier step.
        rough: Part of forces between rods that it was allowed to leave out of balance.
    """

    size: float
    before: float
    goal: float
    age: float
    rough: float

    @property
    def foretold(self) -> bool:
        """Whether an increment by factors of this step leaves less than the goal."""
        return self.age < inf and self._shrinks and self.left <= self.goal

    @property
    def part(self) -> float:
        """Part of the last increment that it leaves, found exactly, and that of the next one if factors are kept."""
        ratio = self.size / self.before
        return ratio if self.age > 0 else ratio * ratio

    @property
    def left(self) -> float:
        """What the last increment leaves, found exactly."""
        return self.size * self.part

    @property
    def slow(self) -> bool:
        """Whether increments shrink, yet so slowly that new factors pay."""
        return self._shrinks and log(self.goal / self.size) < (1.0 + WORTH) * log(self.part)

    def fine(self, *, renewed: bool) -> float:
        """Part of forces between rods that the next increment may leave out of balance.

        It need not be found any finer than the tangent foresees it, nor than what is to be left at last.

        Args:
            renewed: Whether it will be found by new factors.
        """
        if not self._shrinks:
            return FINE
        foreseen = self.size / self.before * self.left / self.before if renewed else self.part
        soon = self.size * max(self.part, self.rough)
        return max(FINEST, min(FINE, max(foreseen, SPARE * self.goal / max(soon, float_info.min))))

    @property
    def _shrinks(self) -> bool:
        return 0.0 < self.size < self.before < inf
