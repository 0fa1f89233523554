"""How long a Newton step is: its largest turn, and its largest change of each linear field beside the field itself."""

from __future__ import annotations

from typing import TYPE_CHECKING

from mpi4py import MPI

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from dolfinrod.continuum.discretization import Discretization

    Array = NDArray[np.float64]

__all__ = ["Sizes"]


class Sizes:
    """Largest magnitudes over all ranks, in one pass over the unknowns and one message.

    Args:
        discretization: Numbering of the unknowns.
        fields: Linear fields that count.
    """

    def __init__(self, discretization: Discretization, fields: Sequence[str]) -> None:
        self._comm, n = discretization.comm, discretization.n_owned
        # The place after the last unknown holds zero: a rank may have no node of a field.
        members = [np.append(discretization.owned_nodes(field).ravel(), n) for field in fields]
        members += [of_step + n + 1 for of_step in members]
        self._order = np.concatenate(members)
        self._starts = np.cumsum([0, *map(len, members[:-1])])
        self._magnitudes = np.zeros(2 * (n + 1))
        self._of_step, self._of_x = self._magnitudes[:n], self._magnitudes[n + 1 : -1]
        self._largest = np.empty(1 + len(members))

    def largest(self, angles: Array, step: Array, x: Array) -> tuple[float, list[float], list[float]]:
        """Largest turn, and largest entries of each field in the step and in the unknowns.

        Args:
            angles: Turns of this rank's nodes [rad], shape (n,).
            step: Change of this rank's own unknowns.
            x: These.

        Returns:
            Turn, and one number a field of the step and of the unknowns.
        """
        found = self._largest
        np.abs(step, out=self._of_step)
        np.abs(x, out=self._of_x)
        found[0] = angles.max(initial=0.0)
        np.maximum.reduceat(self._magnitudes[self._order], self._starts, out=found[1:])
        self._comm.Allreduce(MPI.IN_PLACE, found, op=MPI.MAX)
        turn, *fields = found.tolist()
        half = len(fields) // 2
        return turn, fields[:half], fields[half:]
