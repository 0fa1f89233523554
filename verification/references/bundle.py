"""Parallel rods that lie on planes and on each other, as circles in a plane: closed forms, and any heap by springs.

Rigid circles in a V whose flanks rise by β: one at the bottom, others in chains up both flanks, each leaning on the one
below. Every flank carries q cos β of each of those, a contact n q sin β of the n above it, and the flanks under the
lowest what is left. Such a heap is statically determinate, and stands if the lowest is pressed to both flanks.

With p = ε (g_0 − g) in place of rigid contact the circles sit elsewhere by p/ε: `Heap.settled` minimises the energy of
all pressed gaps and of the loads, by Newton's method in the positions of the centres. Nothing of the models is read.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, sin

import numpy as np
from numpy.typing import NDArray

__all__ = ["Heap", "Settled", "Vee"]

Array = NDArray[np.float64]

MAX_ITERATIONS = 100
ROUND_OFF = 1e-14


@dataclass(frozen=True)
class Vee:
    """Equal rigid circles in a V: one at its bottom, chains up its right and its left flank.

    Args:
        slope: β of both flanks [rad].
        load: q of each circle, downwards [N/m].
        right: Circles in the chain up the right flank.
        left: Likewise.
        radius: Of all [m].
    """

    slope: float
    load: float
    right: int
    left: int
    radius: float = 1.0

    @property
    def links(self) -> tuple[Array, Array]:
        """Line loads between neighbours of the right and the left chain, from the bottom up [N/m]."""
        right, left = (self.load * sin(self.slope) * np.arange(n, 0, -1) for n in (self.right, self.left))
        return right, left

    @property
    def flank(self) -> float:
        """Line load of a flank on each circle of its chain [N/m]."""
        return self.load * cos(self.slope)

    @property
    def bottom(self) -> tuple[float, float]:
        """Line loads of the right and the left flank on the lowest circle; negative where it does not stand [N/m]."""
        c, s = cos(self.slope), sin(self.slope)
        right, left = self.load * self.right * s, self.load * self.left * s
        both, difference = (self.load + (right + left) * s) / c, (left - right) * c / s
        return 0.5 * (both + difference), 0.5 * (both - difference)

    @property
    def centres(self) -> Array:
        """Across and up from where the flanks meet: the lowest, the right chain, the left one, shape (n, 2) [m]."""
        c, s = cos(self.slope), sin(self.slope)
        chains = [np.arange(1, n + 1)[:, None] * 2.0 * self.radius * np.array([side * c, s]) for n, side in self._sides]
        return np.array([0.0, self.radius / c]) + np.concatenate([np.zeros((1, 2)), *chains])

    @property
    def flanks(self) -> Array:
        """Normals of the right and the left flank, shape (2, 2)."""
        return np.array([[-sin(self.slope), cos(self.slope)], [sin(self.slope), cos(self.slope)]])

    @property
    def _sides(self) -> tuple[tuple[int, float], tuple[int, float]]:
        return (self.right, 1.0), (self.left, -1.0)


@dataclass(frozen=True, eq=False)
class Settled:
    """Circles at rest.

    Args:
        centres: Shape (n, 2) [m].
        walls: Line loads of the planes on the circles, shape (n, n_walls) [N/m].
        pairs: Of the circles on each other, symmetric, shape (n, n) [N/m].
    """

    centres: Array
    walls: Array
    pairs: Array


@dataclass(frozen=True, eq=False)
class Heap:
    """Circles pressed on planes and on each other.

    Args:
        radii: Shape (n,) [m].
        loads: Across and up, shape (n, 2) [N/m].
        points: One of each plane, shape (n_walls, 2) [m].
        normals: Of the planes, towards the circles, shape (n_walls, 2).
        eps_wall: ε_N of the planes [N/m²].
        eps_pair: Of circles on circles [N/m²].
        g_0: Gap where contact begins [m].
    """

    radii: Array
    loads: Array
    points: Array
    normals: Array
    eps_wall: float
    eps_pair: float
    g_0: float = 0.0

    def settled(self, start: Array) -> Settled:
        """Where they come to rest.

        Args:
            start: Centres not far from there, so that what touches there touches here, shape (n, 2) [m].

        Raises:
            ArithmeticError: They do not.
        """
        x = np.array(start, dtype=float)
        for _ in range(MAX_ITERATIONS):
            force, stiffness, walls, pairs = self._pushed(x)
            step = np.linalg.lstsq(stiffness, force.ravel(), rcond=1e-14)[0].reshape(-1, 2)
            if np.abs(step).max() < ROUND_OFF * np.abs(x).max():
                return Settled(x, walls, pairs)
            x = x + step * min(1.0, 0.1 * self.radii.min() / np.abs(step).max())
        raise ArithmeticError("the circles do not settle")

    def _pushed(self, x: Array) -> tuple[Array, Array, Array, Array]:
        """Force on each circle, stiffness against moving, and the line loads."""
        n = len(x)
        force, K = self.loads.astype(float).copy(), np.zeros((n, 2, n, 2))
        heights = np.einsum("nwi,wi->nw", x[:, None] - self.points, self.normals) - self.radii[:, None]
        walls = self.eps_wall * np.maximum(self.g_0 - heights, 0.0)
        force += walls @ self.normals
        for k, w in np.argwhere(walls > 0.0):
            K[k, :, k] += self.eps_wall * np.outer(self.normals[w], self.normals[w])
        pairs = np.zeros((n, n))
        for a in range(n):
            for b in range(a):
                apart = x[a] - x[b]
                D = float(np.hypot(*apart))
                p = self.eps_pair * (self.g_0 + self.radii[a] + self.radii[b] - D)
                if p <= 0.0:
                    continue
                pairs[a, b] = pairs[b, a] = p
                out = apart / D
                force[a] += p * out
                force[b] -= p * out
                along = np.outer(out, out)
                k = self.eps_pair * along - p / D * (np.eye(2) - along)
                K[a, :, a] += k
                K[b, :, b] += k
                K[a, :, b] -= k
                K[b, :, a] -= k
        return force, K.reshape(2 * n, 2 * n), walls, pairs
