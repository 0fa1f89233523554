"""Rods in motions that mechanics knows by heart: pendulum (K5), spinning rod (K6), flying rod (K9)."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import ellipk

from dolfinrod.scene import Gravity, Pin, Planar, PointForce, PointMoment, Prescribed, Rod, Scene, Section, Velocity
from verification.motioncase import MotionCase, Run
from verification.references.moving import exact
from verification.stepper import DiscreteStepper, both_schemes

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from dolfinrod.scene import Dynamic
    from verification.case import Array

__all__ = ["CASES"]

PLANE = Planar((0.0, 0.0, 1.0))
STIFF = Section(GJ=1e6, EI=1e6, rhoA=1.0, rhoI=(1e-4, 0.0, 0.0), rigid={"shear", "extension"})
# Damped as Kelvin and Voigt do, so that the vibrations of a sudden start die out; only the discrete model knows that.
EA = 100.0
SPUN = Section(GJ=10.0, EI=10.0, EA=EA, rhoA=1.0, rhoI=(1e-2, 0.0, 0.0), rigid=frozenset({"shear"}), damping=0.1)
UNDAMPED = replace(SPUN, damping=0.0)
SPIN, RUN_UP = 5.0, 8.0
FLYING = Section(EA=1e4, GA=1e4, GJ=500.0, EI=500.0, rhoA=1.0, rhoI=(20.0, 10.0, 10.0))
# Where the load of the flying rod ends, and where it is looked at.
LOADED, LATER = 2.5, 5.0


def period(angle: float) -> float:
    """Of a rod of length 1 that swings by ±angle under g = 1: 4 √(2/3) K(sin²(angle/2)) [s]."""
    return float(4.0 * np.sqrt(2.0 / 3.0) * ellipk(np.sin(0.5 * angle) ** 2))


def hung(angle: float, motion: Dynamic) -> Scene:
    """A stiff rod pinned at the origin, released at an angle to the vertical, g = 1."""
    rod = Rod.straight(1.0, STIFF, direction=(np.sin(angle), -np.cos(angle), 0.0), d2=(np.cos(angle), np.sin(angle), 0))
    return Scene(rods=[rod], supports=[Pin(at="start")], loads=[Gravity((0.0, -1.0, 0.0))], motion=motion)


def swing(result: Result) -> Array:
    """Angle to the vertical and speed of turning of a pendulum, about its pin, at the last state."""
    r, v = result.tip, np.asarray(result.rods[0].v)[-1, -1]
    return np.array([np.arctan2(r[0], -r[1]), (r[0] * v[1] - r[1] * v[0]) / (r @ r)])


def pendulum(degrees: float, quarters: int, words: str) -> MotionCase:
    """A pendulum so many quarters of its period after its release.

    Args:
        degrees: At which it is released.
        quarters: 1: at the bottom, 2: at rest on the other side, 4: where it started.
        words: For the title.

    Returns:
        The case; angles are relative to that of the release, speeds to that at the bottom.
    """
    angle = float(np.deg2rad(degrees))
    fastest = float(np.sqrt(3.0 * (1.0 - np.cos(angle))))
    angles, speeds = {1: (0.0, -fastest), 2: (-angle, 0.0), 4: (angle, 0.0)}[quarters]
    midpoint, euler = both_schemes(1, 2, PLANE)
    return MotionCase(
        name=f"motion-pendulum-{degrees:g}-{words.replace(' ', '-')}",
        title=f"K5, rod swinging by ±{degrees:g}°, {words}",
        scene=lambda motion: hung(angle, motion),
        t_end=0.25 * quarters * period(angle),
        reference=exact("T = 4 √(2/3) K(sin²(θ/2)), ω² = 3 (1 − cos θ)", "complete elliptic integral", angles, speeds),
        scale=angle,
        quantity="angle and angular velocity, rad, rad/s",
        read=swing,
        runs=(
            Run(midpoint, (40, 80, 160), limit=1e-4),
            *((Run(euler, (160, 320, 640)),) if quarters == 1 else ()),
        ),
    )


def whirled(motion: Dynamic) -> Scene:
    """Clamped to what turns at 5 rad/s, as the whole rod does from the start, not yet stretched, damped."""
    nip = Prescribed(at="start", displacement=(0, 0, 0), rotation=(0, 0, SPIN), history=lambda t: t)
    rod = Rod.straight(1.0, SPUN)
    return Scene(rods=[rod], supports=[nip], motion=motion, velocities=[Velocity(omega=(0, 0, SPIN))])


def run_up(t: float) -> float:
    """Angle over Ω that a smooth run-up to the full speed has covered by then, three derivatives of it steady [s]."""
    x = min(t / RUN_UP, 1.0)
    return RUN_UP * x**5 * (7.0 - 14.0 * x + 10.0 * x**2 - 2.5 * x**3) + max(t - RUN_UP, 0.0)


def spun_up(motion: Dynamic) -> Scene:
    """Clamped to what is brought to 5 rad/s; nothing is damped."""
    nip = Prescribed(at="start", displacement=(0, 0, 0), rotation=(0, 0, SPIN), history=run_up)
    return Scene(rods=[Rod.straight(1.0, UNDAMPED)], supports=[nip], motion=motion)


def stretched(result: Result) -> Array:
    """Distance of tip and middle from the axis, and N(0)/EA."""
    h = result.rods[0]
    middle = len(h.s) // 2
    return np.array([np.linalg.norm(h.r[-1, -1]), np.linalg.norm(h.r[-1, middle]), h.n[-1, 0, 0] / EA])


def loaded(t: float) -> float:
    """Until 2.5 s; a step ends there, and nothing acts in the next."""
    return 1.0 if t <= LOADED * (1.0 + 1e-12) else 0.0


def flung(motion: Dynamic) -> Scene:
    """A free rod pushed by 8 N and turned by 80 N m at its lower end."""
    rod = Rod.straight(10.0, FLYING, start=(6, 0, 0), direction=(-0.6, 0.8, 0), d2=(-0.8, -0.6, 0))
    loads = (
        PointForce((8.0, 0.0, 0.0), at="start", history=loaded),
        PointMoment((0.0, 0.0, 80.0), at="start", history=loaded),
    )
    return Scene(rods=[rod], loads=loads, motion=motion)


def centre(result: Result) -> Array:
    """Way and velocity of the centre of mass in the plane, by Simpson's rule or, of the discrete model, its masses."""
    h = result.rods[0]
    n = len(h.s) - 1
    if result.formulation.model == "discrete":
        w = np.r_[0.5, np.ones(n - 1), 0.5] / n
    else:
        w = np.tile([2.0, 4.0], n // 2 + 1)[: n + 1] / (3.0 * n)
        w[[0, -1]] *= 0.5
    return np.concatenate([w @ (h.r[-1] - h.r[0])[:, :2], w @ np.asarray(h.v)[-1][:, :2]])


STEADY = exact(
    "tan(a)/a, sin(a/2)/(a cos a), 1/cos(a) − 1",
    "x″ = −a² x, x(0) = 0, x′(1) = 1",
    np.tan(0.5) / 0.5,
    np.sin(0.25) / (0.5 * np.cos(0.5)),
    1.0 / np.cos(0.5) - 1.0,
)

CASES = (
    pendulum(90.0, 1, "at the bottom"),
    pendulum(90.0, 4, "a period later"),
    pendulum(150.0, 1, "at the bottom"),
    MotionCase(
        name="motion-spinning",
        title="K6, rod spinning about its end, a = ΩL √(ρA/EA) = 0.5, started unstretched",
        scene=whirled,
        t_end=2.0,
        reference=STEADY,
        scale=1.0,
        quantity="distances of tip and middle, m, N(0)/EA",
        read=stretched,
        runs=(Run(DiscreteStepper(40), (200, 400, 800), limit=1e-4, ordered=False),),
        note="Damping lets the vibrations of the start die out. Backward Euler turns each acceleration by ΩΔt, which a "
        "steady rotation feels by its square: the order seen is two.",
    ),
    MotionCase(
        name="motion-spun-up",
        title="K6, rod spinning about its end, a = ΩL √(ρA/EA) = 0.5, brought to it in 8 s",
        scene=spun_up,
        t_end=RUN_UP,
        reference=STEADY,
        scale=1.0,
        quantity="distances of tip and middle, m, N(0)/EA",
        read=stretched,
        runs=(Run(both_schemes(4, 3, PLANE)[0], (400, 800, 1600), limit=1e-4),),
        note="Undamped; what the smooth run-up leaves of vibrations is below the limit.",
    ),
    MotionCase(
        name="motion-flying",
        title="K9, flying rod of Simo and Vu-Quoc, centre of mass at 5 s",
        scene=flung,
        t_end=LATER,
        reference=exact(
            "0.4 t² until 2.5 s, 2 m/s later", "Simo & Vu-Quoc 1986, J. Appl. Mech. 53:855", 7.5, 0.0, 2.0, 0.0
        ),
        scale=7.5,
        quantity="way and velocity of the centre of mass, m, m/s",
        read=centre,
        runs=(
            Run(both_schemes(4, 2, PLANE)[0], (100, 200), limit=1e-9, ordered=False),
            Run(both_schemes(4, 2, PLANE)[1], (100, 200, 400), limit=1e-9),
            Run(DiscreteStepper(10), (100, 200, 400), limit=1e-9),
        ),
        note="The load ends between two steps: the rule of the midpoint takes it all, and no error is left; backward "
        "Euler is ahead by 0.4 t Δt, exactly.",
    ),
)
