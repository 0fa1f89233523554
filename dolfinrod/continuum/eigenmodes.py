"""`dolfinrod.buckling` and `dolfinrod.modes`: what an equilibrium is about to do, and how it vibrates."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from petsc4py import PETSc

import numpy as np

from dolfinrod.continuum.ahead import looking_on
from dolfinrod.continuum.linearization import settle, varies
from dolfinrod.continuum.mass import inertia, mass_matrix
from dolfinrod.continuum.session import opened
from dolfinrod.continuum.shapes import shapes
from dolfinrod.continuum.spectrum import Eigenpairs, Spectrum
from dolfinrod.eigen import Buckling, Modes
from dolfinrod.scene import SceneError
from dolfinrod.scene.quantity import count

if TYPE_CHECKING:
    from mpi4py import MPI

    from numpy.typing import NDArray

    from dolfinrod.continuum.problem import Problem
    from dolfinrod.continuum.session import Session
    from dolfinrod.result import Result
    from dolfinrod.scene import Planar, Scene, Spatial

__all__ = ["MOST_MODES", "buckling", "modes", "next_critical", "no_critical"]

MOST_MODES = 1000
# Frequencies are sought around ω² = −1 in working units, below what a stable rod has: rigid modes are no obstacle.
SHIFT = -1.0
# ω² that is round-off next to that shift.
RIGID = 1e-10


def buckling(
    scene: Scene,
    *,
    modes: int = 3,
    at: Result | None = None,
    elements: int | Sequence[int] = 16,
    degree: int = 3,
    kinematics: Planar | Spatial | None = None,
    comm: MPI.Comm | None = None,
) -> Buckling:
    """Next critical loads by the tangent and its rate at an equilibrium; see `dolfinrod.buckling`."""
    n = count(modes, "modes", MOST_MODES)
    with opened(scene, kinematics, comm, degree, elements) as session:
        session.begin(at)
        if not varies(session.problem.scene, session.t):
            raise SceneError(f"nothing varies with the pseudo-time from t = {session.t:g} on: no load becomes critical")
        return next_critical(session, n)[0]


def next_critical(session: Session, n: int) -> tuple[Buckling, float]:
    """The next n critical points seen from a session's current equilibrium, (K + μ dK/dt) v = 0 with least μ > 0.

    Returns:
        Their record, and the pseudo-time of the last one behind, or minus infinity.
    """
    if not varies(session.problem.scene, session.t):
        return no_critical(session), -np.inf
    with looking_on(session.readout, session.path.states[-1], session.t) as (problem, spectrum):
        ahead, behind = spectrum.most_negative_first(n), spectrum.most_positive_first(1)
        real = np.flatnonzero(ahead.values.imag == 0.0)[:n]
        rods = shapes(problem, session.readout, ahead.vectors[:, real].real)
    t = session.t - 1.0 / ahead.values
    passed = session.t - 1.0 / behind.values[behind.values.imag == 0.0].real
    found = Buckling(t[real].real, ahead.multiplicity[real], rods, session.result(), t[t.imag != 0.0])
    return found, max(passed, default=-np.inf)


def no_critical(session: Session) -> Buckling:
    """The record of no critical point."""
    none = np.zeros((session.problem.discretization.n_dofs, 0))
    rods = shapes(session.problem, session.readout, none)
    return Buckling(np.zeros(0), np.zeros(0, np.int64), rods, session.result(), np.zeros(0, complex))


def modes(
    scene: Scene,
    *,
    modes: int = 6,
    at: Result | None = None,
    elements: int | Sequence[int] = 16,
    degree: int = 3,
    kinematics: Planar | Spatial | None = None,
    comm: MPI.Comm | None = None,
) -> Modes:
    """Vibrations about an equilibrium, K v = ω² M v; see `dolfinrod.modes`."""
    n = count(modes, "modes", MOST_MODES)
    masses = inertia(scene)
    with opened(scene, kinematics, comm, degree, elements) as session:
        session.begin(at)
        problem = session.problem
        settle(problem)
        M, shifted = _mass_and_shifted(problem, *masses)
        if session.phase.needed:
            session.phase.hold_null(problem.discretization.matrix, M)
            M.destroy()
            shifted.destroy()
            M, shifted = _mass_and_shifted(problem, *masses)
        pairs = _around_shift(M, shifted, n).where(slice(n))
        unit = np.sqrt(problem.placement.stiffness / (masses[0].max() * problem.placement.length**4))
        squares = np.where(np.abs(pairs.values) <= RIGID, 0.0, pairs.values)
        rods = shapes(problem, session.readout, pairs.vectors.real)
        for matrix in (M, shifted):
            matrix.destroy()
        return Modes(unit * np.sqrt(squares), pairs.multiplicity, rods, session.result())


def _mass_and_shifted(
    problem: Problem, rhoA: NDArray[np.float64], rhoI: NDArray[np.float64]
) -> tuple[PETSc.Mat, PETSc.Mat]:
    """M and K − σM, which the caller destroys; K stays in the discretization's matrix."""
    K, M = problem.discretization.matrix, mass_matrix(problem, rhoA, rhoI)
    problem.assemble_tangent(K)
    shifted = M.copy()
    shifted.scale(-SHIFT)
    shifted.axpy(1.0, K, structure=PETSc.Mat.Structure.DIFFERENT_NONZERO_PATTERN)
    return M, shifted


def _around_shift(M: PETSc.Mat, shifted: PETSc.Mat, n: int) -> Eigenpairs:
    """Eigenvalues λ = ω² of K v = λ M v nearest the shift, and all the others below it, by those of (K − σM)⁻¹ M."""
    spectrum = Spectrum(M, shifted)
    above, below = spectrum.largest_first(n), spectrum.most_negative_first(n)
    spectrum.close()
    above = above.where(above.values.real > 0.0)
    θ = np.concatenate([below.values, above.values])
    λ = np.asarray(SHIFT + 1.0 / θ, dtype=complex)
    order = np.lexsort([λ.real, (λ.imag == 0.0) & (λ.real >= -RIGID)])
    both = Eigenpairs(
        λ, np.hstack([below.vectors, above.vectors]), np.concatenate([below.multiplicity, above.multiplicity])
    )
    return both.where(order)
