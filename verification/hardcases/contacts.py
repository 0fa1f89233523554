"""Contacts that solvers stumble over, in equilibrium: penalties and walls of all kinds.

A centimetre of the paper's fibre along x lies on something under a line load; what holds its start lets it settle.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import cos, radians, sin
from typing import TYPE_CHECKING, Literal

import numpy as np

from dolfinrod.scene import (
    AugmentedLagrangian,
    Clamp,
    Contact,
    Coulomb,
    Cylinder,
    Groove,
    Guide,
    LineForce,
    Penalty,
    Plane,
    PointForce,
    Rod,
    Scene,
    Section,
    SmoothPenalty,
    Static,
)
from verification.answers import Beside, Exact
from verification.contacts.groove import lateral
from verification.hardcontact import HardContact

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from dolfinrod.scene.history import History

__all__ = ["CASES", "FLOOR", "LENGTH", "PRESS", "RADIUS", "SETTLES", "TIGHT", "fibre", "laid", "lies", "pressed"]

# Of the fibre [m], and the drag of air at 20 m/s (process.md 2.4) as a load that presses it down [N/m].
LENGTH, PRESS = 0.01, 9.3e-3
RADIUS = 1e-5
TIGHT = Penalty.tight()
FLOOR = Plane((0.0, 0.0, 0.0), (0.0, 0.0, 1.0))
# What lets the fibre settle on the floor as a whole, and sideways, too.
SETTLES, DRIFTS = ("z", "ry"), ("y", "z", "ry", "rz")

Law = Penalty | SmoothPenalty | AugmentedLagrangian


def fibre(height: float, length: float = LENGTH, y: float = 0.0) -> Rod:
    """Along x, its surface so high over the floor."""
    return Rod.straight(length=length, section=Section.ramie(), start=(0.0, y, RADIUS + height))


def pressed(size: float = PRESS, history: History = None) -> LineForce:
    """A load onto the floor [N/m]."""
    return LineForce((0.0, 0.0, -size), history=history)


def laid(walls: Sequence[Plane | Cylinder | Groove], law: Law, mu: float | None = None) -> list[Contact]:
    """The same law on every wall."""
    return [Contact(wall, law, None if mu is None else Coulomb(mu)) for wall in walls]


def lies(gap: float, size: float, walls: int = 1) -> Exact:
    """Gap everywhere, over the radius, and the resultant of every wall, over its own.

    Args:
        gap: Exact [m].
        size: Line load of each wall on the fibre [N/m].
        walls: How many of them.
    """

    def off(result: Result) -> float:
        touching = [contact.rods[0] for contact in result.contacts[:walls]]
        gaps = max(float(np.abs(rod.gap[-1] - gap).max()) for rod in touching if rod is not None) / RADIUS
        forces = [float(np.linalg.norm(contact.force[-1])) for contact in result.contacts[:walls]]
        return max(gaps, *(abs(force / (size * LENGTH) - 1.0) for force in forces))

    return Exact("gap g₀ − p/ε_N all along, resultant p L", off)


def penalties() -> tuple[HardContact, ...]:
    """From softer than the fibre's own stiffness to harder than anything, p = q."""

    def posed(law: Law, within: float) -> Callable[[], Scene]:
        return lambda: Scene([fibre(within)], [Guide("start", SETTLES)], [pressed()], laid([FLOOR], law))

    found = []
    for power in range(2, 13, 2):
        law = Penalty(10.0**power)
        title = f"Pressed on a floor of ε_N = 10^{power} N/m²"
        answer = lies(-PRESS / law.eps_N, PRESS)
        found.append(HardContact(f"penalty-1e{power}", "penalty 1e2 … 1e12 N/m²", title, posed(law, -1e-9), answer))
    smooth = SmoothPenalty(4e5, 1e-8)
    answer = lies(-(PRESS / smooth.eps_N + 0.5 * smooth.foot), PRESS)
    found.append(HardContact("smooth", "other laws", "A foot of 10 nm, ε_N = 4e5 N/m²", posed(smooth, -1e-9), answer))
    renewed = AugmentedLagrangian(4e5, 1e-12)
    words = "Augmented Lagrangian, 1e-12 m"
    return (*found, HardContact("augmented", "other laws", words, posed(renewed, -1e-9), lies(0.0, PRESS)))


def started(depth: float, law: Law, name: str) -> HardContact:
    """The fibre starts within the floor."""

    def scene() -> Scene:
        return Scene([fibre(-depth)], [Guide("start", SETTLES)], [pressed()], laid([FLOOR], law))

    title = f"Starts {1e6 * depth:g} µm deep, {name}"
    answer = lies(law.g_0 - PRESS / law.eps_N, PRESS)
    return HardContact(f"deep-{1e6 * depth:g}-{name}", "starts in penetration", title, scene, answer)


def wedge(degrees: float, mu: float | None = None) -> HardContact:
    """Two walls that rise to either side; without friction each bears q/(2 cos β) (process.md 6.8, C4)."""
    β = radians(degrees)
    walls = [Plane((0.0, 0.0, 0.0), (0.0, side * sin(β), cos(β))) for side in (1.0, -1.0)]
    size = PRESS / (2.0 * cos(β))
    # Where both touch: the axis lies so high that its distance from either is the radius.
    height = (RADIUS + TIGHT.g_0 - 1e-9) / cos(β) - RADIUS

    def scene() -> Scene:
        return Scene([fibre(height)], [Guide("start", DRIFTS)], [pressed()], laid(walls, TIGHT, mu))

    rubs = "" if mu is None else f", µ = {mu:g}".replace("µ", "μ")
    title = f"V of two walls at {degrees:g}° to the horizontal{rubs}"
    answer = lies(TIGHT.g_0 - size / TIGHT.eps_N, size, 2) if mu is None else Beside()
    return HardContact(f"wedge-{degrees:g}-{mu}", "two walls at once", title, scene, answer)


def slot(width: float) -> HardContact:
    """Between two walls nearer to each other than the reach of either: the paper's halo of 75 µm."""
    law = Penalty.paper()
    down = Plane((0.0, 0.0, 2.0 * RADIUS + width), (0.0, 0.0, -1.0))

    def scene() -> Scene:
        supports, contacts = [Guide("start", SETTLES)], laid([FLOOR, down], law)
        return Scene([fibre(0.3 * width)], supports, [pressed()], contacts)

    middle, shift = 0.5 * width, 0.5 * PRESS / law.eps_N
    below = law.eps_N * (law.g_0 - middle + shift)
    title = f"Slot of {1e6 * width:g} µm between halos of 75 µm"
    return HardContact(f"slot-{1e6 * width:g}", "thinner than the reach", title, scene, lies(middle - shift, below, 1))


def haloed() -> HardContact:
    """A fibre of 10 µm on a halo of 75 µm floats above the floor."""
    law = Penalty.paper()

    def scene() -> Scene:
        return Scene([fibre(7.4e-5)], [Guide("start", SETTLES)], [pressed()], laid([FLOOR], law))

    title = "Floats on the paper's halo of 75 µm"
    return HardContact("halo", "thinner than the reach", title, scene, lies(law.g_0 - PRESS / law.eps_N, PRESS))


def along(side: Literal["inside", "outside"], radius: float, degrees: float, mu: float | None) -> HardContact:
    """Parallel to a cylinder, within it or on top of it, aslant from the vertical where friction holds it."""
    inside, β = side == "inside", radians(degrees)
    away = radius - RADIUS if inside else radius + RADIUS
    within = TIGHT.g_0 - 1e-9
    reach = away - within if inside else away + within
    sign = -1.0 if inside else 1.0
    at = (0.0, reach * sin(β), sign * reach * cos(β))

    def scene() -> Scene:
        rod = Rod.straight(length=LENGTH, section=Section.ramie(), start=at)
        free = SETTLES if not inside else DRIFTS
        wall = Cylinder((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), radius, side=side)
        return Scene([rod], [Guide("start", free)], [pressed()], laid([wall], TIGHT, mu))

    answer = lies(TIGHT.g_0 - PRESS / TIGHT.eps_N, PRESS) if mu is None else Beside()
    place = f"{side} a cylinder of {1e3 * radius:g} mm" + (f", {degrees:g}° aslant, μ = {mu:g}" if mu else "")
    return HardContact(f"along-{side}-{degrees:g}", "parallel to a cylinder", f"Lies {place}", scene, answer)


def over_lip() -> HardContact:
    """Across the paper's groove: held by its lips, bent into it by a load a hundred times that of air."""

    def scene() -> Scene:
        start = (0.0, RADIUS + TIGHT.g_0, -3e-3)
        rod = Rod.straight(length=6e-3, section=Section.ramie(), start=start, direction=(0.0, 0.0, 1.0))
        groove = Contact(lateral(), TIGHT)
        load = LineForce((0.0, -100.0 * PRESS, 0.0))
        return Scene([rod], [Clamp("start")], [load], [groove])

    title = "Across the groove, bent in over both lips"
    return HardContact("lips", "polyline edges", title, scene, Beside(), elements=32, discrete=80, limit=1e-2)


def across_edge() -> HardContact:
    """Its free end hangs over a lip, pulled down until it stands up, 2.7 rad, by one half of the load and the other.

    Nodes alone feel the edge, and rest on either side of it: ends that load steps lead to lie within two chords.
    """

    def scene() -> Scene:
        start = (0.0, RADIUS + TIGHT.g_0, -4.5e-3)
        rod = Rod.straight(length=4e-3, section=Section.ramie(), start=start, direction=(0.0, 0.0, 1.0))
        groove = Groove(((-6e-3, 0.0), (-1.5e-3, 0.0), (-1.4e-3, -4e-3), (6e-3, -4e-3)))
        walls = [Contact(face, TIGHT) for face in groove.faces()]
        pull = PointForce((0.0, -1e-3, 0.0), at="end")
        return Scene([rod], [Clamp("start")], [pull], walls, motion=Static(steps=2))

    title = "Pulled down across a steep edge by 1 mN"
    return HardContact("edge", "polyline edges", title, scene, Beside(), elements=32, discrete=320, limit=1e-2)


CASES = (
    *map(wedge, (15.0, 45.0, 75.0)),
    wedge(45.0, 0.64),
    *(started(depth, TIGHT, "tight") for depth in (1e-7, 5e-6, 1.5e-5)),
    started(1.5e-5, Penalty(1e8), "hard"),
    over_lip(),
    across_edge(),
    *penalties(),
    along("inside", 5e-4, 0.0, None),
    along("inside", 5e-4, 20.0, 0.64),
    along("outside", 1e-4, 20.0, 0.64),
    haloed(),
    *map(slot, (1e-4, 2e-5)),
)
