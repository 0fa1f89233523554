"""Sets of touching and sticking nodes that an iteration passes through: left for good, come back to, or one by one."""

from __future__ import annotations

import numpy as np

__all__ = ["Rounds"]

# How often one set may be come back to.
MOST_RETURNS = 3
# Iterations in which increments should have fallen to this part.
LONG, PART = 8, 0.5


class Rounds:
    """The sets met in one iteration, with the increments that led on from them.

    Attributes:
        circling: Whether one has been come back to too often.
    """

    def __init__(self) -> None:
        self.circling = False
        self._met, self._last, self._spent = dict[bytes, list[float]](), b"", list[float]()

    def overshoots(self, pattern: bytes, change: float) -> bool:
        """Whether an increment should be halved: it leads on from a set come back to, and is hardly smaller than then.

        Args:
            pattern: States of all nodes, as `Contacts.pattern` has them.
            change: Size of the increment.
        """
        if np.array_equal(_touching(pattern), _touching(self._last)):
            self._spent.clear()
        self._spent.append(change)
        earlier = self._met.setdefault(pattern, [])
        if earlier and pattern == self._last:
            earlier[-1] = change
            return False
        self._last = pattern
        earlier.append(change)
        self.circling = len(earlier) > MOST_RETURNS + 1
        return len(earlier) > 1 and change > PART * earlier[-2]

    @property
    def creeping(self) -> bool:
        """Whether ever other nodes touch, and increments stay as large as they were long ago."""
        return len(self._spent) > LONG and self._spent[-1] > PART * self._spent[-1 - LONG]


def _touching(pattern: bytes) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    return np.frombuffer(pattern, dtype=np.int8) > 0
