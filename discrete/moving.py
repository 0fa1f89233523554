"""Configuration and velocities of all rods at one time, and how they begin."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.mesh import Mesh
    from discrete.supports import Supports
    from dolfinrod.scene import Scene

    Array = NDArray[np.float64]

__all__ = ["Moving", "initial"]


@dataclass(frozen=True, eq=False)
class Moving:
    """State of a motion, lengths and forces in units of the model, time in seconds.

    Args:
        t: Time.
        x: Positions of the nodes, shape (n_nodes, 3).
        R: Section frames, shape (n_nodes, 3, 3).
        F_n: Axial forces, shape (n,).
        v: Velocities, shape (n_nodes, 3).
        ω: Angular velocities in global axes, shape (n_nodes, 3).
        factors: Factors of the prescribed motions, shape (n_prescribed,).
        θ: Sum of all Δt ω, of use only where rotation vectors are added, shape (n_nodes, 3).
        trend: Rates of v, ω and F_n over the step behind, by which the next one is foretold; None: not known.
        bend: Rates of these; None: not known.
    """

    t: float
    x: Array
    R: Array
    F_n: Array
    v: Array
    ω: Array
    factors: Array
    θ: Array
    trend: tuple[Array, Array, Array] | None = None
    bend: tuple[Array, Array, Array] | None = None

    def without_trend(self) -> Moving:
        """The same before a kink of a history: nothing goes on as it did."""
        return replace(self, trend=None, bend=None)


def initial(scene: Scene, mesh: Mesh, supports: Supports) -> Moving:
    """Stress-free rods with the velocities of the scene; what is held moves as its support does.

    Args:
        scene: The problem.
        mesh: Its nodes.
        supports: What holds them.

    Returns:
        The state at t = 0.
    """
    v, ω = np.zeros_like(mesh.x), np.zeros_like(mesh.x)
    r = mesh.x * mesh.units.length + mesh.origin
    for velocity in scene.velocities:
        for k in range(len(scene.rods)) if velocity.rod is None else (velocity.rod,):
            own = slice(mesh.first[k], mesh.first[k + 1])
            v[own] += velocity.at(r[own]) / mesh.units.length
            ω[own] += velocity.omega
    factors = supports.factors(0.0)
    rates = supports.slopes(0.0)
    moved = supports.increments(mesh.x, factors, factors + rates) - supports.increments(mesh.x, factors, factors)
    v = np.where(supports.firm[:, :3], moved[:, :3], v)
    ω = np.where(supports.firm[:, 3:], moved[:, 3:6], ω)
    return Moving(0.0, mesh.x, mesh.R, np.zeros(len(mesh.elements.l)), v, ω, factors, np.zeros_like(mesh.x))
