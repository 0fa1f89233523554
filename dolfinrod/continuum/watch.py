"""What Newton's method does on its way that tells it will not settle, or has settled on another branch."""

from __future__ import annotations

from typing import TYPE_CHECKING

from mpi4py import MPI

import numpy as np

from dolfinrod.continuum.rounds import SHRUNK, Rounds

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.continuum.problem import Problem

    Array = NDArray[np.float64]

__all__ = ["Parting", "Unwatched", "Watch", "largest_turn_between_nodes"]

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
        self._net, self._set_out, self._travelled = np.zeros((len(q), self._kin.n_spin)), None, 0.0
        if last is not None:
            self._set_out = self._net = self._spins(last[q], problem.x[q] - last[q])
            (self._travelled,) = self._largest(self._net)
        self.lost = False
        self._seen: list[tuple[Array, Array]] = []
        self._rounds = Rounds(self._comm, problem.contacts)

    def see(self, q: Array, increment: Array, *, limited: bool) -> None:
        """Take note of an iteration.

        Args:
            q: Rotations of this rank's nodes before it, shape (n, n_q).
            increment: How it changes them, shape (n, n_q).
            limited: Whether the spins were cut down to the largest turn of an iteration.
        """
        self._seen.append((q, increment))
        if limited:
            self._add_up()
            turn, net = self._largest(self._spins(q, increment), self._net)
            self._travelled += turn
            self.lost = bool(self._travelled - net > LARGEST_DETOUR)

    def returned(self, size: float) -> bool:
        """Whether an increment of this size leads round in a circle."""
        return self._rounds.returned(size)

    @property
    def creeping(self) -> bool:
        """Whether increments have hardly become shorter lately."""
        return self._rounds.creeping

    def set_out(self) -> Array | None:
        """Spins with which they set out, shape (n, n_spin); None before the first iteration."""
        self._add_up()
        return self._set_out

    def strayed(self) -> bool:
        """Whether the sections have turned, in all, against the way they set out, as to a mirrored branch."""
        self._add_up()
        if self._set_out is None:
            return False
        (turned,), along = self._largest(self._net), np.array([np.vdot(self._set_out, self._net)])
        self._comm.Allreduce(MPI.IN_PLACE, along, op=MPI.SUM)
        return bool(turned > STRAYED and along < 0.0)

    def _add_up(self) -> None:
        """Add the spins of the iterations seen since the last time, all at once: single ones cost more than they say.

        Iterations that nobody asks about, the most of them, cost next to nothing so.
        """
        if not self._seen:
            return
        q, increments = (np.concatenate(parts) for parts in zip(*self._seen, strict=True))
        spins = self._spins(q, increments).reshape(len(self._seen), *self._net.shape)
        self._net = self._net + spins.sum(axis=0)
        if self._set_out is None:
            self._set_out = spins[0]
        self._seen.clear()

    def _spins(self, q: Array, increments: Array) -> Array:
        """Spins that such changes of rotations stand for, shape (n, n_spin)."""
        return np.matmul(self._kin.spin(q), increments[:, :, None])[:, :, 0]

    def _largest(self, *spins: Array) -> Array:
        """Largest spin in each array, over all ranks; a rank may have none."""
        largest = np.sqrt([np.einsum("ni,ni->n", θ, θ).max(initial=0.0) for θ in spins])
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

    def set_out(self) -> None:
        """Nobody knows."""
        return

    def strayed(self) -> bool:
        """It has not."""
        return False


class Parting(Unwatched):
    """Watch over rods that meet in a step in time: a shorter one leads there sooner than halves of increments do.

    Args:
        problem: Of these rods.

    Attributes:
        creeping: Whether they have parted and met again as before, or have parted on the far side of each other.
    """

    def __init__(self, problem: Problem) -> None:
        self._pairs, self._rounds = problem.pairs, Rounds(problem.discretization.comm, problem.contacts)
        self.creeping, self._last = False, np.inf

    def returned(self, size: float) -> bool:
        """No increment is to be halved."""
        pairs, stays = self._pairs, size > SHRUNK * self._last
        beyond = stays and pairs is not None and not pairs.met and pairs.near and bool(pairs.pierced)
        self.creeping, self._last = self._rounds.returned(size) or beyond or self.creeping, size
        return False


def largest_turn_between_nodes(problem: Problem) -> float:
    """Largest turn of a node against its neighbour in the same element [rad], over all ranks."""
    d = problem.discretization
    q = problem.x[d.dofs["q"]][:, np.argsort(d.nodes)]
    pairs = (q[:, 1:].reshape(-1, q.shape[2]), q[:, :-1].reshape(-1, q.shape[2]))
    largest = float(problem.kinematics.turn_between(*pairs).max(initial=0.0))
    return float(d.comm.allreduce(largest, op=MPI.MAX))
