"""What acts in a step in time while it is iterated on, and what comes of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from discrete.loads import LoadLevel
    from discrete.moving import Moving

    Array = NDArray[np.float64]

__all__ = ["Balance", "Taken"]


@dataclass(frozen=True, eq=False)
class Balance:
    """Forces in a configuration, names as in `Taken`.

    Args:
        x: Positions, shape (3, n_nodes).
        R: Section frames, shape (3, 3, n_nodes).
        e: Chords, shape (n, 3).
        E: Triads attached to their ends, shape (n, 2, 3, 3).
        force: Shape (n, 13).
        energy: Of each element, shape (n,).
        internal: Shape (7, n_nodes).
        drag: Shape (n_nodes, 3).
        pressed: What surfaces do, shape (7, n_nodes); None where there are none.
        moment: That of inertia, shape (n_nodes, 3).
        missing: Shape (7, n_nodes).
    """

    x: Array
    R: Array
    e: Array
    E: Array
    force: Array
    energy: Array
    internal: Array
    drag: Array
    pressed: Array | None
    moment: Array
    missing: Array


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
        missing: Loads, drag, surfaces and inertia minus internal forces: what supports answer with a minus, shape
            (n_nodes, 7).
        pressed: Forces and moments of surfaces, shape (n_nodes, 7); None where there are none.
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
    pressed: Array | None
