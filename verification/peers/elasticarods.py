"""PyElastica's rods in equilibrium and on a plane: there is no static solver, so that rods come to rest under damping.

AnalyticalLinearDamper and position Verlet until the tip does not move any more; contact with a rough plane by
RodPlaneContactWithAnisotropicFriction. PyElastica's documentation, "Damping", "Contact" and "Timesteppers".
"""

from __future__ import annotations

from collections.abc import Callable
from math import dist, sqrt
from typing import Any

import elastica
import numpy as np

from verification.peers.elastica import straight

__all__ = ["POSED"]

# Steps at most, how often the tip is looked at, and its movement over the length meanwhile that counts as rest.
MOST, LOOK, REST = 400_000, 2_000, 1e-7
# Of the longest stable step.
SAFE = 0.3


class Simulator(
    elastica.BaseSystemCollection, elastica.Constraints, elastica.Forcing, elastica.Damping, elastica.Contact
):
    """What the problems need."""


def rod(problem: dict[str, Any], settings: dict[str, Any]) -> Callable[[], list[list[float]]]:
    """A clamped rod under a force at its end, let go and damped as its first mode asks for."""
    if problem["angle"] != 0.0:
        raise ArithmeticError("the adapter poses straight rods only")
    n, length = settings["elements"], problem["length"]
    # Mass and rotary inertia do not matter at rest: waves of bending, stretch and shear are made equally slow.
    mass, h = 1.0, length / n
    step = SAFE * h * sqrt(mass / max(problem["EA"], problem["GA"]))
    needed = 6.0 * length * length * sqrt(mass / problem["EI"]) / step
    if needed > MOST:
        raise ArithmeticError(f"needs some {needed:.1e} explicit steps to come to rest, more than {MOST:g}")
    body = straight({**problem, "rhoA": mass, "rhoI": 0.25 * mass * h * h}, n)
    simulator = Simulator()
    simulator.append(body)
    simulator.constrain(body).using(
        elastica.OneEndFixedBC, constrained_position_idx=(0,), constrained_director_idx=(0,)
    )
    simulator.add_forcing_to(body).using(
        elastica.EndpointForces, np.zeros(3), np.array(problem["force"], dtype=float), ramp_up_time=step
    )
    simulator.dampen(body).using(
        elastica.AnalyticalLinearDamper,
        uniform_damping_constant=7.0 * sqrt(problem["EI"] / mass) / length**2,
        time_step=np.float64(step),
    )
    simulator.finalize()
    stepper = elastica.PositionVerlet()

    def solve() -> list[list[float]]:
        time, before = np.float64(0.0), [0.0, 0.0, 0.0]
        for _ in range(MOST // LOOK):
            for _ in range(LOOK):
                time = stepper.step(simulator, time, np.float64(step))
            tip = [float(c) for c in body.position_collection[:, -1]]
            if dist(tip, before) < REST * length:
                return [tip]
            before = tip
        raise ArithmeticError(f"not at rest after {MOST:g} steps")

    return solve


POSED = {"rod": rod}
