"""How the scene moves on."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from numbers import Real
from typing import TYPE_CHECKING

from dolfinrod.scene.errors import SceneError, quoted
from dolfinrod.scene.history import Steady
from dolfinrod.scene.quantity import assign, count, listed, number, positive

if TYPE_CHECKING:
    from dolfinrod.scene.scene import Scene

__all__ = ["Dynamic", "ImplicitEuler", "Midpoint", "Motion", "Scheme", "Static", "in_time"]

MOST_STEPS = 1_000_000
# Beyond these a fraction of the time is no longer told from nothing, or from infinity.
SHORTEST, LONGEST = 1e-100, 1e100


@dataclass(frozen=True)
class Static:
    """Equilibrium at every pseudo-time from 0 to `t_end`; neither mass nor inertia.

    Args:
        steps: Equal load steps; None: the whole load first, halved on failure.
        t_end: Where the pseudo-time ends; proportional loads are full there.

    Raises:
        SceneError: Not a whole number of steps, more than a million of them, or no positive time.
    """

    steps: int | None = None
    t_end: float = 1.0

    def __post_init__(self) -> None:
        t_end = _duration(self.t_end, "Static.t_end", "")
        steps = None if self.steps is None else count(self.steps, "Static.steps", MOST_STEPS)
        assign(self, steps=steps, t_end=t_end)


@dataclass(frozen=True)
class ImplicitEuler:
    """Backward Euler, v₁ = v₀ + Δt a₁ and r₁ = r₀ + Δt v₁: first order, damps what the steps do not resolve.

    Source: Lyu, Cheng & Xu, CMES 127(2), 2021, 2.3.2.
    """


@dataclass(frozen=True)
class Midpoint:
    """Midpoint rule with mean strains: second order, linear and angular momentum kept to round-off.

    The forces act at the mean of the states before and after the step, with resultants of the mean of their strains, so
    that a rod which only turns carries none, however stiff. Nothing is damped on purpose: the energy swings about its
    value by O(Δt²) as long as the steps resolve the motion.

    Source: Simo, Tarnow & Doblare, Int. J. Numer. Methods Eng. 38, 1995 (mean strains); Marsden & West, Acta Numerica
    10, 2001 (inertia from a discrete action).
    """


Scheme = ImplicitEuler | Midpoint


@dataclass(frozen=True)
class Dynamic:
    """Motion in time from 0 to `t_end`, with the inertia of the rods.

    The time of histories is in seconds. A load without history acts in full from the start; a prescribed motion without
    history grows evenly until `t_end`.

    Args:
        t_end: Where the time ends [s].
        dt: Time step [s]; None: steps as long as `tol` lets them be.
        scheme: How time is stepped.
        tol: Error allowed in each step of a free choice, relative to the length of the rods; None: 1e-6.
        output: Time between stored states, or their times, ascending [s]; None: every step.
        rest: Speed of nodes [m/s]: the motion ends, and its last state is stored, with the step in which the fastest
            falls below it; None: it goes on until `t_end`.

    Raises:
        SceneError: No positive time or speed, both `dt` and `tol`, more than a million steps or stored states, or
            what is no scheme.
    """

    t_end: float
    dt: float | None = None
    scheme: Scheme = field(default_factory=ImplicitEuler)
    tol: float | None = None
    output: float | Sequence[float] | None = None
    rest: float | None = None

    def __post_init__(self) -> None:
        t_end = _duration(self.t_end, "Dynamic.t_end", "s")
        dt = None if self.dt is None else positive(self.dt, "Dynamic.dt", "s")
        tol = None if self.tol is None else positive(self.tol, "Dynamic.tol")
        if dt is not None and tol is not None:
            raise SceneError(f"must be left out where dt is given, got {tol}", field="Dynamic.tol")
        if tol is not None and tol >= 1.0:
            raise SceneError(f"must be below 1, got {tol}", field="Dynamic.tol")
        if dt is not None:
            _few_enough(dt, t_end, "Dynamic.dt")
        if not isinstance(self.scheme, ImplicitEuler | Midpoint):
            raise SceneError(
                f"must be ImplicitEuler() or Midpoint(), got {quoted(self.scheme)}", field="Dynamic.scheme"
            )
        rest = None if self.rest is None else positive(self.rest, "Dynamic.rest", "m/s")
        assign(self, t_end=t_end, dt=dt, tol=tol, output=_output(self.output, t_end), rest=rest)


Motion = Static | Dynamic


def in_time(scene: Scene) -> Scene:
    """The scene with the history of every load written out as its motion takes it.

    In a Dynamic motion a load without history acts in full from the start, `Steady()`; in a Static one it grows
    proportionally, and so does a prescribed motion in both, which None says already.

    Args:
        scene: Any scene.

    Returns:
        The scene to step in time; the same scene where its motion is Static.
    """
    if isinstance(scene.motion, Static):
        return scene
    loads = [replace(load, history=Steady()) if load.history is None else load for load in scene.loads]
    return replace(scene, loads=loads)


def _duration(value: object, field: str, unit: str) -> float:
    """A positive time of a size that can be divided."""
    t_end = positive(value, field, unit)
    if not SHORTEST <= t_end <= LONGEST:
        raise SceneError(f"must lie between {SHORTEST} and {LONGEST}, got {t_end}", field=field)
    return t_end


def _output(value: object, t_end: float) -> float | tuple[float, ...] | None:
    """A period or ascending times up to the end."""
    if value is None:
        return None
    if isinstance(value, Real) and not isinstance(value, bool):
        return _few_enough(positive(value, "Dynamic.output", "s"), t_end, "Dynamic.output")
    times = tuple(number(t, f"Dynamic.output[{i}]", "s") for i, t in enumerate(listed(value)))
    if not times:
        raise SceneError(f"must be a time or times [s], got {quoted(value)}", field="Dynamic.output")
    if not 0.0 <= times[0] or times[-1] > t_end or any(b <= a for a, b in pairwise(times)):
        raise SceneError(f"must ascend between 0 and t_end = {t_end} s, got {quoted(value)}", field="Dynamic.output")
    return times


def _few_enough(period: float, t_end: float, field: str) -> float:
    """A time between steps or states of which no more than a million fit into the motion."""
    if t_end / period > MOST_STEPS:
        least = f"must be at least t_end/{MOST_STEPS} = {t_end / MOST_STEPS} s, got {period} s"
        raise SceneError(least, field=field)
    return period
