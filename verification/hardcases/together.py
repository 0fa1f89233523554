"""Ends brought together: slender rods buckle within a millionth of the way, whatever the load step."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.optimize import brentq
from scipy.special import ellipe, ellipk

from dolfinrod.scene import Guide, LineForce, Prescribed, Rod, Scene, Section
from verification.hardcase import HardCase

if TYPE_CHECKING:
    from dolfinrod.result import Result

__all__ = ["CASES", "Bow", "bow"]

# Of the length, by which the ends come together.
TOGETHER = 0.1
# Across the rod [EI/L³], so that its side is not left to chance.
WHIFF = 1e-4


def bow(together: float) -> float:
    """Height of the middle of Euler's elastica between hinges over its length, √m/K(m).

    Args:
        together: Way of the ends over the length, 2 − 2 E(m)/K(m).

    Source: Love, Theory of Elasticity, 1927, art. 263.
    """
    m = brentq(lambda m: 2.0 - 2.0 * ellipe(m) / ellipk(m) - together, 1e-12, 0.99)
    return float(np.sqrt(m) / ellipk(m))


@dataclass(frozen=True)
class Bow:
    """How high the middle stands.

    Args:
        height: As it should [lengths].
    """

    height: float

    @property
    def words(self) -> str:
        """Whose."""
        return "Euler's elastica, height of the middle"

    def error(self, result: Result, case: HardCase) -> float:
        """Of the height, of the length."""
        rod = case.scene().rods[0]
        return abs(float(result.rods[0].at(0.5 * rod.length)[-1][1]) / rod.length - self.height)


def pushed(slenderness: float) -> HardCase:
    """A hinged rod of L/d whose ends come together, in the steps that the solver takes by itself."""

    def scene() -> Scene:
        section = Section(EA=16.0 * slenderness**2, GJ=1.0 / 1.3, EI=1.0, rigid={"shear"})
        hinged = Guide("start", free={"ry", "rz"})
        brought = Prescribed("end", displacement=(-TOGETHER, 0.0, 0.0))
        return Scene([Rod.straight(1.0, section)], [hinged, brought], [LineForce((0.0, WHIFF, 0.0))])

    return HardCase(
        name=f"together-{slenderness:g}",
        group="ends brought together",
        title=f"Ends of a hinged rod brought together by a tenth, L/d = {slenderness:g}",
        scene=scene,
        check=Bow(bow(TOGETHER)),
        limit=1e-3,
    )


CASES = tuple(pushed(slenderness) for slenderness in (50.0, 200.0, 2000.0))
