"""What is kept of a motion: its states at the stored times, and all that its next step depends on."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from dolfinrod.continuum.motion import Motion
    from dolfinrod.continuum.readout import State
    from dolfinrod.result import StepLog

    Array = NDArray[np.float64]

__all__ = ["Mark", "Trajectory"]


@dataclass
class Trajectory:
    """What is kept of a motion.

    Args:
        t: Stored times [s].
        states: Gathered states at them, with velocities "v" and spins "omega".
        log: One row a step.
        iterations: All Newton iterations, failed attempts included.
        factorizations: Of earlier runs.
        seconds: That earlier runs took [s].
    """

    t: list[float] = field(default_factory=list)
    states: list[State] = field(default_factory=list)
    log: list[StepLog] = field(default_factory=list)
    iterations: int = 0
    factorizations: int = 0
    seconds: float = 0.0


@dataclass(frozen=True, eq=False)
class Mark:
    """Where a march stands at the end of a step, whatever comes after it.

    Args:
        t: Time [s].
        x: State on this rank.
        motion: How the nodes move.
        length: Of the next step [s].
        energy: Ledger, in EI/L.
        stored: Number of states stored.
        steps: Number of steps taken.
        iterations: Spent on them.
        strained: The step behind, where other strains than those of the state have resultants.
        touched: What is remembered of contacts, where there are any.
        rested: Whether the motion has ended there, its nodes being slow enough.
    """

    t: float
    x: Array
    motion: Motion
    length: float
    energy: Mapping[str, float]
    stored: int = 0
    steps: int = 0
    iterations: int = 0
    strained: tuple[Array, Array, Array] | None = None
    touched: Any = None
    rested: bool = False
