"""Contacts that solvers stumble over on their way: lost and regained, walls that turn, huge loads at once."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import cos, radians, sin
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import Clamp, Guide, Scene, Static, Steady, WallMotion
from verification.answers import N_STATIONS, Beside, Exact, InSteps, stations
from verification.hardcases.contacts import FLOOR, LENGTH, PRESS, RADIUS, TIGHT, fibre, laid, pressed
from verification.hardcontact import HardContact

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from dolfinrod.scene.history import History

__all__ = ["CASES"]


def held_up(length: float, size: float, history: History = None) -> Callable[[], Scene]:
    """Clamped 20 µm over the floor and pressed onto it."""

    def scene() -> Scene:
        return Scene([fibre(2e-5, length)], [Clamp("start")], [pressed(size, history)], laid([FLOOR], TIGHT))

    return scene


def lifted() -> HardContact:
    """Pressed down, lifted off by the reverse, pressed down again: as if it had been pressed once."""
    history = ((0.0, 0.0), (0.3, 1.0), (0.6, -1.0), (1.0, 1.0))
    once = Beside(held_up(3e-3, PRESS), "the other model pressed once, twice the elements")
    return HardContact(
        "lifted", "lost and regained", "Pressed, lifted, pressed again", held_up(3e-3, PRESS, history), once
    )


def withdrawn() -> HardContact:
    """The floor is taken away by a tenth of a millimetre and brought back under a steady load."""
    away = WallMotion((0.0, 0.0, -1e-4), history=((0.0, 0.0), (0.5, 1.0), (1.0, 0.0)))

    def scene() -> Scene:
        contacts = laid([replace(FLOOR, motion=away)], TIGHT)
        return Scene([fibre(2e-5, 3e-3)], [Clamp("start")], [pressed(PRESS, Steady())], contacts)

    once = Beside(held_up(3e-3, PRESS), "the other model, floor at rest, twice the elements")
    return HardContact("withdrawn", "lost and regained", "Floor taken away and brought back", scene, once)


def turned(degrees: float) -> HardContact:
    """The floor turns about the hinge of the fibre, which follows."""
    β = radians(degrees)
    hinge = (0.0, 0.0, RADIUS + TIGHT.g_0 - PRESS / TIGHT.eps_N)
    motion = WallMotion(rotation=(0.0, -β, 0.0), about=hinge)

    def scene() -> Scene:
        contacts = laid([replace(FLOOR, motion=motion)], TIGHT)
        return Scene([fibre(hinge[2] - RADIUS)], [Guide("start", ("ry",))], [pressed(PRESS, Steady())], contacts)

    def off(result: Result) -> float:
        along = np.linspace(0.0, LENGTH, N_STATIONS)[:, None] * np.array([cos(β), 0.0, sin(β)])
        return float(np.linalg.norm(stations(result) - np.asarray(hinge) - along, axis=1).max() / LENGTH)

    title = f"Floor turns by {degrees:g}° under the fibre"
    return HardContact(f"turned-{degrees:g}", "a wall that turns", title, scene, Exact("turned with the floor", off))


def huge(factor: float) -> HardContact:
    """Many times the load of air in one step, the fibre clamped above the floor."""
    title = f"{factor:g} times the load at once"
    slowly = Beside(words="the other model in 200 steps, twice the elements", steps=200)
    return HardContact(f"huge-{factor:g}", "huge load step", title, held_up(LENGTH, factor * PRESS), slowly)


def in_steps() -> HardContact:
    """One step, and fifty."""
    scene = held_up(LENGTH, PRESS)

    def at_once() -> Scene:
        return replace(scene(), motion=Static(steps=1))

    return HardContact("steps", "1 and 50 steps", "Pressed down in one step", at_once, InSteps(50), limit=1e-8)


CASES = (
    lifted(),
    withdrawn(),
    *map(huge, (10.0, 1e3)),
    *map(turned, (10.0, 60.0)),
    in_steps(),
)
