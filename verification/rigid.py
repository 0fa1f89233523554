"""Rigid tops through the rotation integrators of both models: errors against the step, what is kept, what is lost."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from verification.order import Order, order
from verification.rigidbodies import INTEGRATORS, TOPS, Turned

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from verification.rigidbodies import Integrator, Top

    Array = NDArray[np.float64]

__all__ = ["TopStudy", "pairs", "record", "richardson", "topstudy"]

# What of the momentum a scheme that keeps it may lose, relative: of a free body, and of a heavy one, whose steps are
# fifty times as short, so that round-off of a turn is as much more of what changes in a step.
KEPT, KEPT_HEAVY = 1e-12, 1e-11
# Energy relative to that at the start that a step may gain by round-off where the scheme only loses it.
GAINED = 1e-12
# How far an observed order may fall short of theory.
SLACK = 0.2
# What an error that does not fall with the step keeps of itself, from the longest to the shortest.
STAYS = 0.5

Errors = tuple[tuple[float, ...], ...]


@dataclass(frozen=True)
class TopStudy:
    """A top by one integrator with steps from long to short.

    Args:
        case: Its name.
        title: For people.
        integrator: Name of it.
        provenance: Where the reference comes from.
        theory: Order of the error in the step; 0 where the integrator leads elsewhere.
        times: Of the reference [s].
        steps: Per second, coarse to fine.
        spin: Errors of the angular velocity over that at the start, a row for each of `steps`, a column for each time.
        attitude: Errors of the attitude, or of the place of the centre of mass over its distance, likewise.
        precession: Errors of the azimuth of a heavy top, likewise [rad]; none of a free body.
        spin_order: The least of all times.
        attitude_order: Likewise.
        extrapolated: Largest error of angular velocity and of attitude with the step extrapolated to none.
        energy: Largest deviation from that at the start, relative, for each of `steps`.
        energy_order: Of that.
        gain: Largest energy gained in any step, relative.
        loses: Whether there must be none.
        momentum: Largest deviation of what no moment changes, relative, for each of `steps`.
        axial: The same of the axial momentum of a heavy top; none of a free body.
        most: Of these may be, of the first, and of the second; None where the integrator keeps none.
    """

    case: str
    title: str
    integrator: str
    provenance: str
    theory: int
    times: tuple[float, ...]
    steps: tuple[int, ...]
    spin: Errors
    attitude: Errors
    precession: Errors
    spin_order: Order
    attitude_order: Order
    extrapolated: tuple[float, float]
    energy: tuple[float, ...]
    energy_order: Order
    gain: float
    loses: bool
    momentum: tuple[float, ...]
    axial: tuple[float, ...]
    most: tuple[float | None, float | None]

    @property
    def holds(self) -> bool:
        """Momentum kept, energy never gained or swinging, all in the order of theory."""
        if self.theory == 0:
            return self.attitude[-1][-1] > STAYS * self.attitude[0][-1]
        for off, most in zip((self.momentum, self.axial), self.most, strict=True):
            if most is not None and max(off, default=0.0) > most:
                return False
        found = (self.spin_order, self.attitude_order, self.energy_order)
        ordered = all(o.observed is None or o.observed >= self.theory - SLACK for o in found)
        return ordered and not (self.loses and self.gain > GAINED)


def pairs() -> tuple[tuple[Top, Integrator], ...]:
    """Every top with every integrator."""
    return tuple((top, integrator) for top in TOPS for integrator in INTEGRATORS)


def topstudy(top: Top, integrator: Integrator, *, levels: int | None = None, until: float = np.inf) -> TopStudy:
    """Turn a top with one step after the other.

    Args:
        top: With its reference.
        integrator: That turns it.
        levels: How many of its steps, from the coarsest; None: all.
        until: Last time that is looked at [s].

    Returns:
        The record.

    Raises:
        ArithmeticError: A step could not be taken.
    """
    times = tuple(t for t in top.times(integrator.order) if t <= until)
    runs = [
        Turned(top, n, (top.start, *integrator.states(top, 1.0 / n, round(times[-1] * n))))
        for n in top.steps(integrator.order)[:levels]
    ]
    return record(integrator, times, runs)


def record(integrator: Integrator, times: tuple[float, ...], runs: Sequence[Turned]) -> TopStudy:
    """What runs with shorter and shorter steps come to."""
    top, theory, steps = runs[0].top, integrator.order, tuple(run.steps for run in runs)
    off = tuple(run.energy_off for run in runs)
    spin = tuple(tuple(run.spin_error(t) for t in times) for run in runs)
    attitude = tuple(tuple(run.attitude_error(t) for t in times) for run in runs)
    most = KEPT if top.free else KEPT_HEAVY
    return TopStudy(
        case=top.name,
        title=top.title,
        integrator=integrator.name,
        provenance=f"{top.reference.id}; {top.reference.method}; {top.reference.source}",
        theory=theory,
        times=times,
        steps=steps,
        spin=spin,
        attitude=attitude,
        precession=() if top.free else tuple(tuple(run.precession_error(t) for t in times) for run in runs),
        spin_order=_least(spin, steps, theory),
        attitude_order=_least(attitude, steps, theory),
        extrapolated=(
            max(top.off_spin(richardson([run.spin(t) for run in runs], theory), t) for t in times),
            max(top.off_place(richardson([run.place(t) for run in runs], theory), t) for t in times),
        ),
        energy=off,
        energy_order=order(off, steps, theory, KEPT),
        gain=max(run.gain for run in runs),
        loses=not integrator.variational,
        momentum=tuple(run.momentum_off for run in runs),
        axial=() if top.free else tuple(run.axial_off for run in runs),
        most=(most if integrator.keeps_momentum else None, most if integrator.variational else None),
    )


def richardson(found: Sequence[Array], power: int) -> Array:
    """Values at no step from those at steps each half of the one before.

    The error is a series in the powers p, 2p, 3p, … of the step: all of them for p = 1, the even ones for the midpoint
    rule, which is its own inverse when time runs backwards.

    Args:
        found: Values, coarse to fine.
        power: p; the finest values stay where it is 0.
    """
    rows = list(found)
    for k in range(1, len(rows) if power else 1):
        factor = 2.0 ** (k * power)
        rows = [(factor * fine - coarse) / (factor - 1.0) for coarse, fine in pairwise(rows)]
    return rows[-1]


def _least(errors: Errors, steps: tuple[int, ...], theory: int) -> Order:
    """The least order of all times."""
    found = [order(column, steps, theory) for column in zip(*errors, strict=True)]
    return min(found, key=lambda o: np.inf if o.observed is None else o.observed)
