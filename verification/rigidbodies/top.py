"""Rigid bodies that turn about a fixed point: two without any force, K7, and one heavy, K8."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Protocol

import numpy as np

from verification.references.tops import TopReference, top_reference

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["TOPS", "Integrator", "State", "Top"]

# Upwards, in space.
UP = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True, eq=False)
class State:
    """A body at one time.

    Args:
        R: Attitude, body to space, shape (3, 3).
        w: Angular velocity in body axes, shape (3,) [rad/s].
    """

    R: Array
    w: Array


class Integrator(Protocol):
    """How a model turns a body."""

    @property
    def name(self) -> str:
        """For people."""
        ...

    @property
    def order(self) -> int:
        """Of the error in the step; 0 where it leads elsewhere."""
        ...

    @property
    def keeps_momentum(self) -> bool:
        """Whether it keeps, to round-off, the components of the momentum in space that no moment changes."""
        ...

    @property
    def variational(self) -> bool:
        """Whether it follows from an action: then it keeps what any symmetry does, and the energy only swings."""
        ...

    def states(self, top: Top, dt: float, steps: int) -> Iterator[State]:
        """States after each of so many equal steps [s].

        Raises:
            ArithmeticError: A step has no solution that Newton's method finds.
        """
        ...


@dataclass(frozen=True)
class Top:
    """A body with one point fixed.

    Args:
        name: Of the case.
        title: For people.
        reference: Its motion.
        second: Steps per second for integrators of order two, coarse to fine, each twice the one before.
        first: The same for those of lower order.
        until: Last time that is asked of the latter [s]: what they lose is soon all there is.
        mass: [kg].
        arm: From the fixed point to the centre of mass along a body axis [m].
        g: Gravity, downwards [m/s²].
    """

    name: str
    title: str
    reference: TopReference
    second: tuple[int, ...]
    first: tuple[int, ...]
    until: float
    mass: float = 0.0
    arm: tuple[float, float, float] = (0.0, 0.0, 0.0)
    g: float = 0.0

    def times(self, order: int) -> tuple[float, ...]:
        """At which an integrator of that order is held against the reference [s]."""
        return tuple(t for t in self.reference.states if order > 1 or t <= self.until)

    def steps(self, order: int) -> tuple[int, ...]:
        """Per second, coarse to fine."""
        return self.second if order > 1 else self.first

    @cached_property
    def J(self) -> Array:
        """Inertia about the fixed point (Steiner), shape (3,) [kg m²]."""
        a = np.array(self.arm)
        return np.array(self.reference.J) + self.mass * (a @ a - a * a)

    @property
    def free(self) -> bool:
        """Whether no moment acts."""
        return not any(self.weight)

    @property
    def weight(self) -> Array:
        """In space, shape (3,) [N]."""
        return -self.mass * self.g * UP

    @property
    def start(self) -> State:
        """At t = 0."""
        return State(np.eye(3), np.array(self.reference.w))

    def energy(self, state: State) -> float:
        """½ w·J w − weight · place [J]."""
        return 0.5 * float(self.J @ state.w**2) - float(self.weight @ state.R @ np.array(self.arm))

    def momentum(self, state: State) -> Array:
        """What of the moment of momentum in space no moment changes: all of it, or what is vertical [kg m²/s]."""
        momentum = np.asarray(state.R @ (self.J * state.w))
        return momentum if self.free else np.array([UP @ momentum])

    def axial(self, state: State) -> float:
        """Moment of momentum about the axis of a round heavy body, which turns with it [kg m²/s]."""
        return float(np.array(self.arm) @ (self.J * state.w)) / float(np.linalg.norm(self.arm))

    def place(self, state: State) -> Array:
        """Attitude of a free body, over √2; place of the centre of mass of a heavy one over its distance."""
        if self.free:
            return state.R / np.sqrt(2.0)
        return np.asarray(state.R @ np.array(self.arm)) / np.linalg.norm(self.arm)

    def off_place(self, place: Array, t: float) -> float:
        """Distance from the reference: small angles in rad."""
        known = self.reference.states[t]
        if self.free:
            there = rotation(np.array([known[f"q{i}"] for i in range(4)])) / np.sqrt(2.0)
        else:
            there = np.array([known[c] for c in "xyz"]) / np.linalg.norm(self.arm)
        return float(np.linalg.norm(place - there))

    def off_spin(self, w: Array, t: float) -> float:
        """|w − reference| over |w| at the start."""
        known = self.reference.states[t]
        there = np.array([known[f"w{i}"] for i in (1, 2, 3)])
        return float(np.linalg.norm(w - there) / np.linalg.norm(self.reference.w))


def rotation(q: Array) -> Array:
    """Rotation matrix of a unit quaternion, scalar first, shape (3, 3)."""
    w, v = q[0], q[1:]
    return np.asarray((w * w - v @ v) * np.eye(3) + 2.0 * np.outer(v, v) + 2.0 * w * np.cross(np.eye(3), v))


TOPS = (
    Top(
        name="top-unequal",
        title="Free body of three unequal inertias, tumbling about the middle one",
        reference=top_reference("K7-top-J(1.0, 2.0, 3.0)-w(0.1, 1.0, 0.1)"),
        second=(10, 20, 40, 80),
        first=(20, 40, 80, 160),
        until=5.0,
    ),
    Top(
        name="top-round",
        title="Free round body, nutating",
        reference=top_reference("K7-top-J(1.0, 1.0, 2.0)-w(0.3, 0.0, 2.0)"),
        second=(10, 20, 40, 80),
        first=(20, 40, 80, 160),
        until=5.0,
    ),
    Top(
        name="top-heavy",
        title="Heavy round top on its tip at 150 rad/s, after Géradin and Cardona",
        reference=top_reference("K8-heavytop-w(0.0, 150.0, -4.61538)"),
        second=(1000, 2000, 4000),
        first=(4000, 8000, 16000),
        until=0.1,
        mass=15.0,
        arm=(0.0, 1.0, 0.0),
        g=9.81,
    ),
)
