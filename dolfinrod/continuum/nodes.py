"""Where the element ends of a rod lie: evenly spaced, the nearest one moved under each support and load."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import SceneError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.scene import Scene

__all__ = ["element_counts", "element_ends"]


def element_counts(scene: Scene, elements: int | Sequence[int]) -> tuple[int, ...]:
    """One number of elements a rod.

    Raises:
        SceneError: Not a positive whole number for every rod.
    """
    if isinstance(elements, Sequence) and not isinstance(elements, str):
        counts = list(elements)
    else:
        counts = [elements] * len(scene.rods)
    if len(counts) != len(scene.rods):
        raise SceneError(f"elements must be one number or one for each of the {len(scene.rods)} rods, got {elements}")
    for n in counts:
        if not isinstance(n, int | np.integer) or isinstance(n, bool) or n < 1:
            raise SceneError(f"elements must be a positive whole number, got {n!r}")
    return tuple(map(int, counts))


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
