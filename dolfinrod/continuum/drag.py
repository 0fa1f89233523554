"""Air that drags the nodes of moving rods, each for the length it stands for."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.continuum.lumped import node_lengths

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.continuum.moving import Moving
    from dolfinrod.scene import Air

    Array = NDArray[np.float64]

__all__ = ["Drag"]


class Drag:
    """Force of the air on this rank's own nodes, f(u − ṙ, d₁) times the length of the Gauss-Lobatto rule.

    Args:
        problem: Owner of the state.
        air: What flows.
    """

    name = "Air"

    def __init__(self, problem: Moving, air: Air) -> None:
        self._problem, self._air = problem, air
        d, place = problem.discretization, problem.placement
        nodes = problem.lumped.r[:, 0]
        self._share = node_lengths(problem)[nodes] * (place.length / place.force)
        diameter, axis = np.zeros(len(problem.x)), np.zeros((len(problem.x), 3))
        everywhere = d.dofs["r"][:, :, 0]
        diameter[everywhere] = 2.0 * np.array([rod.section.radius for rod in problem.scene.rods])[problem.rod][:, None]
        axis[everywhere] = problem.R_0[:, :, :, 0]
        self._diameter, self._axis = diameter[nodes], axis[nodes] @ place.axes

    def force(self, r: Array, q: Array, rate: Array, t: float) -> Array:
        """Forces on the nodes, in EI/L².

        Args:
            r: Positions where the air is looked up, shape (n, d).
            q: Rotations there, shape (n, n_q).
            rate: Velocities of the nodes in L per unit of time, shape (n, d).
            t: Time [s].

        Returns:
            Shape (n, d).
        """
        v, tangent = self._relative(r, q, rate, t)
        f = self._air.drag(v, tangent, self._diameter)
        return self._share[:, None] * (f @ self._problem.placement.axes)

    def gradient(self, r: Array, q: Array, rate: Array, t: float) -> tuple[Array, Array]:
        """∂/∂rate and ∂/∂q of that, shapes (n, d, d) and (n, d, n_q)."""
        problem, axes = self._problem, self._problem.placement.axes
        v, tangent = self._relative(r, q, rate, t)
        _, by_v, by_t = self._air.linearized_drag(v, tangent, self._diameter)
        turned = problem.kinematics.rotate_gradient(q, self._axis)
        scale = self._share[:, None, None]
        by_rate = -scale * (axes.T @ by_v @ axes) * (problem.placement.length / problem.lumped.second)
        return by_rate, scale * (axes.T @ by_t @ axes) @ turned

    def _relative(self, r: Array, q: Array, rate: Array, t: float) -> tuple[Array, Array]:
        """Velocity of the air against the nodes [m/s] and normals of their sections, in space."""
        problem, place = self._problem, self._problem.placement
        wind = self._air.velocity(place.to_space(r), t)
        moving = rate @ place.axes.T * (place.length / problem.lumped.second)
        return wind - moving, problem.kinematics.rotate(q, self._axis) @ place.axes.T
