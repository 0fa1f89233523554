"""Newton's method inside PETSc's SNES, with section rotations limited in each iteration.

Rotations are what makes rods nonlinear: with them known, r and N follow from linear equations. So every iteration
turns the sections by at most `LARGEST_TURN`, while r and N take their full increment; m, which follows the turn of
the sections by elasticity, is held back with them (a full m on a half-turned rod feeds motion out of the plane).
No residual line search: on the way to equilibrium the residual has to grow.
"""

from __future__ import annotations

from functools import partial
from math import isfinite, isnan, sqrt
from typing import TYPE_CHECKING

from petsc4py import PETSc

import numpy as np

from dolfinrod.continuum.coupled import linear_solver
from dolfinrod.continuum.direct import LIBRARY_ERROR
from dolfinrod.continuum.leap import part_taken
from dolfinrod.continuum.outcome import LOST, MOST_ITERATIONS, SINGULAR, Outcome, words
from dolfinrod.continuum.pivots import Pivoting
from dolfinrod.continuum.pressed import DIRECT, ROUGH, Attempts
from dolfinrod.continuum.sizes import Sizes
from dolfinrod.continuum.watch import Unwatched, Watch
from dolfinrod.scene import Dynamic

if TYPE_CHECKING:
    from mpi4py import MPI

    from numpy.typing import NDArray

    from dolfinrod.continuum.problem import Problem

    Array = NDArray[np.float64]

__all__ = ["Newton", "Outcome"]

# Largest turn of a section in one iteration [rad]: beyond it the linearised rotation says nothing any more.
LARGEST_TURN = 2.0
# Increments relative to the unknowns (and to 1 rad, L, EI/L², EI/L) at which an iteration has converged.
TOLERANCE = 1e-9
# Where Newton converges quadratically, an increment this small is known to come next without computing it.
NEGLIGIBLE = 1e-13
# An increment above this part of the one before is no Newton step: where nothing moves, it is round-off of the forces.
STALLED = 0.1
# Round-off of positions over the root of how many nodes there are: twice the most seen on walls of 10⁹ to 10¹¹ N/m².
ROUNDED = 512.0 * float(np.finfo(float).eps)
# Increments of an iteration that is worth going on with however few it was given.
CLOSE = 1e-3
# Turn in an iteration [rad] beyond which what it presses is found out before anything moves, and in how many trials.
WIDE, FORESIGHTS = 0.1, 2


class Newton:
    """SNES for one problem: its loop, linear solver, monitors and reasons, our step.

    Args:
        problem: Residual, tangent and state.
    """

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        d = problem.discretization
        self.factorizations = 0
        self._r, self._q, self._foresights = d.owned_nodes("r"), d.owned_nodes("q"), 0
        self._sizes, self._m = Sizes(d, ("r", "N", "m")), d.owned_nodes("m").ravel()
        self._pivoting = Pivoting(problem, self._r)
        self._attempts = Attempts(problem.pairs if isinstance(problem.scene.motion, Dynamic) else None)
        self._multipliers = np.unique(d.dofs.get("multiplier", np.zeros(0, dtype=np.int32)))
        self._size = self._next = self._moved = np.inf
        self._stalls = False
        # Positions are rounded off node after node along a rod, to either side: as the root of their number.
        self._round_off = max(NEGLIGIBLE, ROUNDED * sqrt(d.comm.allreduce(len(self._r))))
        self._open()

    def _open(self) -> None:
        d = self.problem.discretization
        self._alone = d.comm.size == 1
        self._A, self._X, self._F = (d.matrix, d.x.vector.duplicate(), d.x.vector.duplicate())
        self.snes: PETSc.SNES = self._make_snes(d.comm)

    def _make_snes(self, comm: MPI.Comm) -> PETSc.SNES:
        snes = PETSc.SNES().create(comm)
        snes.setOptionsPrefix("rod_")
        snes.setType(PETSc.SNES.Type.NEWTONLS)
        snes.setFunction(self._residual, self._F)
        snes.setJacobian(self._tangent, self._A)
        snes.setLineSearchPreCheck(self._limit)
        snes.setConvergenceTest(self._test)
        ksp = snes.getKSP()
        ksp.setType(PETSc.KSP.Type.PREONLY)
        self._lu = linear_solver(ksp.getPC(), self._A, self.problem)
        database, option = PETSc.Options(), "rod_snes_linesearch_type"
        database[option] = "basic"
        snes.setFromOptions()
        database.delValue(option)
        return snes

    def solve(self, last: NDArray[np.float64] | None = None) -> Outcome:
        """Equilibrium at the problem's pseudo-time, from the problem's state; on failure the state is lost.

        Args:
            last: The equilibrium on this rank that the state was extrapolated from; None: it is one itself.
        """
        contacts, find = self.problem.contacts, partial(self._found, last)
        if contacts is None:
            return find(MOST_ITERATIONS, TOLERANCE)
        return self._attempts.made(self.problem.x, contacts, find, MOST_ITERATIONS, TOLERANCE)

    def _found(self, last: NDArray[np.float64] | None, most: int, fine: float) -> Outcome:
        """A zero of the residual, in so many iterations at most, the last of this size."""
        self._most, self._fine, self._foresights = most, fine, FORESIGHTS if most <= DIRECT else 0
        self._X.array[:] = self.problem.x[: self.problem.discretization.n_owned]
        self._size, self._next, self._stalls = np.inf, np.inf, False
        self._watch = self._watched(last)
        self._pivoting.begin()
        reason = self._run()
        iterations = self.snes.getIterationNumber()
        if reason == SINGULAR:
            self.reopen()
            return Outcome(False, iterations, np.nan, words(SINGULAR, iterations))
        # The last residual was that of the solution, and left the problem there with multipliers in balance.
        residual = float(self.snes.getFunctionNorm())
        return Outcome(reason > 0, iterations, residual, words(reason, iterations), self._watch.strayed())

    @property
    def set_out(self) -> NDArray[np.float64] | None:
        """Spins with which the sections of this rank set out in the last attempt, shape (n, n_spin)."""
        return self._watch.set_out()

    def _watched(self, last: NDArray[np.float64] | None) -> Watch | Unwatched:
        return Watch(self.problem, last)

    def _run(self) -> int:
        """The SNES reason for which it stopped."""
        try:
            self.snes.solve(None, self._X)
        except PETSc.Error as error:
            # MUMPS refuses to solve with what it could not factorise, on all ranks at once.
            if error.ierr != LIBRARY_ERROR:
                raise
            return SINGULAR
        if self._lu is not None and self._lu.singular:
            return SINGULAR
        return int(self.snes.getConvergedReason())

    def reopen(self) -> None:
        """Begin anew with solvers that have met no singular tangent."""
        self.close()
        self._open()

    def close(self) -> None:
        """Free what PETSc holds, on all ranks together: the garbage collector would do it on each at its own time."""
        self.snes.destroy()
        self._F.destroy()
        self._X.destroy()

    def _take(self, X: PETSc.Vec) -> None:
        """Make X the problem's state, but for the multipliers: these follow from it, and X may have lost them."""
        state, multipliers = self.problem.x, self._multipliers
        balanced = state[multipliers]
        if self._alone:
            state[:] = X.array_r
        else:
            X.ghostUpdate(PETSc.InsertMode.INSERT, PETSc.ScatterMode.FORWARD)
            with X.localForm() as x:
                state[:] = x.array_r
        state[multipliers] = balanced

    def _residual(self, snes: PETSc.SNES, X: PETSc.Vec, F: PETSc.Vec) -> None:
        self._take(X)
        if self._alone:
            b = F.array
            b[:] = 0.0
            self.problem.add_residual(b)
        else:
            with F.localForm() as f:
                f.array[:] = 0.0
                self.problem.add_residual(f.array)
            F.ghostUpdate(PETSc.InsertMode.ADD, PETSc.ScatterMode.REVERSE)
            b = F.array
        self.problem.balance_multipliers(b)
        self.problem.clear_held(b)

    def _tangent(self, snes: PETSc.SNES, X: PETSc.Vec, A: PETSc.Mat, P: PETSc.Mat) -> None:
        self.problem.assemble_tangent(P)
        self.factorizations += 1

    def _limit(self, X: PETSc.Vec, Y: PETSc.Vec) -> bool:
        """Replace the Newton step Y (x − Y is next) by one that stays on the manifold and turns at most so far."""
        kin, x, y = self.problem.kinematics, X.array_r, Y.array
        self._pivoting.complete(self.snes.getKSP(), X, Y)
        if self.problem.pairs is not None:
            y *= part_taken(self.problem, y[self._r])
        q = x[self._q]
        increment = kin.increment(q, -y[self._q])
        turn, changes, fields = self._sizes.largest(kin.angles(increment), y, x)
        if turn > WIDE and self._foresees(x, y):
            y[:] = 0.0
            return True
        before, self._size = self._size, max(turn, *(by / max(of, 1.0) for by, of in zip(changes, fields, strict=True)))
        if turn > LARGEST_TURN:
            increment *= LARGEST_TURN / turn
            y[self._m] *= LARGEST_TURN / turn
        if self._watch.returned(self._size):
            increment, y[:] = 0.5 * increment, 0.5 * y
        self._watch.see(q, increment, limited=turn > LARGEST_TURN)
        y[self._q] = q - kin.turn(q, increment)
        self._moved, self._next = max(turn, changes[0]), self._expected(before, self._size)
        return True

    def _foresees(self, x: Array, y: Array) -> bool:
        """Whether so long a step presses other points than it was taken with: it is taken anew with these first."""
        contacts = self.problem.contacts
        if contacts is None or not self._foresights or not contacts.foresee(x[self._r] - y[self._r]):
            return False
        self._foresights -= 1
        return True

    def _expected(self, before: float, size: float) -> float:
        """Next increment after these two: quadratic, with their ratio, never taken below 1."""
        self._stalls = isfinite(before) and size > STALLED * before
        return size**2 * max(1.0, size / before**2) if isfinite(before) else np.inf

    def _settled(self) -> bool:
        """Whether no further increment matters."""
        if self._stalls and self._moved < self._round_off:
            return True
        if self._fine > TOLERANCE:
            return self._size < self._fine and not (self._fine < ROUGH and self._touches_anew)
        return (self._size < TOLERANCE or self._next < NEGLIGIBLE) and not self._touches_anew

    @property
    def _touches_anew(self) -> bool:
        """Whether the last increment has changed what touches, sticks or slides: the tangent was of something else."""
        return self.problem.contacts is not None and self._size > NEGLIGIBLE and self.problem.contacts.changed

    def _test(self, snes: PETSc.SNES, iteration: int, norms: tuple[float, float, float]) -> int:
        reasons = PETSc.SNES.ConvergedReason
        if not isfinite(norms[2]) or isnan(self._size):
            return reasons.DIVERGED_FNORM_NAN
        if self._watch.lost:
            return LOST
        if iteration > 0 and self._settled():
            return reasons.CONVERGED_SNORM_RELATIVE
        lost = self._most <= DIRECT and (self._watch.creeping or self._pivoting.gives_way)
        most = DIRECT if self._most < DIRECT and self._size < CLOSE else self._most
        return reasons.DIVERGED_MAX_IT if lost or iteration >= most else reasons.ITERATING
