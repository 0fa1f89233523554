"""Energies that points on a wall have exchanged in a step: compiled loops."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.compiled import compiled

__all__ = ["rubbed_off", "wall_work"]

Array = NDArray[np.float64]


@compiled
def wall_work(force: Array, moment: Array, Q: Array, moved: Array, turn: Array, on_wall: Array, turned: Array) -> Array:
    """Work of a moving wall: that of forces and moments in space less that past the wall, shape (n,) [J/m].

    Args:
        force: In space, shape (n, 3) [N/m].
        moment: Likewise [N].
        Q: Axes of the wall as columns, shape (3, 3).
        moved: Ways of the points in space, shape (n, 3) [m].
        turn: Turns of their sections there, shape (n, 3) [rad].
        on_wall: Ways in axes of the wall, shape (n, 3) [m].
        turned: Turns against the wall in its axes, shape (n, 3) [rad].

    Returns:
        f·Δx + m·ψ − (Qᵀf)·ΔX − (Qᵀm)·Ψ.
    """
    work = np.zeros(len(force))
    for i in range(len(force)):
        for a in range(3):
            way, spin = moved[i, a], turn[i, a]
            for j in range(3):
                way -= Q[a, j] * on_wall[i, j]
                spin -= Q[a, j] * turned[i, j]
            work[i] += force[i, a] * way + moment[i, a] * spin
    return work


@compiled
def rubbed_off(
    u_0: Array, ε_T: float, on: NDArray[np.intp], anchored: Array, traction: Array, w: Array
) -> tuple[Array, Array]:
    """What friction has taken: the work against it less what more the anchors store, shape (n,) [J/m].

    Args:
        u_0: Displacements from the anchors where the step began, shape (n, 3) [m].
        ε_T: Stiffness of the anchors [N/m²].
        on: Numbers of the points that rub, shape (m,).
        anchored: Their displacements from the anchors where it ended, shape (m, 3) [m].
        traction: Shape (m, 3) [N/m].
        w: Their ways past the wall, shape (m, 3) [m].

    Returns:
        The energy, and all displacements from the anchors where it ended, shape (n, 3) [m].
    """
    rubbed, u = np.zeros(len(u_0)), np.zeros_like(u_0)
    for i in range(len(u_0)):
        rubbed[i] = 0.5 * ε_T * (u_0[i, 0] ** 2 + u_0[i, 1] ** 2 + u_0[i, 2] ** 2)
    for k in range(len(on)):
        i = on[k]
        for a in range(3):
            u[i, a] = anchored[k, a]
            rubbed[i] -= traction[k, a] * w[k, a] + 0.5 * ε_T * anchored[k, a] ** 2
    return rubbed, u
