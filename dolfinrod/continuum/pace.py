"""How long the next step in time may be."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, log2

__all__ = ["Pace"]

# Part of the step that would just meet the tolerance, and how much a step may differ from the one before.
SAFETY, SHORTER, LONGER = 0.9, 0.2, 2.0
# Steps stay as they are, and with them the tangent, unless they can grow by more than this.
WORTH = 1.2


@dataclass
class Pace:
    """Length of the next step, as long as the error of each stays within a tolerance.

    Steps of fixed length that are lost grow again as they have shrunk, to twice the one before: what a step met does
    not end with it.

    Args:
        length: Of the next step [s].
        order: Power of the step with which the error of one step falls.
        tol: Error allowed in a step, in L; None: steps are as long as the first one where none is lost.
    """

    length: float
    order: int
    tol: float | None = None

    def __post_init__(self) -> None:
        self._longest = self.length if self.tol is None else inf

    def allows(self, error: float, tried: float) -> bool:
        """Whether a step was accurate enough; the next one is chosen by its error.

        Args:
            error: Estimate for the step, in L.
            tried: Its length [s].
        """
        if self.tol is None:
            # A step cut short by the time it leads to says nothing against a longer one.
            self.length = min(max(self.length, LONGER * tried), self._longest)
            return True
        wanted = SAFETY * (self.tol / error) ** (1.0 / self.order) if error > 0.0 else LONGER
        if not 1.0 <= wanted < WORTH:
            self.length = tried * min(max(wanted, SHORTER), LONGER)
        return error <= self.tol

    def fail(self, tried: float) -> None:
        """A step that found no state: half of it comes next."""
        self.length = tried / 2.0

    def halved(self, tried: float, left: float) -> int:
        """How often a step of fixed length is halved already: as it grows slowly again, more would never end.

        Args:
            tried: Its length [s].
            left: Time to where it leads, with the steps that follow [s].
        """
        return max(0, round(log2(min(self._longest, left) / tried))) if self.tol is None else 0
