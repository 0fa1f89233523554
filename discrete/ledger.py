"""Where the energy of a motion goes, step by step.

kinetic + strain + potential − their first values = load work + support work + drag + damping + numerical.

With surfaces there is what contact stores on the left as well, and the works of friction and of moving walls on the
right. The law of pressures is convex, so that steps lose the energy −p₁ (g₁ − g₀) − ΔU of a penetration, too.

Every entry is worked out from what it names, so that the law holds as well as the steps are solved. With Δq = Δt (v, ω)
and P the internal forces at the end of a step, the scheme loses ½ Δv·m Δv + ½ ΔΩ·J* ΔΩ of the kinetic and, for all
strain that is convex, a positive P·Δq − ΔU of the elastic energy.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from discrete.momentum import in_body
from discrete.unknowns import AXIAL, SPIN, X
from dolfinrod.scene import Gravity, factor

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from discrete.euler import BackwardEuler, Taken
    from discrete.moving import Moving
    from discrete.touched import Booking
    from dolfinrod.scene import Scene

    Array = NDArray[np.float64]

__all__ = ["WORKS", "WORKS_THERE", "Ledger"]

STORED = ("kinetic", "strain", "potential")
WORKS = ("load work", "support work", "drag", "damping", "numerical")
# Of scenes with contacts.
WORKS_THERE = ("friction", "wall work")


class Ledger:
    """Energies and works so far, in units of the model.

    Args:
        scene: The problem.
        method: Its steps.
        start: The first state.
        strain: Its strain energy.
        works: Works done before it, by name.
    """

    def __init__(
        self, scene: Scene, method: BackwardEuler, start: Moving, strain: float, works: Mapping[str, float]
    ) -> None:
        self._scene, self._method = scene, method
        self._node_i, self._inertia = method.mesh.elements.node_i, method.inertia
        origin = method.mesh.origin / method.mesh.units.length
        weights = [(load, self._weight(load)) for load in scene.loads if isinstance(load, Gravity)]
        self._weights = [(load, weight, float(weight.sum(axis=1) @ origin)) for load, weight in weights]
        self._firm, self._guided = method.supports.firm_rows, method.supports.guides.nodes
        self.now = dict.fromkeys((*STORED, *WORKS), 0.0)
        if method.contacts is not None:
            self.now |= {"contact": method.contacts.stored(), **dict.fromkeys(WORKS_THERE, 0.0)}
        self.now |= works
        self._keep(start, in_body(start.R, start.ω), strain)

    def add(self, before: Moving, step: Taken, strain: float, damped: float, booked: Booking | None) -> None:
        """Enter a step.

        Args:
            before: Where it began.
            step: The step.
            strain: Strain energy at its end.
            damped: Energy that the sections have dissipated.
            booked: What surfaces have; None where there are none.
        """
        new, now = step.state, self.now
        dt = new.t - before.t
        moved = dt * np.concatenate((new.v.T, new.ω.T))
        Ω_0, Ω = in_body(before.R, before.ω), in_body(new.R, new.ω)
        internal, answer = step.internal.T[:AXIAL], -step.missing.T[:AXIAL]
        lost = float(np.vdot(internal, moved)) - (strain - now["strain"]) - damped
        lost += self._inertia.kinetic(new.v - before.v, Ω - Ω_0)
        # A guide at rest does no work but that of its turning off the axis it held.
        guides = 0.0
        if len(self._guided):
            guides = float(np.vdot(answer[SPIN, self._guided], moved[SPIN, self._guided]))
        potential = now["potential"]
        self._keep(new, Ω, strain)
        now["load work"] += float(np.vdot(step.acting.T[:AXIAL], moved)) + now["potential"] - potential
        now["support work"] += float(np.vdot(answer.reshape(-1)[self._firm], moved.reshape(-1)[self._firm]))
        now["drag"] += float(np.vdot(step.drag.T, moved[X]))
        now["damping"] -= damped
        now["numerical"] += guides - lost
        if booked is not None and step.pressed is not None:
            given = float(np.vdot(step.pressed.T[:AXIAL], moved)) - booked.pushed + booked.rubbed + booked.damped
            now["numerical"] += given + booked.stored - now["contact"]
            now["contact"] = booked.stored
            now["damping"] -= booked.damped
            now["friction"] -= booked.rubbed
            now["wall work"] += booked.pushed

    def _keep(self, state: Moving, Ω: Array, strain: float) -> None:
        """Energies of a state."""
        self.now["kinetic"] = self._inertia.kinetic(state.v, Ω)
        self.now["strain"] = strain
        t_end = self._scene.motion.t_end
        self.now["potential"] = -sum(
            factor(load.history, state.t, t_end) * (float(np.vdot(weight, state.x.T)) + at_origin)
            for load, weight, at_origin in self._weights
        )

    def _weight(self, load: Gravity) -> Array:
        """Weight of the nodes, shape (3, n_nodes)."""
        elements, units = self._method.mesh.elements, self._method.mesh.units
        ρA = np.array([rod.section.rhoA for rod in self._scene.rods], dtype=float)[elements.rod]
        half = 0.5 * ρA * elements.l * units.length / units.force
        share = np.zeros(len(self._method.mesh.x))
        share[self._node_i] = half
        share[self._node_i + 1] += half
        return np.array(load.g)[:, None] * share
