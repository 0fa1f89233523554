"""Stability maps: step × element length × rise of the load, scheme by scheme: converged, dissipated, off, failed.

The paper's fibre, clamped at one end, under the drag of air at 20 m/s as a dead load across it (process.md 2.4,
9.3 mN/m), put on at once or within half a millisecond; nothing touches it. In that time it moves by some millimetres.
"""

from __future__ import annotations

import time
from dataclasses import dataclass
from functools import cache
from math import ceil
from typing import TYPE_CHECKING, Protocol

import numpy as np

from dolfinrod.result import NotConverged
from dolfinrod.scene import Dynamic, ImplicitEuler, LineForce, Midpoint, Steady
from verification.explicit import Explicit, ForwardEuler, Moved, Rule, SymplecticEuler
from verification.explicitlimit import LENGTH, fibre, highest
from verification.patience import CRAWLS, Patience

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.result import Result
    from dolfinrod.scene import Scene

    Array = NDArray[np.float64]

__all__ = ["ENDED", "LIMIT", "RISES", "SCHEMES", "Cell", "Stepper", "cells", "reference"]

# Drag of air at 20 m/s on a fibre of 20 µm (process.md 2.4) [N/m], and the end of the motion [s].
DRAG, ENDED = 9.3e-3, 5e-4
# Within which the load grows [s].
RISES = (0.0, 5e-4)
# Error of the centreline over the way it has gone, and part of the work of the load, beyond which a run is not right.
LIMIT = 1e-2
# Where positions are compared: nodes of every mesh.
STATIONS = LENGTH * np.arange(1, 11) / 10.0
# Elements that all are compared with, no mesh of the maps, and the part of the longest stable step.
FINE, FINE_PART = 100, 0.95


@dataclass(frozen=True)
class Cell:
    """One step length on one mesh.

    Args:
        scheme: In words.
        rise: In which the load grows [s].
        l: Length of the elements [m].
        dt: Step [s].
        outcome: "converged"; "dissipated": finished, but the steps took more than `LIMIT` of the work of the load;
            "off": finished with an error beyond `LIMIT` that is not theirs alone; "failed": refused, or numbers beyond
            all bounds, or more energy made than the load put in.
        error: Of the centreline, over the way it has gone; NaN where it failed.
        lost: Energy that the steps made, over the work of the load; negative where they destroyed it.
        seconds: Of this machine for a simulated second; NaN where it failed.
        limit: 2/ω_max of the matrices of an explicit scheme [s]; None: not explicit.
        reason: Of a failure.
    """

    scheme: str
    rise: float
    l: float
    dt: float
    outcome: str
    error: float
    lost: float
    seconds: float
    limit: float | None
    reason: str

    @property
    def holds(self) -> bool:
        """A scheme fails beyond its limit and only there, forward Euler everywhere, an implicit one nowhere."""
        if self.scheme == ForwardEuler().name:
            return self.outcome == "failed"
        return (self.outcome == "failed") == (self.limit is not None and self.dt > self.limit)


class Stepper(Protocol):
    """A scheme on a model."""

    @property
    def name(self) -> str:
        """In words."""

    @property
    def steps(self) -> tuple[float, ...]:
        """Steps that are worth trying [s]."""

    def cell(self, elements: int, rise: float, dt: float) -> Cell:
        """Go to the end."""


@dataclass(frozen=True)
class Continuum:
    """Cubic elements of the continuum model."""

    scheme: ImplicitEuler | Midpoint
    steps: tuple[float, ...] = (5e-6, 1e-5, 2e-5, 5e-5, 1e-4)

    @property
    def name(self) -> str:
        """In words."""
        return f"continuum, {'midpoint' if isinstance(self.scheme, Midpoint) else 'implicit Euler'}"

    def cell(self, elements: int, rise: float, dt: float) -> Cell:
        """Go to the end."""
        from dolfinrod.continuum import solve

        def solved(scene: Scene, patience: Patience) -> Result:
            return solve(scene, elements=elements, degree=3, progress=patience)

        return _implicit(self.name, solved, blown(rise, dt, self.scheme), (elements, rise, dt))


@dataclass(frozen=True)
class Discrete:
    """The paper's scheme on its elements."""

    name: str = "discrete, implicit Euler"
    steps: tuple[float, ...] = (1e-6, 2e-6, 5e-6, 1e-5, 2e-5, 5e-5, 1e-4)

    def cell(self, elements: int, rise: float, dt: float) -> Cell:
        """Go to the end."""
        from discrete import solve

        def solved(scene: Scene, patience: Patience) -> Result:
            return solve(scene, elements=elements, progress=patience)

        return _implicit(self.name, solved, blown(rise, dt, ImplicitEuler()), (elements, rise, dt))


@dataclass(frozen=True)
class OnElements:
    """An explicit rule on the paper's elements."""

    rule: Rule
    steps: tuple[float, ...] = (1e-7, 2e-7, 5e-7, 1e-6, 2e-6, 5e-6, 1e-5, 2e-5, 5e-5, 1e-4)

    @property
    def name(self) -> str:
        """In words."""
        return self.rule.name

    def cell(self, elements: int, rise: float, dt: float) -> Cell:
        """Go to the end, or until it is lost."""
        rod = Explicit(blown(rise, dt, ImplicitEuler()), elements)
        started = time.perf_counter()
        moved = rod.run(self.rule, rod.rest(), dt, round(ENDED / dt))
        seconds = (time.perf_counter() - started) / ENDED
        error, lost = off(reached(rod, moved), rise), moved.gained / moved.supplied
        shape = self.name, rise, LENGTH / elements, dt
        limit = 2.0 / highest(rod)
        if moved.lost:
            reason = f"blew up within {moved.steps} steps"
            return Cell(*shape, "failed", np.nan, lost, np.nan, limit, reason)
        return Cell(*shape, _outcome(error, lost), error, lost, seconds, limit, "")


SCHEMES: tuple[Stepper, ...] = (
    Discrete(),
    Continuum(ImplicitEuler()),
    Continuum(Midpoint()),
    OnElements(SymplecticEuler()),
    OnElements(ForwardEuler()),
)


def cells(scheme: Stepper, elements: int, rise: float, steps: tuple[float, ...] = ()) -> tuple[Cell, ...]:
    """One line of a map.

    Args:
        scheme: On a model.
        elements: Of the fibre.
        rise: In which the load grows [s].
        steps: Lengths of steps [s]; none: those worth trying.

    Returns:
        A cell for every step.
    """
    return tuple(scheme.cell(elements, rise, dt) for dt in steps or scheme.steps)


def blown(rise: float, dt: float, scheme: ImplicitEuler | Midpoint) -> Scene:
    """The fibre under the load."""
    history = ((0.0, 0.0), (rise, 1.0)) if rise else Steady()
    load = LineForce((0.0, DRAG, 0.0), history=history)
    return fibre(Dynamic(ENDED, dt, scheme=scheme, output=ENDED), load)


@cache
def reference(rise: float) -> Array:
    """Where the stations end by symplectic Euler on a fine mesh, near its longest step, shape (10, 3) [m].

    Nothing is iterated in it. The continuum model on 20 × P4 by the midpoint rule in steps of 5 µs is 7e-4 off.
    """
    rod = Explicit(blown(rise, ENDED, ImplicitEuler()), FINE)
    steps = ceil(ENDED / (FINE_PART * 2.0 / highest(rod)))
    return reached(rod, rod.run(SymplecticEuler(), rod.rest(), ENDED / steps, steps))


def reached(rod: Explicit, moved: Moved) -> Array:
    """Where an explicit run has taken the stations, shape (10, 3) [m]."""
    at = [rod.mesh.node(0, s) for s in STATIONS]
    return np.asarray(moved.nodes.x[at] * rod.mesh.units.length + rod.mesh.origin)


def stations(result: Result) -> Array:
    """Where the stations are at the end, shape (10, 3) [m]."""
    return np.array([result.rods[0].at(s)[-1] for s in STATIONS])


def off(r: Array, rise: float) -> float:
    """Largest error of a station over the longest way."""
    exact = reference(rise)
    start = np.stack([STATIONS, 0.0 * STATIONS, 0.0 * STATIONS], axis=1)
    return float(np.linalg.norm(r - exact, axis=1).max() / np.linalg.norm(exact - start, axis=1).max())


def _implicit(name: str, solve: _Solve, scene: Scene, at: tuple[int, float, float]) -> Cell:
    """A cell by a solver that may refuse."""
    elements, rise, dt = at
    shape = name, rise, LENGTH / elements, dt
    assert isinstance(scene.motion, Dynamic)
    patience = Patience(scene.motion)
    try:
        result = solve(scene, patience)
    except NotConverged as failed:
        reason = CRAWLS if patience.over else failed.reason
        return Cell(*shape, "failed", np.nan, np.nan, np.nan, None, reason)
    lost = float(result.energy["numerical"][-1] / result.energy["load work"][-1])
    error = off(stations(result), rise)
    return Cell(*shape, _outcome(error, lost), error, lost, result.statistics.seconds_solve / ENDED, None, "")


class _Solve(Protocol):
    def __call__(self, scene: Scene, patience: Patience, /) -> Result: ...


def _outcome(error: float, lost: float) -> str:
    """Of a run that reached the end."""
    if not (np.isfinite(error) and lost <= 1.0):
        return "failed"
    if lost < -LIMIT:
        return "dissipated"
    return "converged" if error <= LIMIT else "off"
