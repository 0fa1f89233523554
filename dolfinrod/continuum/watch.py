"""What Newton's method does on its way that tells it will not settle, or has settled on another branch."""

from __future__ import annotations

from typing import TYPE_CHECKING

from mpi4py import MPI

import numpy as np

from dolfinrod.continuum.rounds import Rounds

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.continuum.problem import Problem

    Array = NDArray[np.float64]

__all__ = ["Unwatched", "Watch", "largest_turn_between_nodes"]

# Sections that turned this far in all beyond where they got [rad] are lost: what leads somewhere turns one way.
LARGEST_DETOUR = 8.0
# The first increment is the rate of the path: a rod that turned the other way in the end, by more than this [rad], has
# gone to another branch.
STRAYED = 1e-2


class Watch:
    """Turns of the sections during one attempt at equilibrium.

    Args:
        problem: Owner of the state; where it is now is where the attempt begins.
        last: The last equilibrium on this rank if the attempt begins at a state extrapolated from it, else None.

    Attributes:
        lost: Whether some section has turned much farther than it got.
    """

    def __init__(self, problem: Problem, last: Array | None) -> None:
        self._comm, self._kin = problem.discretization.comm, problem.kinematics
        q = problem.discretization.owned_nodes("q")
        start = problem.x[q] if last is None else last[q]
        self._net = np.einsum("nij,nj->ni", problem.kinematics.spin(start), problem.x[q] - start)
        (self._travelled,) = self._largest(np.linalg.norm(self._net, axis=1))
        self.lost = False
        self._set_out = None if last is None else self._net.copy()
        self._rounds = Rounds(self._comm, problem.contacts)

    def see(self, q: Array, increment: Array, *, limited: bool) -> None:
        """Take note of an iteration.

        Args:
            q: Rotations of this rank's nodes before it, shape (n, n_q).
            increment: How it changes them, shape (n, n_q).
            limited: Whether the spins were cut down to the largest turn of an iteration.
        """
        spin = np.einsum("nij,nj->ni", self._kin.spin(q), increment)
        self._net += spin
        if self._set_out is None:
            self._set_out = spin
        if limited:
            turn, net = self._largest(np.linalg.norm(spin, axis=1), np.linalg.norm(self._net, axis=1))
            self._travelled += turn
            self.lost = bool(self._travelled - net > LARGEST_DETOUR)

    def returned(self, size: float) -> bool:
        """Whether an increment of this size leads round in a circle."""
        return self._rounds.returned(size)

    @property
    def creeping(self) -> bool:
        """Whether increments have hardly become shorter lately."""
        return self._rounds.creeping

    def strayed(self) -> bool:
        """Whether the sections have turned, in all, against the way they set out, as to a mirrored branch."""
        if self._set_out is None:
            return False
        (turned,) = self._largest(np.linalg.norm(self._net, axis=1))
        along = self._comm.allreduce(float(np.vdot(self._set_out, self._net)))
        return bool(turned > STRAYED and along < 0.0)

    def _largest(self, *values: Array) -> Array:
        """Largest magnitude in each array, over all ranks; a rank may have none."""
        largest = np.array([np.abs(v).max(initial=0.0) for v in values])
        self._comm.Allreduce(MPI.IN_PLACE, largest, op=MPI.MAX)
        return largest


class Unwatched:
    """No watch: a step in time is too short to wander."""

    lost = creeping = False

    def returned(self, size: float) -> bool:
        """It does not."""
        return False

    def see(self, q: Array, increment: Array, *, limited: bool) -> None:
        """Take no note."""

    def strayed(self) -> bool:
        """It has not."""
        return False


def largest_turn_between_nodes(problem: Problem) -> float:
    """Largest turn of a node against its neighbour in the same element [rad], over all ranks."""
    d = problem.discretization
    q = problem.x[d.dofs["q"]][:, np.argsort(d.nodes)]
    pairs = (q[:, 1:].reshape(-1, q.shape[2]), q[:, :-1].reshape(-1, q.shape[2]))
    largest = float(problem.kinematics.turn_between(*pairs).max(initial=0.0))
    return float(d.comm.allreduce(largest, op=MPI.MAX))
