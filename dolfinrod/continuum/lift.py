"""A planar state as one in space."""

from __future__ import annotations

from typing import TYPE_CHECKING

from dolfinrod.continuum import quaternion

if TYPE_CHECKING:
    from dolfinrod.continuum.placement import Placement
    from dolfinrod.continuum.readout import State

__all__ = ["lifted"]


def lifted(state: State, plane: Placement) -> State:
    """Fields of a spatial problem on the same elements, multipliers not in balance yet.

    Args:
        state: Gathered state of a planar problem.
        plane: Its placement; the one in space has the same origin and units.

    Returns:
        Gathered state.
    """
    spin = plane.spin_axes[:, 0]
    r, N = (state[field] @ plane.axes.T for field in ("r", "N"))
    q, m = quaternion.exponential(state["q"] * spin), state["m"] * spin
    return {"r": r, "q": q, "N": N, "m": m, "multiplier": 0.0 * q[..., :1]}
