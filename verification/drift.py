"""What a free flying rod keeps: its momenta, and its energy as well as the scheme can."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import Rod, Scene, Section, Spatial, Velocity
from verification.order import Order, order
from verification.stepper import ContinuumStepper, DiscreteStepper, both_schemes

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from dolfinrod.scene import Dynamic
    from verification.case import Array
    from verification.stepper import Stepper

__all__ = ["KEPT", "STEPPERS", "DriftStudy", "driftstudy", "momenta"]

# Three different stiffnesses and inertias, thick enough for its turning to count.
RHO_A, RHO_I = 1.0, (3e-2, 1e-2, 2e-2)
SECTION = Section(EA=1200.0, GA=(400.0, 300.0), GJ=0.8, EI=(1.0, 2.0), rhoA=RHO_A, rhoI=RHO_I)
SIMPSON = np.array([1.0, 4.0, 1.0]) / 6.0
# Largest relative change of a momentum that is kept.
KEPT = 1e-9
# States stored of a run: so many that no peak of the energy is passed over.
STORED = 500
# How far the order of the energy may lie from theory.
SLACK = 0.3
ELEMENTS, DEGREE = 2, 2
STEPPERS: tuple[ContinuumStepper | DiscreteStepper, ...] = (
    *both_schemes(ELEMENTS, DEGREE, Spatial()),
    DiscreteStepper(6),
)


@dataclass(frozen=True)
class DriftStudy:
    """A free rod over a time, in ever smaller steps.

    Args:
        model: Name of the model and the scheme.
        mesh: In words.
        seconds: Of the motion [s].
        steps: Numbers of steps, ascending.
        linear: Largest change of linear momentum, relative, one a number of steps.
        angular: The same of angular momentum about the origin.
        energy: The same of kinetic and strain energy.
        end: Change of energy at the end, relative; negative where it was lost.
        order: Of the energy in the time step, where the scheme keeps the momenta.
        keeps: Whether the scheme keeps angular momentum and has no loss of energy.
    """

    model: str
    mesh: str
    seconds: float
    steps: tuple[int, ...]
    linear: tuple[float, ...]
    angular: tuple[float, ...]
    energy: tuple[float, ...]
    end: tuple[float, ...]
    order: Order
    keeps: bool

    @property
    def holds(self) -> bool:
        """Linear momentum kept by all; by Midpoint angular momentum, too, and the energy within O(Δt²)."""
        if max(self.linear) > KEPT:
            return False
        if not self.keeps:
            return max(self.end) < 0.0
        falls = self.order.observed is not None and abs(self.order.observed - self.order.theory) <= SLACK
        return max(self.angular) <= KEPT and falls


def thrown(motion: Dynamic) -> Scene:
    """A rod that turns about three axes and bends meanwhile."""

    def bending(r: Array) -> Array:
        return np.stack([0.0 * r[:, 0], 2.0 * np.sin(np.pi * r[:, 0]), 1.0 - np.cos(2.0 * np.pi * r[:, 0])], axis=1)

    start = (Velocity(v=(0.3, 0.2, -0.1), omega=(8.0, 2.0, -3.0)), Velocity(v=bending))
    return Scene(rods=[Rod.straight(1.0, SECTION)], motion=motion, velocities=start)


def driftstudy(stepper: Stepper, seconds: float, steps: tuple[int, ...]) -> DriftStudy:
    """Throw the rod.

    Args:
        stepper: The model.
        seconds: For so long [s].
        steps: Numbers of steps, ascending.

    Returns:
        The record.
    """
    linear: list[float] = []
    angular: list[float] = []
    energy: list[float] = []
    end: list[float] = []
    for n in steps:
        result = stepper.solve(thrown(stepper.motion(seconds, n, seconds / min(n, STORED))))
        for found, kept in zip((linear, angular), momenta(result), strict=True):
            found.append(float(np.abs(kept - kept[0]).max() / np.linalg.norm(kept[0])))
        total = result.energy["kinetic"] + result.energy["strain"]
        energy.append(float(np.abs(total / total[0] - 1.0).max()))
        end.append(float(total[-1] / total[0] - 1.0))
    return DriftStudy(
        model=stepper.name,
        mesh=stepper.mesh,
        seconds=seconds,
        steps=steps,
        linear=tuple(linear),
        angular=tuple(angular),
        energy=tuple(energy),
        end=tuple(end),
        order=order(energy, steps, stepper.order),
        keeps=stepper.order == 2,
    )


def momenta(result: Result) -> tuple[Array, Array]:
    """Linear momentum and moment of momentum about the origin at the stored times, each of shape (n_t, 3).

    Args:
        result: Of one rod that the steppers of this file moved.
    """
    h = result.rods[0]
    if result.formulation.model == "discrete":
        from discrete.mass import node_masses
        from discrete.mesh import mesh

        m, J = node_masses(mesh(result.scene, len(h.s) - 1), [SECTION], whole_ends=False)
    else:
        # Simpson's rule on each quadratic element.
        m = np.zeros(len(h.s))
        for e in range(0, len(h.s) - 1, DEGREE):
            m[e : e + 3] += SIMPSON * RHO_A * (h.s[e + 2] - h.s[e])
        J = m[:, None] * np.asarray(RHO_I) / RHO_A
    p = m[:, None] * np.asarray(h.v)
    in_section = J * np.einsum("tsji,tsj->tsi", h.frames, np.asarray(h.omega))
    moment = np.cross(h.r, p) + np.einsum("tsij,tsj->tsi", h.frames, in_section)
    return np.asarray(p.sum(axis=1)), np.asarray(moment.sum(axis=1))
