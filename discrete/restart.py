"""The last state of a result, kept in SI units so that a later solve can go on from it."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from discrete.moving import Moving
from discrete.state import State
from dolfinrod.scene import SceneError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from discrete.mesh import Mesh

    Array = NDArray[np.float64]

__all__ = ["moving_on", "restored", "stored", "stored_motion"]

_TREND = ("a", "alpha", "F_n_rate")


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


def stored_motion(state: Moving, step: float, mesh: Mesh) -> dict[str, Array]:
    """State of a motion as arrays in SI units.

    Args:
        state: Configuration and velocities.
        step: Length of the next step [s].
        mesh: Its mesh.

    Returns:
        What `stored` keeps, with velocities, their rates, sums of turns and the next step.
    """
    node_i, L = mesh.elements.node_i, mesh.units.length
    e = state.x[node_i + 1] - state.x[node_i]
    u = e / np.linalg.norm(e, axis=1)[:, None]
    arrays = stored(State(state.x, state.R, u, state.F_n, state.factors), mesh)
    arrays |= {"v": state.v * L, "omega": state.ω, "theta": state.θ, "step": np.array(step)}
    if state.trend is not None:
        units = (L, 1.0, mesh.units.force)
        arrays |= {name: rate * unit for name, rate, unit in zip(_TREND, state.trend, units, strict=True)}
    return arrays


def moving_on(arrays: Mapping[str, Array], begin: Moving, mesh: Mesh, t: float | None) -> Moving:
    """State of a motion that goes on from a result.

    Args:
        arrays: What `stored` or `stored_motion` returned.
        begin: The first state of the scene.
        mesh: Its mesh.
        t: Time that the result had reached in the same scene; None: only its shape is taken over, from which the
            motion begins with the velocities of the scene.

    Returns:
        The state.

    Raises:
        SceneError: The arrays are of another model or mesh.
    """
    node_i = mesh.elements.node_i
    reference = State(begin.x, begin.R, np.zeros((len(node_i), 3)), begin.F_n, begin.factors)
    state = restored(arrays, reference, mesh)
    shaped = replace(begin, x=state.x, R=state.R, F_n=state.F_n)
    if t is None or "v" not in arrays:
        return shaped
    L = mesh.units.length
    trend = None
    if all(name in arrays for name in _TREND):
        trend = arrays["a"] / L, arrays["alpha"], arrays["F_n_rate"] / mesh.units.force
    return replace(
        shaped, t=t, v=arrays["v"] / L, ω=arrays["omega"], θ=arrays["theta"], factors=state.factors, trend=trend
    )
