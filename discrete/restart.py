"""The last state of a result, kept in SI units so that a later solve can go on from it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from discrete.state import State
from dolfinrod.scene import SceneError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from discrete.mesh import Mesh

    Array = NDArray[np.float64]

__all__ = ["restored", "stored"]


def stored(state: State, mesh: Mesh) -> dict[str, Array]:
    """A state as arrays in SI units.

    Args:
        state: The configuration.
        mesh: Its mesh.

    Returns:
        Positions [m], section frames, chord directions, axial forces [N] and factors of prescribed motions.
    """
    return {
        "x": state.x * mesh.units.length + mesh.origin,
        "R": state.R,
        "u": state.u,
        "F_n": state.F_n * mesh.units.force,
        "factors": state.factors,
    }


def restored(arrays: Mapping[str, Array], reference: State, mesh: Mesh) -> State:
    """The state that `stored` kept, in the units of a mesh.

    Factors of prescribed motions are taken over where there are as many, otherwise the motions begin anew.

    Args:
        arrays: What `stored` returned.
        reference: A state of the mesh, for its shapes.
        mesh: The mesh.

    Returns:
        The state.

    Raises:
        SceneError: The arrays are of another model or mesh.
    """
    shapes = {name: getattr(reference, name).shape for name in ("x", "R", "u", "F_n")}
    if "factors" not in arrays or any(name not in arrays or arrays[name].shape != shapes[name] for name in shapes):
        raise SceneError("start must be a result of the discrete model, with equilibrium, on the same elements")
    same = arrays["factors"].shape == reference.factors.shape
    return State(
        x=(arrays["x"] - mesh.origin) / mesh.units.length,
        R=arrays["R"].copy(),
        u=arrays["u"],
        F_n=arrays["F_n"] / mesh.units.force,
        factors=arrays["factors"] if same else reference.factors,
    )
