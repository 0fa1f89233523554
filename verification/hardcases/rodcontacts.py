"""Rods on rods that solvers stumble over, in equilibrium: across, along and on end, of all penalties and radii.

The paper's fibres lie on a floor and on one another; whatever is above is free to sink, so that every force is known.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise
from math import cos, sin
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import (
    Contact,
    Coulomb,
    Guide,
    Penalty,
    PointForce,
    Rod,
    RodContact,
    Scene,
    Section,
)
from verification.answers import Exact
from verification.hardcases.contacts import FLOOR, RADIUS, TIGHT
from verification.hardcontact import HardContact

if TYPE_CHECKING:
    from dolfinrod.result import Result

__all__ = ["CASES", "FIBRE", "LENGTH", "MESH", "SINKS", "bears", "crossing", "heights", "stack", "thick"]

FIBRE = Section.ramie()
LENGTH = 4e-3
# As little as softest rods can bear in a crossing, and as much as drag of air on a few millimetres [N].
LIGHT, FIRM = 2e-8, 2e-5
# Rods begin that deep in what they rest on, so that they are held from the start [m].
WITHIN = 1e-9
SINKS = ("z",)
MESH = {"elements": 8, "discrete": 20}
# Part of a length at which fibres cross: not in the middle, where nodes are.
ASIDE = 0.45


def thick(factor: float) -> Section:
    """The paper's fibre, so many times as thick."""
    area, inertia = factor**2, factor**4
    assert FIBRE.rhoA is not None
    assert FIBRE.rhoI is not None
    polar, *axial = FIBRE.rhoI
    return Section(
        EA=area * FIBRE.EA,
        GA=area * FIBRE.GA[0],
        GJ=inertia * FIBRE.GJ,
        EI=inertia * FIBRE.EI[0],
        rhoA=area * FIBRE.rhoA,
        rhoI=(inertia * polar, inertia * axial[0], inertia * axial[1]),
        radius=factor * RADIUS,
    )


def crossing(section: Section, z: float, angle: float, length: float = LENGTH) -> Rod:
    """At a height, turned about the vertical; its crossing point on the z axis is off its middle."""
    along = np.array([cos(angle), sin(angle), 0.0])
    start = (*(-ASIDE * length * along[:2]), z)
    return Rod.straight(length=length, section=section, start=start, direction=tuple(along))


def heights(radii: Sequence[float], law: Penalty, within: float = WITHIN) -> list[float]:
    """Of axes of rods that lie on one another and on the floor [m]."""
    z = [radii[0] + TIGHT.g_0 - WITHIN]
    for below, above in pairwise(radii):
        z.append(z[-1] + below + above + law.g_0 - within)
    return z


def bears(force: float, n: int) -> Exact:
    """What presses the topmost of n rods is handed down from each to the one below, and at last to the floor.

    Part of it goes to the floor directly where an end of a rod above comes down to it.
    """

    def off(result: Result) -> float:
        floor = result.contacts[0].rods
        below = [0.0 if rod is None else float(rod.force[-1, 2]) for rod in floor]
        found = [float(result.meetings[0].force(-1, k, k - 1)[2]) + sum(below[k:]) for k in range(1, n)]
        return max(abs(F / force - 1.0) for F in (*found, sum(below)))

    return Exact("whatever presses from above is handed down", off)


def stack(
    rods: Sequence[Rod], force: float, law: Penalty, mu: float | None = None, *, at: float = ASIDE
) -> Callable[[], Scene]:
    """Rods on one another, the topmost pressed by a point force where they cross."""

    def scene() -> Scene:
        top = len(rods) - 1
        load = PointForce((0.0, 0.0, -force), at=at * rods[top].length, rod=top)
        touching = Contact(FLOOR, TIGHT), RodContact(law, None if mu is None else Coulomb(mu))
        return Scene(list(rods), [Guide("start", SINKS)], [load], touching)

    return scene


def across(
    name: str,
    group: str,
    title: str,
    force: float,
    law: Penalty,
    *,
    angles: Sequence[float] = (0.0, 1.2),
    sections: Sequence[Section] = (FIBRE, FIBRE),
    lengths: Sequence[float] = (LENGTH, LENGTH),
    within: float = WITHIN,
) -> HardContact:
    """Rods across one another on the floor, all at one spot."""
    z = heights([section.radius or 0.0 for section in sections], law, within)
    rods = [crossing(*row) for row in zip(sections, z, angles, lengths, strict=True)]
    answer = bears(force, len(rods))
    return HardContact(name, group, title, stack(rods, force, law), answer, limit=1e-6, **MESH)


def penalties() -> tuple[HardContact, ...]:
    """A crossing touches over a few micrometres, with the depth to the power of 3/2."""
    soft = [
        across(f"crossed-1e{k}", "rods: penalty 1e3 … 1e8 N/m²", f"{LIGHT:g} N across, ε_N = 10^{k} N/m²", LIGHT, law)
        for k, law in ((k, Penalty(10.0**k)) for k in range(8, 2, -1))
    ]
    firm = [
        across(f"pressed-1e{k}", "rods: penalty 1e3 … 1e8 N/m²", f"{FIRM:g} N across, ε_N = 10^{k} N/m²", FIRM, law)
        for k, law in ((k, Penalty(10.0**k)) for k in (8, 7, 6, 5))
    ]
    return (*soft, *firm)


def deep(depth: float, power: int) -> HardContact:
    """The upper one starts within the lower, up to three quarters of a diameter."""
    title = f"Starts {1e6 * depth:g} µm deep across, ε_N = 10^{power} N/m²"
    name, law = f"within-{1e6 * depth:g}-1e{power}", Penalty(10.0**power)
    return across(name, "rods: start in one another", title, FIRM, law, within=depth)


def aslant(angle: float) -> HardContact:
    """Almost side by side, so that a long stretch touches a little."""
    title = f"Cross at {angle:g} rad"
    return across(f"aslant-{angle:g}", "rods: side by side", title, FIRM, TIGHT, angles=(0.0, angle))


def on_end() -> HardContact:
    """A fibre stands upright on another: its end is half a ball."""
    law, length = Penalty(1e6), 1e-3
    lower, upper = heights((RADIUS, RADIUS), law)
    rods = [
        crossing(FIBRE, lower, 0.0),
        Rod.straight(length=length, section=FIBRE, start=(0.0, 0.0, upper + length), direction=(0.0, 0.0, -1.0)),
    ]
    answer = bears(1e-6, 2)
    return HardContact(
        "on-end", "rods: an end", "Stands on end", stack(rods, 1e-6, law, at=0.0), answer, limit=1e-6, **MESH
    )


def thick_and_long() -> tuple[HardContact, ...]:
    """Ten times as thick above and below, and ten times as long as elements of the other."""
    law, group = Penalty(1e7), "rods: radii and meshes 1:10"
    pairs = {"thin on thick": (10.0, 1.0), "thick on thin": (1.0, 10.0)}
    radii = [
        across(words.replace(" ", "-"), group, f"{words}, 1:10", FIRM, law, sections=tuple(map(thick, factors)))
        for words, factors in pairs.items()
    ]
    lengths = {"fine on coarse": (LENGTH, 0.1 * LENGTH), "coarse on fine": (0.1 * LENGTH, LENGTH)}
    meshes = [
        across(words.replace(" ", "-"), group, f"Elements {words}, 1:10", FIRM, law, lengths=both)
        for words, both in lengths.items()
    ]
    return (*radii, *meshes)


def heap() -> HardContact:
    """Three at one spot, each on the one below."""
    return across(
        "heap",
        "rods: three at one spot",
        "Three across one another at one spot",
        FIRM,
        Penalty(1e7),
        angles=(0.0, 1.0, 2.2),
        sections=(FIBRE,) * 3,
        lengths=(LENGTH,) * 3,
    )


CASES = (
    *penalties(),
    *(deep(depth, 6) for depth in (1e-7, 5e-6, 1.5e-5)),
    deep(5e-6, 8),
    *map(aslant, (0.1, 0.01)),
    on_end(),
    *thick_and_long(),
    heap(),
)
