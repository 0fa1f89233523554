"""Where the element ends of a rod lie: evenly spaced, the nearest one moved under each support and load."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import SceneError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.scene import Scene

__all__ = ["element_ends"]


def element_ends(scene: Scene, rod: int, n: int) -> NDArray[np.float64]:
    """Ascending arc lengths of the n + 1 element ends of a rod, a node under every mark of the scene.

    Raises:
        SceneError: More marks than nodes.
    """
    length = scene.rods[rod].length
    s = np.linspace(0.0, length, n + 1)
    free = np.ones(n + 1, dtype=bool)
    free[[0, -1]] = False
    for mark in scene.marks(rod):
        if min(mark, length - mark) <= 0.0:
            continue
        if not free.any():
            raise SceneError(f"elements must be more than {n}: rods[{rod}] is held or loaded at more places inside")
        nearest = np.flatnonzero(free)[np.argmin(np.abs(s[free] - mark))]
        s[nearest] = mark
        free[nearest] = False
    return np.sort(s)
