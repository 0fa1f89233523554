"""Steps so long that a rod ends inside a wall or beyond it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from dolfinrod.scene.surfaces import Surface

__all__ = ["PIERCED", "pierces"]

Array = NDArray[np.float64]

PIERCED = "a rod went through a wall in one step"
# Places on the way of a point at which it is looked for behind the wall.
PLACES = 9


def pierces(surface: Surface, X: tuple[Array, Array], n: tuple[Array, Array], φ: Array) -> bool:
    """Whether any point has sunk into a bulge by half its radius, or has gone through it to where normals face away.

    Args:
        surface: At rest.
        X: Points at the start and the end of a step, in axes that move with it, shape (n, 3) each [m].
        n: Normals there.
        φ: Distances at the end, shape (n,) [m].

    Returns:
        Whether one has.
    """
    behind = φ < 0.0
    if behind.any():
        end = surface.closest(X[1][behind])
        bend = np.abs(np.linalg.eigvalsh(end.curvature)).max(axis=1)
        if (end.distance * bend < -1.0).any():
            return True
    away = np.einsum("ni,ni->n", *n) < 0.0
    if not away.any():
        return False
    parts = np.linspace(0.0, 1.0, PLACES)[:, None, None]
    way = ((1.0 - parts) * X[0][away] + parts * X[1][away]).reshape(-1, 3)
    return bool((surface.closest(way).distance < 0.0).any())
