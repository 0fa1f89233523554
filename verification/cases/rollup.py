"""Cantilever rolled up by an end moment: π, 2π, 4π, 10π EI/L."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import Clamp, PointMoment, Scene
from verification.case import Case
from verification.cases.elastica import circular, in_plane, straight
from verification.references import circle, tabulated

if TYPE_CHECKING:
    from verification.case import Pose

__all__ = ["CASES", "rolled"]

IDS = {0.5: "1/2", 1.0: "1", 2.0: "2", 5.0: "5"}


def rolled(turns: float) -> Case:
    """End moment 2π·turns·EI/L: a circle whatever EA and GA; here a circular section with L/d = 200.

    Args:
        turns: 0.5, 1, 2 or 5.

    Returns:
        The case.
    """
    moment = 2.0 * np.pi * turns

    def scene(pose: Pose) -> Scene:
        return Scene(
            rods=[straight(circular(200.0), pose)],
            supports=[Clamp(at="start")],
            loads=[PointMoment(pose.vector(0.0, 0.0, moment), at="end")],
        )

    return Case(
        name=f"rollup-{turns:g}",
        title=f"Roll-up, end moment {2 * turns:g}π EI/L".replace(" 1π", " π"),
        family="rollup",
        scene=scene,
        reference=tabulated(f"B-turns-{IDS[turns]}"),
        length=1.0,
        turns=max(1, round(turns)),
        centreline=lambda s: in_plane(circle(moment, s)),
    )


CASES = (rolled(0.5), rolled(1.0), rolled(2.0), rolled(5.0))
