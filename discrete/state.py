"""Configuration of all rods while equilibrium is sought, and how the search ended."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from discrete.assembly import SingularTangentError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.nodes import Tangent

    Array = NDArray[np.float64]

__all__ = ["Outcome", "State"]


@dataclass(frozen=True, eq=False)
class State:
    """Configuration of all rods, in the units of the model.

    Args:
        x: Positions of the nodes, shape (n_nodes, 3).
        R: Section frames, shape (n_nodes, 3, 3).
        u: Directions of the chords, shape (n, 3).
        F_n: Axial forces, shape (n,).
        factors: Factors of the prescribed motions that have been carried out, shape (n_prescribed,).
    """

    x: Array
    R: Array
    u: Array
    F_n: Array
    factors: Array


@dataclass(frozen=True, eq=False)
class Outcome:
    """How an attempt at equilibrium ended.

    Args:
        state: Where it ended.
        converged: Whether that is an equilibrium.
        iterations: Linear systems solved.
        residual: Largest out-of-balance force or moment before the last increment.
        reason: Why it stopped, in words.
        turned: Largest net turn of a section on the way [rad].
        last_tangent: None where the first one was singular.
        strayed: Whether the sections ended up turned against the way they set out.
    """

    state: State
    converged: bool
    iterations: int
    residual: float
    reason: str
    turned: float
    last_tangent: Tangent | None
    strayed: bool

    @property
    def tangent(self) -> Tangent:
        """Where it was taken last: an increment before the end.

        Raises:
            SingularTangentError: The first one had no inverse.
        """
        if self.last_tangent is None:
            raise SingularTangentError
        return self.last_tangent
