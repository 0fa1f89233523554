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
from dolfinrod.continuum.turning import NoTurning, Turning
from dolfinrod.scene import Gravity, LineForce, Steady

if TYPE_CHECKING:
    from collections.abc import Iterable

    from petsc4py import PETSc

    from numpy.typing import NDArray

    from dolfinrod.continuum.discretization import Discretization
    from dolfinrod.continuum.placement import Placement
    from dolfinrod.continuum.problem import Block
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
        parts: Residuals of inertia, elasticity, loads, air and contact in the last step, on all local dofs.
        motion: How the nodes move.
        turns: Whether any section has rotary inertia, on any rank.
    """

    def __init__(self, scene: Scene, discretization: Discretization, placement: Placement, scheme: Scheme) -> None:
        self.scheme, self.level = scheme, scheme.level
        super().__init__(scene, discretization, placement)
        self.lumped = Lumped.of(self)
        self.motion = Motion(np.zeros(self.lumped.r.shape), np.zeros((len(self.lumped.q), self.kinematics.n_spin)))
        self._before, self._start = self.x.copy(), self.motion
        self.turns = discretization.comm.allreduce(bool(self.lumped.J.any()), op=MPI.LOR)
        self._turning = (Turning if self.turns else NoTurning)(self.kinematics, scheme, self.lumped.J)
        lines = [load for load in scene.loads if isinstance(load, Gravity | LineForce)]
        self._weights = [
            summed(self, vector)
            for load, (history, vector) in zip(lines, self.line_loads, strict=True)
            if isinstance(load, Gravity) and isinstance(history, Steady)
        ]
        self._drag = None if scene.air is None else Drag(self, scene.air)
        self._parts = [backend.function(discretization.space) for _ in range(5)]
        self.parts = [part.x.array for part in self._parts]
        self._is_held = np.isin(np.arange(len(self.x)), self.constraints.dofs)
        self._set_levels()

    def _set_levels(self) -> None:
        """Weights of the states before and after a step in the one at which forces act: no multipliers there."""
        d, level = self.discretization, self.scheme.level
        self._nodal = np.unique(np.concatenate([d.dofs[f].ravel() for f in ("r", "q")]))
        self._quaternions = np.unique(d.dofs["q"].reshape(-1, d.dofs["q"].shape[2]), axis=0)
        self._multipliers = np.unique(d.dofs.get("multiplier", np.zeros(0, dtype=np.int32)))
        self._after_part, self._before_part = np.ones(len(self.x)), np.zeros(len(self.x))
        self._after_part[self._nodal], self._before_part[self._nodal] = level, 1.0 - level
        self._after_part[self._multipliers] = 0.0
        self._shrink = d.matrix.createVecLeft()
        self._shrink.set(1.0)
        self._shrink.array[np.concatenate([self.lumped.r.ravel(), self.lumped.q.ravel()])] = level

    def begin_step(self, t: float, dt: float) -> None:
        """Put the supports at the end of a step from t on, and the loads where the scheme has them [s]."""
        self._before[:] = self.x
        self._start = self.motion
        self.h = dt / self.lumped.second
        self.discretization.begin_step(self._before, dt, self.scheme.level)
        self.advance_to(t + self.scheme.level * dt)
        self.x[self.constraints.dofs] = self.constraints.values(t + dt)
        if self.contacts is not None:
            self.contacts.begin(t + dt)
        self._r_0 = self._before[self.lumped.r]
        self._turning.begin(self._before[self.lumped.q], self._start.π, self.h)
        self._from_before = self._before_part * self._before

    def add_residual(self, b: Array) -> None:
        """Add this rank's residual of the step to the local array b."""
        self._add_apart(b, b, b, b, b)

    def _add_apart(self, inertia: Array, elastic: Array, loads: Array, drag: Array, contact: Array) -> None:
        """Add this rank's residuals of inertia, elasticity, loads, air and contact, each to its own local array."""
        lumped, rate = self.lumped, self._rate()
        per_step = 1.0 / (self.scheme.level * self.h)
        inertia[lumped.r] += (per_step * lumped.m)[:, None] * (rate - self._start.v)
        inertia[lumped.q] += per_step * self._turning.residual(self.x[lumped.q])
        self._add_elastic(elastic)
        at = self._acting_at() if self._acting or self._drag is not None or self.contacts is not None else self.x
        self.add_loads(loads, at)
        if self._drag is not None:
            drag[lumped.r] -= self._drag.force(at[lumped.r], at[lumped.q], rate, self.t)
        if self.contacts is not None:
            self.contacts.add_residual(contact, at[lumped.q])

    def _add_elastic(self, b: Array) -> None:
        """Add the residual of the forms, at the state at which forces act."""
        if self.scheme.level == 1.0:
            self.discretization.residual.add_vector(b)
            return
        x = self.x
        after = x.copy()
        x[:] = self._between(after)
        self.discretization.residual.add_vector(b)
        x[:] = after
        # The nodes are on the sphere after the step, not between.
        b[self._multipliers] = 0.0

    def _rate(self) -> Array:
        """Mean velocity of this rank's own nodes in the step."""
        r = self.lumped.r
        return (self.x[r] - self._r_0) / self.h

    def change(self) -> Array:
        """What the last step changed of this rank's own positions and rotations, nothing else."""
        moved = np.zeros(len(self.x))
        moved[self._nodal] = self.x[self._nodal] - self._before[self._nodal]
        return moved[: self.discretization.n_owned]

    def potential(self) -> float:
        """This rank's part of the potential energy of the weights that always act in full, zero at the origin."""
        n = self.discretization.n_owned
        return sum(float(vector[:n] @ self.x[:n]) for vector in self._weights)

    def _between(self, after: Array) -> Array:
        """The state in the forms: positions and rotations between, resultants as they are, no multipliers."""
        return self._after_part * after + self._from_before

    def _acting_at(self) -> Array:
        """The same with unit quaternions, for forces that follow the rods."""
        if self.scheme.level == 1.0:
            return self.x
        x = self._between(self.x)
        if len(self._multipliers):
            p = x[self._quaternions]
            x[self._quaternions] = p / np.sqrt(np.einsum("ni,ni->n", p, p))[:, None]
        return x

    def side(self) -> Array:
        """Rotations of this rank's own nodes along whose unit sphere the balance of moments is taken."""
        return (self.x if self.scheme.side else self._before)[self.lumped.q]

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
        per_step = 1.0 / (self.scheme.level * h)
        mass = (per_step / h * self.lumped.m)[:, None, None] * np.eye(r.shape[1])
        backend.add_entries(A, *self.entries(r, r, mass))
        backend.add_entries(A, *self.entries(q, q, per_step * self._turning.tangent(after[q])))
        if self._drag is not None:
            self._add_drag(A, self._drag)
        if self.contacts is not None:
            for block in self.contacts.blocks(self._acting_at()[q]):
                backend.add_entries(A, *self.entries(*block))
        A.assemble()

    def _contact_stiffnesses(self) -> Iterable[Block]:
        """None among those by the state between: contact is linearised by the one after the step."""
        return ()

    def _add_drag(self, A: PETSc.Mat, drag: Drag) -> None:
        """Tangent of the air's force."""
        r, q = self.lumped.r, self.lumped.q
        at = self._acting_at()
        by_rate, by_q = drag.gradient(at[r], at[q], self._rate(), self.t)
        backend.add_entries(A, *self.entries(r, r, -by_rate / self.h))
        backend.add_entries(A, *self.entries(r, q, -self.scheme.level * by_q))

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
        return float(self.discretization.comm.allreduce(self.motion.error(self._start, self.scheme.order), op=MPI.MAX))

    def end_step(self) -> None:
        """Take the velocities and momenta that the step leads to."""
        r, q, rate, start = self.lumped.r, self.lumped.q, self._rate(), self._start
        after = self.x[q]
        self._take_apart()
        if self.scheme.side:
            self.motion = Motion(rate, self._turning.mean(after), (rate - start.v) / self.h, self.h)
            return
        # What a support adds to the momentum of what it holds is not known: the mean rate stands for it.
        v = np.where(self._is_held[r], rate, 2.0 * rate - start.v)
        π = self._turning.left(after, sum(b[q] for b in self.parts[1:]))
        held = self._is_held[q].any(axis=1)
        if held.any():
            π[held] = self._turning.mean(after)[held]
        self.motion = Motion(v, π, (v - start.v) / self.h, self.h)

    def _take_apart(self) -> None:
        """Give `parts` what the step has led to."""
        for b in self.parts:
            b[:] = 0.0
        self._add_apart(*self.parts)
        for part in self._parts:
            backend.sum_over_ranks(part)
