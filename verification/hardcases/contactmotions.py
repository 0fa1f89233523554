"""Contacts that schemes in time stumble over: friction of all sizes on a slope, starts within a wall, walls that go."""

from __future__ import annotations

from math import cos, pi, radians, sin, sqrt
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import Contact, Coulomb, Dynamic, LineForce, Plane, Rod, Scene, Section, Steady, WallMotion
from verification.answers import Exact, stations
from verification.hardcases.contacts import FLOOR, LENGTH, PRESS, RADIUS, TIGHT, fibre, laid, pressed
from verification.hardcontact import HardContact

if TYPE_CHECKING:
    from dolfinrod.result import Result

__all__ = ["CASES"]

RAMIE = Section.ramie()
assert RAMIE.rhoA is not None
MASS = RAMIE.rhoA
SLOPE = radians(45.0)
# In which loads grow, and end of the slides [s].
RISE, ENDED = 2e-5, 2e-4
# Speed of the paper's roller (process.md 2.3) [m/s].
DELIVERY = 0.17157
# Error of implicit Euler in slides of 200 steps is a half per cent.
COARSE = 2e-2


def way(acceleration: float) -> float:
    """Of what starts at rest and is drawn by a force that grows within `RISE`, until `ENDED` [m]."""
    t = ENDED - RISE
    return acceleration * (t**2 / 2.0 + RISE * t / 2.0 + RISE**2 / 6.0)


def slope(mu: float) -> HardContact:
    """Lengthwise on a slope, where nothing rolls: a = (q/ρA)(sin β − μ cos β), or none (process.md 6.8, C5)."""
    down, up = np.array([cos(SLOPE), 0.0, -sin(SLOPE)]), np.array([sin(SLOPE), 0.0, cos(SLOPE)])
    start = (RADIUS + TIGHT.g_0) * up

    def scene() -> Scene:
        rod = Rod.straight(length=LENGTH, section=Section.ramie(), start=tuple(start), direction=tuple(down))
        load = LineForce((0.0, 0.0, -PRESS), history=((0.0, 0.0), (RISE, 1.0)))
        wall = Plane((0.0, 0.0, 0.0), tuple(up))
        return Scene([rod], [], [load], laid([wall], TIGHT, mu), motion=Dynamic(ENDED, 1e-6))

    slides = mu < np.tan(SLOPE)
    gone = way(PRESS / MASS * (sin(SLOPE) - mu * cos(SLOPE))) if slides else PRESS * sin(SLOPE) / TIGHT.eps_N

    def off(result: Result) -> float:
        moved = float(((stations(result) - start) @ down).mean() - LENGTH / 2.0)
        if slides:
            return abs(moved / gone - 1.0)
        rod = result.contacts[0].rods[0]
        assert rod is not None
        crept = float((rod.slip[-1] - rod.slip[len(rod.slip) // 2]).max())
        # Anchors that hold swing about gone, at most as far as they would under a sudden load.
        return (crept + max(0.0, moved - 2.0 * gone)) / gone

    title = f"Lengthwise on a slope of 45°, μ = {mu:g}"
    words = "a = (q/ρA)(sin β − μ cos β)" if slides else "no slip in the second half"
    return HardContact(f"slope-{mu:g}", "μ = 0 … 5", title, scene, Exact(words, off), limit=COARSE)


def thrown(depth: float, part: float) -> HardContact:
    """Starts within the floor, which throws it off with v = δ √(ε_N/ρA), or slower where steps are long.

    Args:
        depth: [m].
        part: Of the time 1/ω = √(ρA/ε_N) in a step.
    """
    time, δ = sqrt(MASS / TIGHT.eps_N), depth + TIGHT.g_0
    fast = δ / time
    t_end = max(pi * time, 4.0 * part * time)

    def scene() -> Scene:
        return Scene([fibre(-depth)], [], [], laid([FLOOR], TIGHT), motion=Dynamic(t_end, part * time))

    def off(result: Result) -> float:
        v = result.rods[0].v
        assert v is not None
        speed = float(v[-1, :, 2].mean())
        return abs(speed / fast - 1.0) if part < 1.0 else max(0.0, speed / fast - 1.0)

    title = f"Starts {1e6 * depth:g} µm deep, Δt = {part:g} √(ρA/ε_N)"
    answer = Exact("v = δ √(ε_N/ρA)" if part < 1.0 else "v ≤ δ √(ε_N/ρA)", off)
    return HardContact(f"thrown-{part:g}", "starts in penetration", title, scene, answer, limit=COARSE)


def belt(mu: float) -> HardContact:
    """The floor runs at the speed of delivery from the start; the fibre takes it on and sticks (process.md 6.8, C9)."""
    motion = WallMotion(velocity=(DELIVERY, 0.0, 0.0))
    running = Plane((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), motion)

    def scene() -> Scene:
        rod, load = fibre(TIGHT.g_0 - PRESS / TIGHT.eps_N), pressed(PRESS, Steady())
        return Scene([rod], [], [load], [Contact(running, TIGHT, Coulomb(mu))], motion=Dynamic(ENDED, 1e-6))

    # It has slid by v²/2a less than the wall.
    exact = DELIVERY * ENDED - DELIVERY**2 / (2.0 * mu * PRESS / MASS)

    def off(result: Result) -> float:
        moved = float((stations(result)[:, 0]).mean() - LENGTH / 2.0)
        return abs(moved / exact - 1.0)

    title = f"Floor runs at {DELIVERY:g} m/s, μ = {mu:g}"
    answer = Exact("lags by v²ρA/2μq", off)
    return HardContact(f"belt-{mu:g}", "a wall that goes", title, scene, answer, limit=COARSE)


def turntable() -> HardContact:
    """The floor turns about the start of the fibre; it turns with it, but rolls, all its sections alike.

    Friction on the whole of it gives its middle a third of the acceleration of the floor there and its spin the rest
    (I = m r²/2), so that the place that stays at rest is a third of its length from the axis.
    """
    angle, t_end = 0.02, 5e-4
    # The outer end needs 3.9e3 m/s² at most, of which friction gives three times as much; waves of torsion cross the
    # fibre fifty times in this time.
    motion = WallMotion(rotation=(0.0, 0.0, angle), history=lambda t: sin(0.5 * pi * t / t_end) ** 2)
    turning = Plane((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), motion)

    def scene() -> Scene:
        rod, load = fibre(TIGHT.g_0 - PRESS / TIGHT.eps_N), pressed(PRESS, Steady())
        return Scene([rod], [], [load], [Contact(turning, TIGHT, Coulomb(0.64))], motion=Dynamic(t_end, 5e-6))

    def off(result: Result) -> float:
        found = stations(result)[:, 1]
        exact = sin(angle) * (np.linspace(0.0, LENGTH, len(found)) - LENGTH / 3.0)
        return float(np.abs(found - exact).max() / (angle * LENGTH))

    title = f"Floor turns by {angle:g} rad about its normal under a free fibre"
    answer = Exact("turns with the floor and rolls, about L/3", off)
    return HardContact("turntable", "a wall that turns", title, scene, answer, limit=COARSE)


CASES = (
    *map(slope, (0.0, 0.3, 0.64, 0.9, 1.1, 2.0, 5.0)),
    *(thrown(5e-6, part) for part in (0.01, 100.0)),
    *map(belt, (0.64, 5.0)),
    turntable(),
)
