"""Motions that schemes stumble over: extreme steps, whips, releases, no mass, stiff drag, kinks, many turns."""

from __future__ import annotations

import numpy as np

from dolfinrod.scene import (
    Air,
    Clamp,
    Dynamic,
    Gravity,
    LineForce,
    Pin,
    PointForce,
    Prescribed,
    Rod,
    Scene,
    Section,
    Velocity,
)
from verification.hardmotion import HardMotion
from verification.whereabouts import At, AtRest, Finer, Vibrating

__all__ = ["CASES"]

TURNS = 50


def slender(ratio: float, mass: float = 1.0, turning: float = 1.0) -> Section:
    """Round section of a rod with L = EI = 1 and L/d = ratio, ν = 0.3; rotary inertia times a factor.

    Args:
        ratio: L/d.
        mass: ρA L⁴/EI [s²].
        turning: Part of the rotary inertia that counts.
    """
    EA = 16.0 * ratio**2
    I = turning * mass / EA
    return Section(EA=EA, GA=0.9 * EA / 2.6, GJ=1.0 / 1.3, EI=1.0, rhoA=mass, rhoI=(2.0 * I, I, I))


def rod(section: Section) -> Rod:
    """Of unit length along x."""
    return Rod.straight(length=1.0, section=section)


def weighed(dt: float) -> HardMotion:
    """The paper's fibre, let go under its own weight: 20 steps of any length, resolved or not."""

    def scene() -> Scene:
        fibre = Rod.straight(length=0.04, section=Section.ramie())
        return Scene([fibre], [Clamp("start")], [Gravity((0.0, -9.81, 0.0))], motion=Dynamic(20.0 * dt, dt))

    # The first bending vibration takes 0.12 s; by 0.02 s the fibre has fallen by a twentieth of its length, which is no
    # small vibration any more.
    check = Vibrating() if dt < 1e-3 else Finer() if dt == 1e-3 else None
    return HardMotion(
        f"step-{dt:g}", "steps from 1e-8 to 1e-1 s", f"Fibre under its weight, Δt = {dt:g} s", scene, check
    )


def slender_at_large_steps() -> HardMotion:
    """L/d = 2000, bent out of plane by a sudden force; 10⁴ times the explicit limit of 80 elements, (L/80)/√(EA/ρA)."""
    section = slender(2000.0)
    dt = 1e4 / 80.0 / np.sqrt(section.EA)

    def scene() -> Scene:
        force = PointForce((0.0, 2.0, -1.0), at="end")
        return Scene([rod(section)], [Clamp("start")], [force], motion=Dynamic(0.5, dt))

    title = f"L/d = 2000, sudden force, Δt = 10⁴ × the explicit limit = {dt:.2g} √(ρA L⁴/EI)"
    return HardMotion("slender-2000", "slenderness", title, scene, Finer(), discrete=80)


def flung(angle: float) -> HardMotion:
    """A clamp that turns fast and stops dead: the free end whips past it."""

    def scene() -> Scene:
        turned = Prescribed("start", (0, 0, 0), (0.0, 0.0, angle), history=((0.0, 0.0), (0.25, 1.0)))
        return Scene([rod(slender(200.0))], [turned], motion=Dynamic(0.75, 5e-3))

    title = f"Clamp turns by {angle:g} rad in 0.25 √(ρA L⁴/EI) and stops"
    return HardMotion(f"flung-{angle:g}", "whips", title, scene, Finer())


def travelling_loop() -> HardMotion:
    """A rod folded to a U, pinned at one end, the other branch moving along: the fold runs down and the end cracks.

    In axes that go with the fold at V/2 every point runs along the rod with V/2, so that nothing stretches.
    """
    radius, branch, speed = 0.05, 0.4, 20.0
    turn = np.pi * radius
    s = np.concatenate([np.linspace(0.0, branch, 30), branch + np.linspace(0.0, turn, 21)[1:-1]])
    s = np.concatenate([s, branch + turn + np.linspace(0.0, branch, 30)])
    inside = np.clip((s - branch) / radius, 0.0, np.pi)
    x = np.minimum(s, branch) + radius * np.sin(inside) - np.maximum(s - branch - turn, 0.0)
    points = np.stack([x, radius * (1.0 - np.cos(inside)), 0.0 * s], axis=1)

    def velocity(r: np.ndarray) -> np.ndarray:
        angle = np.arctan2(r[:, 0] - branch, radius - r[:, 1])
        angle = np.where(r[:, 0] > branch, angle, np.where(r[:, 1] < radius, 0.0, np.pi))
        along = np.stack([np.cos(angle), np.sin(angle), 0.0 * angle], axis=1)
        return -0.5 * speed * (along - np.array([1.0, 0.0, 0.0]))

    def scene() -> Scene:
        folded = Rod.through(points, section=slender(200.0))
        begun = [Velocity(v=velocity)]
        return Scene([folded], [Pin("start")], motion=Dynamic(0.045, 5e-4), velocities=begun)

    title = "A fold runs down a free end, 20 L/√(ρA L⁴/EI)"
    return HardMotion("loop", "whips", title, scene, Finer(48, 2), elements=32, discrete=80)


def released(force: float) -> HardMotion:
    """Bent within 0.5 √(ρA L⁴/EI), then the load is gone within a hundredth of a step."""
    dt = 0.01

    def scene() -> Scene:
        gone = ((0.0, 0.0), (0.5, 1.0), (0.5 + 1e-2 * dt, 0.0))
        load = PointForce((0.0, force, -0.3 * force), at="end", history=gone)
        return Scene([rod(slender(200.0))], [Clamp("start")], [load], motion=Dynamic(1.0, dt))

    title = f"Bent by {force:g} EI/L², let go"
    return HardMotion(f"released-{force:g}", "sudden release", title, scene, Finer())


def massless(mass: float, turning: float) -> HardMotion:
    """Next to no mass, with or without rotary inertia, bent by a load that grows in steps of many periods."""

    def scene() -> Scene:
        ramp = PointForce((0.0, 5.0, -2.0), at="end", history=lambda t: np.sin(0.5 * np.pi * t) ** 2)
        return Scene([rod(slender(200.0, mass, turning))], [Clamp("start")], [ramp], motion=Dynamic(1.0, 0.05))

    title = f"ρA = {mass:g} EI s²/L⁴, {'with' if turning else 'no'} rotary inertia"
    return HardMotion(f"massless-{mass:g}-{turning:g}", "next to no mass", title, scene, AtRest())


def unsaid() -> HardMotion:
    """A section that says nothing of its rotary inertia."""

    def scene() -> Scene:
        section = Section(EA=1e4, GA=4e3, GJ=0.8, EI=1.0, rhoA=1.0)
        load = PointForce((0.0, 1.0, 0.5), at="end")
        return Scene([rod(section)], [Clamp("start")], [load], motion=Dynamic(0.5, 0.01))

    return HardMotion("unsaid-rhoI", "next to no mass", "Rotary inertia not given", scene)


def windy(wind: float, viscosity: float, dt: float) -> HardMotion:
    """The paper's fibre in a wind, or in something as thick as honey: drag that relaxes in a part of a step."""

    def scene() -> Scene:
        fibre = Rod.straight(length=0.04, section=Section.ramie())
        air = Air(field=(0.0, wind, 0.3 * wind), viscosity=viscosity)
        return Scene([fibre], [Clamp("start")], air=air, motion=Dynamic(40.0 * dt, dt))

    title = f"Fibre in a wind of {wind:g} m/s, {viscosity:g} Pa s, Δt = {dt:g} s"
    return HardMotion(f"wind-{wind:g}-{viscosity:g}", "strong drag", title, scene, Finer())


def hurried(short: float) -> HardMotion:
    """Long steps, one that is next to nothing, long steps again."""

    def scene() -> Scene:
        load = PointForce((0.0, 1.0, -0.4), at="end")
        motion = Dynamic(0.5, 0.01, output=(0.25, 0.25 + short, 0.5))
        return Scene([rod(slender(200.0))], [Clamp("start")], [load], motion=motion)

    title = f"A step of {short:g} s after steps of 0.01 s"
    return HardMotion(f"short-{short:g}", "a short step after long ones", title, scene, Finer())


def kinked(rotation: bool) -> HardMotion:
    """A clamp that goes to and fro, or turns to and fro, in straight pieces: its speed jumps."""
    zigzag = ((0.0, 0.0), (0.1, 1.0), (0.2, -1.0), (0.25, 0.5), (0.4, 0.0))

    def scene() -> Scene:
        place = (0.0, 0.0, 0.0) if rotation else (0.05, 0.2, -0.1)
        turn = (0.0, 0.3, 1.0) if rotation else (0.0, 0.0, 0.0)
        moved = Prescribed("start", place, turn, history=zigzag)
        return Scene([rod(slender(100.0))], [moved], motion=Dynamic(0.5, 5e-3))

    words = "turns" if rotation else "moves"
    return HardMotion(f"kinks-{words}", "kinks", f"Clamp {words} to and fro with kinks", scene, Finer())


def spun(axis: tuple[float, float, float], why: str) -> HardMotion:
    """Turned by fifty turns in ten units of time, all of it with the clamp from the start."""
    angle = 2.0 * np.pi * TURNS
    spin = tuple(angle / 10.0 * c for c in axis)

    def scene() -> Scene:
        turned = Prescribed("start", (0, 0, 0), tuple(angle * c for c in axis))
        begun = [Velocity(omega=spin)]
        # Half a radian a step.
        return Scene([rod(slender(200.0))], [turned], motion=Dynamic(10.0, 10.0 / (2.0 * angle)), velocities=begun)

    check = At((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), why)
    name = "own" if axis[0] else "across"
    return HardMotion(f"spun-{name}", "many turns", f"Fifty turns about {why.split(',')[0]}", scene, check, elements=8)


def thrown(turning: float) -> HardMotion:
    """A free rod that tumbles ten times; without rotary inertia nothing resists a spin about its own axis."""
    angle = 2.0 * np.pi * 10

    def scene() -> Scene:
        begun = [Velocity(v=(0.1, 0.0, 0.2), omega=(0.0, 0.0, angle / 10.0), about=(0.5, 0.0, 0.0))]
        motion = Dynamic(10.0, 10.0 / (10.0 * angle))
        return Scene([rod(slender(20.0, turning=turning))], motion=motion, velocities=begun)

    title = f"Free flight with ten turns, {'with' if turning else 'no'} rotary inertia"
    return HardMotion(f"thrown-{turning:g}", "many turns", title, scene, Finer(), elements=4, discrete=20)


def loaded_late(load: float) -> HardMotion:
    """A line load that appears at once and is a hundred times what bends the rod double."""

    def scene() -> Scene:
        late = LineForce((0.0, load, 0.1 * load), history=((0.0, 0.0), (0.1, 0.0), (0.1 + 1e-6, 1.0)))
        return Scene([rod(slender(200.0))], [Clamp("start")], [late], motion=Dynamic(0.3, 2e-3))

    return HardMotion(f"late-{load:g}", "sudden release", f"Line load of {load:g} EI/L³ at once", scene, Finer(16))


CASES = (
    *map(weighed, (1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1)),
    slender_at_large_steps(),
    *map(flung, (1.0, 6.0)),
    travelling_loop(),
    *map(released, (1.0, 10.0)),
    loaded_late(100.0),
    massless(1e-6, 1.0),
    massless(1e-6, 0.0),
    massless(1e-12, 0.0),
    unsaid(),
    windy(20.0, 1.81e-5, 2e-5),
    windy(1.0, 1.0, 1e-3),
    *map(hurried, (1e-4, 1e-7)),
    *map(kinked, (False, True)),
    spun((1.0, 0.0, 0.0), "its own axis, straight"),
    spun((0.0, 0.0, 1.0), "an axis across it, straight but for the centrifugal stretch"),
    thrown(1.0),
    thrown(0.0),
)
