"""Faults in contact: most of them in what both models share, the law at a point, and some in what each makes of it."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from discrete.contact import Contacts as DiscreteContacts
from dolfinrod.continuum import contact as continuum_contact
from dolfinrod.continuum.contact import Contacts
from dolfinrod.scene import Cylinder, Plane, Touch, rubbing, touch
from dolfinrod.scene.pressing import Pressing
from dolfinrod.scene.reply import Booked, Gradient, Reply
from dolfinrod.scene.rubbing import Pressed, Rubbing, Step, rubbed
from dolfinrod.scene.surfaces.surface import Closest
from tests.mutations.contact_scenes import RADIUS
from tests.mutations.planting import all_of, replaced
from tests.scenes import Array


def _without_anchors(right: Any, self: Touch) -> Booked:
    booked: Booked = right(self)
    self._u[:] = 0.0
    return booked


def _in_a_fixed_frame(right: Any, self: Touch, X: Array, turned: Array) -> Step:
    """The way since where the rods were in space, not on the wall."""
    on_the_wall, self._X_0 = self._X_0, self._end.back(self._x_0)
    step: Step = right(self, X, turned)
    self._X_0 = on_the_wall
    return step


def _longer_normal(right: Any, self: Any, x: Array) -> Closest:
    closest: Closest = right(self, x)
    return replace(closest, normal=1.1 * closest.normal)


def _from_the_centreline(right: Any, self: Any, x: Array) -> Closest:
    closest: Closest = right(self, x)
    return replace(closest, distance=closest.distance + RADIUS)


def _flat(right: Any, self: Any, x: Array) -> Closest:
    closest: Closest = right(self, x)
    return replace(closest, curvature=0.0 * closest.curvature)


def _no_moment(right: Any, *args: Any) -> Reply:
    reply: Reply = right(*args)
    return replace(reply, moment=0.0 * reply.moment)


def _no_slope_of_the_moment(right: Any, *args: Any) -> Gradient:
    change: Gradient = right(*args)
    return replace(change, m_x=0.0 * change.m_x, m_turn=0.0 * change.m_turn)


def _drawn_everywhere(
    _right: Any, self: Pressing, _X: Array, gap: Array, λ: Array, _torn: Array
) -> tuple[Array, Array, Array, Array]:
    """p = ε (g_0 − g), below zero where the gap is wider."""
    p, slope = self.law.drawn(gap, λ)
    return p, slope, np.ones(len(gap), dtype=bool), p


def _never_released(
    right: Any, self: Pressing, X: Array, gap: Array, λ: Array, torn: Array
) -> tuple[Array, Array, Array, Array]:
    """What was pressed once stays so."""
    p, slope, pressed, expected = right(self, X, gap, λ, torn)
    kept = self._once = pressed | getattr(self, "_once", False)
    drawn, stiff = self.law.drawn(gap, λ)
    return np.where(kept, drawn, p), np.where(kept, stiff, slope), kept, np.where(kept, drawn, expected)


def _not_tangential(right: Any, pressed: Pressed, v: Array, *rest: Any) -> Rubbing:
    """Anchors pull along the normal, too."""
    rubbing: Rubbing = right(replace(pressed, n=0.0 * pressed.n), v, *rest)
    return rubbing


def _limit_before(right: Any, self: Touch, X: Array, turned: Array) -> Step:
    """|t| ≤ μ p with the pressure where the step began."""
    step: Step = right(self, X, turned)
    if step.rubbing is None:
        return step
    p = self._pressing.law.pressure(self._gap_0, self._λ_0)[0][step.on]
    before = replace(step.pressed, p=p)
    return replace(
        step,
        rubbing=rubbed(
            before,
            step.v,
            self._friction.mu,
            self._ε_T,
            self._clings[step.on],
            self._glides[step.on],
            self._slid[step.on],
        ),
    )


def _anchors_in_space(right: Any, self: Touch, X: Array, turned: Array) -> Step:
    """They do not turn with the wall."""
    on_the_wall, self._u = self._u, self._u @ self._pose(self._t_0).Q.T @ self._end.Q
    step: Step = right(self, X, turned)
    self._u = on_the_wall
    return step


def _anchors_stay(right: Any, *args: Any) -> Rubbing:
    """However far the rod slides from them."""
    rubbing: Rubbing = right(*args)
    return replace(rubbing, anchored=rubbing.u)


def _touched_all_the_way(right: Any, self: Touch, t: float) -> None:
    right(self, t)
    self._afar = np.zeros_like(self._afar)


def _stale_multipliers(right: Any, self: Touch, t: float) -> None:
    """Those of the last attempt, whatever came of it."""
    stale = getattr(self, "_λ", None)
    right(self, t)
    if stale is not None:
        self._λ = stale


def _turned_with_the_wall(right: Any, self: Touch, X: Array, turned: Array) -> Step:
    """The turn of the sections in space taken for that against the wall."""
    step: Step = right(self, X, turned + self._wall_turn)
    return step


def _without_friction(right: Any, pressed: Pressed, *rest: Any) -> Array:
    return np.zeros_like(right(pressed, *rest))


def _as_on_a_plane(right: Any, pressed: Pressed) -> Array:
    """∂(p n)/∂X without p ∂n/∂X."""
    tangent: Array = right(replace(pressed, n_X=0.0 * pressed.n_X))
    return tangent


def _turns_in_one(right: Any, self: Contacts) -> list[float]:
    """Turns since the rods were placed, not over the step."""
    before = self._q_0
    booked: list[float] = right(self)
    self._q_0 = before
    return booked


def _at_the_end(_right: Any, self: Pressing, _start: Array, gap: Array, λ: Array) -> tuple[Array, Array, Array, Array]:
    """The pressure after a step in place of the mean over it."""
    p, slope = self.law.pressure(gap, λ)
    return (*self._grazing(p, slope, p > 0.0, gap), p)


def _at_the_start(_right: Any, self: Pressing, start: Array, gap: Array, λ: Array) -> tuple[Array, Array, Array, Array]:
    """The pressure before it."""
    p, _ = self.law.pressure(start, λ)
    return (*self._grazing(p, np.zeros_like(gap), p > 0.0, gap), p)


def _half_way(_right: Any, self: Pressing, start: Array, gap: Array, λ: Array) -> tuple[Array, Array, Array, Array]:
    """The pressure at the middle of a step in place of the mean over it."""
    p, slope = self.law.pressure(0.5 * (start + gap), λ)
    return (*self._grazing(p, 0.5 * slope, p > 0.0, gap), p)


def _forgotten(_right: Any, self: Touch, memory: Any, t: float) -> None:
    """But for where the points are."""
    self.place(memory["x"], t)


def _rubbed_in_space(right: Any, self: Touch) -> Booked:
    """Friction times the way in space, not past the wall."""
    moved = self._x - self._x_0
    traction = self._reply.traction
    booked: Booked = right(self)
    return replace(booked, rubbed=-np.einsum("ni,ni->n", traction, moved))


def _whole_ends(right: Any, problem: Any) -> Array:
    """The nodes at ends of rods, with the smallest lengths, for as much as those between elements."""
    lengths: Array = right(problem)
    return np.where(lengths < 1.01 * lengths[lengths > 0.0].min(), 2.0 * lengths, lengths)


def _in_axes_of_the_wall(right: Any, self: Touch, x: Array, turn: Array) -> Reply:
    """Forces that are not turned into space."""
    reply: Reply = right(self, x, turn)
    Q = self._acting.Q
    return replace(reply, normal=reply.normal @ Q, traction=reply.traction @ Q, moment=reply.moment @ Q)


def _nothing_stored(right: Any, self: Touch) -> Array:
    return np.zeros_like(right(self))


def _stays_soft(right: Any, self: Touch, by: float) -> None:
    """The softest wall on the way to what is pressed is kept."""
    if by != 1.0:
        right(self, by)


def _whole_discrete_ends(right: Any, self: DiscreteContacts, *args: Any) -> None:
    """The same of a single rod."""
    right(self, *args)
    for pair in self.pairs:
        pair.share[[0, -1]] *= 2.0


def _discrete_turns_in_one(right: Any, self: DiscreteContacts, *args: Any) -> Any:
    before = self._R_0
    booked = right(self, *args)
    self._R_0 = before
    return booked


WITHOUT_STICK = replaced(Touch, "accept", _without_anchors)
FIXED_FRAME = replaced(Touch, "_led", _in_a_fixed_frame)
NOT_UNIT = all_of(*(replaced(wall, "closest", _longer_normal) for wall in (Plane, Cylinder)))
FROM_THE_CENTRELINE = all_of(*(replaced(wall, "closest", _from_the_centreline) for wall in (Plane, Cylinder)))
NO_MOMENT = all_of(replaced(Touch, "respond", _no_moment), replaced(Touch, "gradient", _no_slope_of_the_moment))
ADHESIVE = replaced(Pressing, "at", _drawn_everywhere)
NEVER_RELEASED = replaced(Pressing, "at", _never_released)
NOT_TANGENTIAL = replaced(touch, "rubbed", _not_tangential)
LIMIT_BEFORE = replaced(Touch, "_led", _limit_before)
ANCHORS_IN_SPACE = replaced(Touch, "_led", _anchors_in_space)
ANCHORS_STAY = replaced(touch, "rubbed", _anchors_stay)
WALL_DOES_NOT_TURN = replaced(Touch, "_led", _turned_with_the_wall)
IN_AXES_OF_THE_WALL = replaced(Touch, "respond", _in_axes_of_the_wall)
TOUCHED_ALL_THE_WAY = replaced(Touch, "begin", _touched_all_the_way)
STALE_MULTIPLIERS = replaced(Touch, "begin", _stale_multipliers)
NOT_RENEWED = replaced(Touch, "renew", lambda *_: True)
FORGOTTEN = replaced(Touch, "recall", _forgotten)
AT_THE_END = replaced(Pressing, "mean", _at_the_end)
AT_THE_START = replaced(Pressing, "mean", _at_the_start)
HALF_WAY = replaced(Pressing, "mean", _half_way)
NOTHING_STORED = replaced(Touch, "stored", _nothing_stored)
RUBBED_IN_SPACE = replaced(Touch, "accept", _rubbed_in_space)
AS_ON_A_PLANE = replaced(Pressed, "gradient", _as_on_a_plane)
NO_CURVATURE = replaced(Cylinder, "closest", _flat)
NO_TANGENT_OF_FRICTION = replaced(rubbing, "traction_gradient", _without_friction)
STAYS_SOFT = replaced(Touch, "soften", _stays_soft)

WHOLE_ENDS = replaced(continuum_contact, "node_lengths", _whole_ends)
TURNS_IN_ONE = replaced(Contacts, "accept", _turns_in_one)
WHOLE_DISCRETE_ENDS = replaced(DiscreteContacts, "__init__", _whole_discrete_ends)
DISCRETE_TURNS_IN_ONE = replaced(DiscreteContacts, "accept", _discrete_turns_in_one)
