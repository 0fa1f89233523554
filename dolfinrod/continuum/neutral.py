"""Phase conditions: rigid motions that no support resists are held where they are while equilibrium is sought.

A rod between two pins may turn about the line through them. Its tangent is singular along that motion z as far as its
loads are balanced in it: every turned state is an equilibrium, too. One unknown that takes part in z is then held,
which picks one of them. As elastic forces do no work in rigid motions (the interpolation is objective), the residual
has no part along z, and the held unknown needs no force exactly if the loads are balanced in z. Where it does need
one, as in a pendulum held aslant, z is released and Newton's method goes on from there.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from mpi4py import MPI
from petsc4py import PETSc

import numpy as np
from scipy.linalg import qr

from dolfinrod.continuum.coupled import coupled
from dolfinrod.scene.mechanism import named, null_space

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.continuum.newton import Newton, Outcome
    from dolfinrod.continuum.problem import Problem

__all__ = ["UNBALANCED", "PhaseCondition", "equilibrium"]

# Force along a motion, over the largest resultant, up to which the loads are balanced in it.
BALANCED = 1e-9
UNBALANCED = "the loads push a rod along a motion that no support resists, and no equilibrium was met that way"


class PhaseCondition:
    """Free rigid motions of the rods of a problem, held or released.

    Args:
        problem: Owner of the state.

    Attributes:
        needed: Whether any rod is free to move.
        notes: What was held in an accepted state, in words.
    """

    def __init__(self, problem: Problem) -> None:
        self._problem = problem
        self.notes: tuple[str, ...] = ()
        self._motions = self._free()
        self.needed = any(len(motions) for motions in self._motions)

    def hold(self) -> None:
        """Hold every free motion at the current state."""
        self._motions = self._free()
        self._choose()

    def release(self) -> None:
        """Let the rods move again; notes what was held until now."""
        place, kin = self._problem.placement, self._problem.kinematics
        self.notes = ()
        for rod, z in enumerate(self._motions):
            in_space = np.concatenate([z[:, : kin.dim] @ place.axes.T, z[:, kin.dim :] @ place.spin_axes.T], axis=1)
            self.notes += tuple(f"{words}: balanced, held by a phase condition" for words in named(rod, in_space))
        self._problem.hold(np.zeros(0, dtype=np.int32))

    def hold_unresisted(self) -> None:
        """Hold the free motions that nothing resists at the current state, with no others held."""
        A = self._problem.discretization.matrix
        self._problem.assemble_tangent(A)
        with coupled(A, self._problem) as tangent:
            self.hold_null(tangent)

    def hold_null(self, *matrices: PETSc.Mat) -> None:
        """Hold the free motions that all of these matrices, assembled with none held, map to zero."""
        self._motions = self._free()
        scale = self._largest()
        for rod, free in enumerate(self._motions):
            moved = [self._carried(rod, z) for z in free]
            if moved:
                rows = [np.linalg.qr(self._images(A, moved))[1] / scale for A in matrices]
                self._motions[rod] = null_space(np.concatenate(rows)) @ free
        self._choose()

    def _images(self, A: PETSc.Mat, changes: list[NDArray[np.float64]]) -> NDArray[np.float64]:
        """A times each change, all components on every rank, as columns."""
        x, y = A.createVecs()
        columns = []
        for change in changes:
            x.array[:] = change
            A.mult(x, y)
            columns.append(np.concatenate(self._problem.discretization.comm.allgather(y.array_r.copy())))
        x.destroy()
        y.destroy()
        return np.stack(columns, axis=1)

    def _carried(self, rod: int, z: NDArray[np.float64]) -> NDArray[np.float64]:
        """Change of this rank's own unknowns as the rod moves along z with its forces N; m and multipliers stay."""
        problem, d, kin = (self._problem, self._problem.discretization, self._problem.kinematics)
        mine = problem.rod == rod
        r, q, N = (d.dofs[f][mine].reshape(-1, d.dofs[f].shape[2]) for f in ("r", "q", "N"))
        at_rest = kin.at_rest(len(N))
        moved = np.zeros(len(problem.x))
        moved[np.concatenate([r, q], axis=1)] = z @ kin.rigid_motions(problem.x[r], problem.x[q])
        moved[N] = z[kin.dim :] @ kin.rigid_motions(problem.x[N], at_rest)[:, kin.dim :, : kin.dim]
        return moved[: d.n_owned]

    def drop_pushed(self) -> bool:
        """Release the motions along which the loads push; whether there were any."""
        forces = self._forces()
        pushed = [i for i, force in enumerate(forces) if np.abs(force).max(initial=0.0) > BALANCED * self._largest()]
        for rod in pushed:
            self._motions[rod] = null_space(forces[rod][None]) @ self._motions[rod]
        if pushed:
            self._choose()
        return bool(pushed)

    def balanced(self) -> bool:
        """Whether what is held needs no force, however far the rods have turned since it was chosen."""
        # A quaternion changes by half the spin, so the force on it is twice the moment.
        needed = 0.5 * float(np.abs(self._problem.held_force).max(initial=0.0))
        return bool(self._problem.discretization.comm.allreduce(needed, op=MPI.MAX) <= BALANCED * self._largest())

    def _free(self) -> list[NDArray[np.float64]]:
        """Rigid motions of each rod that leave its supported unknowns where they are, shape (n, dim + n_spin)."""
        problem, kin = self._problem, self._problem.kinematics
        rows: list[list[NDArray[np.float64]]] = [[] for _ in problem.scene.rods]
        for rod, node in problem.constraints.places:
            dofs = np.concatenate([node["r"], node["q"]])
            moved = kin.rigid_motions(problem.x[node["r"]][None], problem.x[node["q"]][None])[0]
            rows[rod].append(moved[:, np.isin(dofs, problem.constraints.dofs)].T)
        everywhere = problem.discretization.comm.allgather(rows)
        none = np.zeros((0, kin.dim + kin.n_spin))
        return [
            null_space(np.concatenate([none, *(r for part in everywhere for r in part[k])])) for k in range(len(rows))
        ]

    def _choose(self) -> None:
        """Hold as many unknowns of a rod's first node as it has motions to hold, those that move most in them."""
        problem = self._problem
        self._held: dict[int, NDArray[np.float64]] = {}
        chosen = [np.zeros(0, dtype=np.int32)]
        for rod, z in enumerate(self._motions):
            node = problem.locate(rod, 0.0)
            if node is None or not len(z):
                continue
            dofs = np.concatenate([node["r"], node["q"]])
            moved = z @ problem.kinematics.rigid_motions(problem.x[node["r"]][None], problem.x[node["q"]][None])[0]
            _, order = qr(moved, mode="r", pivoting=True)
            most = order[: len(z)]
            chosen.append(dofs[most])
            if dofs[0] < problem.discretization.n_owned:
                self._held[rod] = moved[:, most]
        problem.hold(np.concatenate(chosen))

    def _forces(self) -> list[NDArray[np.float64]]:
        """Force along each held motion, one array a rod, on every rank."""
        forces = [np.zeros(len(z)) for z in self._motions]
        start = 0
        for rod, moved in self._held.items():
            forces[rod] = moved @ self._problem.held_force[start : start + len(moved)]
            start += len(moved)
        comm = self._problem.discretization.comm
        return [np.asarray(comm.allreduce(force, op=MPI.SUM)) for force in forces]

    def _largest(self) -> float:
        """Largest resultant in working units, and no less than one of them."""
        d, x = self._problem.discretization, self._problem.x
        sizes = (float(np.abs(x[d.dofs[f]]).max(initial=0.0)) for f in ("N", "m"))
        return max(1.0, float(d.comm.allreduce(max(sizes), op=MPI.MAX)))


def equilibrium(newton: Newton, phase: PhaseCondition, last: NDArray[np.float64] | None = None) -> Outcome:
    """Equilibrium with free motions held, and from there with those released along which the loads push.

    Args:
        newton: Solver of the problem.
        phase: Its free motions.
        last: The equilibrium on this rank that the problem's state was extrapolated from, if it was.

    Returns:
        How the attempt ended, all iterations counted.
    """
    if not phase.needed:
        return newton.solve(last)
    if newton.problem.contacts is None:
        phase.hold()
    else:
        # Only what no surface resists, either, is free.
        newton.problem.hold(np.zeros(0, dtype=np.int32))
        phase.hold_unresisted()
    found = newton.solve(last)
    while found.converged and phase.drop_pushed():
        again = newton.solve()
        reason = again.reason if again.converged else UNBALANCED
        found = replace(again, iterations=found.iterations + again.iterations, reason=reason)
    if found.converged and not phase.balanced():
        found = replace(found, converged=False, reason=UNBALANCED)
    phase.release()
    return found
