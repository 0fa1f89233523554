"""Off an unstable equilibrium, along the direction in which stability was lost, to the side the rods had set out to.

The tangent K of an equilibrium beyond a critical load has a negative eigenvalue, and the spins s of the path before it
have a part along its direction: the rate at which an imperfection grows. Inverse iteration from s, s ← −K⁻¹ s with the
spins as moments, makes that part grow in the ratio of the eigenvalues and keeps its sign, while parts along stable
directions change theirs. A radian that way the stable state lies in reach of Newton's method.

Source: inverse iteration, Golub & Van Loan, Matrix Computations, 4th ed., 8.2.2.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from mpi4py import MPI
from petsc4py import PETSc

import numpy as np

from dolfinrod.continuum.direct import LIBRARY_ERROR

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.continuum.newton import Newton

    Array = NDArray[np.float64]

__all__ = ["push_aside"]

# Largest turn of a section by which the state is left [rad]: where what is linear about it ends.
AWAY = 1.0
# Inverse iterations; each costs a solution with factors.
ROUNDS = 4
# Part of the way they set out that goes along the direction, over all of it and over 1 rad, below which its side is
# round-off: the root of that. A perfect column stays straight.
SEEN = float(np.sqrt(np.finfo(float).eps))


def push_aside(newton: Newton) -> bool:
    """Push the problem off the unstable equilibrium where it is.

    Args:
        newton: That has just found it.

    Returns:
        Whether it was: there is a direction that lowers the energy, and the rods had set out to one side of it.
    """
    problem, spins = newton.problem, newton.set_out
    if spins is None or not _dot(problem.discretization.comm, spins, spins) > SEEN**2:
        return False
    found = _direction(newton, spins)
    if found is None:
        return False
    q, x, kin = problem.discretization.owned_nodes("q"), problem.x, problem.kinematics
    at = x[q]
    x[: len(found)] += AWAY * found
    x[q] = kin.turn(at, AWAY * kin.increment(at, found[q]))
    problem.discretization.x.x.scatter_forward()
    return True


def _direction(newton: Newton, set_out: Array) -> Array | None:
    """Change of this rank's own unknowns in which stability was lost, with a largest turn of 1 rad; None if unknown."""
    problem, d = newton.problem, newton.problem.discretization
    q, kin, A = d.owned_nodes("q"), problem.kinematics, d.matrix
    at = problem.x[q]
    spin, spins, energy = kin.spin(at), set_out, np.nan
    problem.assemble_tangent(A)
    newton.factorizations += 1
    y, b = A.createVecs()
    ksp = newton.snes.getKSP()
    ksp.setOperators(A)
    for _ in range(ROUNDS):
        b.set(0.0)
        b.array[q] = np.einsum("nij,ni->nj", spin, spins)
        problem.clear_held(b.array)
        if not _solved(newton, ksp, b, y):
            break
        turned = np.einsum("nij,nj->ni", spin, kin.increment(at, -y.array_r[q]))
        energy = -_dot(d.comm, spins, turned)
        largest = d.comm.allreduce(float(np.linalg.norm(turned, axis=1).max(initial=0.0)), op=MPI.MAX)
        spins = turned / largest
        change = -y.array_r / largest
    for owned in (y, b):
        owned.destroy()
    if not energy < 0.0:
        return None
    least = SEEN * np.sqrt(_dot(d.comm, spins, spins) * max(_dot(d.comm, set_out, set_out), 1.0))
    return change if _dot(d.comm, spins, set_out) > least else None


def _solved(newton: Newton, ksp: PETSc.KSP, b: PETSc.Vec, y: PETSc.Vec) -> bool:
    """Whether K y = b has a solution, which is y then."""
    try:
        ksp.solve(b, y)
    except PETSc.Error as error:
        if error.ierr != LIBRARY_ERROR:
            raise
        newton.reopen()
        return False
    return True


def _dot(comm: MPI.Comm, a: Array, b: Array) -> float:
    """Over all ranks."""
    return float(comm.allreduce(float(np.vdot(a, b))))
