"""Resultants and strain energy at a state whose strains have no resultants of their own yet.

Between two steps of the midpoint rule positions and rotations are known, forces and moments only at the mean state.
Those of the strains are those of the mixed form, C N = γ on each element; a rigid strain leaves them as they are.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.continuum import reference

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.continuum.problem import Problem

    Array = NDArray[np.float64]

__all__ = ["Strain"]

# Compliances below this part of the largest are those of rigid strains.
RIGID = 1e-13


class Strain:
    """Resultants of the strains of a problem's state.

    Args:
        problem: Owner of the state.
    """

    def __init__(self, problem: Problem) -> None:
        d = problem.discretization
        self._problem, self._mine = problem, slice(0, d.n_owned_cells)
        self._φ = reference.discontinuous_basis(d.degree - 1, d.points)
        self._rotations = reference.lagrange_basis(d.degree, d.points)
        self._weights = np.diff(problem.ends[self._mine], axis=1) * reference.quadrature_weights(2 * d.degree)
        self._inverse_m = np.linalg.pinv(self._blocks(problem.values.C_m[self._mine]), RIGID, hermitian=True)

    def settle(self) -> float:
        """Give the state the resultants of its strains; the strain energy in EI/L."""
        p, d = self._problem, self._problem.discretization
        dofs = {f: d.dofs[f][self._mine].reshape(d.n_owned_cells, -1) for f in ("N", "m")}
        kept = {f: p.x[at].copy() for f, at in dofs.items()}
        for at in dofs.values():
            p.x[at] = 0.0
        strains = d.assembled_residual()
        C = self._turned(p.values.C_n[self._mine])
        energy = 0.0
        for field, inverse, blocks in (
            ("N", np.linalg.pinv(C, RIGID, hermitian=True), C),
            ("m", self._inverse_m, self._blocks(p.values.C_m[self._mine])),
        ):
            g, old = strains[dofs[field]], kept[field]
            # Its strains are those of the rigid part of the old resultants, zero, and of the new ones.
            found = np.einsum("cij,cj->ci", inverse, g)
            energy += 0.5 * float(np.einsum("ci,ci->", g, found))
            p.x[dofs[field]] = old + found - np.einsum("cij,cjk,ck->ci", inverse, blocks, old, optimize=True)
        d.x.x.scatter_forward()
        return float(d.comm.allreduce(energy))

    def _turned(self, C: Array) -> Array:
        """∫ φ φ R C Rᵀ of each element, R at its Gauss points."""
        p, d = self._problem, self._problem.discretization
        q = np.einsum("qa,cai->cqi", self._rotations, p.x[d.dofs["q"][self._mine]])
        flat = q.reshape(-1, q.shape[2])
        dim = p.kinematics.dim
        columns = [p.kinematics.rotate_back(flat, np.tile(e, (len(flat), 1))) for e in np.eye(dim)]
        R_T = np.stack(columns, axis=2).reshape(*q.shape[:2], dim, dim)
        return self._blocks(np.einsum("cqki,cqkl,cqlj->cqij", R_T, C, R_T, optimize=True))

    def _blocks(self, C: Array) -> Array:
        """∫ φ_a φ_b C of each element, shape (cells, k d, k d)."""
        blocks = np.einsum("cq,qa,qb,cqij->caibj", self._weights, self._φ, self._φ, C, optimize=True)
        n = blocks.shape[1] * blocks.shape[2]
        return np.asarray(blocks.reshape(len(C), n, n))
