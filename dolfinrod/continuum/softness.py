"""How the sections of an equilibrium turn under moments: S⁻¹, with S the stiffness that the tangent stands for."""

from __future__ import annotations

from typing import TYPE_CHECKING

from petsc4py import PETSc

import numpy as np

from dolfinrod.continuum.direct import LIBRARY_ERROR

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.continuum.newton import Newton

    Array = NDArray[np.float64]

__all__ = ["Softness"]


class Softness:
    """The tangent at the present state of a problem, factorised once; symmetric where loads have a potential.

    Args:
        newton: Solver of the problem.
    """

    def __init__(self, newton: Newton) -> None:
        self._newton, self._problem = newton, newton.problem
        d = self._problem.discretization
        self._q, A = d.owned_nodes("q"), d.matrix
        self._at = self._problem.x[self._q]
        self._spin = self._problem.kinematics.spin(self._at)
        self._problem.assemble_tangent(A)
        newton.factorizations += 1
        self._x, self._b = A.createVecs()
        self._ksp = newton.snes.getKSP()
        self._ksp.setOperators(A)

    def change(self, moments: Array) -> Array | None:
        """Change of this rank's own unknowns under moments on its sections.

        Args:
            moments: On the spins of its nodes, shape (n, n_spin).

        Returns:
            The change; None where the tangent is singular.
        """
        b = self._b
        b.set(0.0)
        b.array[self._q] = np.einsum("nij,ni->nj", self._spin, moments)
        self._problem.clear_held(b.array)
        try:
            self._ksp.solve(b, self._x)
        except PETSc.Error as error:
            if error.ierr != LIBRARY_ERROR:
                raise
            self._newton.reopen()
            return None
        return self._x.array_r.copy() if np.isfinite(self._x.norm()) else None

    def spins(self, change: Array) -> Array:
        """Spins of such a change, shape (n, n_spin)."""
        increment = self._problem.kinematics.increment(self._at, change[self._q])
        return np.einsum("nij,nj->ni", self._spin, increment)

    def close(self) -> None:
        """Free what PETSc holds, on all ranks together."""
        self._x.destroy()
        self._b.destroy()
