"""Where a path leads from an equilibrium: loads continued in straight lines, the rates of state and tangent.

With K(t) the tangent along the path, its next critical points are where K + μ dK/dt is singular. K depends on the
state x and on the loads; dK/dt is taken along x′ = −K⁻¹ ∂R/∂t by differences of fourth order, whose step follows the
state: K is linear in forces, moments and multipliers, so only turns limit it.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from mpi4py import MPI
from petsc4py import PETSc

import numpy as np

from dolfinrod.continuum import backend, reference
from dolfinrod.continuum.spectrum import direct_solver
from dolfinrod.scene import Prescribed, Static
from dolfinrod.scene.history import History, Line, factor, slope

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from dolfinrod.continuum.problem import Problem
    from dolfinrod.scene import Scene

    Array = NDArray[np.float64]

__all__ = ["continued", "settle", "tangent_and_rate", "varies"]

# Turn of a section in one difference step [rad]: its fourth power, the error, is below round-off over the step.
TURN = 1e-3
SMALLEST = float(np.finfo(float).tiny)
# Weights of f(jh)/h in f′(0).
DIFFERENCE = ((1, 8 / 12), (-1, -8 / 12), (2, -1 / 12), (-2, 1 / 12))


def continued(scene: Scene, t: float) -> Scene:
    """The scene whose loads and prescribed motions are straight lines in τ, tangent to those of `scene` at t.

    Args:
        scene: Any scene.
        t: Pseudo-time, τ = 0 of the new scene.

    Returns:
        The new scene; its pseudo-time is counted in the same unit.
    """
    t_end = scene.motion.t_end

    def line(history: History) -> Line:
        return Line(factor(history, t, t_end), slope(history, t, t_end))

    loads = [replace(load, history=line(load.history)) for load in scene.loads]
    supports = [replace(s, history=line(s.history)) if isinstance(s, Prescribed) else s for s in scene.supports]
    return replace(scene, loads=loads, supports=supports, motion=Static(t_end=t_end), velocities=(), air=None)


def varies(scene: Scene, t: float) -> bool:
    """Whether any load or support changes from pseudo-time t on."""
    histories = [load.history for load in scene.loads]
    histories += [s.history for s in scene.supports if isinstance(s, Prescribed)]
    return any(slope(history, t, scene.motion.t_end) != 0.0 for history in histories)


def settle(problem: Problem) -> Array:
    """Balance the multipliers at the current state; what is left of the residual at the owned dofs.

    Held rows are kept for `held_force` and zeroed.
    """
    F = problem.discretization.x.vector.duplicate()
    b = _assembled(problem, F)
    problem.balance_multipliers(b)
    problem.clear_held(b)
    F.destroy()
    return b


def tangent_and_rate(problem: Problem) -> tuple[PETSc.Mat, PETSc.Mat]:
    """K and dK/dt at the problem's state, an equilibrium at its pseudo-time zero.

    Args:
        problem: Of a `continued` scene, free rigid motions held.

    Returns:
        Two matrices that the caller destroys; the state is as it was.
    """
    d, x = problem.discretization, problem.x.copy()
    problem.assemble_tangent(d.matrix)
    K = d.matrix.copy()
    solver = direct_solver(K)
    rate = _rate_of_state(problem, x, solver)
    h = _step(problem, x, rate)
    dK = K.duplicate()
    dK.zeroEntries()
    for j, weight in DIFFERENCE:
        _put(problem, x + j * h * rate, j * h)
        problem.assemble_tangent(d.matrix)
        dK.axpy(weight, d.matrix, structure=PETSc.Mat.Structure.SAME_NONZERO_PATTERN)
    dK.scale(1.0 / h)
    _put(problem, x, 0.0)
    _add_transport(problem, K, dK, rate)
    solver.destroy()
    return K, dK


def _add_transport(problem: Problem, K: PETSc.Mat, dK: PETSc.Mat, rate: Array) -> None:
    """Take dK/dt in unknowns that do not turn with the sections, dK/dt + K W + Wᵀ K with the rates W of `transport`.

    It is singular at the same loads, as any congruent tangent is; but a round rod that is twisted looks the same in
    these unknowns, so that the line K + μ dK/dt meets the tangent far ahead, too.
    """
    d, kin = problem.discretization, problem.kinematics
    q = d.owned_nodes("q")
    W = d.tangent.matrix()
    backend.add_entries(W, *problem.entries(q, q, kin.transport(problem.x[q], rate[q])[0]))
    φ = reference.lagrange_basis(d.degree, reference.discontinuous_nodes(d.degree - 1))
    at_moments = (
        np.einsum("na,cai->cni", φ, v[d.dofs["q"][: d.n_owned_cells]]).reshape(-1, q.shape[1])
        for v in (problem.x, rate)
    )
    m = d.dofs["m"][: d.n_owned_cells].reshape(-1, kin.n_spin)
    backend.add_entries(W, *problem.entries(m, m, kin.transport(*at_moments)[1]))
    W.assemble()
    KW = K.matMult(W)
    WK = W.transposeMatMult(K)
    for product in (KW, WK):
        dK.axpy(1.0, product, structure=PETSc.Mat.Structure.DIFFERENT_NONZERO_PATTERN)
    for owned in (KW, WK, W):
        owned.destroy()


def _put(problem: Problem, x: Array, t: float) -> None:
    """Loads and supports at t, state x, which need not meet the supports to more than first order."""
    problem.advance_to(t)
    problem.x[:] = x


def _rate_of_state(problem: Problem, x: Array, solver: PETSc.KSP) -> Array:
    """x′ = −K⁻¹ ∂R/∂t on the local dofs, with the motion of the supports."""
    rate = np.zeros_like(x)
    dofs, comm = problem.constraints.dofs, problem.discretization.comm
    h = TURN * problem.scene.motion.t_end
    for _ in range(2):
        rate[dofs] = _difference(problem.constraints.values, h)
        h = TURN / max(_largest(comm, rate), TURN / problem.scene.motion.t_end)
    moving = _largest(comm, rate)
    F, X = (problem.discretization.x.vector.duplicate() for _ in range(2))

    def residual(t: float) -> Array:
        _put(problem, x + t * rate, t)
        b = _assembled(problem, F)
        problem.clear_held(b)
        return b.copy()

    G = _difference(residual, h)
    G = _difference(residual, min(h if moving else np.inf, 1.0 / max(_largest(comm, G), SMALLEST)))
    F.array[:] = -G
    solver.solve(F, X)
    X.ghostUpdate(PETSc.InsertMode.INSERT, PETSc.ScatterMode.FORWARD)
    with X.localForm() as local:
        rate += local.array_r
    F.destroy()
    X.destroy()
    _put(problem, x, 0.0)
    return rate


def _step(problem: Problem, x: Array, rate: Array) -> float:
    """Step in which sections turn by no more than `TURN` and no resultant changes by more than its size, or 1."""
    d = problem.discretization
    sizes = []
    for field, dofs in d.dofs.items():
        size = TURN if field == "q" else max(1.0, _largest(d.comm, x[dofs]))
        sizes.append(_largest(d.comm, rate[dofs]) / size)
    return 1.0 / max(*sizes, SMALLEST)


def _assembled(problem: Problem, F: PETSc.Vec) -> Array:
    """Residual at the owned dofs, in F's own memory."""
    with F.localForm() as f:
        b = f.array
        b[:] = 0.0
        problem.add_residual(b)
    F.ghostUpdate(PETSc.InsertMode.ADD, PETSc.ScatterMode.REVERSE)
    return np.asarray(F.array)


def _difference(f: Callable[[float], Array], h: float) -> Array:
    """f′(0) to fourth order."""
    return np.asarray(sum(weight * f(j * h) for j, weight in DIFFERENCE) / h)


def _largest(comm: MPI.Comm, values: Array) -> float:
    """Largest magnitude over all ranks."""
    return float(comm.allreduce(np.abs(values).max(initial=0.0), op=MPI.MAX))
