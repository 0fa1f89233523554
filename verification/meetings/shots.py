"""Rods shot at rods: side by side, crosswise, and further in a step than they are thick."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from scipy import integrate

from dolfinrod.scene import Penalty, Rod, RodContact, Scene, Section, Spatial, Velocity
from verification.contactcase import ContactCase
from verification.contacts.timed import in_time
from verification.references.moving import exact
from verification.references.shots import Exchange, Lens
from verification.stepper import DiscreteStepper, Stepper, both_schemes

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from dolfinrod.scene import Dynamic
    from verification.case import Array

__all__ = ["CASES", "apart", "crosswise", "momentum", "parallel", "through"]

# The paper's fibre, 1 m/s, and one twice as heavy that it hits.
FIBRE = Section.ramie(rigid={"shear"})
HEAVY = Section(
    EA=FIBRE.EA, EI=FIBRE.EI, GJ=FIBRE.GJ, rhoA=2.0 * (FIBRE.rhoA or 0.0), rhoI=FIBRE.rhoI, radius=1e-5, rigid={"shear"}
)
# Stiffness of fibres that are shot at each other side by side, and crosswise, where little more than a point touches.
LENGTH, R, EPS, HARD = 1e-3, 1e-5, 4e5, 1e8
SIDE = Exchange(FIBRE.rhoA or 0.0, HEAVY.rhoA or 0.0, 1.0)
# Diameters that a shot goes in a step, and those that a quick report takes.
DIAMETERS, QUICK = (1.2, 3.0, 8.0), 3.0
# Diameters that it flies, three of them up to its target; much later that has turned and no longer lies across it.
FLIGHT = 24.0
# Chords on which the discrete model's own error, 3 % on four, lies below that of the steps: a line load on its curves
# is not spread over the nodes as their masses are, and so bends the fibres a little.
FINE = 16
# How long it is looked at, in contact times.
LOOKED = 1.5
# So stiff that they only move as a whole: they yield to the force by 1e-6 of what the contact does.
STIFF = Section(EA=1e9, EI=1e5, GJ=1e5, rhoA=1.0, rhoI=(5e-5, 2.5e-5, 2.5e-5), radius=0.01, rigid={"shear"})
ACROSS, SPEED, LENS = 0.1, 0.1, Lens(1e6, 0.02)
MASS = Exchange(ACROSS * 1.0, ACROSS * 1.0, SPEED)


def parallel(motion: Dynamic) -> Scene:
    """A fibre that comes to another broadside on and just touches it."""
    rods = [Rod.straight(LENGTH, section, start=(0.0, y, 0.0)) for section, y in ((FIBRE, 0.0), (HEAVY, 2.0 * R))]
    contacts, velocities = [RodContact(Penalty(EPS))], [Velocity((0.0, SIDE.v, 0.0), rod=0)]
    return Scene(rods=rods, contacts=contacts, velocities=velocities, motion=motion)


def crosswise(motion: Dynamic) -> Scene:
    """A stiff rod that comes to another across it, middle to middle, and just touches it."""
    rods = [
        Rod.straight(ACROSS, STIFF, start=(-0.5 * ACROSS, 0.0, 0.0)),
        Rod.straight(ACROSS, STIFF, start=(0.0, LENS.reach, -0.5 * ACROSS), direction=(0.0, 0.0, 1.0)),
    ]
    contacts, velocities = [RodContact(Penalty(LENS.eps_N))], [Velocity((0.0, SPEED, 0.0), rod=0)]
    return Scene(rods=rods, contacts=contacts, velocities=velocities, motion=motion)


def through(motion: Dynamic, *, v: float, off: float = 0.3) -> Scene:
    """A fibre shot at another across it, from three diameters away, off its middle."""
    rods = [
        Rod.straight(LENGTH, FIBRE, start=(-0.5 * LENGTH, -6.0 * R, 0.0)),
        Rod.straight(LENGTH, FIBRE, start=(off * LENGTH, 0.0, -0.37 * LENGTH), direction=(0.1, 0.0, 1.0)),
    ]
    contacts, velocities = [RodContact(Penalty(HARD))], [Velocity((0.0, v, 0.0), rod=0)]
    return Scene(rods=rods, contacts=contacts, velocities=velocities, motion=motion)


def means(result: Result) -> tuple[Array, Array]:
    """Mean heights and speeds of both rods at the end."""
    heights = [_mean(result, rod.r[-1, :, 1]) for rod in result.rods]
    speeds = [_mean(result, np.asarray(rod.v)[-1, :, 1]) for rod in result.rods]
    return np.array(heights), np.array(speeds)


def _mean(result: Result, values: Array) -> float:
    """Along a rod on even elements, each node weighed as the model lumps mass: by trapezia, or by Simpson's rule."""
    rule = integrate.trapezoid if result.formulation.model == "discrete" else integrate.simpson
    return float(rule(values, dx=1.0) / (len(values) - 1))


def apart(result: Result, *, reach: float, after: float, v: float) -> Array:
    """Speeds over that of the impact, and how far the rods have parted over how far they should have."""
    heights, speeds = means(result)
    return np.array([*(speeds / v), (heights[1] - heights[0] - reach) / (after * v)])


def momentum(result: Result) -> Array:
    """Shot and target, weighed by their masses, over that of the shot at the start."""
    masses = [(rod.section.rhoA or 0.0) * rod.length for rod in result.scene.rods]
    start = masses[0] * _shot(result)
    return np.array([masses @ means(result)[1] / start])


def _shot(result: Result) -> float:
    v = result.scene.velocities[0].v
    assert not callable(v)
    return float(v[1])


def stays(result: Result) -> Array:
    """Whether the shot is still on its side of the target, in its own direction, and the momentum."""
    first, second = result.rods
    side = []
    for a, b in zip(first.r, second.r, strict=True):
        # Where they cross, seen along y.
        near = np.linalg.norm((a[:, None] - b)[..., [0, 2]], axis=-1)
        i, j = np.unravel_index(near.argmin(), near.shape)
        side.append(b[j, 1] - a[i, 1] > 0.0)
    return np.array([float(all(side)), *momentum(result)])


def steppers(elements: int, chords: int) -> tuple[Stepper, ...]:
    """Euler and midpoint on quadratic elements, and the discrete model."""
    midpoint, euler = both_schemes(elements, 2, Spatial())
    return euler, midpoint, DiscreteStepper(chords)


def side_case() -> ContactCase:
    """Side by side."""
    time = SIDE.time(EPS)
    end, after = LOOKED * time, SIDE.after
    parted = (LOOKED - 1.0) * time
    return ContactCase(
        name="shot-parallel",
        title="Fibre that hits another broadside on at 1 m/s, which is twice as heavy",
        family="shot",
        reference=exact("momentum exchanged; π √(m/ε_N)", "verification/references/shots.py", *after, 1.0),
        scale=1.0,
        quantity="speeds after it and how far the two have parted, over speed and way of the shot",
        read=partial(apart, reach=2.0 * R, after=parted, v=SIDE.v),
        runs=tuple(
            in_time(stepper, parallel, end, (60, 120, 240), limit=limit, order=order, quick=True)
            for stepper, (limit, order) in zip(steppers(2, FINE), ((0.1, 0.8), (1e-3, 1.8), (0.1, 0.8)), strict=True)
        ),
    )


def cross_case() -> ContactCase:
    """Crosswise."""
    time = LENS.time(MASS.reduced, SPEED)
    end, parted = LOOKED * time, (LOOKED - 1.0) * time
    return ContactCase(
        name="shot-crosswise",
        title="Stiff rod that hits its like across, middle to middle",
        family="shot",
        reference=exact("speeds exchanged; time by quadrature", "verification/references/shots.py", 0.0, 1.0, 1.0),
        scale=1.0,
        quantity="speeds after it and how far the two have parted, over speed and way of the shot",
        read=partial(apart, reach=LENS.reach, after=parted, v=SPEED),
        runs=tuple(
            in_time(stepper, crosswise, end, (30, 60, 120), limit=limit, order=order)
            for stepper, (limit, order) in zip(steppers(2, 4), ((0.2, 0.8), (1e-3, 1.8), (0.2, 0.8)), strict=True)
        ),
    )


def fast_case(diameters: float) -> ContactCase:
    """Further in a step than a diameter."""
    steps, v = round(FLIGHT / diameters), 5.0
    dt = diameters * 2.0 * R / v
    return ContactCase(
        name=f"shot-through-{diameters:g}",
        title=f"Fibre shot across another at 5 m/s, {diameters:g} diameters a step: it must not pass",
        family="shot",
        reference=exact("stays on its side; momentum", "no rod goes through another", 1.0, 1.0),
        scale=1.0,
        quantity="1 while the shot is on its side of the target at all times; momentum over that of the shot",
        read=stays,
        runs=tuple(
            in_time(
                stepper,
                partial(through, v=v),
                steps * dt,
                (steps,),
                output=tuple(dt * k for k in range(steps + 1)),
                limit=1e-9,
                quick=diameters == QUICK,
            )
            for stepper in steppers(10, 20)
        ),
    )


CASES = (side_case(), cross_case(), *(fast_case(d) for d in DIAMETERS))
