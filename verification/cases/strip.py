"""A cantilever strip loaded 30° off its principal axes: it bends about both of them, twists, and leaves the plane."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import Clamp, PointForce, Rod, Scene, Section
from verification.case import UPRIGHT, Case
from verification.references import rod_problem, solved

if TYPE_CHECKING:
    from verification.case import Pose

__all__ = ["CASES", "strip"]

ANGLE = np.pi / 6


def strip(ratio: float, alpha: float) -> Case:
    """Unit rod along x with d2 turned by 30° from y, neither shearing nor stretching, EI3 = 1 N m².

    Args:
        ratio: EI2/EI3; a thin strip has GJ = 0.8 EI3 whatever its width.
        alpha: Dead tip force along y [N].

    Returns:
        The case.
    """
    section = Section(GJ=0.8, EI=(ratio, 1.0), rigid={"shear", "extension"})
    name = f"strip-{ratio:g}-{alpha:g}"

    def scene(pose: Pose) -> Scene:
        rod = Rod.straight(
            1.0,
            section,
            start=pose.start(1.0),
            direction=pose.vector(1.0, 0.0),
            d2=pose.vector(0.0, np.cos(ANGLE), np.sin(ANGLE)),
        )
        load = PointForce(pose.vector(0.0, alpha), at="end")
        return Scene(rods=[rod], supports=[Clamp(at="start")], loads=[load])

    return Case(
        name=name,
        title=f"Strip off its axes by 30°, EI2/EI3 = {ratio:g}, PL²/EI3 = {alpha:g}",
        family="strip",
        scene=scene,
        reference=solved(name, rod_problem(scene(UPRIGHT)), 1.0),
        length=1.0,
        planar=False,
    )


CASES = (strip(4.0, 10.0), strip(100.0, 10.0))
