"""Rollers on rough slopes and planes: what slips, what rolls, and what slips until it rolls (Lv, Lvb, C8, P7)."""

from __future__ import annotations

from functools import partial
from math import pi, radians, tan
from typing import TYPE_CHECKING

import numpy as np

from verification.contactcase import ContactCase
from verification.contacts.bodies import RADIUS, ROLLERS, roller, spun, way
from verification.contacts.timed import in_time
from verification.references.friction import Incline, Slide
from verification.references.moving import exact

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from verification.case import Array

__all__ = ["CASES"]

# Slope of C8, of a core on a ramp [°], and how far it rolls [s].
RAMP, ROLLED = 15.0, 0.5
# How long cylinders are looked at on slopes [s].
RELEASED = 0.25
SUDDEN = "The load is there at once: anchors swing by what they yield, 1e-7 m, until the scheme damps it, if it does."


def down(result: Result, phi: float) -> Array:
    """Way, speed and radius times spin at the end."""
    s, v = way(result, phi)
    return np.array([s[-1], v[-1], RADIUS * spun(result)[-1]])


def incline_case(degrees: float, mu: float) -> ContactCase:
    """A cylinder released on a slope."""
    phi = radians(degrees)
    body = Incline(phi, mu)
    values = (0.5 * body.cylinder * RELEASED**2, body.cylinder * RELEASED, body.spin * RELEASED)
    # Close to where it would slip, a cylinder that rolls takes the midpoint rule many short steps.
    quick = abs(mu - tan(phi) / 3.0) > 0.1 * mu
    return ContactCase(
        name=f"friction-cylinder-{degrees:g}-{mu:g}",
        title=f"Lv, solid cylinder on a slope of {degrees:g}°, μ = {mu:g}: {'rolls' if body.rolls else 'slips'}",
        family="friction",
        reference=exact("a = ⅔ g sin φ where μ ≥ tan(φ)/3", "textbook; Lv of the references", *values),
        scale=values,
        quantity="way, speed and radius times spin; m, m/s",
        read=lambda result: down(result, phi),
        runs=tuple(
            in_time(stepper, partial(roller, phi=phi, mu=mu), RELEASED, (50, 100, 200), limit=2e-2, quick=quick)
            for stepper in ROLLERS
        ),
        note=SUDDEN,
    )


def ramp_case() -> ContactCase:
    """C8: turns by the way."""
    phi = radians(RAMP)
    body = Incline(phi, 0.64)
    turns = 0.5 * body.cylinder * ROLLED**2 / (2.0 * pi * RADIUS)

    def read(result: Result) -> Array:
        s, _ = way(result, phi)
        turned = 0.5 * (spun(result)[1:] + spun(result)[:-1]) @ np.diff(result.t)
        return np.array([s[-1] / (2.0 * pi * RADIUS), turned / (2.0 * pi)])

    output = tuple(np.linspace(0.0, ROLLED, 51))
    return ContactCase(
        name="friction-roller",
        title="C8, stiff rod rolling down a ramp of 15°, μ = 0.64",
        family="friction",
        reference=exact("s/2πR, s = ⅓ g sin φ t²", "process.md 6.8", turns, turns),
        scale=turns,
        quantity="turns, by way and by spin",
        read=read,
        runs=tuple(
            in_time(stepper, partial(roller, phi=phi, mu=0.64), ROLLED, (50, 100, 200), output=output, limit=2e-2)
            for stepper in ROLLERS
        ),
        note=SUDDEN,
    )


def slide_case() -> ContactCase:
    """A cylinder that slips until it rolls, at the moment of that and at 1 s."""
    body = Slide(1.0, 0.3)
    begun, path, speed = body.rolls

    def read(result: Result) -> Array:
        s, v = way(result, 0.0)
        return np.array([s[1], s[2], v[2], RADIUS * spun(result)[2]])

    return ContactCase(
        name="friction-slide-to-roll",
        title="Lvb, P7b: solid cylinder pushed along a plane at 1 m/s, μ = 0.3",
        family="friction",
        reference=exact(
            "t = v/3μg, 2v/3 from there", "textbook; Lvb of the references", path, body.cylinder(1.0), *2 * (speed,)
        ),
        scale=(path, body.cylinder(1.0), speed, speed),
        quantity="way when it begins to roll and at 1 s, speed and radius times spin at 1 s; m, m/s",
        read=read,
        runs=tuple(
            in_time(
                stepper,
                partial(roller, phi=0.0, mu=0.3, v=1.0),
                1.0,
                (100, 200, 400),
                output=(0.0, begun, 1.0),
                limit=2e-2,
            )
            for stepper in ROLLERS
        ),
    )


CASES = (
    incline_case(30.0, 0.2),
    incline_case(20.0, 0.5),
    incline_case(45.0, 0.2),
    ramp_case(),
    slide_case(),
)
