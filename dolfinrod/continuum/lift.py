"""States in the working coordinates of another problem."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.continuum import quaternion
from dolfinrod.continuum.placement import exact_zeros

if TYPE_CHECKING:
    from dolfinrod.continuum.placement import Placement
    from dolfinrod.continuum.readout import State

__all__ = ["lifted", "restated"]


def lifted(state: State, plane: Placement, space: Placement) -> State:
    """Fields of a spatial problem on the same elements, multipliers not in balance yet.

    Args:
        state: Gathered state of a planar problem.
        plane: Its placement.
        space: That of the problem in space, of the same origin and units.

    Returns:
        Gathered state.
    """
    spin = exact_zeros(space.spin_axes.T @ plane.spin_axes[:, 0])
    r, N = (state[field] @ exact_zeros(plane.axes.T @ space.axes) for field in ("r", "N"))
    q, m = quaternion.exponential(state["q"] * spin), state["m"] * spin
    return {"r": r, "q": q, "N": N, "m": m, "multiplier": 0.0 * q[..., :1]}


def restated(state: State, before: Placement, now: Placement) -> State:
    """The same state of the same rods in other working coordinates and units, multipliers not in balance.

    Args:
        state: Gathered state.
        before: Placement it belongs to.
        now: Placement wanted, of the same kinematics.

    Returns:
        Gathered state.
    """
    spins = exact_zeros(before.spin_axes.T @ now.spin_axes)
    q = state["q"]
    angles = q @ spins if q.shape[-1] == 1 else np.concatenate([q[..., :1], q[..., 1:] @ spins], axis=-1)
    forces = exact_zeros(before.axes.T @ now.axes) * (before.force / now.force)
    moments = spins * (before.moment / now.moment)
    return state | {
        "r": now.points(before.to_space(state["r"])),
        "q": angles,
        "N": state["N"] @ forces,
        "m": state["m"] @ moments,
    }
