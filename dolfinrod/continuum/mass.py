"""Inertia of the rods: the consistent mass matrix at a state."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.continuum import backend, reference
from dolfinrod.scene import SceneError

if TYPE_CHECKING:
    from petsc4py import PETSc

    from numpy.typing import NDArray

    from dolfinrod.continuum.problem import Problem
    from dolfinrod.scene import Scene

__all__ = ["ALIKE", "densities", "inertia", "mass_matrix"]

# Rotary inertia of a change of quaternion over ρA L², of rods of which nothing is known: L/d = 25.
ALIKE = 1e-4


def inertia(scene: Scene) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Mass per length (rods,) [kg/m] and rotary inertia per length (rods, 3) [kg m].

    Raises:
        SceneError: A rod without them.
    """
    for k, rod in enumerate(scene.rods):
        for name, unit, none in (("rhoA", "kg/m", ""), ("rhoI", "kg m", "; (0, 0, 0) for none")):
            if getattr(rod.section, name) is None:
                needed = f"must be given [{unit}] for motion and vibrations{none}, got None"
                raise SceneError(needed, field=f"rods[{k}].section.{name}")
    sections = [rod.section for rod in scene.rods]
    return np.array([s.rhoA for s in sections], dtype=float), np.array([s.rhoI for s in sections], dtype=float)


def densities(scene: Scene) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Mass per length of each rod, over the largest, and what its sections resist a change of quaternion with.

    The sections count as round where they are of different inertia about their axes: more would matter for the
    frequency of a flutter, not for whether there is one nearby. Rods without a density are alike, of L/d = 25.
    """
    sections = [rod.section for rod in scene.rods]
    longest = max(rod.length for rod in scene.rods)
    if any(section.rhoA is None or section.rhoI is None for section in sections):
        return np.ones(len(sections)), np.full(len(sections), ALIKE)
    rhoA = np.array([section.rhoA for section in sections], dtype=float)
    rhoI = np.array([max(section.rhoI or (0.0,)) for section in sections])
    return rhoA / rhoA.max(), 4.0 * rhoI / (rhoA.max() * longest**2)


def mass_matrix(problem: Problem, rhoA: NDArray[np.float64], rhoI: NDArray[np.float64]) -> PETSc.Mat:
    """M of the kinetic energy ½ ∫ ρA ṙ·ṙ + ω·ρI ω ds, ω = 2 Im(p̄ ṗ)/|p|² in the turned frame.

    Unit of mass per length is the largest ρA, of time √(ρA L⁴/EI). Rows and columns of held dofs, resultants and
    multipliers are zero.

    Args:
        problem: Its current state.
        rhoA: Mass per length of each rod, shape (rods,) [kg/m].
        rhoI: Rotary inertia per length, shape (rods, 3) [kg m].

    Returns:
        A matrix that the caller destroys.
    """
    d, kin = problem.discretization, problem.kinematics
    mine = slice(0, d.n_owned_cells)
    unit = rhoA.max()
    φ = reference.lagrange_basis(d.degree, d.points)
    weights = np.diff(problem.ends[mine], axis=1) * reference.quadrature_weights(2 * d.degree)
    j = (rhoI / unit / problem.placement.length**2)[problem.rod]
    J = np.einsum("cqij,cj,cqkj->cqik", problem.spins, j, problem.spins)
    q = np.einsum("qa,cai->cqi", φ, problem.x[d.dofs["q"][mine]])
    spin = kin.body_spin(q.reshape(-1, q.shape[2])).reshape(*q.shape[:2], kin.n_spin, q.shape[2])
    if kin.n_spin == 3:
        spin = spin / np.einsum("cqi,cqi->cq", q, q)[:, :, None, None]
    turning = np.einsum("cq,qa,qb,cqsi,cqst,cqtj->caibj", weights, φ, φ, spin, J[mine], spin, optimize=True)
    eye = np.eye(kin.dim)
    moving = np.einsum("c,cq,qa,qb,ij->caibj", rhoA[problem.rod[mine]] / unit, weights, φ, φ, eye, optimize=True)
    M = d.tangent.matrix()
    for field, blocks in (("r", moving), ("q", turning)):
        dofs = d.dofs[field][mine].reshape(len(weights), -1)
        backend.add_entries(M, *problem.entries(dofs, dofs, blocks))
    M.assemble()
    return M
