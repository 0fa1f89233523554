"""Air that flows past the rods, and how it drags them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.drag import resistances
from dolfinrod.scene.errors import SceneError, quoted
from dolfinrod.scene.quantity import VectorLike, assign, positive, vector

__all__ = ["Air"]

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Air:
    """Air of a given flow, which the rods do not change; it drags circular sections across and along.

    f = ρ_a d |v_n| (c_n(w) v_n + c_t(w) v_t), w = |v_n| d/ν, with v = u_air − v_rod split along the rod.

    Args:
        field: Velocity of the air [m/s]: a vector, or f(x (n, 3) [m], t [s]) → (n, 3).
        density: ρ_a [kg/m³].
        viscosity: Dynamic viscosity ρ_a ν [Pa s].

    Raises:
        SceneError: A density or viscosity that is not positive.

    Source: Marheineke & Wegener, Int. J. Multiphase Flow 37, 2011, DOI 10.1016/j.ijmultiphaseflow.2010.10.001.
    """

    field: VectorLike | Callable[[Array, float], Array] = (0.0, 0.0, 0.0)
    density: float = 1.204
    viscosity: float = 1.81e-5

    def __post_init__(self) -> None:
        assign(
            self,
            field=self.field if callable(self.field) else vector(self.field, "Air.field", "m/s"),
            density=positive(self.density, "Air.density", "kg/m³"),
            viscosity=positive(self.viscosity, "Air.viscosity", "Pa s"),
        )

    def velocity(self, x: Array, t: float) -> Array:
        """Velocity of the air at points.

        Args:
            x: Shape (n, 3) [m].
            t: Time [s].

        Returns:
            Shape (n, 3) [m/s].

        Raises:
            SceneError: A field that gives anything else.
        """
        if not callable(self.field):
            return np.broadcast_to(np.asarray(self.field), x.shape)
        u = np.asarray(self.field(x, t), dtype=float)
        if u.shape != x.shape or not np.isfinite(u).all():
            raise SceneError(f"must give finite velocities of shape {x.shape}, got {quoted(u)}", field="air.field")
        return u

    def drag(self, v: Array, tangent: Array, diameter: Array) -> Array:
        """Force per length on rods that the air passes.

        Args:
            v: Velocity of the air against the rod, shape (n, 3) [m/s].
            tangent: Unit tangent of the rod, shape (n, 3).
            diameter: d, shape (n,) [m].

        Returns:
            Shape (n, 3) [N/m].
        """
        v_n, v_t, speed = _split(v, tangent)
        k_n, k_t, *_ = self.viscosity * resistances(self._reynolds(diameter) * speed)
        return k_n[:, None] * v_n + k_t[:, None] * v_t

    def drag_gradient(self, v: Array, tangent: Array, diameter: Array) -> Array:
        """∂f/∂v at fixed tangent, shape (n, 3, 3) [N s/m²]; arguments as `drag`."""
        return self.linearized_drag(v, tangent, diameter)[1]

    def linearized_drag(self, v: Array, tangent: Array, diameter: Array) -> tuple[Array, Array, Array]:
        """Drag with its derivatives, in one pass; arguments as `drag`.

        ∂f/∂v = k_n (1 − t⊗t) + k_t t⊗t + (k_n′ v_n + k_t′ v_t) ⊗ ∂w/∂v, and for turns of the tangent, δt·t = 0,
        ∂f/∂t = (k_t − k_n)(t⊗v + (v·t) 1) − (v·t)(k_n′ v_n + k_t′ v_t) ⊗ ∂w/∂v.

        Returns:
            f, shape (n, 3) [N/m]; ∂f/∂v, shape (n, 3, 3) [N s/m²]; ∂f/∂t, shape (n, 3, 3) [N/m].
        """
        v_n, v_t, speed = _split(v, tangent)
        per_speed = self._reynolds(diameter)
        k_n, k_t, slope_n, slope_t = (self.viscosity * resistances(per_speed * speed))[:, :, None]
        direction = per_speed[:, None] * (v_n / np.maximum(speed, np.finfo(float).tiny)[:, None])
        change = (slope_n * v_n + slope_t * v_t)[:, :, None] * direction[:, None, :]
        along, one = np.einsum("ni,ni->n", v, tangent)[:, None, None], np.eye(3)
        k_n, gap = k_n[:, :, None], (k_t - k_n)[:, :, None]
        by_v = k_n * one + gap * tangent[:, :, None] * tangent[:, None, :] + change
        by_t = gap * (tangent[:, :, None] * v[:, None, :] + along * one) - along * change
        return k_n[:, :, 0] * v_n + k_t * v_t, by_v, by_t

    def _reynolds(self, diameter: Array) -> Array:
        """w per speed across, d/ν, shape (n,) [s/m]."""
        return diameter * (self.density / self.viscosity)


def _split(v: Array, tangent: Array) -> tuple[Array, Array, Array]:
    """v_n, v_t and |v_n|."""
    v_t = np.einsum("ni,ni->n", v, tangent)[:, None] * tangent
    v_n = v - v_t
    return v_n, v_t, np.sqrt(np.einsum("ni,ni->n", v_n, v_n))
