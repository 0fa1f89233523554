"""How many unknowns each field has."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from dolfinrod.continuum.discretization import Discretization
    from dolfinrod.continuum.readout import State

__all__ = ["unknowns"]


def unknowns(d: Discretization, state: State) -> dict[str, int]:
    """Dofs of each field over all ranks, those of neighbouring elements counted once.

    Args:
        d: Elements.
        state: A gathered state on them.

    Returns:
        Field → number of dofs.
    """
    found = {field: int(np.prod(state[field].shape)) for field in d.kinematics.fields}
    for field in set(found) - {"N", "m"}:
        cells, nodes, components = state[field].shape
        found[field] = (cells * (nodes - 1) + len(d.elements)) * components
    return found
