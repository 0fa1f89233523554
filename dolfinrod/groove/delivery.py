"""Twist that leaves at B while fibres and roller go on."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import SceneError
from dolfinrod.twist import outflow

if TYPE_CHECKING:
    from dolfinrod.groove.scenario import Scenario
    from dolfinrod.result import Result
    from dolfinrod.twist import Outflow

__all__ = ["delivery"]


def delivery(result: Result, scenario: Scenario, *, since: float = 0.0) -> Outflow:
    """Twist of the strand that leaves through the plane of B, T_out = −(1/2πv) dθ/dt, the mean over all pairs.

    The plane stands still where the farthest fibres can all be seen from then on: at B, or where the shortest of them
    ended then, a stretch of some micrometres before.

    Args:
        result: Of the scenario, by either model.
        scenario: What was solved; its fibres move on, `ends.speed` above zero.
        since: Time from which on it counts, such as the end of gathering [s].

    Returns:
        Turns and twist over time.

    Raises:
        SceneError: Fibres that stay, a single one, or fewer than two stored times from then on.
        ValueError: A fibre turns back, or states are stored too seldom, as `dolfinrod.twist` says.
    """
    if scenario.ends.speed <= 0.0 or scenario.fibres < 2:
        raise SceneError("must be above 0, with two fibres or more, for twist to leave at B", field="Ends.speed")
    later = result.t >= since
    if later.sum() < 2:
        raise SceneError(f"must leave two stored times or more, got {since!r} s", field="since")
    fibres = [rod.r[later] for rod in result.rods[: scenario.fibres]]
    B = min(scenario.bundle.length, *(float(r[:, -1, 0].min()) for r in fibres))
    return outflow(np.asarray(result.t)[later], fibres, X=B, speed=scenario.ends.speed)
