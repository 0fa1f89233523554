"""A rod with its supports and loads, posed for `bvp` in words of its own: nothing of either model's scene is read."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

__all__ = ["AXES", "Curvature", "Held", "LineLoad", "PointLoad", "Problem"]

Array = NDArray[np.float64]
Vector = tuple[float, float, float]

NOTHING = (0.0, 0.0, 0.0)
AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


@dataclass(frozen=True)
class Curvature:
    """κ₀(s) of a rod of uniform curvature whose section is turned about d1 by pretwist·s.

    Args:
        kappa: Twist and curvature about d2 and d3 at s = 0 [1/m].
        pretwist: Rate of turn [rad/m].
    """

    kappa: Vector = NOTHING
    pretwist: float = 0.0

    def __call__(self, s: Array) -> Array:
        """κ₀ in the section frame, shape (n, 3)."""
        twist, two, three = self.kappa
        c, w = np.cos(self.pretwist * s), np.sin(self.pretwist * s)
        return np.stack([twist + self.pretwist + 0.0 * s, c * two + w * three, c * three - w * two], axis=-1)


@dataclass(frozen=True)
class Held:
    """A support.

    Args:
        s: Where [m].
        along: Directions in which the point is held, orthonormal.
        about: Axes about which the section is held: none, all three, or two, orthonormal, of a hinge about the third.
        moved: By what it is displaced under the full load [m].
    """

    s: float
    along: tuple[Vector, ...] = AXES
    about: tuple[Vector, ...] = ()
    moved: Vector = NOTHING

    def __post_init__(self) -> None:
        if len(self.about) == 1:
            raise ValueError("a section held about a single axis is no hinge and not posed here")


@dataclass(frozen=True)
class PointLoad:
    """Force and moment at a section: dead ones in space, followers in the section frame.

    Args:
        s: Where [m].
        force: [N].
        moment: [N m].
        follower_force: Along d1, d2, d3 [N].
        follower_moment: About d1, d2, d3 [N m].
    """

    s: float
    force: Vector = NOTHING
    moment: Vector = NOTHING
    follower_force: Vector = NOTHING
    follower_moment: Vector = NOTHING


@dataclass(frozen=True)
class LineLoad:
    """Dead force per stress-free length between a and b.

    Args:
        force: [N/m].
        a: Where it begins [m].
        b: Where it ends [m].
    """

    force: Vector
    a: float
    b: float


@dataclass(frozen=True)
class Problem:
    """A rod, what holds it and what acts on it.

    Args:
        length: L [m].
        compliance_n: 1/EA, 1/GA2, 1/GA3 [1/N].
        compliance_m: 1/GJ, 1/EI2, 1/EI3 [1/(N m²)].
        supports: What holds it, one a place.
        loads: At sections.
        lines: Along it.
        curvature: κ₀(s), shape (n,) to (n, 3) [1/m].
        d1: Along the rod at its start, a unit vector; the start itself is the origin.
        d2: Second section axis there, a unit vector across d1.
        steps: In which the load grows, halved where Newton's method fails.
    """

    length: float
    compliance_n: Vector
    compliance_m: Vector
    supports: tuple[Held, ...]
    loads: tuple[PointLoad, ...] = ()
    lines: tuple[LineLoad, ...] = ()
    curvature: Callable[[Array], Array] = Curvature()
    d1: Vector = AXES[0]
    d2: Vector = AXES[1]
    steps: int = 8

    @property
    def places(self) -> Array:
        """Where supports and loads sit and line loads end, and both ends; ascending [m]."""
        at = [*(held.s for held in self.supports), *(load.s for load in self.loads)]
        lines = [s for line in self.lines for s in (line.a, line.b)]
        return np.unique([0.0, self.length, *at, *lines])

    @property
    def stiffness(self) -> float:
        """Largest bending stiffness [N m²]."""
        return 1.0 / min(self.compliance_m[1:])

    def in_units(self) -> Problem:
        """The same with length and largest bending stiffness one: lengths in L, forces in EI/L², moments in EI/L."""
        L, EI = self.length, self.stiffness
        force, moment = L**2 / EI, L / EI
        return replace(
            self,
            length=1.0,
            compliance_n=_times(self.compliance_n, 1.0 / force),
            compliance_m=_times(self.compliance_m, EI),
            supports=tuple(replace(h, s=h.s / L, moved=_times(h.moved, 1.0 / L)) for h in self.supports),
            loads=tuple(
                PointLoad(
                    s=one.s / L,
                    force=_times(one.force, force),
                    moment=_times(one.moment, moment),
                    follower_force=_times(one.follower_force, force),
                    follower_moment=_times(one.follower_moment, moment),
                )
                for one in self.loads
            ),
            lines=tuple(LineLoad(_times(one.force, force * L), one.a / L, one.b / L) for one in self.lines),
            curvature=lambda s: L * self.curvature(L * s),
        )


def _times(v: Vector, factor: float) -> Vector:
    x, y, z = (factor * c for c in v)
    return x, y, z
