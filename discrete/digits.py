"""How many digits round-off leaves of the energies of modes: elements can be too short for any."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from discrete.unknowns import N_NODE, X
from dolfinrod.scene import SceneError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.nodes import Tangent

    Array = NDArray[np.float64]

__all__ = ["demand_digits", "lost"]

# Translations among the unknowns of an element.
_MOVES = np.array([0, 1, 2, N_NODE, N_NODE + 1, N_NODE + 2])
# Errors of eigenvalues over those of the energies of their modes: two to six times on 1000 to 5000 elements.
OFTEN = 8.0
# Largest relative error of an eigenvalue that is given out.
LEAST = 1e-3


def lost(tangent: Tangent, v: Array) -> Array:
    """Relative round-off of the energy vᵀ K v of modes, ε (Σ (|u|ᵀ |K_e| |u|)²)^½ / |vᵀ K v|.

    Neighbours move by nearly the same u, and what is left of their stiffnesses 12 EI/l³ is EI/L³ of the rod. Errors of
    elements know nothing of each other.

    Args:
        tangent: K.
        v: Modes as columns, shape (n_unknowns, m).

    Returns:
        One number a mode, shape (m,).
    """
    i = tangent.system.node_i
    u = np.abs(v.reshape(len(v) // N_NODE, N_NODE, v.shape[1])[:, X])
    own = np.concatenate([u[i], u[i + 1]], axis=1)
    stiffness = np.abs(tangent.elements[:, _MOVES[:, None], _MOVES])
    work = np.einsum("eam,eam->em", own, np.matmul(stiffness, own))
    energy = np.abs(np.einsum("im,im->m", v, tangent.times(v)))
    return np.asarray(np.finfo(float).eps * np.sqrt(np.square(work).sum(axis=0)) / energy)


def demand_digits(part: Array, elements: int, what: str) -> None:
    """Refuse eigenvalues of which round-off leaves fewer than three digits.

    Args:
        part: Relative round-off of the energies that they are made of, shape (m,).
        elements: Of all rods.
        what: They are, for the message.

    Raises:
        SceneError: There is such a one.
    """
    error = OFTEN * float(np.max(part, initial=0.0))
    if error > LEAST:
        raise SceneError(
            f"must be fewer: double precision leaves an error of {error:.1%} in {what} on {elements}, as their "
            "stiffnesses 12 EI/l³ nearly cancel; try a few hundred, or the continuum model",
            field="elements",
        )
