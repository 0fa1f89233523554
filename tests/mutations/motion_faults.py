"""Faults in the motion of both models: inertia, drag, weight, damping."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

import discrete.dynamics
from discrete.damping import Damping
from discrete.drag import Drag as DiscreteDrag
from discrete.loads import Loads
from discrete.momentum import Inertia
from discrete.step import Step
from dolfinrod.continuum import moving
from dolfinrod.continuum.discretization import Discretization
from dolfinrod.continuum.drag import Drag
from dolfinrod.continuum.lumped import Lumped
from dolfinrod.continuum.motion import Motion
from dolfinrod.continuum.moving import Moving
from tests.mutations.planting import Plant, all_of, replaced
from tests.scenes import Array


def _held_in_space(right: Any, self: Inertia, R: Array, Ω: Array, ΔΩ: Array, dt: float) -> Array:
    """J* taken for components in space."""
    ω, Δω = (np.einsum("nij,nj->ni", R, vectors) for vectors in (Ω, ΔΩ))
    return right(self, np.broadcast_to(np.eye(3), R.shape), ω, Δω, dt)


def _blocks_in_space(right: Any, self: Inertia, R: Array, ω: Array, _Ω: Array, *rest: Any) -> Array:
    return right(self, np.broadcast_to(np.eye(3), R.shape), ω, ω, *rest)


def _gyroscopic_before(right: Any, self: Inertia, R: Array, Ω: Array, ΔΩ: Array, dt: float) -> Array:
    """Ω₀ × J* Ω₀ in place of Ω₁ × J* Ω₁."""
    still = right(self, R, 0.0 * Ω, 0.0 * ΔΩ, dt)
    at_start = right(self, R, Ω - ΔΩ, 0.0 * ΔΩ, dt)
    return right(self, R, 0.0 * Ω, ΔΩ, dt) + at_start - still


def _carried_before(right: Any, self: Step) -> tuple[Array, Array]:
    """x₁ = x₀ + Δt v₀."""
    x, R = right(self)
    return x - self.dt * self.Δv, R


def _whole_ends(right: Any, *args: Any, whole_ends: bool) -> tuple[Array, Array]:
    return right(*args, whole_ends=not whole_ends)


def _half_inside(right: Any, *args: Any, whole_ends: bool) -> tuple[Array, Array]:
    """Of one rod."""
    m, J_star = right(*args, whole_ends=whole_ends)
    m[1:-1] *= 0.5
    return m, J_star


def _at_rest_before(right: Any, self: Damping, dt: float, before: Any) -> Any:
    """The strain itself in place of its change over the step."""
    return right(self, dt, replace(before, θ=0.0 * before.θ, ε=0.0 * before.ε))


def _carried_along(right: Any, self: Moving) -> Array:
    """Momentum that turns with its section: without ω × Jω."""
    q = self.lumped.q
    start, kin = self._start.π, self.kinematics
    return right(self) + start - kin.turned_spin(self.x[q], kin.turned_back(self._before[q], start))


def _turned_inertia(right: Any, kin: Any, J: Array, q_0: Array, *rest: Any) -> Any:
    """J that stays in space as the sections turn."""
    once = np.stack([kin.turned_back(q_0, J[:, :, k]) for k in range(3)], axis=2)
    return right(kin, np.stack([kin.turned_back(q_0, once[:, k]) for k in range(3)], axis=1), q_0, *rest)


def _whole_end_nodes(right: Any, problem: Any) -> Lumped:
    """Those with the smallest mass are the ends of rods of equal elements."""
    lumped = right(problem)
    return replace(lumped, m=np.where(lumped.m < 1.01 * lumped.m.min(), 2.0 * lumped.m, lumped.m))


def _half_between(right: Any, problem: Any) -> Lumped:
    """Nodes between elements keep the share of one of them."""
    lumped = right(problem)
    inner = np.isclose(lumped.m, 2.0 * lumped.m.min())
    return replace(lumped, m=np.where(inner, 0.5 * lumped.m, lumped.m))


def _mean_velocity(right: Any, v: Array, π: Array, a: Array | None = None, h: float = np.inf) -> Motion:
    """Velocity in the middle of a step kept for that at its end."""
    return right(v, π) if a is None else right(v - 0.5 * h * a, π, a, h)


def _minus(right: Any, *args: Any) -> Any:
    return -right(*args)


NO_GYROSCOPIC: Plant = all_of(
    replaced(Inertia, "moment", lambda f, self, R, Ω, ΔΩ, dt: f(self, R, 0.0 * Ω, ΔΩ, dt)),
    replaced(Inertia, "blocks", lambda f, self, R, ω, Ω, *rest: f(self, R, ω, 0.0 * Ω, *rest)),
)
HELD_IN_SPACE = all_of(replaced(Inertia, "moment", _held_in_space), replaced(Inertia, "blocks", _blocks_in_space))
GYROSCOPIC_BEFORE = replaced(Inertia, "moment", _gyroscopic_before)
CARRIED_BEFORE = replaced(Step, "configuration", _carried_before)
WHOLE_ENDS = replaced(discrete.dynamics, "node_masses", _whole_ends)
HALF_INSIDE = replaced(discrete.dynamics, "node_masses", _half_inside)
PUSHED_BY_AIR = all_of(replaced(DiscreteDrag, "force", _minus), replaced(DiscreteDrag, "blocks", _minus))
TWICE_THE_WEIGHT = replaced(Loads, "_per_element", lambda f, self, load: 2.0 * f(self, load))
NO_RATE = replaced(Damping, "over", _at_rest_before)

NO_GYROSCOPIC_TERM = replaced(Moving, "_gained", _carried_along)
INERTIA_HELD_IN_SPACE = replaced(moving, "momentum", _turned_inertia)
MEAN_MOMENTUM = replaced(moving, "momentum", lambda f, *args: f(*args[:-1], 0.0))
MEAN_VELOCITY = replaced(moving, "Motion", _mean_velocity)
WHOLE_END_NODES = replaced(Lumped, "of", _whole_end_nodes)
HALF_BETWEEN = replaced(Lumped, "of", _half_between)
AIR_PUSHES = all_of(
    replaced(Drag, "force", _minus),
    replaced(Drag, "gradient", lambda f, *args: tuple(-part for part in f(*args))),
)
WEIGHT_TWICE = replaced(Discretization, "line_loads", lambda f, self, q: [2.0 * vector for vector in f(self, q)])
