"""What load stepping has reached so far."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from dolfinrod.continuum.readout import State
    from dolfinrod.result import StepLog

__all__ = ["Path"]


@dataclass
class Path:
    """States accepted so far.

    Args:
        t: Their pseudo-times.
        states: Their gathered states.
        energy: Their strain energies [J].
        log: One row a step.
        iterations: All Newton iterations, failed attempts included.
        stable: Whether the last state is stable; None where that is not known.
        seconds_stability: Time for finding that out, for all states [s].
    """

    t: list[float] = field(default_factory=list)
    states: list[State] = field(default_factory=list)
    energy: list[float] = field(default_factory=list)
    log: list[StepLog] = field(default_factory=list)
    iterations: int = 0
    stable: bool | None = None
    seconds_stability: float = 0.0
