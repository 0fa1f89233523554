"""A scene in motion as a system of equations: one step in time, with the inertia of the rods at their nodes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from mpi4py import MPI

import numpy as np

from dolfinrod.continuum import backend
from dolfinrod.continuum.drag import Drag
from dolfinrod.continuum.lumped import Lumped, NodeBlocks
from dolfinrod.continuum.motion import Motion
from dolfinrod.continuum.problem import Problem
from dolfinrod.continuum.turning import NoTurning, Turning

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
        parts: Residuals of inertia, elasticity, loads, air and contact in the last step, shape (5, local dofs).
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
        self._drag = None if scene.air is None else Drag(self, scene.air)
        self.parts, self._carrier = np.zeros((5, len(self.x))), backend.function(discretization.space)
        self._acts = slice(3 if self._drag is None and self.contacts is None else 5)
        self._is_held = np.isin(np.arange(len(self.x)), self.constraints.dofs)
        self._set_levels()
        self._set_blocks()

    def _set_levels(self) -> None:
        """Weights of the states before and after a step in the one at which forces act: no multipliers there."""
        d, level = self.discretization, self.scheme.level
        self._nodal = np.unique(np.concatenate([d.dofs[f].ravel() for f in ("r", "q")])).astype(np.intp)
        self._quaternions = np.unique(d.dofs["q"].reshape(-1, d.dofs["q"].shape[2]), axis=0).astype(np.intp)
        self._multipliers = np.unique(d.dofs.get("multiplier", np.zeros(0, dtype=np.int32))).astype(np.intp)
        self._after_part, self._before_part = np.ones(len(self.x)), np.zeros(len(self.x))
        self._after_part[self._nodal], self._before_part[self._nodal] = level, 1.0 - level
        self._after_part[self._multipliers] = 0.0
        self._shrink = d.matrix.createVecLeft()
        self._shrink.set(1.0)
        self._shrink.array[np.concatenate([self.lumped.r.ravel(), self.lumped.q.ravel()])] = level

    def _set_blocks(self) -> None:
        """Where inertia, and the conditions of a mean state, enter the tangent."""
        r, q = self.lumped.r.reshape(-1, 1), self.lumped.q
        places = [(r, r), (q, q)]
        if self.scheme.level != 1.0 and self._lumped is not None:
            rows, λ = self._unit
            places += [(rows, λ[:, None]), (λ[:, None], rows)]
        self._blocks = NodeBlocks(self, places)

    def begin_step(self, t: float, dt: float) -> None:
        """Put the supports at the end of a step from t on, and the loads where the scheme has them [s]."""
        self._before[:] = self.x
        self._start = self.motion
        self.h = dt / self.lumped.second
        self.discretization.begin_step(self._before, dt, self.scheme.level)
        self.t = t + self.scheme.level * dt
        self._acting = [build(self.t) for build in self._point_terms]
        self.x[self.constraints.dofs] = self.constraints.values(t + dt)
        if self.contacts is not None:
            self.contacts.begin(t + dt)
        self._r_0 = self._before[self.lumped.r]
        self._per_step = 1.0 / (self.scheme.level * self.h)
        self._m_per_step = (self._per_step * self.lumped.m)[:, None]
        self._turning.begin(self._before[self.lumped.q], self._start.π, self.h)
        self._from_before = self._before_part * self._before

    def add_residual(self, b: Array) -> None:
        """Add this rank's residual of the step to the local array b; `parts` keeps what it is made of."""
        self.parts[self._acts] = 0.0
        self._add_apart(*self.parts)
        b += self.parts[self._acts].sum(axis=0)

    def _add_apart(self, inertia: Array, elastic: Array, loads: Array, drag: Array, contact: Array) -> None:
        """Add this rank's residuals of inertia, elasticity, loads, air and contact, each to its own local array."""
        r, q, rate = self.lumped.r, self.lumped.q, self._rate()
        inertia[r] = self._m_per_step * (rate - self._start.v)
        inertia[q] = self._per_step * self._turning.residual(self.x[q])
        self._add_elastic(elastic)
        at = self._acting_at() if self._acting or self._drag is not None or self.contacts is not None else self.x
        self.add_loads(loads, at)
        if self._drag is not None:
            drag[r] -= self._drag.force(at[r], at[q], rate, self.t)
        if self.contacts is not None:
            self.contacts.add_residual(contact, at[q])

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
        r, q = self.lumped.r, self.lumped.q
        if self.scheme.level != 1.0:
            A.diagonalScale(None, self._shrink)
        mass = np.repeat(self._m_per_step / self.h, r.shape[1])
        blocks = [mass, self._per_step * self._turning.tangent(after[q])]
        self._blocks.add(A, blocks + self._condition_blocks())
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

    def _condition_blocks(self) -> list[Array]:
        """Unit norm after the step, its multiplier along the rotation before, where the form has both between."""
        if self.scheme.level == 1.0 or self._lumped is None:
            return []
        q, _ = self._unit
        before, after = self._before[q], self.x[q]
        w, half = self._lumped[:, None], 0.25 * (before + after)
        return [w * (before - 2.0 * half), w * (after - half)]

    def local_error(self) -> float:
        """Error of the last step, in L."""
        return float(self.discretization.comm.allreduce(self.motion.error(self._start, self.scheme.order), op=MPI.MAX))

    def end_step(self) -> None:
        """Take the velocities and momenta that the step leads to."""
        r, q, rate, start = self.lumped.r, self.lumped.q, self._rate(), self._start
        after = self.x[q]
        self._add_up()
        if self.scheme.side:
            self.motion = Motion(rate, self._turning.mean(after), (rate - start.v) / self.h, self.h)
            return
        # What a support adds to the momentum of what it holds is not known: the mean rate stands for it.
        v = np.where(self._is_held[r], rate, 2.0 * rate - start.v)
        π = self._turning.left(after, self.parts[1:].sum(axis=0)[q])
        held = self._is_held[q].any(axis=1)
        if held.any():
            π[held] = self._turning.mean(after)[held]
        self.motion = Motion(v, π, (v - start.v) / self.h, self.h)

    def _add_up(self) -> None:
        """Make `parts`, which the last residual has left, those of all ranks."""
        if self.discretization.comm.size > 1:
            for part in self.parts[self._acts]:
                self._carrier.x.array[:] = part
                backend.sum_over_ranks(self._carrier)
                part[:] = self._carrier.x.array
