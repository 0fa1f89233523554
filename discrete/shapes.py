"""Eigenvectors as a user reads them: displacement and rotation along the rods, in space, to one scale."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from discrete.unknowns import N_NODE, SPIN, X
from dolfinrod.eigen import RodShapes

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.mesh import Mesh
    from discrete.nodes import Tangent

    Array = NDArray[np.float64]

__all__ = ["shapes"]

# Displacement over length and spin below which a mode is one of rotation alone.
NO_DISPLACEMENT = 1e-6


def shapes(mesh: Mesh, tangent: Tangent, vectors: Array) -> tuple[RodShapes, ...]:
    """Shapes of modes, one record a rod.

    Args:
        mesh: Nodes and elements.
        tangent: Says in which axes spins stand.
        vectors: Eigenvectors as columns, shape (n_nodes · 7, n_modes).

    Returns:
        Displacements up to 1, or spins where there are none.
    """
    moves = np.array([_scaled(tangent.in_space(v.reshape(-1, N_NODE)), mesh.units.length) for v in vectors.T])
    moves = moves.reshape(vectors.shape[1], len(mesh.x), N_NODE)
    return tuple(
        RodShapes(s, moves[:, a:b, X], moves[:, a:b, SPIN])
        for s, (a, b) in zip(mesh.s, pairwise(mesh.first), strict=True)
    )


def _scaled(mode: Array, length: float) -> Array:
    """A mode to one scale, displacements in metres; the first component that is nearly the largest is positive."""
    mode = mode.copy()
    displacement, spin = (np.linalg.norm(mode[:, part], axis=1).max() for part in (X, SPIN))
    turns_only = displacement <= NO_DISPLACEMENT * spin
    mode[:, X] *= 0.0 if turns_only else length
    main = mode[:, SPIN if turns_only else X].reshape(-1)
    size = spin if turns_only else displacement * length
    marked = np.abs(main) > 0.9 * np.abs(main).max()
    return mode * (np.sign(main[marked.argmax()]) / size)
