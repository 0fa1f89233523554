"""The next critical points on a path, seen from an equilibrium: (K + μ dK/dt) v = 0."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

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

__all__ = ["critical_ahead"]

# Critical points farther away than this many times t_end are none.
FAR = 1e6
# Part of 1/μ, over the largest, that is round-off.
SLIGHT = 1e-7


def critical_ahead(
    equilibrium: Equilibrium, scene: Scene, state: State, t: float, tangent: Tangent, n: int
) -> tuple[Complex, Complex]:
    """Ways μ to the next critical points, and how the rods give way there.

    Args:
        equilibrium: Solver of the scene.
        scene: The problem.
        state: An equilibrium.
        t: Its pseudo-time.
        tangent: There.
        n: How many are sought.

    Returns:
        μ with a positive real part, the least first, and vectors as columns, spins in the axes of the tangent.

    Raises:
        SingularTangentError: The load is critical at t.
    """
    rate = rate_of_state(equilibrium, scene, state, t, tangent)
    dK = replace(tangent, elements=rate_of_tangent(equilibrium, scene, state, t, tangent, rate))
    inverse = tangent.inverse()
    free = np.ones(tangent.system.n_unknowns, dtype=bool)
    free[tangent.system.held] = False

    def times(v: Array) -> Array:
        return -inverse.times(dK.times(v) * free[:, None])

    θ, v, largest = leading(times, free, n, lambda θ: θ.real, least=SLIGHT)
    ahead = θ.real > max(SLIGHT * largest, 1.0 / (FAR * scene.motion.t_end))
    return 1.0 / θ[ahead], v[:, ahead]
