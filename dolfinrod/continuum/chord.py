"""Newton's method for steps in time: each is close to the one before, so its tangent may serve again."""

from __future__ import annotations

from math import isfinite
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.continuum.coupled import CoupledLU
from dolfinrod.continuum.newton import NEGLIGIBLE, STALLED, TOLERANCE, Newton, Outcome
from dolfinrod.continuum.watch import Parting, Unwatched

if TYPE_CHECKING:
    from petsc4py import PETSc

    from numpy.typing import NDArray

    from dolfinrod.continuum.moving import Moving

__all__ = ["Chord"]

# Ratio of an increment to the one before, with a kept tangent, beyond which a new one costs less than more iterations.
SLOW = 0.03
# A new tangent costs as much as so many iterations with an old one: of few unknowns, where each call has its price, of
# very many, and how many lie halfway between. To the end it takes so many itself.
DEAR, DEAREST, HALFWAY = 2.0, 7.0, 1500
QUADRATIC = 2
# First increment that an old tangent may find, in L, rad and forces over themselves.
LARGEST = 1.0
# Steps that differ by less than this part have the same tangent, but for terms of that size.
SAME = 1e-3


class Chord(Newton):
    """Newton's method that keeps its factors, over iterations and steps, as long as they converge quickly.

    The increments then fall by a ratio instead of quadratically, and an iteration costs a residual and a solve with
    the factors. What is solved, and how accurately, does not depend on how old the tangent is.

    Args:
        problem: Residual, tangent and state.
    """

    problem: Moving

    def __init__(self, problem: Moving) -> None:
        super().__init__(problem)
        self._h = np.nan
        self._when_new = self._excess = 0
        n = problem.discretization.n_dofs
        self._dear = DEAR + (DEAREST - DEAR) * n / (n + HALFWAY)
        self._serves = self._is_fresh = self._contracted = self._lags = self._inherited = False

    def solve(self, last: NDArray[np.float64] | None = None) -> Outcome:
        """State after the step that the problem has begun."""
        h = self.problem.h
        if not abs(h - self._h) <= SAME * h:
            self._serves = False
        self._contracted = False
        factorizations = self.factorizations
        outcome = super().solve(last)
        self._age(outcome, is_new=self.factorizations > factorizations)
        return outcome

    def _age(self, outcome: Outcome, *, is_new: bool) -> None:
        """Give the tangent up once the iterations that it took beyond those when new cost as much as a new one."""
        if is_new:
            self._when_new, self._excess = outcome.iterations, 0
        self._excess += max(outcome.iterations - self._when_new, 0)
        self._serves = self._serves and outcome.converged and self._excess < self._dear

    def _watched(self, last: NDArray[np.float64] | None) -> Unwatched:
        return Unwatched() if self.problem.pairs is None else Parting(self.problem)

    def _tangent(self, snes: PETSc.SNES, X: PETSc.Vec, A: PETSc.Mat, P: PETSc.Mat) -> None:
        walls = self.problem.walls
        # Of points that have just come to touch, stick or slide an old tangent knows nothing.
        if walls is not None and np.isfinite(self._size) and walls.changed:
            self._serves = False
        self._is_fresh = not self._serves
        if self._is_fresh:
            super()._tangent(snes, X, A, P)
            self._h = self.problem.h
            self._serves = True

    def _limit(self, X: PETSc.Vec, Y: PETSc.Vec) -> bool:
        """As in Newton's method; where an old tangent leads away, the step is not taken and a new one is made."""
        before = self._size
        super()._limit(X, Y)
        if not self._is_fresh and self._size > min(before, LARGEST):
            Y.array[:] = 0.0
            self._size, self._next, self._serves = before, np.inf, False
        return True

    def _expected(self, before: float, size: float) -> float:
        """Next increment after these two, in the ratio of them, which may be small by chance; or a smaller one."""
        if not isfinite(before) or not before > 0.0:
            # The tangent of the step before does for one increment, even if it did not pay to go on with it last time.
            self._inherited = not self._is_fresh
            self._serves = self._is_fresh or not self._lags
            return np.inf
        ratio = size / before
        pays = self._pays(size, ratio)
        if self._inherited:
            self._lags, self._inherited = not pays, False
        self._contracted = self._contracted or ratio <= SLOW
        self._stalls = ratio > STALLED and (self._is_fresh or self._contracted)
        self._serves = self._is_fresh or pays or size < TOLERANCE or self._ends or self._meets_anew
        return size * max(ratio, size)

    def _pays(self, size: float, ratio: float) -> bool:
        """Whether a kept tangent, whose increments fall by a ratio, gets to the end at less cost than a new one."""
        if ratio > SLOW or size <= NEGLIGIBLE:
            return ratio <= SLOW
        return size * ratio ** (self._dear + QUADRATIC) <= NEGLIGIBLE

    @property
    def _meets_anew(self) -> bool:
        """Whether rods touch one another elsewhere than before: of that a tangent is never old, it stands beside it."""
        walls, pairs = self.problem.walls, self.problem.pairs
        if pairs is None or not isinstance(self._lu, CoupledLU) or not self._lu.follows:
            return False
        return pairs.changed and not (walls is not None and walls.changed)

    @property
    def _ends(self) -> bool:
        """Whether round-off is left: in stiff rods that of the positions is more than `TOLERANCE` of the forces."""
        return self._stalls and (self._size < TOLERANCE or self._moved < self._round_off)

    def _settled(self) -> bool:
        small = self._next < NEGLIGIBLE or (self._is_fresh and self._size < TOLERANCE)
        return self._ends or (small and not self._touches_anew)
