"""Resultants and strain energy at a state whose strains have no resultants of their own yet.

Between two steps of the midpoint rule positions and rotations are known, forces and moments only at the mean state.
Those of the strains are those of the mixed form, C N = γ on each element; a rigid strain leaves them as they are.
Where sections damp, those of the rates in the step behind come to them, C N = γ + τ γ̇.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.continuum import reference

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from dolfinrod.continuum.excess import Excess
    from dolfinrod.continuum.problem import Problem

    Array = NDArray[np.float64]
    Solve = Callable[[Array, Array, Array], tuple[Array, Array]]
    Law = tuple[str, Solve, Array]

__all__ = ["Strain"]

# Compliances below this part of the largest are those of rigid strains.
RIGID = 1e-13


class Strain:
    """Resultants of the strains of a problem's state.

    Args:
        problem: Owner of the state.

    Attributes:
        dissipated: This rank's part of the energy that damping took in the step behind, in EI/L.
    """

    def __init__(self, problem: Problem) -> None:
        d = problem.discretization
        self._problem, self._mine = problem, slice(0, d.n_owned_cells)
        φ = reference.discontinuous_basis(d.degree - 1, d.points)
        self._pairs = np.einsum("qa,qb->abq", φ, φ).reshape(-1, len(φ))
        self._rotations = reference.lagrange_basis(d.degree, d.points)
        self._weights = np.diff(problem.ends[self._mine], axis=1) * reference.quadrature_weights(2 * d.degree)
        self._dofs = {f: _flat(d.dofs[f][self._mine]) for f in ("N", "m")}
        self._C_n, C_m = problem.values.C_n[self._mine], problem.values.C_m[self._mine]
        self._solve_n, self._solve_m = _solver(self._C_n, d.degree), _solver(C_m, d.degree)
        self._blocks_m = self._blocks(C_m)
        self._damps = any(rod.section.damping for rod in problem.scene.rods)
        self.dissipated = 0.0

    def settle(self) -> float:
        """Give the state the resultants of its strains and of any rates; this rank's strain energy in EI/L."""
        p, d = self._problem, self._problem.discretization
        kept = {f: p.x[at] for f, at in self._dofs.items()}
        for at in self._dofs.values():
            p.x[at] = 0.0
        strains = d.elastic_residual()
        energy = 0.0
        laws: list[Law] = [("N", self._solve_n, self._turned()), ("m", self._solve_m, self._blocks_m)]
        for field, solve, C in laws:
            g, old = strains[self._dofs[field]], kept[field]
            found, rigid = solve(C, g, old)
            energy += 0.5 * float(np.vdot(g, found))
            p.x[self._dofs[field]] = found + rigid
        if d.excess is not None:
            d.excess.end()
        if d.excess is not None and self._damps:
            self._add_viscous(d.excess, laws)
        d.x.x.scatter_forward()
        return energy

    def _add_viscous(self, excess: Excess, laws: list[Law]) -> None:
        """Add the resultants of the rates, whose work on the change of the strains is what damping took."""
        rates = excess.rates()
        power = np.zeros(len(excess.ratio[self._mine]))
        for field, solve, C in laws:
            at = self._dofs[field]
            found, _ = solve(C, rates[at], np.zeros(at.shape))
            power += np.einsum("ci,ci->c", rates[at], found)
            excess.resultants[at] = found
            self._problem.x[at] += found
        ratio = excess.ratio[self._mine]
        moving = ratio > 0.0
        self.dissipated = float((power[moving] / ratio[moving]).sum())

    def _turned(self) -> Array:
        """∫ φ φ R C Rᵀ of each element, R at its Gauss points."""
        p, d = self._problem, self._problem.discretization
        q = self._rotations @ p.x[d.dofs["q"][self._mine]]
        R = p.kinematics.rotation(q.reshape(-1, q.shape[2])).reshape(*q.shape[:2], *self._C_n.shape[2:])
        return self._blocks(np.asarray(R @ self._C_n @ np.swapaxes(R, 2, 3), dtype=float))

    def _blocks(self, C: Array) -> Array:
        """∫ φ_a φ_b C of each element, shape (cells, k d, k d)."""
        cells, points, dim, _ = C.shape
        k = int(np.sqrt(len(self._pairs)))
        blocks = self._pairs @ (self._weights[:, :, None] * C.reshape(cells, points, dim * dim))
        return np.asarray(np.swapaxes(blocks.reshape(cells, k, k, dim, dim), 2, 3).reshape(cells, k * dim, k * dim))


def _flat(dofs: NDArray[np.int32]) -> NDArray[np.intp]:
    """Those of a cell in a row, also where this rank has no cell."""
    cells, nodes, components = dofs.shape
    return dofs.reshape(cells, nodes * components).astype(np.intp)


def _solver(C: Array, nodes: int) -> Solve:
    """How strains give resultants of that many nodes an element, for such compliances at the Gauss points."""
    eigenvalues = np.linalg.eigvalsh(C)
    elastic = (eigenvalues > RIGID * eigenvalues.max(initial=0.0)).sum(axis=2)
    if elastic.min(initial=C.shape[-1]) == C.shape[-1]:
        return _elastic
    return partial(_with_rigid, nodes * elastic.min(axis=1))


def _elastic(C: Array, g: Array, old: Array) -> tuple[Array, Array]:
    """Resultants of the strains g, and nothing else."""
    return np.linalg.solve(C, g[:, :, None])[:, :, 0], np.zeros_like(old)


def _with_rigid(elastic: NDArray[np.int64], C: Array, g: Array, old: Array) -> tuple[Array, Array]:
    """Resultants of the strains g along the softest directions of each element, the old ones along the others.

    Args:
        elastic: How many directions strain; where an element is bent, the others are not quite at zero compliance.
        C: Compliances of the elements.
        g: Strains.
        old: Resultants before.
    """
    compliance, V = np.linalg.eigh(C)
    n = C.shape[1]
    soft = np.arange(n) >= n - elastic[:, None]
    along = np.einsum("cji,cj->ci", V, g) * np.divide(soft, compliance, out=np.zeros_like(compliance), where=soft)
    rigid = np.where(soft, 0.0, np.einsum("cji,cj->ci", V, old))
    return (V @ along[:, :, None])[:, :, 0], (V @ rigid[:, :, None])[:, :, 0]
