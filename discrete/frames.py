"""Directions of sections and elements: Eq. 10, 11 and 19–21.

Triads are stored with the axes u, v, w as **columns** (global components), so that a local vector becomes global by
multiplication. The paper's direction cosines [A] (Eq. 11) and [t] (Eq. 19) hold the axes as rows: their transpose.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from discrete.rotation import cross, log

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["ElementFrame", "deformation", "direction_cosines", "element_frame", "inertia", "transformation"]


def direction_cosines(triad: NDArray[np.float64]) -> NDArray[np.float64]:
    """Direction cosines [A] of O′uvw relative to Oxyz, Eq. 11: rows are the local axes.

    Args:
        triad: Local axes as columns, shape (..., 3, 3).

    Returns:
        A, shape (..., 3, 3): local components = A · global components.
    """
    return np.swapaxes(triad, -1, -2)


def inertia(J_star: NDArray[np.float64], A: NDArray[np.float64]) -> NDArray[np.float64]:
    """Inertia in global axes, [J] = [A]ᵀ [J*] [A], Eq. 10.

    Args:
        J_star: Inertia in local axes, shape (..., 3, 3) [kg m²].
        A: Direction cosines, Eq. 11, shape (..., 3, 3).

    Returns:
        J, shape (..., 3, 3) [kg m²].
    """
    return np.swapaxes(A, -1, -2) @ J_star @ A


def transformation(t: NDArray[np.float64]) -> NDArray[np.float64]:
    """Transformation [t] of end forces and displacements, Eq. 19: four times the direction cosines.

    Args:
        t: Direction cosines of the element's axes, shape (n, 3, 3).

    Returns:
        Block-diagonal matrices, shape (n, 12, 12): Δ* = [t] Δ and [k] = [t]ᵀ [k*] [t].
    """
    matrix = np.zeros((len(t), 4, 3, 4, 3))
    for block in range(4):
        matrix[:, block, :, block, :] = t
    return matrix.reshape(-1, 12, 12)


def deformation(
    e: NDArray[np.float64], A_i: NDArray[np.float64], A_j: NDArray[np.float64], l_0: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Displacement {δ_e} of node j from its unstrained place, seen from node i, Eq. 20 and 21.

    δ_x = A_i (x_j − x_i) − (l_0, 0, 0) and δ_φ = rotation vector of A_i A_jᵀ, both in the axes of node i.

    Args:
        e: Chords x_j − x_i, shape (n, 3) [m].
        A_i: Direction cosines at nodes i, shape (n, 3, 3).
        A_j: Direction cosines at nodes j, shape (n, 3, 3).
        l_0: Natural lengths of the chords, shape (n,) [m].

    Returns:
        (δ_x, δ_φ), shape (n, 6) [m, rad].
    """
    delta = np.empty((len(e), 6))
    delta[:, :3] = np.matmul(A_i, e[:, :, None])[:, :, 0]
    delta[:, 0] -= l_0
    delta[:, 3:] = log(A_i @ np.swapaxes(A_j, -1, -2))
    return delta


@dataclass(frozen=True, eq=False)
class ElementFrame:
    """Axes along the chord, turned about it to the mean of the node triads.

    Args:
        length: Distance of the nodes L, shape (n,) [m].
        axes: T = [u v w], columns, shape (n, 3, 3).
        turned: Node triads in these axes, Tᵀ E_i and Tᵀ E_j, shape (n, 2, 3, 3).
    """

    length: NDArray[np.float64]
    axes: NDArray[np.float64]
    turned: NDArray[np.float64]


def element_frame(e: NDArray[np.float64], triads: NDArray[np.float64]) -> ElementFrame:
    """Axes of an element: u along the chord e = x_j − x_i, v and w from the mean of the node triads.

    Of all frames with u = e/|e| the one nearest to both triads: v ∝ s₂ − u × s₃ normal to u, with s = E_i + E_j.
    No node and no transverse axis is preferred: exchanging the ends reverses u and w (or u and v), nothing else.

    Args:
        e: Chords, shape (n, 3) [m].
        triads: Triads E_i and E_j attached to the nodes, parallel to the axes in the reference, shape (n, 2, 3, 3).

    Returns:
        Length, axes and triads relative to them.
    """
    length = np.sqrt(np.einsum("ni,ni->n", e, e))
    u = e / length[:, None]
    total = triads[:, 0] + triads[:, 1]
    s, t = total[:, :, 1], total[:, :, 2]
    axes = np.empty((len(e), 3, 3))
    v = axes[:, :, 1]
    axes[:, :, 0] = u
    v[:] = s - cross(u, t)
    v -= np.einsum("ni,ni->n", v, u)[:, None] * u
    v /= np.sqrt(np.einsum("ni,ni->n", v, v))[:, None]
    axes[:, :, 2] = cross(u, v)
    return ElementFrame(length, axes, np.swapaxes(axes, 1, 2)[:, None] @ triads)
