"""The curved beam of BeamDyn and Kynema: published as the 45° bend, but its axis is a parabola through three points."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import Clamp, PointForce, Rod, Scene, Section
from verification.case import Case
from verification.references import tabulated

if TYPE_CHECKING:
    from verification.case import Pose

__all__ = ["CASES", "bend"]

# The six-digit points (x, y) that the axis goes through after the origin [m].
THROUGH = np.array([(38.2683, -7.61205), (70.7107, -29.2893)])
SECTION = Section(EA=1e7, GA=4166670.0, GJ=833300.0, EI=833300.0)
# The cubic through so many points of the parabola moves the tip by less than 1e-12 of the length.
POINTS = 257


def bend() -> Case:
    """Parabola y = a x + b x² clamped at the origin, with a dead tip force of 600 N along z."""
    a, b = np.linalg.solve(THROUGH[:, :1] ** [1, 2], THROUGH[:, 1])
    x = np.linspace(0.0, THROUGH[-1, 0], POINTS)
    slope = a + 2.0 * b * x[[0, -1]]
    start, end = (slope * np.sqrt(1.0 + slope**2) + np.arcsinh(slope)) / (4.0 * b)
    length = float(end - start)

    def scene(pose: Pose) -> Scene:
        points = np.column_stack([x, a * x + b * x**2, np.zeros(POINTS)]) @ pose.rotation.T + pose.start(length)
        rod = Rod.through(points, section=SECTION, d2=pose.vector(0.0, 0.0, 1.0))
        load = PointForce(pose.vector(0.0, 0.0, 600.0), at="end")
        return Scene(rods=[rod], supports=[Clamp(at="start")], loads=[load])

    return Case(
        name="parabola-600",
        title="Parabola, force 600, BeamDyn and Kynema, Simo–Reissner",
        family="parabola",
        scene=scene,
        reference=tabulated("D2-parabola-F600"),
        length=length,
        models=("continuum",),
        planar=False,
    )


CASES = (bend(),)
