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


def pierces(surface: Surface, X_0: Array, X: Array) -> bool:
    """Whether any point has sunk into a bulge by half its radius, or has gone through it to where normals face away.

    Args:
        surface: At rest.
        X_0: Points at the start of a step, in axes that move with it, shape (n, 3) [m].
        X: At its end.

    Returns:
        Whether one has.
    """
    end = surface.closest(X)
    bend = np.abs(np.linalg.eigvalsh(end.curvature)).max(axis=1, initial=0.0)
    if (end.distance * bend < -1.0).any():
        return True
    away = np.einsum("ni,ni->n", surface.closest(X_0).normal, end.normal) < 0.0
    if not away.any():
        return False
    parts = np.linspace(0.0, 1.0, PLACES)[:, None, None]
    way = ((1.0 - parts) * X_0[away] + parts * X[away]).reshape(-1, 3)
    return bool((surface.closest(way).distance < 0.0).any())
