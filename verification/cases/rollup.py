"""Cantilever rolled up by an end moment: an eighth of a turn to ten turns."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import Clamp, PointMoment, Scene
from verification.case import Case
from verification.cases.elastica import circular, in_plane, straight
from verification.references import Reference, circle, tabulated

if TYPE_CHECKING:
    from verification.case import Pose

__all__ = ["CASES", "rolled"]

TURNS = {0.125: "1/8", 0.25: "1/4", 0.5: "1/2", 1.0: "1", 2.0: "2", 5.0: "5"}


def rolled(turns: float) -> Case:
    """End moment 2π·turns·EI/L: a circle whatever EA and GA; here a circular section with L/d = 200.

    Args:
        turns: 1/8, 1/4, 1/2, 1, 2 or 5, which are tabulated, or any other whole number.

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

    whole = turns == round(turns)
    return Case(
        name=f"rollup-{turns:g}",
        title=f"Roll-up, end moment {2 * turns:g}π EI/L".replace(" 1π", " π"),
        family="rollup",
        scene=scene,
        reference=tabulated(f"B-turns-{TURNS[turns]}") if turns in TURNS else closed(turns),
        length=1.0,
        turns=max(1, round(turns)),
        centreline=lambda s: in_plane(circle(moment, s)),
        note="The tip of whole turns shows no order: equal elements close on themselves exactly." if whole else "",
    )


def closed(turns: float) -> Reference:
    """Whole turns end where they began."""
    return Reference(
        id=f"circle(turns={turns:g})",
        value=(0.0, 0.0, 0.0),
        method="closed form: a circle of curvature M/EI, gone round a whole number of times",
        source="Euler 1744; verification/references/elastica.py",
        digits_trusted=15,
        agreement=0.0,
    )


CASES = (*map(rolled, TURNS), rolled(10.0))
