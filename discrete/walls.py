"""Surfaces and other rods in the steps of a motion: what they do to a rod, and whether a step may end."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from discrete.grip import DEEP, HALF_TURN, MOST_RENEWALS, ROLLED
from discrete.step import PiercedError, StepLostError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.step import Step
    from discrete.surroundings import Surroundings
    from discrete.touched import Touched

    Array = NDArray[np.float64]

__all__ = ["Walls"]


class Walls:
    """Surfaces during one step after the other.

    Args:
        contacts: The contacts of the scene.

    Attributes:
        contacts: As above.
        renewals: How often multipliers have been renewed in this step.
    """

    def __init__(self, contacts: Surroundings) -> None:
        self.contacts, self._made, self.renewals = contacts, b"", 0

    def begin(self, t: float) -> None:
        """A step from the last state that counts leads to time t."""
        self.contacts.begin(t)
        self.renewals = 0

    def press(self, x: Array, frames: Array) -> Array:
        """Forces and moments by rows, shape (7, n_nodes), at positions by rows and section frames (n_nodes, 3, 3)."""
        return self.contacts.force(x.T, frames).T

    @property
    def changed(self) -> bool:
        """Whether other nodes touch and stick than where `touched` or `coupled` was asked for last."""
        return self.contacts.pattern != self._made

    @property
    def foreign(self) -> bool:
        """Whether factors are of no use for that: what stands beside them where rods touch rods foresees it as well."""
        return self.changed and self.contacts.others is None

    def touched(self) -> Touched:
        """Resistance where `press` was asked for last."""
        self._made = self.contacts.pattern
        return self.contacts.blocks()

    def coupled(self) -> Touched | None:
        """Resistance with what other rods do, where `press` was asked for last; None where there are none."""
        if self.contacts.others is None:
            return None
        self._made = self.contacts.pattern
        return self.contacts.answers()

    def agree(self, step: Step, *, exact: bool) -> bool:
        """Whether a step may end where its last increment has led.

        Args:
            step: There.
            exact: Whether that increment was round-off.

        Returns:
            Whether the same nodes touch and stick as those it was found for, none too deep.

        Raises:
            StepLostError: A section that rubs turned too far, renewals do not help, or a rod went through another.
        """
        x, R = step.configuration()
        self.press(x, R.transpose(2, 0, 1))
        if not exact and (self.changed or not self.contacts.settled):
            return False
        if self.contacts.others is not None and (through := self.contacts.others.pierced):
            raise PiercedError(through)
        if self.contacts.rubbing and step.dt * float(np.abs(step.ω).max()) > HALF_TURN:
            raise StepLostError(ROLLED)
        if self.contacts.renew():
            return True
        self.renewals += 1
        if self.renewals > MOST_RENEWALS:
            raise StepLostError(DEEP)
        return False
