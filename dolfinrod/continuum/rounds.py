"""Newton's method among surfaces may go round in circles, or creep from node to node: what tells so."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from mpi4py import MPI

    from numpy.typing import NDArray

    from dolfinrod.continuum.together import Touching

__all__ = ["SHRUNK", "Rounds"]

# Part of an increment that is left, at most, where an iteration gets on.
SHRUNK = 0.5
# Iterations over which it gets on.
PATIENCE = 8


class Rounds:
    """What touches, sticks and slides in the iterations of one attempt, and how long their increments are.

    Args:
        comm: Ranks that iterate together.
        contacts: What the rods touch; None: nothing.
    """

    def __init__(self, comm: MPI.Comm, contacts: Touching | None) -> None:
        self._comm, self._contacts = comm, contacts
        self._met, self._last, self._sizes = dict[bytes, float](), b"", list[float]()

    def returned(self, size: float) -> bool:
        """Whether an increment of this size starts from a set that had been left, by one that was hardly larger."""
        if self._contacts is None:
            return False
        # That of all ranks: each alone may come back to what it had while others do not.
        pattern, last = b"".join(self._comm.allgather(self._contacts.pattern)), self._last
        if np.array_equal(touching(pattern), touching(last)):
            self._sizes.clear()
        self._sizes.append(size)
        back = pattern != last and size > SHRUNK * self._met.get(pattern, np.inf)
        self._met[pattern], self._last = size, pattern
        return bool(back)

    @property
    def creeping(self) -> bool:
        """Whether other nodes touch from iteration to iteration and increments do not become smaller."""
        return len(self._sizes) > PATIENCE and self._sizes[-1] > SHRUNK * self._sizes[-1 - PATIENCE]


def touching(pattern: bytes) -> NDArray[np.bool_]:
    """Of the states of nodes those that touch."""
    return np.frombuffer(pattern, dtype=np.int8) > 0
