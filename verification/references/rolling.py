"""Round bodies that roll on planes and on one another: how far their axes go for the angle that they turn by.

Friction holds the points that touch. Where gaps are not zero, each body's lever is its radius and half the gap to
another rod, so that levers add up to the distance of the axes; against a wall it is the radius alone.

    turned = s/R: winding is at most s/2πR turns over a way s of the axis;
    a plank on a roller on a floor goes v = (R + a) φ, the roller's axis R φ, with a = R + g/2 to the plank;
    rods held side by side that drive one another turn as −(r_A + g/2) to (r_B + g/2).

Source: textbook kinematics; process.md 6.6 for the bound.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

__all__ = ["Plank", "driven", "most_turns"]


@dataclass(frozen=True)
class Plank:
    """A roller between a floor and a plank.

    Args:
        radius: R of the roller [m].
        way: Of the plank [m].
        gap: g between plank and roller [m].
    """

    radius: float
    way: float
    gap: float = 0.0

    @property
    def angle(self) -> float:
        """By which the roller turns [rad]."""
        return self.way / (2.0 * self.radius + 0.5 * self.gap)

    @property
    def axis(self) -> float:
        """Way of the roller [m]."""
        return self.radius * self.angle


def driven(angle: float, driver: float, follower: float, gap: float) -> float:
    """Angle of a rod that another drives, both held [rad]."""
    return -angle * (driver + 0.5 * gap) / (follower + 0.5 * gap)


def most_turns(way: float, radius: float) -> float:
    """s/2πR: turns that a core can wind on its way."""
    return way / (2.0 * pi * radius)
