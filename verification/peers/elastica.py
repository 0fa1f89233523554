"""PyElastica: staggered Cosserat rod with shear, explicit position Verlet, pinned at its first node.

Stiffnesses and inertia are set on the rod after it is made, so that it poses the same problem whatever cross-section
they belong to; PyElastica's documentation, "Rods" and "Timesteppers".
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import elastica
import numpy as np

__all__ = ["POSED"]


class Simulator(elastica.BaseSystemCollection, elastica.Constraints, elastica.Forcing):
    """What the problem needs."""


def straight(problem: dict[str, Any], n: int) -> elastica.CosseratRod:
    """A rod along x with the stiffnesses and the inertia of the problem."""
    return laid(problem, np.linspace(np.zeros(3), [problem["length"], 0.0, 0.0], n + 1).T)


def laid(problem: dict[str, Any], places: np.ndarray) -> elastica.CosseratRod:
    """A rod through places (3, n + 1) in a plane across z, there without stretch; without curvature where straight."""
    n, edges = places.shape[1] - 1, np.diff(places)
    radius = problem.get("radius", 1.0 / np.sqrt(np.pi))
    rod = elastica.CosseratRod.straight_rod(
        n,
        places[:, 0].copy(),
        edges[:, 0] / np.linalg.norm(edges[:, 0]),
        np.array([0.0, 0.0, 1.0]),
        base_length=problem["length"],
        base_radius=radius,
        density=problem["rhoA"] / (np.pi * radius**2),
        youngs_modulus=1.0,
        shear_modulus=1.0,
        position=places,
    )
    # Directors are (d2, d3, d1), the tangent last.
    rod.shear_matrix[:] = np.diag([problem["GA"], problem["GA"], problem["EA"]])[..., None]
    rod.bend_matrix[:] = np.diag([problem["EI"], problem["EI"], problem["GJ"]])[..., None]
    inertia = problem["length"] / n * problem["rhoI"] * np.array([1.0, 1.0, 2.0])
    rod.mass_second_moment_of_inertia[:] = np.diag(inertia)[..., None]
    rod.inv_mass_second_moment_of_inertia[:] = np.diag(1.0 / inertia)[..., None]
    return rod


def swing(problem: dict[str, Any], settings: dict[str, Any]) -> Callable[[], list[list[float]]]:
    """A rod pinned at one end, released from the horizontal."""
    rod = straight(problem, settings["elements"])
    simulator = Simulator()
    simulator.append(rod)
    simulator.constrain(rod).using(
        elastica.GeneralConstraint,
        constrained_position_idx=(0,),
        translational_constraint_selector=np.array([True, True, True]),
        rotational_constraint_selector=np.array([False, False, False]),
    )
    simulator.add_forcing_to(rod).using(elastica.GravityForces, acc_gravity=np.array([0.0, -problem["g"], 0.0]))
    simulator.finalize()
    stepper = elastica.PositionVerlet()

    def solve() -> list[list[float]]:
        tip: list[list[float]] = []
        time, start = np.float64(0.0), 0.0
        for end in problem["times"]:
            steps = round((end - start) / settings["step"])
            for _ in range(steps):
                time = stepper.step(simulator, time, np.float64((end - start) / steps))
            start = end
            tip.append([float(c) for c in rod.position_collection[:, -1]])
        return tip

    return solve


POSED = {"swing": swing}
