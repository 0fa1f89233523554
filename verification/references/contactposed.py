"""Thin rods against walls that push back in proportion, each with its way from the straight rod, in units of EI = 1.

Half of a rod is posed where it is its own mirror image: its start, or its end, is then held along and against turning.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from verification.references.contactrod import ANGLE, N_X, N_Y, End, M, PressedRod, Pushed, X, Y, pushed
from verification.references.contactwalls import Flat, Round

__all__ = ["FALLS", "POSED", "WALLS", "WOUND", "Posed", "Wound", "quantities"]

Way = Callable[[float], PressedRod]

# Names of the components of a state.
COMPONENTS = {"x": X, "y": Y, "angle": ANGLE, "n_x": N_X, "n_y": N_Y, "m": M}
# Degree and panels of the second solution.
FINER = (12, 32)
# Part of a radius by which a rod begins inside the wall, which holds it from the first step on.
DENT = 1e-3


@dataclass(frozen=True)
class Posed:
    """A problem with a name of its own.

    Args:
        words: What it is.
        way: The rod on the way, from 0 where it is straight to 1.
        crest: Height of the straight rod where neither end is held at one [m].
    """

    words: str
    way: Way = field(repr=False)
    crest: float = 0.0

    def solved(self, *, finer: bool = False) -> Pushed:
        """The equilibrium, on request on more and longer polynomials."""
        if finer:
            return pushed(self.way, self.crest, degree=FINER[0], panels=FINER[1])
        return pushed(self.way, self.crest)


@dataclass(frozen=True)
class Wound:
    """Half a rod over the crest of a round wall, its end pulled in a direction below the horizontal.

    Args:
        pull: F [N].
        below: Direction of F below x [rad].
        length: Of the half [m].
        eps_N: [N/m²].
        radius: Distance of the axis from the centre at which the wall begins to push [m].
    """

    pull: float
    below: float
    length: float
    eps_N: float
    radius: float = 1.0

    def __call__(self, way: float) -> PressedRod:
        """The direction of the pull sinks on the way."""
        α = self.below * way
        end = End(n_x=self.pull * np.cos(α), n_y=-self.pull * np.sin(α))
        return PressedRod(self.length, 1.0, End(x=0.0, angle=0.0), end, Round(self.radius, 0.0), self.eps_N)

    @property
    def posed(self) -> Posed:
        """With a name."""
        words = f"half rod of {self.length:g}, EI=1, over a cylinder of {self.radius:g}, pulled by {self.pull:g}"
        return Posed(f"{words}, {np.degrees(self.below):g}° down; eps_N={self.eps_N:g}", self, 1.0 - DENT)


def against_wall(h: float, thrust: float, eps_N: float) -> Posed:
    """Half an elastica of length 1, pinned on y = 0, that its thrust presses against the wall y = h."""

    def way(t: float) -> PressedRod:
        # Pushed aside on the way only, so that it buckles towards the wall.
        ends = End(y=0.0, n_x=-thrust * t), End(x=0.5, angle=0.0)
        return PressedRod(0.5, 1.0, *ends, Flat(h, -1.0), eps_N, f_y=100.0 * t * (1.0 - t))

    return Posed(f"pinned elastica, L=EI=1, thrust {thrust:.6g}, wall at h={h:.6g}, eps_N={eps_N:g}; half of it", way)


def touchdown(h: float, length: float, eps_N: float) -> Posed:
    """Heavy rod, w = EI = 1, its clamp lifted by h above where it lies."""

    def way(t: float) -> PressedRod:
        return PressedRod(length, 1.0, End(x=0.0, y=h * t, angle=0.0), End(), Flat(1.0 / eps_N), eps_N, f_y=-1.0)

    return Posed(f"rod of {length:g}, w=EI=1, clamped {h:g} above where it lies, free to slide, eps_N={eps_N:g}", way)


def tensionless(load: float, half: float) -> Posed:
    """Half a weightless rod on a foundation of modulus 4, β = 1, pressed down at its middle."""

    def way(t: float) -> PressedRod:
        start = End(x=0.0, angle=0.0, n_y=0.5 * load)
        return PressedRod(half, 1.0, start, End(), Flat(1e-6 * (1.0 - t)), 4.0)

    return Posed(f"half a rod of {2 * half:g}, EI=1, eps_N=4, pressed down by {load:g} at its middle", way)


# Lib of the references: half of the turn; what is left of the curvature at the end of the arm is exp(−√F ℓ) < 1e-4,
# of its energy the square.
WOUND = {"120": Wound(4.0, np.pi / 3, 7.0, 1e5), "180": Wound(1.0, np.pi / 2, 11.0, 1e5)}
# Lii of the references: h and P where the curvature at the middle vanishes, by the slope β there.
WALLS = {
    1: (0.008725538690807643, 39.473907888441936),
    10: (0.08616393371174719, 39.027090956555114),
    25: (0.2013507546464472, 36.645672314276986),
}
# Liib: height, length of the rod, stiffness of the ground.
FALLS = ((1e-4, 0.6, 1e7), (0.05, 2.5, 1e6), (0.5, 4.0, 1e6))

POSED = {
    **{f"wound-{turn}": half.posed for turn, half in WOUND.items()},
    **{f"wall-beta{β}": against_wall(h, P, 1e6) for β, (h, P) in WALLS.items()},
    **{f"touchdown-h{h:g}": touchdown(h, length, ε) for h, length, ε in FALLS},
    "tensionless": tensionless(1e-3, 4.0),
}


def quantities(found: Pushed) -> dict[str, float]:
    """By name: the state at the start and at the end, such as "n_x0" and "y1", two integrals, and edges of contact."""
    ends = {f"{name}{k}": float(u[c]) for k, u in enumerate((found.start, found.end)) for name, c in COMPONENTS.items()}
    integrals = {"pressed": found.force, "drawn_in": found.drawn_in}
    return {**ends, **integrals, **{f"edge{k}": float(s) for k, s in enumerate(found.edges)}}
