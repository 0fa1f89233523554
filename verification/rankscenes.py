"""One scene of each kind that the continuum model solves, short enough to be solved on one rank and on two."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from sys import float_info

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene import (
    Air,
    Clamp,
    Contact,
    Coulomb,
    Dynamic,
    FollowerForce,
    Gravity,
    Groove,
    ImplicitEuler,
    LineForce,
    Midpoint,
    Penalty,
    Pin,
    Plane,
    PointForce,
    Prescribed,
    Rod,
    RodContact,
    Scene,
    Section,
    Spatial,
    Static,
    Velocity,
)

__all__ = ["KINDS", "Kind"]

Array = NDArray[np.float64]

SECTION = Section(EA=1e4, GA=4e3, GJ=0.8, EI=1.0, rhoA=1.0, rhoI=(1e-3, 1e-3, 2e-3))
RAMIE = Section.ramie()


@dataclass(frozen=True)
class Kind:
    """What is asked of ranks.

    Args:
        name: Under which it is asked for.
        title: In words.
        found: Solves it and returns what ranks must agree on, in its own unit.
    """

    name: str
    title: str
    found: Callable[[], Array]


def solved(scene: Scene, elements: int) -> Array:
    """Of all nodes at all times: positions over the largest, strains γ, moments over the largest, shape (n,).

    Strains stand for forces, which round-off of positions leaves uncertain by EA times as much.
    """
    from dolfinrod import solve

    result = solve(scene, elements=elements, kinematics=Spatial())
    found = [q.ravel() for rod in result.rods for q in (over_largest(rod.r), rod.gamma, over_largest(rod.m))]
    return np.concatenate(found)


def over_largest(q: Array) -> Array:
    """Divided by its largest component."""
    return np.asarray(q / max(float(np.abs(q).max()), float_info.min))


def unit(*, scene: Callable[[], Scene], elements: int) -> Callable[[], Array]:
    """Of a scene that is only solved."""
    return lambda: solved(scene(), elements)


def arc() -> Scene:
    """The curved cantilever of Bathe and Bolourchi (1979), which leaves its plane."""
    section = Section(EA=1e7, GA=5e6, GJ=8.4e5, EI=1e7 / 12.0)
    rod = Rod.arc(radius=100.0, angle=np.pi / 4.0, section=section)
    return Scene([rod], [Clamp(at="start")], [PointForce((0.0, 0.0, 600.0), at="end")])


def followed() -> Scene:
    """A force that turns with the end."""
    rod = Rod.straight(1.0, SECTION)
    return Scene([rod], [Clamp(at="start")], [FollowerForce((0.0, 3.0, 1.0), at="end")])


def column() -> Scene:
    """Clamped at its foot, pressed at its top."""
    return Scene([Rod.straight(1.0, SECTION)], [Clamp(at="start")], [PointForce((-4.0, 0.0, 0.0), at="end")])


def swing(scheme: ImplicitEuler | Midpoint) -> Scene:
    """Let go from the horizontal, with a kick out of the plane."""
    motion = Dynamic(0.05, dt=0.005, scheme=scheme)
    kick = Velocity(omega=(0.0, 0.5, 0.0))
    return Scene(
        [Rod.straight(1.0, SECTION)], [Pin(at="start")], [Gravity((0.0, 0.0, -9.81))], motion=motion, velocities=[kick]
    )


def blown() -> Scene:
    """The paper's fibre in a wind."""
    motion = Dynamic(2e-5, dt=1e-6)
    return Scene([Rod.straight(0.04, RAMIE)], [Clamp(at="start")], air=Air(field=(0.0, -10.0, 3.0)), motion=motion)


def dragged() -> Scene:
    """Pressed on a floor, then dragged until part of it slips."""
    press = LineForce((0.0, -0.01, 0.0), history=[(0, 0), (1, 1), (2, 1)])
    drag = PointForce((2e-4, 0.0, 0.0), at="end", history=[(0, 0), (1, 0), (2, 1)])
    floor = Contact(Plane(normal=(0, 1, 0)), law=Penalty.tight(), friction=Coulomb(mu=0.64))
    rod = Rod.straight(0.04, RAMIE, start=(0.0, 1.1e-5, 0.0))
    return Scene(
        [rod],
        [Prescribed(at="start", displacement=(None, None, 0.0))],
        [press, drag],
        contacts=[floor],
        motion=Static(t_end=2.0),
    )


def thrown() -> Scene:
    """The paper's fibre falls into a round groove."""
    groove = Contact(Groove.round(radius=5e-4), law=Penalty.paper(), friction=Coulomb(mu=0.64))
    rod = Rod.straight(0.01, RAMIE, start=(0.0, 2.2e-5, 0.0))
    motion = Dynamic(2e-5, dt=1e-6)
    return Scene([rod], contacts=[groove], velocities=[Velocity(v=(0.0, -1.0, 0.3))], motion=motion)


def crossed(motion: Static | Dynamic) -> Scene:
    """Two fibres that cross, the upper one pressed down."""
    below = Rod.straight(0.01, RAMIE)
    across = Rod.straight(0.01, RAMIE, start=(0.005, -0.005, 2.1e-5), direction=(0, 1, 0))
    meet = RodContact(law=Penalty.tight(), friction=Coulomb(mu=0.3))
    held = [Clamp(at=at, rod=k) for k in (0, 1) for at in ("start", "end")]
    return Scene([below, across], held, [LineForce((0.0, 0.0, -1e-3), rod=1)], contacts=[meet], motion=motion)


def critical_loads() -> Array:
    """Factors at which the column loses its stability, and those of linear buckling."""
    from dolfinrod import buckling, critical

    return np.concatenate([critical(column(), elements=8).factors, buckling(column(), modes=2, elements=8).factors])


def frequencies() -> Array:
    """Of the loaded column."""
    from dolfinrod import modes

    return np.asarray(modes(column(), modes=4, elements=8).frequencies)


KINDS = (
    Kind("bend", "curved cantilever, statics", unit(scene=arc, elements=16)),
    Kind("follower", "follower force, statics", unit(scene=followed, elements=16)),
    Kind("critical", "column, critical loads", critical_loads),
    Kind("modes", "column, vibrations", frequencies),
    Kind("euler", "swinging rod, implicit Euler", unit(scene=lambda: swing(ImplicitEuler()), elements=16)),
    Kind("midpoint", "swinging rod, midpoint rule", unit(scene=lambda: swing(Midpoint()), elements=16)),
    Kind("air", "fibre in a wind", unit(scene=blown, elements=40)),
    Kind("floor", "dragged over a floor, statics with friction", unit(scene=dragged, elements=20)),
    Kind("groove", "thrown into a groove", unit(scene=thrown, elements=20)),
    Kind("crossing", "fibres that cross, statics", unit(scene=lambda: crossed(Static()), elements=9)),
    Kind(
        "crossing-motion", "fibres that cross, motion", unit(scene=lambda: crossed(Dynamic(2e-5, dt=1e-6)), elements=9)
    ),
)
