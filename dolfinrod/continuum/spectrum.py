"""Eigenpairs of B⁻¹ A by SLEPc, with their multiplicities.

A Krylov space grown from one vector meets one vector of each eigenspace. So several are grown, each from another
vector, until those found together span no more; the operator restricted to their span then has the eigenvalues, each
as often as it is due.

Every rank computes all of them on its own: the matrices of rods are small, and exchanging a few numbers in each of
hundreds of products takes longer than the products.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from petsc4py import PETSc
from slepc4py import SLEPc

import numpy as np
from scipy.linalg import qr

from dolfinrod.continuum.direct import everywhere

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    Values = NDArray[np.complex128]

__all__ = ["Eigenpairs", "Spectrum", "direct_solver"]

# Accuracy asked of an eigenvalue, over the largest.
TOLERANCE = 1e-12
# Below this part of the largest an eigenvalue is zero: round-off of a double zero, √ε, and something to spare.
ZERO = 1e-7
# Unit vectors closer than this to the span of others add nothing but round-off to it.
INDEPENDENT = 1e-5
# An imaginary part this small is round-off of a double real eigenvalue, relative to its magnitude.
REAL = 1e-7
# So is one this small over the largest eigenvalue.
ROUND_OFF = 1e-10
# Eigenvalues this close are one, relative to their magnitude.
TOGETHER = 1e-7
# Error of an eigenpair in its own equation, relative to the eigenvalue.
RESIDUAL = 1e-7
# Vectors of a Krylov space beyond two for each eigenvalue asked for.
ROOM = 30
# Restarts of a Krylov space, and of one that finds no more: then only zeros, which are many, are left.
MOST_RESTARTS, FRUITLESS = 100, 6
# Start vectors beyond the number of eigenvalues asked for.
MOST_MULTIPLE = 2


def direct_solver(B: PETSc.Mat) -> PETSc.KSP:
    """B⁻¹ by MUMPS, factorised at the first use."""
    solver = PETSc.KSP().create(B.getComm())
    solver.setOperators(B)
    solver.setType(PETSc.KSP.Type.PREONLY)
    pc = solver.getPC()
    pc.setType(PETSc.PC.Type.LU)
    pc.setFactorSolverType(PETSc.Mat.SolverType.MUMPS)
    pc.setFactorSetUpSolverType()
    # Room for the zero pivots of multipliers, which it puts off.
    pc.getFactorMatrix().setMumpsIcntl(14, 200)
    return solver


@dataclass(frozen=True)
class Eigenpairs:
    """Eigenvalues in order and their vectors, all components on every rank.

    Args:
        values: Shape (n,); real ones have an imaginary part of zero.
        vectors: Shape (N, n).
        multiplicity: Independent vectors of each eigenvalue, shape (n,).
    """

    values: Values
    vectors: Values
    multiplicity: NDArray[np.int64]

    def where(self, which: NDArray[np.bool_] | NDArray[np.int64] | slice) -> Eigenpairs:
        """Some of them; a multiplicity counts those left out."""
        return Eigenpairs(self.values[which], self.vectors[:, which], self.multiplicity[which])


class Spectrum:
    """The operator B⁻¹ A.

    Args:
        A: Any matrix.
        B: One that is not singular.

    Attributes:
        largest: Largest magnitude of an eigenvalue.
    """

    def __init__(self, A: PETSc.Mat, B: PETSc.Mat) -> None:
        self._comm = A.getComm().tompi4py()
        self._matrices = everywhere(A), everywhere(B)
        self._solver = direct_solver(self._matrices[1])
        self._eps = SLEPc.EPS().create(PETSc.COMM_SELF)
        self._eps.setOptionsPrefix("rod_")
        self._eps.setOperators(*self._matrices)
        self._eps.setProblemType(SLEPc.EPS.ProblemType.GNHEP)
        self._eps.getST().setKSP(self._solver)
        self._x, self._y = self._matrices[0].createVecs()
        self._eps.setTolerances(1e-6, MOST_RESTARTS)
        rough = self._krylov(1, SLEPc.EPS.Which.LARGEST_MAGNITUDE, seed=0)
        self.largest = float(np.abs(np.linalg.eigvals(self._restricted(rough)[1])).max(initial=0.0))
        self._eps.setConvergenceTest(SLEPc.EPS.Conv.ABS)
        self._progress = 0, 0
        self._eps.setStoppingTest(self._stop)
        self._eps.setTolerances(max(TOLERANCE * self.largest, np.finfo(float).tiny), MOST_RESTARTS)

    def close(self) -> None:
        """Free what PETSc holds."""
        for owned in (self._eps, self._solver, *self._matrices, self._x, self._y):
            owned.destroy()

    def largest_first(self, n: int) -> Eigenpairs:
        """The n eigenvalues of largest magnitude, or more."""
        return self._several(n, SLEPc.EPS.Which.LARGEST_MAGNITUDE, lambda θ: -np.abs(θ))

    def most_negative_first(self, n: int) -> Eigenpairs:
        """The n eigenvalues of least real part, or more, as far as that is negative."""
        return self._several(n, SLEPc.EPS.Which.SMALLEST_REAL, lambda θ: np.where(θ.real < 0.0, θ.real, np.inf))

    def most_positive_first(self, n: int) -> Eigenpairs:
        """The n eigenvalues of greatest real part, or more, as far as that is positive."""
        return self._several(n, SLEPc.EPS.Which.LARGEST_REAL, lambda θ: np.where(θ.real > 0.0, -θ.real, np.inf))

    def _several(self, n: int, which: int, rank: Callable[[Values], NDArray[np.float64]]) -> Eigenpairs:
        """Krylov spaces from one start vector after the other, until the first n eigenvalues stay as they are."""
        span = np.zeros((self._x.getSize(), 0))
        before = np.zeros(0, dtype=complex)
        for seed in range(n + MOST_MULTIPLE):
            span, H, error = self._restricted(np.hstack([span, self._krylov(n, which, seed)]))
            θ, Y = (part.astype(complex) for part in np.linalg.eig(H))
            good = np.linalg.norm(error @ Y, axis=0) <= RESIDUAL * np.abs(θ)
            good &= (np.abs(θ) > ZERO * self.largest) & np.isfinite(rank(θ))
            order = np.flatnonzero(good)[np.argsort(rank(θ[good]), kind="stable")]
            found = np.sort_complex(θ[order[:n]])
            if len(found) == len(before) and np.allclose(found, before, rtol=TOGETHER, atol=0.0):
                break
            before = found
        # The Krylov spaces hold more, less accurate the further; what equals the last one wanted belongs to it.
        last = rank(θ[order[n - 1 : n]])
        order = order[rank(θ[order]) <= (last + TOGETHER * np.abs(last) if len(last) else np.inf)]
        # One answer for all ranks, to the last bit: what is done next depends on it.
        return self._comm.bcast(_grouped(θ[order], span @ Y[:, order], ROUND_OFF * self.largest))

    def _krylov(self, n: int, which: int, seed: int) -> NDArray[np.float64]:
        """Unit vectors, as columns, that span the eigenvectors one start vector leads to, shape (N, any)."""
        eps = self._eps
        self._x.array[:] = np.random.default_rng(seed).standard_normal(self._x.getSize())
        # Components of infinite stiffness or no mass are gone once the operator was applied, twice where coupled.
        for _ in range(2):
            self._apply()
            self._x.array[:] = self._y.array_r / max(self._y.norm(), np.finfo(float).tiny)
        eps.setInitialSpace(self._x)
        eps.setDimensions(n, min(2 * n + ROOM, self._x.getSize()))
        eps.setWhichEigenpairs(which)
        eps.solve()
        columns = []
        for i in range(eps.getConverged()):
            eps.getEigenpair(i, self._x, self._y)
            columns += [v.array_r.copy() for v in (self._x, self._y) if v.norm() > INDEPENDENT]
        return np.array([c / np.linalg.norm(c) for c in columns]).reshape(-1, self._x.getSize()).T

    def _stop(self, eps: SLEPc.EPS, restarts: int, most: int, converged: int, wanted: int) -> int:
        """SLEPc's reason to stop, or none."""
        reasons = SLEPc.EPS.ConvergedReason
        if converged > self._progress[0] or restarts <= 1:
            self._progress = converged, restarts
        if converged >= wanted:
            return reasons.CONVERGED_TOL
        over = restarts >= most or restarts - self._progress[1] >= FRUITLESS
        return reasons.DIVERGED_ITS if over else reasons.CONVERGED_ITERATING

    def _restricted(self, vectors: NDArray[np.float64]) -> tuple[NDArray[np.float64], ...]:
        """Orthonormal basis Q of unit vectors, the operator QᵀTQ within it, and what leads out of it, TQ − QQᵀTQ."""
        Q, R, _ = qr(vectors, mode="economic", pivoting=True)
        Q = Q[:, np.abs(np.diag(R)) > INDEPENDENT]
        TQ = np.zeros_like(Q)
        for i in range(Q.shape[1]):
            self._x.array[:] = Q[:, i]
            self._apply()
            TQ[:, i] = self._y.array_r
        H = Q.T @ TQ
        return Q, H, TQ - Q @ H

    def _apply(self) -> None:
        """y = B⁻¹ A x."""
        self._eps.getST().apply(self._x, self._y)


def _grouped(θ: Values, vectors: Values, round_off: float) -> Eigenpairs:
    """Eigenpairs in the order given; equal real values next to each other, with orthonormal real vectors."""
    left = list(range(len(θ)))
    values, columns, multiplicity = [], [], []
    while left:
        first = θ[left[0]]
        real = abs(first.imag) <= max(REAL * abs(first), round_off)
        same = [i for i in left if abs(θ[i] - first) <= TOGETHER * abs(first)] if real else left[:1]
        left = [i for i in left if i not in same]
        v = vectors[:, same]
        if real:
            Q, R, _ = qr(np.hstack([v.real, v.imag]), mode="economic", pivoting=True)
            v = Q[:, : min(len(same), int((np.abs(np.diag(R)) > INDEPENDENT).sum()))]
        n = v.shape[1]
        values += [θ[same].real.mean() + 0.0j if real else first] * n
        columns.append(v.astype(complex))
        multiplicity += [n] * n
    stacked = np.hstack([np.zeros((len(vectors), 0), dtype=complex), *columns])
    return Eigenpairs(np.array(values, dtype=complex), stacked, np.array(multiplicity, dtype=np.int64))
