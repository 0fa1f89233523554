"""Rods on rods that solvers stumble over on their way: rubbed along and across, squeezed, wound up, coils on coils."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from math import cos, pi, sin, sqrt, tanh
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import (
    Clamp,
    Contact,
    Coulomb,
    Guide,
    LineForce,
    PointForce,
    Prescribed,
    Rod,
    RodContact,
    Scene,
    Static,
)
from verification.answers import Beside, Exact
from verification.hardcases.contacts import FLOOR, PRESS, RADIUS, TIGHT
from verification.hardcases.rodcontacts import FIBRE, LENGTH, MESH, SINKS, bears, crossing, heights
from verification.hardcontact import HardContact

if TYPE_CHECKING:
    from dolfinrod.result import Result

__all__ = ["CASES"]

# They are pressed first, and drawn when they are.
FIRST, THEN = ((0.0, 0.0), (0.5, 1.0), (1.0, 1.0)), ((0.0, 0.0), (0.5, 0.0), (1.0, 1.0))
Scenes = Callable[[], Scene]


def piled(n: int, mu: float | None = None) -> tuple[Scenes, Exact]:
    """Fibres that lie along one another on the floor, the topmost under a line load."""
    z = heights((RADIUS,) * n, TIGHT)
    rods = [Rod.straight(length=LENGTH, section=FIBRE, start=(0.0, 0.0, height)) for height in z]

    def scene() -> Scene:
        load = LineForce((0.0, 0.0, -PRESS), rod=n - 1, history=FIRST)
        touching = Contact(FLOOR, TIGHT), RodContact(TIGHT, None if mu is None else Coulomb(mu))
        return Scene(rods, [Guide("start", SINKS)], [load], touching)

    return scene, bears(PRESS * LENGTH, n)


def along(n: int) -> HardContact:
    """Flat contact of all of their lengths; they are held only at one end, and may be about to roll off sideways."""
    scene, answer = piled(n)
    title = f"{n} along one another on the floor"
    return HardContact(f"along-{n}", "rods: side by side", title, scene, answer, limit=1e-6, **MESH)


def drawn(mu: float, part: float) -> HardContact:
    """Drawn along the fibre below, by a part of the way on which anchors hold.

    What slides is braked by μ q L; what sticks is drawn through anchors at the other, both stretching: their way past
    each other is w" = k² w with k² = 2 ε_T/EA, given where they are held, w' = 0 at their ends.

    Args:
        mu: Friction.
        part: Of μ p/ε_T, or of a micrometre without friction.
    """
    way = part * (mu * PRESS / TIGHT.eps_N if mu > 0.0 else 1e-6)
    k = sqrt(2.0 * TIGHT.eps_N / FIBRE.EA)
    force = TIGHT.eps_N * way * tanh(k * LENGTH) / k if part < 1.0 else mu * PRESS * LENGTH

    def scene() -> Scene:
        still = piled(2, mu)[0]()
        upper = Prescribed("start", (way, 0.0, None), (0.0, 0.0, 0.0), THEN, rod=1)
        return replace(still, supports=(Guide("start", SINKS, rod=0), upper), motion=Static(steps=4))

    def off(result: Result) -> float:
        x, _, z = result.meetings[0].force(-1, 1, 0)
        return max(abs(float(x) + force), abs(float(z) - PRESS * LENGTH)) / (PRESS * LENGTH)

    title = f"Drawn along by {part:g} times what friction holds, μ = {mu:g}"
    words = Exact("ε_T u tanh(k L)/k" if part < 1.0 else "μ q L", off)
    return HardContact(f"drawn-{mu:g}-{part:g}", "rods: μ = 0 … 5", title, scene, words, **MESH)


def squeezed() -> HardContact:
    """A fibre on the floor under one across it, whose ends are pushed down to it: wall, fibre and fibre."""
    lower, upper = heights((RADIUS, RADIUS), TIGHT)
    rods = [crossing(FIBRE, lower, 0.0), crossing(FIBRE, upper, 1.2)]

    def scene() -> Scene:
        down = (0.0, 0.0, -2.0 * RADIUS)
        ends = [Prescribed(at, down, (0.0, 0.0, 0.0), rod=1) for at in ("start", "end")]
        touching = Contact(FLOOR, TIGHT), RodContact(TIGHT)
        return Scene(rods, [Guide("start", SINKS, rod=0), *ends], [], touching)

    title = "Between the floor and one across it, whose ends are pushed down by a diameter"
    return HardContact(
        "squeezed", "rods: a wall and a rod", title, scene, Beside(), elements=16, discrete=60, limit=1e-3
    )


def circle(turn: float, phase: float, of: Callable[[float], float], t: float) -> float:
    """Way along an axis on a circle of radius one."""
    return of(phase + turn * t) - of(phase)


def ply(turns: float, steps: int) -> HardContact:
    """Two fibres side by side whose ends are turned about each other and pulled."""
    reach, turn, length = RADIUS + 0.5 * TIGHT.g_0, 2.0 * pi * turns, 1e-3

    def scene() -> Scene:
        rods, supports = [], []
        for k, phase in enumerate((0.0, pi)):
            y, z = reach * cos(phase), reach * sin(phase)
            rods.append(Rod.straight(length=length, section=FIBRE, start=(0.0, y, z)))
            for shift, of in (((None, reach, None), cos), ((None, None, reach), sin)):
                supports.append(Prescribed("end", shift, history=partial(circle, turn, phase, of), rod=k))
            supports.append(Prescribed("end", rotation=(turn, 0.0, 0.0), rod=k))
        pull = PointForce((1e-3, 0.0, 0.0), at="end", history=((0.0, 1.0), (1.0, 1.0)))
        return Scene(rods, [Clamp("start"), *supports], [pull], [RodContact(TIGHT)], motion=Static(steps=steps))

    title = f"Two wound about each other by {turns:g} turns under 1 mN each"
    answer, group = Beside(), "rods: wound and tightened"
    return HardContact(f"ply-{turns:g}", group, title, scene, answer, elements=6, discrete=30, limit=1e-3)


def coil() -> HardContact:
    """A spring whose coils are pressed onto each other: one rod, which touches itself all along."""
    radius, pitch, turns = 1e-4, 2.0 * RADIUS + 3e-6, 2.3
    slope = pitch / (2.0 * pi)
    round_2 = radius**2 + slope**2
    length = 2.0 * pi * turns * round_2**0.5

    def scene() -> Scene:
        direction = np.array([0.0, radius, slope]) / round_2**0.5
        curvature = (slope / round_2, 0.0, radius / round_2)
        rod = Rod.curved(length, FIBRE, curvature, (radius, 0.0, 0.0), tuple(direction), (-1.0, 0.0, 0.0))
        supports = Clamp("start"), Guide("end", SINKS)
        load = PointForce((0.0, 0.0, -5e-5), at="end")
        return Scene([rod], supports, [load], [RodContact(TIGHT)], motion=Static(steps=4))

    title = "A spring of 2.3 coils pressed solid by 50 µN"
    return HardContact(
        "coil", "rods: one that touches itself", title, scene, Beside(), elements=16, discrete=64, limit=1e-3
    )


CASES = (
    *map(along, (2, 3)),
    *(drawn(mu, 3.0) for mu in (0.0, 0.3, 1.0, 5.0)),
    drawn(1.0, 0.5),
    squeezed(),
    ply(0.5, 5),
    coil(),
)
