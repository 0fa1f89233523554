"""Where the next step in time is likely to lead."""

from __future__ import annotations

from math import prod
from typing import TYPE_CHECKING

from mpi4py import MPI

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.continuum.moving import Moving

    Array = NDArray[np.float64]

__all__ = ["Predictor"]

# States that an extrapolation goes through at most.
MOST_STATES = 4


class Predictor:
    """Extrapolates the states before a step in time, through as many of them as would have served best last time.

    Smooth motion is met by a high order; where loads jump, or waves are not resolved by the steps, a low one is better.

    Args:
        problem: Owner of the state.
        t: Its time [s].
    """

    def __init__(self, problem: Moving, t: float) -> None:
        self._problem = problem
        d = problem.discretization
        self._r = problem.lumped.r
        self._nodal = np.concatenate([problem.lumped.r.ravel(), problem.lumped.q.ravel()])
        self._free = np.ones(len(problem.x), dtype=bool)
        self._free[problem.constraints.dofs] = False
        self._free[np.unique(d.dofs.get("multiplier", np.zeros(0, dtype=np.int32)))] = False
        self._quaternions = np.unique(d.dofs["q"].reshape(-1, d.dofs["q"].shape[2]), axis=0).astype(np.intp)
        self._t, self._x = [t], problem.x[None].copy()
        self._best, self._guesses = 0, self._x

    def guess(self, t: float) -> Array:
        """State at a time after the last one, but for what is held, which the problem has already [s]."""
        problem, x = self._problem, self._problem.x.copy()
        self._guesses = self._weights(t) @ self._x
        # From a single state the nodes go on with their velocities.
        self._guesses[0, self._r] += problem.h * problem.motion.v
        found = self._guesses[min(self._best, len(self._guesses) - 1)].copy()
        if self._quaternions.shape[1] == 4:
            p = found[self._quaternions]
            found[self._quaternions] = p / np.sqrt(np.einsum("ni,ni->n", p, p))[:, None]
        x[self._free] = found[self._free]
        return x

    def learn(self, t: float) -> None:
        """Take note of the state that the step has led to, at time t [s]."""
        problem, at = self._problem, self._nodal
        errors = np.abs(self._guesses[:, at] - problem.x[at]).max(axis=1, initial=0.0)
        problem.discretization.comm.Allreduce(MPI.IN_PLACE, errors, op=MPI.MAX)
        best = int(errors.argmin())
        self._best = best + int(best + 1 == len(self._x) < MOST_STATES)
        recent = slice(1 - MOST_STATES, None)
        self._t = [*self._t[recent], t]
        self._x = np.concatenate([self._x[recent], problem.x[None]])

    def _weights(self, t: float) -> Array:
        """Lagrange's weights of the last n states at time t, a row for each n, shape (n_states, n_states)."""
        times, n = self._t, len(self._t)
        weights = np.zeros((n, n))
        for first in range(n):
            for i in range(first, n):
                others = (times[j] for j in range(first, n) if j != i)
                weights[n - 1 - first, i] = prod((t - other) / (times[i] - other) for other in others)
        return weights
