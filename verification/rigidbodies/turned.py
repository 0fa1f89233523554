"""A top as one integrator has turned it with one step, held against what is known of it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from verification.rigidbodies.top import State, Top

    Array = NDArray[np.float64]

__all__ = ["Turned"]


@dataclass(frozen=True, eq=False)
class Turned:
    """States of a top after equal steps.

    Args:
        top: With its reference.
        steps: Per second.
        states: After each step, the start first.
    """

    top: Top
    steps: int
    states: tuple[State, ...]

    def at(self, t: float) -> State:
        """State at a time [s]."""
        return self.states[round(t * self.steps)]

    def spin(self, t: float) -> Array:
        """Angular velocity in body axes at a time, shape (3,) [rad/s]."""
        return self.at(t).w

    def place(self, t: float) -> Array:
        """What is compared of the attitude at a time."""
        return self.top.place(self.at(t))

    def spin_error(self, t: float) -> float:
        """Of the angular velocity, relative."""
        return self.top.off_spin(self.spin(t), t)

    def attitude_error(self, t: float) -> float:
        """Of the attitude, or of the centre of mass of a heavy top, relative."""
        return self.top.off_place(self.place(t), t)

    def precession_error(self, t: float) -> float:
        """Of the azimuth of the centre of mass of a heavy top [rad]."""
        x, y, _ = self.place(t)
        known = self.top.reference.states[t]
        turned = complex(x, y) / complex(known["x"], known["y"])
        return abs(float(np.angle(turned)))

    @cached_property
    def energies(self) -> Array:
        """Over that at the start, shape (n,)."""
        found = np.array([self.top.energy(state) for state in self.states])
        return found / abs(found[0])

    @property
    def energy_off(self) -> float:
        """Largest deviation from the start."""
        return float(np.abs(self.energies - self.energies[0]).max())

    @property
    def gain(self) -> float:
        """Largest gain in a step."""
        return float(np.diff(self.energies).max())

    @property
    def momentum_off(self) -> float:
        """Largest deviation of the momentum that no moment changes, over its size."""
        kept = np.array([self.top.momentum(state) for state in self.states])
        return float(np.abs(kept - kept[0]).max() / np.linalg.norm(kept[0]))

    @property
    def axial_off(self) -> float:
        """Largest deviation of the axial momentum of a heavy top, over its size."""
        kept = np.array([self.top.axial(state) for state in self.states])
        return float(np.abs(kept / kept[0] - 1.0).max())
