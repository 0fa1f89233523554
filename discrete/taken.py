"""What comes of a step in time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from discrete.loads import LoadLevel
    from discrete.moving import Moving

    Array = NDArray[np.float64]

__all__ = ["Taken"]


@dataclass(frozen=True, eq=False)
class Taken:
    """A step and all that acted in it, in units of the model.

    Args:
        state: At its end.
        iterations: Linear systems solved.
        residual: Largest force or moment out of balance before the last increment.
        force: End forces of the elements, shape (n, 13).
        internal: The same at the nodes, shape (n_nodes, 7).
        energy: Strain energy by the law of the step.
        level: Loads at its end.
        acting: The same at the nodes, shape (n_nodes, 7).
        drag: Forces of the air, shape (n_nodes, 3).
        missing: Loads, drag and inertia minus internal forces: what supports answer with a minus, shape (n_nodes, 7).
    """

    state: Moving
    iterations: int
    residual: float
    force: Array
    internal: Array
    energy: float
    level: LoadLevel
    acting: Array
    drag: Array
    missing: Array
