"""The paper's scenario as printed, in each reading of what it leaves open: what it gives, and where it cannot work."""

from __future__ import annotations

import time
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.groove import LineSink, Scenario, course
from dolfinrod.result import NotConverged

if TYPE_CHECKING:
    from dolfinrod.result import Result

__all__ = ["PaperRun", "as_printed"]

# The paper's step [s].
STEP = 1e-6


@dataclass(frozen=True)
class PaperRun:
    """One reading by one model.

    Args:
        reading: Units of c and ε₀.
        mesh: "long" or "zone".
        air: Whether air was added, which no equation of the paper has.
        model: That solved it.
        asked: Steps.
        taken: Steps, fewer where it failed.
        iterations: Of Newton's method, a step.
        moved: How far any node has moved across [m].
        speed: Largest, at the end [m/s].
        gap: Least between a fibre and a wall at the end [m].
        walls: Normal force of all walls at the end [N].
        seconds: On the processor [s].
        failure: Why it ended early, in words; empty: it did not.
    """

    reading: str
    mesh: str
    air: bool
    model: str
    asked: int
    taken: int
    iterations: float
    moved: float
    speed: float
    gap: float
    walls: float
    seconds: float
    failure: str = ""

    @property
    def holds(self) -> bool:
        """It ran, or it says where it cannot."""
        return self.taken == self.asked or bool(self.failure)

    @property
    def words(self) -> str:
        """For a list of misses."""
        return f"The paper's groove, {self.reading}, {self.mesh}, {self.model}: {self.taken} of {self.asked} steps"


def as_printed(reading: str, mesh: str, model: str, steps: int, *, air: bool) -> PaperRun:
    """Run a reading.

    Args:
        reading: Of `Scenario.paper`.
        mesh: Likewise.
        model: "continuum" or "discrete".
        steps: How many, of 1 µs.
        air: Whether the default sink is added, at once and not growing.

    Returns:
        What it gives.
    """
    flow = LineSink(ramp=0.0) if air else None
    scenario = replace(Scenario.paper(reading, mesh), air=flow, dt=STEP, t_end=steps * STEP, output=STEP)
    begun = time.process_time()
    try:
        result, failure = scenario.run(model), ""
    except NotConverged as stopped:
        result, failure = stopped.result, str(stopped)
    seconds, over = time.process_time() - begun, course(result, scenario)
    return PaperRun(
        reading=reading,
        mesh=mesh,
        air=air,
        model=model,
        asked=steps,
        taken=len(result.log),
        iterations=float(np.mean([step.iterations for step in result.log])) if result.log else float("nan"),
        moved=max(float(np.abs(rod.r[-1] - rod.r[0])[:, 1:].max()) for rod in result.rods),
        speed=float(over.speed[-1]),
        gap=_gap(result),
        walls=float(over.walls[-1]),
        seconds=seconds,
        failure=failure,
    )


def _gap(result: Result) -> float:
    """Least of all fibres and walls."""
    felt = [one for history in result.contacts for one in history.rods if one is not None]
    return min(float(one.gap[-1].min()) for one in felt)
