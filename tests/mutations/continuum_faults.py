"""Faults in the continuum model that leave its weak form as it is: numbers, loads, supports, solver, output."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from petsc4py import PETSc

import numpy as np

import dolfinrod as dr
from dolfinrod.continuum import constraints, loading, problem, quaternion, recovery, reference
from dolfinrod.continuum.discretization import Discretization
from dolfinrod.continuum.newton import Newton
from dolfinrod.continuum.placement import Placement
from dolfinrod.continuum.problem import Problem
from dolfinrod.continuum.readout import Readout
from dolfinrod.continuum.spatial import SpatialRods
from dolfinrod.continuum.terms.point import DeadMoments, FollowerForces
from tests.mutations.planting import all_of, derived, replaced
from tests.scenes import Array


def _straight(right: Any, self: Problem) -> None:
    """Strains are measured from a straight rod, while the curved one is where it is."""
    right(self)
    rods, place = self.scene.rods, self.placement
    starts, normals = (np.array([getattr(rod, q)(np.zeros(1))[0] for rod in rods]) for q in ("centerline", "frames"))
    along = self.s[:, :, None] * place.length * normals[self.rod][:, None, :, 0]
    self.values = replace(self.values, r_0=place.points(starts[self.rod][:, None] + along))
    self.discretization.set(self.values)


def _compliance_turned_back(right: Any, self: Problem) -> None:
    """C = R₀ᵀ diag R₀ in place of R₀ diag R₀ᵀ."""
    right(self)
    R = np.swapaxes(self.layout.on_rods(self.layout.along(self.discretization.points), "frames"), 2, 3)
    sections = [rod.section for rod in self.scene.rods]
    c_n = np.array([section.compliance_n for section in sections])[self.rod] * self.placement.force
    c_m = np.array([section.compliance_m for section in sections])[self.rod] * self.placement.stiffness
    C_n, C_m = (np.einsum("cqij,cj,cqkj->cqik", R, c, R) for c in (c_n, c_m))
    self.values = replace(self.values, C_n=C_n, C_m=C_m)
    self.discretization.set(self.values)


def _reference_kept(right: Any, self: Problem, t: float) -> None:
    """Remembers the quaternions that a step begins with."""
    right(self, t)
    if "multiplier" in self.discretization.dofs:
        self.kept = self.x[self.discretization.owned_nodes("q")].copy()


def _taken_whole(_right: Any, self: Newton, X: PETSc.Vec) -> None:
    """Takes the multipliers from SNES like any unknown."""
    X.ghostUpdate(PETSc.InsertMode.INSERT, PETSc.ScatterMode.FORWARD)
    with X.localForm() as x:
        self.problem.x[:] = x.array_r


def _balanced_along_the_kept(_right: Any, self: Problem, b: Array) -> None:
    """Takes the normal of the unit sphere from the last step."""
    q, λ = self._unit
    along = (self.kept * b[q]).sum(axis=1)
    b[q] -= along[:, None] * self.kept
    self.x[λ] -= along / self._lumped


def _unloaded_end(right: Any, self: Discretization, f: Array) -> list[Array]:
    """The last node gets half of its share of the line loads."""
    vectors = right(self, f)
    last = self.dofs["r"][np.argmax(self.cell), 1]
    for vector in vectors:
        vector[last] *= 0.5
    return vectors


def _whole_line_load(right: Any, scene: dr.Scene, *rest: Any) -> Any:
    """Where a line load begins and ends is not asked."""
    loads = [replace(load, between=None) if isinstance(load, dr.LineForce) else load for load in scene.loads]
    return right(replace(scene, loads=loads), *rest)


def _turned_again(right: Any, self: Readout, states: Sequence[Any]) -> Any:
    """R in place of Rᵀ: force in the section frame is R·N."""
    return tuple(
        replace(rod, n=np.einsum("tsij,tsjk,tsk->tsi", rod.frames, rod.frames, rod.n)) for rod in right(self, states)
    )


def _normal_flipped(right: Any, scene: dr.Scene, kinematics: Any) -> Placement:
    place = right(scene, kinematics)
    return replace(place, spin_axes=-place.spin_axes) if place.spin_axes.shape[1] == 1 else place


def _without_geometric_stiffness(right: Any, self: Problem, A: Any, **options: Any) -> None:
    """Tangent of a rod without force: what forces do as sections turn is left out."""
    N = self.discretization.dofs["N"]
    force = self.x[N].copy()
    self.x[N] = 0.0
    right(self, A, **options)
    self.x[N] = force


def _last_weight_lost(right: Any, degree: int) -> Array:
    weights = right(degree).copy()
    weights[-1] = 0.0
    return weights


def _conjugate(right: Any, p: Array, v: Array) -> Array:
    return right(p * [1.0, -1.0, -1.0, -1.0], v)


def _without_tangent(_right: Any, _self: FollowerForces, _x: Array) -> None:
    return None


FOUR_TIMES_EA = derived(dr.Section, "compliance_n", lambda c: (0.25 * c[0], c[1], c[2]))
GA_SWAPPED = derived(dr.Section, "compliance_n", lambda c: (c[0], c[2], c[1]))
EI_SWAPPED = derived(dr.Section, "compliance_m", lambda c: (c[0], c[2], c[1]))
STRAIGHT = replaced(Problem, "_set_values", _straight)
COMPLIANCE_TURNED_BACK = replaced(Problem, "_set_values", _compliance_turned_back)
FRAMES_R_0_LEFT = replaced(
    SpatialRods, "turned_frames", lambda f, self, q, axes, R_0: R_0 @ f(self, q, axes, 0.0 * R_0 + np.eye(3))
)
MULTIPLIER_KEPT = all_of(
    replaced(Problem, "balance_multipliers", lambda _f, _self, _b: None),
    replaced(Newton, "_take", _taken_whole),
)
GAUGE_KEPT = all_of(
    replaced(Problem, "advance_to", _reference_kept),
    replaced(Problem, "balance_multipliers", _balanced_along_the_kept),
)
NOT_NORMALISED = replaced(SpatialRods, "turn", lambda _f, _self, q, increment: q + increment)
TURNED_TWICE = replaced(SpatialRods, "turn", lambda f, self, q, increment: f(self, q, 2.0 * increment))
FOLLOWING_MOMENT = replaced(DeadMoments, "_spin", lambda _f, self, q: self.kinematics.body_spin(q))
SPIN_SIGN = replaced(DeadMoments, "_spin", lambda f, self, q: -f(self, q))
DEAD_FOLLOWER = replaced(FollowerForces, "residual", lambda _f, self, _x: (self.r, -self.values))
NO_FOLLOWER_TANGENT = replaced(FollowerForces, "tangent", _without_tangent)
FOLLOWER_TANGENT_SIGN = replaced(quaternion, "rotate_gradient", lambda f, p, v: -f(p, v))
TRANSPOSED = replaced(quaternion, "rotate", _conjugate)
NO_GEOMETRIC_STIFFNESS = replaced(Problem, "assemble_tangent", _without_geometric_stiffness)
WEIGHT_LOST = replaced(reference, "quadrature_weights", _last_weight_lost)
HALF_END = replaced(Discretization, "line_loads", _unloaded_end)
WHOLE_LINE_LOAD = replaced(problem, "line_loads", _whole_line_load)
FIRST_ROD_WEIGHS = replaced(
    problem, "line_loads", lambda f, scene, place, rod, s: f(scene, place, np.zeros_like(rod), s)
)
R_IN_N = replaced(Readout, "histories", _turned_again)
TWICE_THE_ENERGY = replaced(Readout, "energy", lambda f, self: 2.0 * f(self))
SECTIONS_SIGN = replaced(recovery, "_cross", lambda f, a, b: -f(a, b))
ROTATIONS_REVERSED = replaced(SpatialRods, "compose", lambda f, self, spins: f(self, spins[::-1]))
LOAD_SQUARED = replaced(loading, "factor", lambda f, *args: f(*args) ** 2)
LINE_LOAD_SQUARED = replaced(problem, "factor", lambda f, *args: f(*args) ** 2)
MOTION_SQUARED = replaced(constraints, "factor", lambda f, *args: f(*args) ** 2)
NORMAL_FLIPPED = replaced(Placement, "of", _normal_flipped)
