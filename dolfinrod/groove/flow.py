"""All the air of a scenario as one field: the sink, what presses fibres onto the walls, and the roller's bend."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from dolfinrod.groove.air import LineSink
from dolfinrod.groove.pressing import Pressing
from dolfinrod.groove.roller import turned, unrolled
from dolfinrod.scene import Groove, SceneError

if TYPE_CHECKING:
    from dolfinrod.groove.scenario import Scenario

__all__ = ["Flow", "check", "flowing"]

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Flow:
    """Velocity of the air in space.

    Args:
        sink: In the unrolled groove.
        pressing: What presses fibres onto the walls, growing in time as the sink does; None: nothing.
        walls: Of the unrolled groove.
        radius: Of a fibre [m].
        roller: Radius of the roller; None: the groove is straight [m].
    """

    sink: LineSink
    pressing: Pressing | None
    walls: tuple[Groove, ...]
    radius: float
    roller: float | None

    def __call__(self, x: Array, t: float) -> Array:
        """Velocity at points.

        Args:
            x: Shape (n, 3) [m].
            t: Time [s].

        Returns:
            Shape (n, 3) [m/s].
        """
        X = x if self.roller is None else unrolled(x, self.roller)
        u = self.sink(X, t)
        if self.pressing is not None:
            u = u + self.sink.grown(t) * self._onto(self.pressing, X)
        return u if self.roller is None else turned(u, X, self.roller)

    @cached_property
    def _speed(self) -> float:
        return 0.0 if self.pressing is None else self.pressing.speed(2.0 * self.radius)

    def _onto(self, pressing: Pressing, X: Array) -> Array:
        """Of the flow towards the nearest wall."""
        found = [wall.closest(X) for wall in self.walls]
        distance = np.stack([wall.distance for wall in found])
        nearest, every = distance.argmin(axis=0), np.arange(len(X))
        normal = np.stack([wall.normal for wall in found])[nearest, every]
        across = X[:, 2] - self.sink.bottom[1]
        share = pressing.share(distance[nearest, every] - self.radius, across, 2.0 * self.radius)
        return np.asarray(-(self._speed * share)[:, None] * normal)


def check(scenario: Scenario) -> None:
    """What presses is part of the air.

    Raises:
        SceneError: There is none.
    """
    if scenario.pressing is not None and scenario.air is None:
        raise SceneError("must be None where there is no air", field="Scenario.pressing")


def flowing(scenario: Scenario, air: LineSink) -> LineSink | Flow:
    """The air of a scenario: its sink along the bottom, with what a scenario adds to it.

    Args:
        scenario: Whose groove it is.
        air: Its sink, which knows no groove; the nip keeps it from what is before A.

    Returns:
        A field in space.
    """
    (y, z), sign = scenario.section.bottom, -1.0 if scenario.mirrored else 1.0
    begin = max(air.between[0], 0.0) if scenario.bundle.tail else air.between[0]
    sink = replace(air, bottom=(y, sign * z), between=(begin, air.between[1]))
    if scenario.pressing is None and scenario.roller is None:
        return sink
    walls = scenario.section.surfaces(None, mirrored=scenario.mirrored)
    return Flow(sink, scenario.pressing, walls, scenario.bundle.radius, scenario.roller)
