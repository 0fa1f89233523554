"""PyElastica's rods on rough surfaces: a plane by its anisotropic friction, here the same all round, and a drum.

On the drum, friction is the lesser of c times the slip and μ N. PyElastica's documentation, "Contact", "Constraints".
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from math import cos, pi, sqrt
from typing import Any

import elastica
import numpy as np

from verification.peers.elastica import laid
from verification.peers.elasticarods import Simulator
from verification.peers.rodshape import round_drum

__all__ = ["POSED"]

# How deep weight or pull presses a rod into what it lies on, over its radius, and the damping of that over critical.
DEEP, DAMPED = 1e-3, 0.5
# Speed below which a rod on a plane sticks, over that of the push, and on a drum, below which friction falls.
SLOW, CREEP = 1e-4, 0.1
# The pull is the mean of so many over that part of the time at its end.
LAST, LOOKS = 0.2, 100


class Drawn(elastica.ConstraintBase):
    """The last node moves at a speed along −y."""

    def __init__(self, speed: float, **kwargs: Any) -> None:
        """At a speed."""
        super().__init__(**kwargs)
        self.speed = speed

    def constrain_values(self, system: Any, time: np.float64) -> None:
        """Places follow from speeds."""

    def constrain_rates(self, system: Any, time: np.float64) -> None:
        """Speeds of the last node."""
        system.velocity_collection[:, -1] = (0.0, -self.speed, 0.0)


def plane(problem: dict[str, Any], settings: dict[str, Any]) -> Callable[[], list[list[float]]]:
    """A rod along x on the plane z = 0, pushed."""
    n, mass, mu = settings["elements"], problem["rhoA"] * problem["length"] / settings["elements"], problem["mu"]
    places = np.linspace([0.0, 0.0, problem["radius"]], [problem["length"], 0.0, problem["radius"]], n + 1).T
    rod = laid(problem, places)
    rod.velocity_collection[:] = np.array(problem["velocity"])[:, None]
    ground = elastica.Plane(np.zeros(3), np.array([0.0, 0.0, 1.0]))
    stiff = mass * problem["g"] / (DEEP * problem["radius"])
    simulator = Simulator()
    simulator.append(rod)
    simulator.append(ground)
    simulator.add_forcing_to(rod).using(elastica.GravityForces, acc_gravity=np.array([0.0, 0.0, -problem["g"]]))
    simulator.detect_contact_between(rod, ground).using(
        elastica.RodPlaneContactWithAnisotropicFriction,
        k=stiff,
        nu=2.0 * DAMPED * sqrt(stiff * mass),
        slip_velocity_tol=SLOW * np.linalg.norm(problem["velocity"]),
        static_mu_array=np.full(3, mu),
        kinetic_mu_array=np.full(3, mu),
    )
    simulator.finalize()

    def solve() -> list[list[float]]:
        times = moved(simulator, problem["times"], settings["step"])
        return [(rod.position_collection.mean(axis=1) - places.mean(axis=1)).tolist() for _ in times]

    return solve


def moved(simulator: Simulator, times: list[float], step: float) -> Iterator[float]:
    """Time after time."""
    stepper, time, start = elastica.PositionVerlet(), np.float64(0.0), 0.0
    for end in times:
        steps = round((end - start) / step)
        for _ in range(steps):
            time = stepper.step(simulator, time, np.float64((end - start) / steps))
        start = end
        yield end


def capstan(problem: dict[str, Any], settings: dict[str, Any]) -> Callable[[], list[list[float]]]:
    """A rope drawn over a drum: pull at its last element over counterpull; so many elements lie on the drum."""
    n, force = settings["elements"], problem["force"]
    places, angle = np.array(round_drum(n, problem["tail"])).T, pi / n
    rod, mass, stiff = laid(problem, places), problem["rhoA"] * angle, force * angle / (DEEP * problem["radius"])
    axes = np.array([[0.0, 0.0, -1.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]])
    drum = elastica.Cylinder(*axes, 2.0, cos(0.5 * angle) - problem["radius"], problem["rhoA"])
    simulator = Simulator()
    simulator.append(rod)
    simulator.append(drum)
    simulator.constrain(drum).using(
        elastica.OneEndFixedBC, constrained_position_idx=(0,), constrained_director_idx=(0,)
    )
    simulator.constrain(rod).using(Drawn, problem["speed"])
    simulator.add_forcing_to(rod).using(
        elastica.EndpointForces, np.array([0.0, -force, 0.0]), np.zeros(3), ramp_up_time=problem["times"][0] * LAST
    )
    simulator.detect_contact_between(rod, drum).using(
        elastica.RodCylinderContact,
        k=stiff,
        nu=2.0 * DAMPED * sqrt(stiff * mass),
        velocity_damping_coefficient=problem["mu"] * force * angle / (CREEP * problem["speed"]),
        friction_coefficient=problem["mu"],
    )
    simulator.finalize()

    def solve() -> list[list[float]]:
        end = problem["times"][0]
        looks = [end * (1.0 - LAST * (1.0 - k / LOOKS)) for k in range(LOOKS + 1)]
        pulls = [rod.internal_stress[2, -1] / rod.dilatation[-1] for _ in moved(simulator, looks, settings["step"])]
        return [[float(np.mean(pulls)) / force, 0.0, 0.0]]

    return solve


POSED = {"plane": plane, "capstan": capstan}
