"""The paper's fibre in its lateral groove: pressed onto a flank and dragged to the bottom, in equilibrium or in time.

Frame and section of process.md 6.1 and 6.2: x along the groove, y out of it, z across; the corner at the bottom is
rounded by 0.15 mm, for a sharp one has no normal. End A is clamped above the left flank, end B is free but for a
tension, so that it can be gathered.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import cos, pi, radians, sin
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import (
    Clamp,
    Contact,
    Coulomb,
    Dynamic,
    Groove,
    ImplicitEuler,
    LineForce,
    PointForce,
    Rod,
    Scene,
    Section,
    Static,
    Steady,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from dolfinrod.result import Result
    from dolfinrod.scene import AugmentedLagrangian, Penalty
    from dolfinrod.scene.motion import Motion, Scheme

    Array = NDArray[np.float64]
    Law = AugmentedLagrangian | Penalty

__all__ = ["CASES", "LENGTH", "GrooveCase", "gathered", "lateral", "pressed", "stations"]

# Of the fibre, and where along the groove's section it starts [m].
LENGTH, FEED = 0.04, -1e-3
# Flanks, lip and corner of the section (process.md 6.2).
LEFT, RIGHT, HALF_WIDTH, FILLET = radians(15.0), radians(75.0), 1.5e-3, 1.5e-4
MU, TENSION = 0.64, 1e-3
# Loads of a quasi-static pull, and the drag of air at 20 m/s (process.md 2.4) on a fibre that is let go [N/m].
PULL, DRAG = 4e-3, 9.3e-3
# In which the air sets in, and the end of the gathering [s].
RISE, GATHERED = 1e-4, 4e-4
# Where the centreline is compared: nodes of every mesh.
STATIONS = LENGTH * np.arange(1, 11) / 10.0


def lateral() -> Groove:
    """Left flank at 15° to the surface, right wall at 15° to its normal."""
    return Groove.v(LEFT, RIGHT, HALF_WIDTH, fillet=FILLET)


def fibre(within: float) -> Rod:
    """Straight along the groove, its surface so far from the left flank [m]."""
    foot = np.array([FEED, -(FEED + HALF_WIDTH) * np.tan(LEFT)])
    section = Section.ramie()
    assert section.radius is not None
    z, y = foot + (section.radius + within) * np.array([sin(LEFT), cos(LEFT)])
    return Rod.straight(length=LENGTH, section=section, start=(0.0, y, z))


def pressed(law: Law, motion: Motion) -> Scene:
    """Pressed against the flank, dragged down along it to the bottom, let back a little, then pulled at its end.

    It starts in equilibrium with what presses it. When the drag falls by a tenth, everything sticks; the last pull
    slides it along the groove no farther than friction lets it, so that it ends in zones that stick and that slide.
    """
    press = LineForce((0.0, -PULL * cos(LEFT), -PULL * sin(LEFT)), history=Steady())
    down = (0.0, -PULL * sin(LEFT), PULL * cos(LEFT))
    let_back = ((0.0, 0.0), (0.2, 0.0), (0.7, 1.0), (0.8, 0.9), (1.0, 0.9))
    drag = LineForce(down, history=let_back)
    pulls = ((0.0, 0.0), (0.2, 1.0), (0.8, 1.0), (1.0, 1.05))
    tension = PointForce((TENSION, 0.0, 0.0), at="end", history=pulls)
    contact = Contact(lateral(), law, Coulomb(MU))
    start = fibre(law.g_0 - PULL / law.eps_N)
    return Scene([start], [Clamp("start")], [press, drag, tension], [contact], motion=motion)


def gathered(law: Law, motion: Motion) -> Scene:
    """Blown down the flank, at 45° to the surface."""
    size = DRAG / np.sqrt(2.0)

    def rises(t: float) -> float:
        return sin(0.5 * pi * min(t / RISE, 1.0)) ** 2

    air = LineForce((0.0, -size, size), history=rises)
    tension = PointForce((TENSION, 0.0, 0.0), at="end", history=rises)
    contact = Contact(lateral(), law, Coulomb(MU))
    return Scene([fibre(law.g_0)], [Clamp("start")], [air, tension], [contact], motion=motion)


@dataclass(frozen=True)
class GrooveCase:
    """A way into the groove.

    Args:
        name: Short, unique.
        title: For people.
        scene: Of a law and a motion.
        t_end: Of the motion [s]; None: statics.
    """

    name: str
    title: str
    scene: Callable[[Law, Motion], Scene] = field(repr=False)
    t_end: float | None

    def motion(self, steps: int, scheme: Scheme | None = None) -> Motion:
        """So many equal steps."""
        if self.t_end is None:
            return Static(steps=steps)
        return Dynamic(self.t_end, self.t_end / steps, scheme=scheme or ImplicitEuler(), output=self.t_end)


CASES = (
    GrooveCase("groove-pressed", "Pressed onto the flank and dragged, in equilibrium", pressed, None),
    GrooveCase("groove-gathered", "Blown down the flank in 0.4 ms", gathered, GATHERED),
)


def stations(result: Result) -> Array:
    """Where the stations are at the end, shape (10, 3) [m]."""
    return np.array([result.rods[0].at(s)[-1] for s in STATIONS])
