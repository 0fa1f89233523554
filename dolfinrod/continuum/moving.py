"""A scene in motion as a system of equations: one step in time, with the inertia of the rods at their nodes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from mpi4py import MPI

import numpy as np

from dolfinrod.continuum import backend
from dolfinrod.continuum.drag import Drag
from dolfinrod.continuum.lumped import Lumped, summed
from dolfinrod.continuum.motion import Motion
from dolfinrod.continuum.problem import Problem
from dolfinrod.continuum.schemes import momentum
from dolfinrod.scene import Gravity, LineForce, Steady

if TYPE_CHECKING:
    from petsc4py import PETSc

    from numpy.typing import NDArray

    from dolfinrod.continuum.discretization import Discretization
    from dolfinrod.continuum.placement import Placement
    from dolfinrod.continuum.readout import Readout
    from dolfinrod.continuum.schemes import Scheme
    from dolfinrod.scene import Scene

    Array = NDArray[np.float64]

__all__ = ["Moving"]


class Moving(Problem):
    """Owner of the state, the velocities and the momenta while a scene moves.

    Args:
        scene: What is posed, histories written out in time.
        discretization: Elements, spaces and forms.
        placement: Working coordinates and units.
        scheme: How a step weighs forces and inertia.

    Attributes:
        lumped: Masses of the nodes.
        motion: How the nodes move.
    """

    def __init__(self, scene: Scene, discretization: Discretization, placement: Placement, scheme: Scheme) -> None:
        super().__init__(scene, discretization, placement)
        self.scheme = scheme
        self.lumped = Lumped.of(self)
        self.motion = Motion(np.zeros(self.lumped.r.shape), np.zeros((len(self.lumped.q), self.kinematics.n_spin)))
        self._before, self._start = self.x.copy(), self.motion
        lines = [load for load in scene.loads if isinstance(load, Gravity | LineForce)]
        self._weights = [
            summed(self, vector)
            for load, (history, vector) in zip(lines, self.line_loads, strict=True)
            if isinstance(load, Gravity) and isinstance(history, Steady)
        ]
        self._drag = None if scene.air is None else Drag(self, scene.air)
        self._forces = backend.function(discretization.space)
        self._nodal = [np.unique(discretization.dofs[f]) for f in ("r", "q")]
        self._multipliers = np.unique(discretization.dofs.get("multiplier", np.zeros(0, dtype=np.int32)))
        self._shrink = self.discretization.matrix.createVecLeft()
        self._shrink.set(1.0)
        self._shrink.array[np.concatenate([self.lumped.r.ravel(), self.lumped.q.ravel()])] = scheme.level

    def begin_step(self, t: float, dt: float) -> None:
        """Put the supports at the end of a step from t on, and the loads where the scheme has them [s]."""
        self._before[:] = self.x
        self._start = self.motion
        self.h = dt / self.lumped.second
        self.advance_to(t + self.scheme.level * dt)
        self.x[self.constraints.dofs] = self.constraints.values(t + dt)

    def add_residual(self, b: Array) -> None:
        """Add this rank's residual of the step to the local array b."""
        self.add_apart(b, b, b, b)

    def add_apart(self, inertia: Array, elastic: Array, loads: Array, drag: Array) -> None:
        """Add this rank's residuals of inertia, elasticity, loads and air, each to its own local array."""
        lumped, kin = self.lumped, self.kinematics
        r, q = lumped.r, lumped.q
        per_step = 1.0 / (self.scheme.level * self.h)
        after = self.x.copy()
        inertia[r] += per_step * lumped.m[:, None] * ((after[r] - self._before[r]) / self.h - self._start.v)
        inertia[q] += per_step * np.einsum("nij,ni->nj", kin.spin(self.side()), self._gained())
        if self.scheme.level != 1.0:
            self.x[:] = self._between(after)
        self.discretization.residual.add_vector(elastic)
        self.x[:] = after
        if self.scheme.level != 1.0:
            # The nodes are on the sphere after the step, not between.
            elastic[self._multipliers] = 0.0
        at = after if self.scheme.level == 1.0 else self._between(after, unit=True)
        self.add_loads(loads, at)
        if self._drag is not None:
            drag[r] -= self._drag.force(at[r], at[q], self._rate(), self.t)

    def _rate(self) -> Array:
        """Mean velocity of this rank's own nodes in the step."""
        r = self.lumped.r
        return (self.x[r] - self._before[r]) / self.h

    def change(self) -> Array:
        """What the last step changed of this rank's own positions and rotations, nothing else."""
        n = self.discretization.n_owned
        moved = np.zeros(len(self.x))
        for dofs in self._nodal:
            moved[dofs] = self.x[dofs] - self._before[dofs]
        return moved[:n]

    def potential(self) -> float:
        """Potential energy of the weights that act in full all the time, zero at the origin."""
        n = self.discretization.n_owned
        energy = sum(float(vector[:n] @ self.x[:n]) for vector in self._weights)
        return float(self.discretization.comm.allreduce(energy))

    def _between(self, after: Array, *, unit: bool = False) -> Array:
        """The state at which forces act: positions and rotations between, resultants as they are, no multipliers."""
        x = after.copy()
        for dofs in self._nodal:
            x[dofs] += (1.0 - self.scheme.level) * (self._before[dofs] - after[dofs])
        x[self._multipliers] = 0.0
        if unit and len(self._multipliers):
            q = self.discretization.dofs["q"].reshape(-1, 4)
            x[q] /= np.linalg.norm(x[q], axis=1, keepdims=True)
        return x

    def side(self) -> Array:
        """Rotations of this rank's own nodes along whose unit sphere the balance of moments is taken."""
        return (self.x if self.scheme.side else self._before)[self.lumped.q]

    def _gained(self) -> Array:
        """Moment of momentum gained in the part of the step that the balance is about."""
        q = self.lumped.q
        bend = 0.0 if self.scheme.side else 0.5
        Π, _ = momentum(self.kinematics, self.lumped.J, self._before[q], self.x[q], self.h, bend)
        return self.kinematics.turned_spin(self.side(), Π) - self._start.π

    def balance_multipliers(self, b: Array) -> None:
        """As in statics, along the rotations of the balance; the multipliers are no part of the forces between."""
        if self.scheme.side or not len(self._multipliers):
            super().balance_multipliers(b)
            return
        q, λ = self._unit
        p = self._before[q]
        along = (p * b[q]).sum(axis=1)
        b[q] -= along[:, None] * p
        b[λ] = 0.0
        self.x[λ] = -along / self._lumped
        self.discretization.x.x.scatter_forward()

    def assemble_tangent(self, A: PETSc.Mat, *, on_sphere: bool = False) -> None:
        """Tangent of the step."""
        after = self.x.copy()
        if self.scheme.level != 1.0:
            self.x[:] = self._between(after)
        super().assemble_tangent(A, on_sphere=on_sphere)
        self.x[:] = after
        r, q, h = self.lumped.r, self.lumped.q, self.h
        if self.scheme.level != 1.0:
            A.diagonalScale(None, self._shrink)
            self._add_conditions(A)
        twice = 1.0 / (self.scheme.level * h)
        mass = (twice / h * self.lumped.m)[:, None, None] * np.eye(r.shape[1])
        backend.add_entries(A, *self.entries(r, r, mass))
        backend.add_entries(A, *self.entries(q, q, twice * self._turning()))
        if self._drag is not None:
            self._add_drag(A, self._drag)
        A.assemble()

    def _add_drag(self, A: PETSc.Mat, drag: Drag) -> None:
        """Tangent of the air's force."""
        r, q = self.lumped.r, self.lumped.q
        at = self.x if self.scheme.level == 1.0 else self._between(self.x, unit=True)
        by_rate, by_q = drag.gradient(at[r], at[q], self._rate(), self.t)
        backend.add_entries(A, *self.entries(r, r, -by_rate / self.h))
        backend.add_entries(A, *self.entries(r, q, -self.scheme.level * by_q))

    def _turning(self) -> Array:
        """∂/∂q₁ of what the sections gain, along the sphere, shape (n, n_q, n_q)."""
        kin, q = self.kinematics, self.lumped.q
        side, gained = self.side(), self._gained()
        Π, dΠ = momentum(kin, self.lumped.J, self._before[q], self.x[q], self.h, 0.0 if self.scheme.side else 0.5)
        turned = np.stack([kin.turned_spin(side, dΠ[:, :, j]) for j in range(dΠ.shape[2])], axis=2)
        if self.scheme.side and kin.n_spin == 3:
            turned += kin.rotate_gradient(side, Π)
        blocks = np.einsum("nij,nik->njk", kin.spin(side), turned)
        if self.scheme.side and kin.n_spin == 3:
            n, n_q = q.shape
            units = kin.spin(np.repeat(np.eye(n_q), n, axis=0)).reshape(n_q, n, -1, n_q)
            blocks += np.einsum("knij,ni->njk", units, gained)
        return blocks

    def _add_conditions(self, A: PETSc.Mat) -> None:
        """Unit norm after the step, its multiplier along the rotation before, where the form has both between."""
        if self._lumped is None:
            return
        q, λ = self._unit
        before, after = self._before[q], self.x[q]
        between = 0.5 * (before + after)
        w = self._lumped[:, None]
        rows = λ[:, None]
        backend.add_entries(A, *self.entries(q, rows, (w * (before - between))[:, :, None]))
        backend.add_entries(A, *self.entries(rows, q, (w * (after - 0.5 * between))[:, None, :]))

    def local_error(self) -> float:
        """Error of the last step, in L."""
        error = self.motion.error(self._start, self.scheme.order)
        return float(self.discretization.comm.allreduce(error, op=MPI.MAX))

    def rates(self, readout: Readout) -> dict[str, Array]:
        """Velocities and spins at the nodes by cell, on every rank, in working units."""
        d, lumped, kin = self.discretization, self.lumped, self.kinematics
        spin = kin.turned_back(self.x[lumped.q], self.motion.π)
        spin = kin.turned_spin(self.x[lumped.q], np.einsum("nij,nj->ni", lumped.J_inverse, spin))
        moving = backend.function(d.space)
        moving.x.array[lumped.r] = self.motion.v
        moving.x.array[lumped.q[:, : kin.n_spin]] = spin
        moving.x.scatter_forward()
        q = d.dofs["q"][:, :, : kin.n_spin]
        return readout.gather(v=moving.x.array[d.dofs["r"]], omega=moving.x.array[q])

    def end_step(self) -> None:
        """Take the velocities and momenta that the step leads to."""
        r, q, kin = self.lumped.r, self.lumped.q, self.kinematics
        rate, start = self._rate(), self._start
        mean, _ = momentum(kin, self.lumped.J, self._before[q], self.x[q], self.h, 0.0)
        v, π = rate, kin.turned_spin(self.x[q], mean)
        if not self.scheme.side:
            # What a support adds to the momentum of what it holds is not known: the mean rate stands for it there.
            held_r, held_q = (np.isin(dofs, self.constraints.dofs) for dofs in (r, q))
            v = np.where(held_r, rate, 2.0 * rate - start.v)
            π = np.where(held_q.any(axis=1)[:, None], π, self._left())
        self.motion = Motion(v, π, (v - start.v) / self.h, self.h)

    def _left(self) -> Array:
        """Moment of momentum that a midpoint step leaves the free sections with."""
        q, kin = self.lumped.q, self.kinematics
        b = self._forces.x.array
        b[:] = 0.0
        self.add_apart(np.zeros_like(b), b, b, b)
        backend.sum_over_ranks(self._forces)
        Π, _ = momentum(kin, self.lumped.J, self._before[q], self.x[q], self.h, -0.5)
        # Half of a change of q after the step moves the state between: a quarter of the spin for a quaternion.
        share = 0.125 if kin.n_spin == 3 else 0.5
        return kin.turned_spin(self.x[q], Π) - self.h * share * np.einsum("nij,nj->ni", kin.spin(self.x[q]), b[q])
