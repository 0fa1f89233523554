"""Air that flows past the rods, and how it drags them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.drag import linearized, resisting
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
        # Where an iteration that diverges has lost a point, no field is to blame.
        if u.shape != x.shape or not (np.isfinite(u).all() or np.isfinite(u[np.isfinite(x).all(axis=1)]).all()):
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
        return np.asarray(resisting(*self._passing(v, tangent, diameter)))

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
        f, by_v, by_t = linearized(*self._passing(v, tangent, diameter))
        return f, by_v, by_t

    def _passing(self, v: Array, tangent: Array, diameter: Array) -> tuple[Array, Array, Array, float]:
        """What the drag depends on: velocity, tangent, Reynolds number per speed across, d/ν [s/m], and viscosity."""
        per_speed = diameter * (self.density / self.viscosity)
        return np.ascontiguousarray(v), np.ascontiguousarray(tangent), per_speed, self.viscosity
