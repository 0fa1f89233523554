"""Air that flows past the rods, and how it drags them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.errors import SceneError, quoted
from dolfinrod.scene.quantity import VectorLike, assign, positive, vector

__all__ = ["Air", "drag_coefficients"]

Array = NDArray[np.float64]

# Reynolds numbers at which the formulas for c_n and c_t change.
SLOW, FAST = 0.1, 100.0
# Below this one the drag is linear in the velocity, w c(w) staying what it is here.
CREEPING = 1e-3
S_0 = 2.0022


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
        across, along = self._per_velocity(v, tangent, diameter)
        v_t = np.einsum("ni,ni->n", v, tangent)[:, None] * tangent
        return across[:, None] * (v - v_t) + along[:, None] * v_t

    def drag_gradient(self, v: Array, tangent: Array, diameter: Array) -> Array:
        """∂f/∂v at fixed tangent, shape (n, 3, 3) [N s/m²]."""
        across, along = self._per_velocity(v, tangent, diameter)
        v_t = np.einsum("ni,ni->n", v, tangent)[:, None] * tangent
        v_n = v - v_t
        speed = np.sqrt(np.einsum("ni,ni->n", v_n, v_n))
        slopes = self._slopes(speed, diameter)
        project = np.einsum("ni,nj->nij", tangent, tangent)
        direction = v_n / np.maximum(speed, np.finfo(float).tiny)[:, None]
        change = slopes[0][:, None] * v_n + slopes[1][:, None] * v_t
        moving = across[:, None, None] * (np.eye(3) - project) + along[:, None, None] * project
        return moving + np.einsum("ni,nj->nij", change, direction)

    def _per_velocity(self, v: Array, tangent: Array, diameter: Array) -> tuple[Array, Array]:
        """ρ_a d |v_n| c_n and ρ_a d |v_n| c_t, which are ρ_a ν w c(w), shape (n,) each [N s/m²]."""
        v_n = v - np.einsum("ni,ni->n", v, tangent)[:, None] * tangent
        w = self._reynolds(np.sqrt(np.einsum("ni,ni->n", v_n, v_n)), diameter)
        c_n, c_t = drag_coefficients(w)
        return self.viscosity * w * c_n, self.viscosity * w * c_t

    def _slopes(self, speed: Array, diameter: Array) -> tuple[Array, Array]:
        """Their derivatives with |v_n|, by a central difference of relative step ε^(1/3); zero where creeping."""
        w = self._reynolds(speed, diameter)
        ratio = 1.0 + np.cbrt(np.finfo(float).eps)
        (n_1, t_1), (n_0, t_0) = drag_coefficients(w * ratio), drag_coefficients(w / ratio)
        per_speed = self.viscosity / (np.maximum(speed, np.finfo(float).tiny) * (ratio - 1.0 / ratio))
        moving = w > CREEPING * ratio
        return tuple(
            np.where(moving, per_speed * w * (ratio * c_1 - c_0 / ratio), 0.0) for c_1, c_0 in ((n_1, n_0), (t_1, t_0))
        )

    def _reynolds(self, speed: Array, diameter: Array) -> Array:
        """w = |v_n| d/ν, no less than what makes the drag linear."""
        return np.maximum(speed * diameter * self.density / self.viscosity, CREEPING)


def drag_coefficients(w: Array) -> tuple[Array, Array]:
    """Drag of a long cylinder across and along it.

    Slender-body theory for w < 0.1, a fit in log w up to 100, boundary layers beyond; w c(w) is constant below 1e-3.

    Args:
        w: Reynolds number of the velocity across, shape (n,).

    Returns:
        c_n and c_t, shape (n,) each.

    Source: Marheineke & Wegener 2011, with S(w) = 2.0022 − ln w.
    """
    low = np.clip(w, CREEPING, SLOW)
    S = S_0 - np.log(low)
    inner = 4.0 * np.pi / low
    slow_n = inner / S * (1.0 - low**2 * (S**2 - S / 2 + 5 / 16) / (32 * S))
    slow_t = inner / (2 * S - 1) * (1.0 - low**2 * (2 * S**2 - 2 * S + 1) / (16 * (2 * S - 1)))
    L = np.log(np.clip(w, SLOW, FAST))
    mid_n = np.exp(1.6911 - 0.67222 * L + 0.033287 * L**2 + 0.0035015 * L**3)
    mid_t = np.exp(1.1552 - 0.68479 * L + 0.014884 * L**2 + 0.00074966 * L**3)
    root = 2.0 / np.sqrt(np.maximum(w, FAST))
    ranges = [w < SLOW, w <= FAST]
    creeping = low / np.minimum(np.maximum(w, np.finfo(float).tiny), low)
    return (
        np.select(ranges, [slow_n * creeping, mid_n], root + 0.5),
        np.select(ranges, [slow_t * creeping, mid_t], root),
    )
