"""The next critical points on a path, seen from an equilibrium: (K + μ dK/dt) v = 0 in axes that turn with the rods."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from discrete.corotating import Corotating
from discrete.digits import lost
from discrete.krylov import leading
from discrete.onward import rate_of_state, rate_of_tangent

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.equilibrium import Equilibrium
    from discrete.nodes import Tangent
    from discrete.state import State
    from dolfinrod.scene import Scene

    Array = NDArray[np.float64]
    Complex = NDArray[np.complex128]

__all__ = ["Ahead", "critical_ahead"]

# Critical points farther away than this many times t_end are none.
FAR = 1e6
# Part of 1/μ, over the largest, that is round-off.
SLIGHT = 1e-7


@dataclass(frozen=True, eq=False)
class Ahead:
    """Critical points ahead of an equilibrium.

    Args:
        way: μ to each, of a positive real part, the least first, shape (m,).
        motion: How the rods give way there, spins in the axes of the tangent, shape (n_unknowns, m).
        lost: Relative round-off of the energies of these motions, shape (m,).
    """

    way: Complex
    motion: Complex
    lost: Array


def critical_ahead(equilibrium: Equilibrium, scene: Scene, state: State, t: float, tangent: Tangent, n: int) -> Ahead:
    """The next critical points, in axes that turn with the rods where these touch nothing.

    Args:
        equilibrium: Solver of the scene.
        scene: The problem.
        state: An equilibrium.
        t: Its pseudo-time.
        tangent: There.
        n: How many are sought.

    Returns:
        As many as there are.

    Raises:
        SingularTangentError: The load is critical at t.
    """
    rate = rate_of_state(equilibrium, scene, state, t, tangent)
    dK = replace(tangent, elements=rate_of_tangent(equilibrium, scene, state, t, tangent, rate))
    # Walls do not turn with the rods.
    turning = Corotating(equilibrium.mesh, tangent, state, rate if equilibrium.contacts is None else 0.0 * rate)
    pencil = _Pencil(tangent, dK, turning)
    θ, y, largest = leading(pencil.times, pencil.free, n, lambda θ: θ.real, least=SLIGHT)
    ahead = θ.real > max(SLIGHT * largest, 1.0 / (FAR * scene.motion.t_end))
    μ, v = 1.0 / θ[ahead], y[: tangent.system.n_unknowns, ahead]
    turned = turning.times(v.real) + 1j * turning.times(v.imag)
    return Ahead(μ, v + μ * turned, lost(tangent, v.real))


class _Pencil:
    """−A⁻¹ B of A y + μ B y = 0, y being motions v′ and what holds the held unknowns of v = (1 + μ W) v′.

    A = [K Hᵀ; H 0] and B = [K′ + K W + Wᵀ K, Wᵀ Hᵀ; H W, 0] with H v = 0.
    """

    def __init__(self, tangent: Tangent, dK: Tangent, turning: Corotating) -> None:
        self._tangent, self._dK, self._turning, self._inverse = tangent, dK, turning, tangent.inverse()
        self._held, self._n = tangent.system.held, tangent.system.n_unknowns
        self.free = np.zeros(self._n + len(self._held), dtype=bool)
        self.free[: self._n] = True
        self.free[self._held] = False

    def times(self, y: Array) -> Array:
        """Products with columns."""
        v, turning, K = y[: self._n], self._turning, self._tangent
        turned, forces = turning.times(v), K.times(v)
        forces[self._held] += y[self._n :]
        right = self._dK.times(v) + K.times(turned) + turning.transposed(forces)
        kept = right[self._held]
        right[self._held] = turned[self._held]
        v = self._inverse.times(right)
        return -np.concatenate([v, kept - K.times(v)[self._held]])
