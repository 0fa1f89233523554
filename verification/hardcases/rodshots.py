"""Rods shot at rods: over diameters a step, at random angles, aside, on end, at rods that lie on a floor."""

from __future__ import annotations

from collections.abc import Sequence
from math import sqrt
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import Contact, Coulomb, Dynamic, Penalty, Plane, Rod, RodContact, Scene, Section, Velocity
from verification.answers import Exact
from verification.contactaudit import audit
from verification.hardcases.contacts import RADIUS, TIGHT
from verification.hardcases.rodcontacts import FIBRE, thick
from verification.hardcontact import HardContact
from verification.hardmotion import LOSS

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.result import Result, RodHistory

    Array = NDArray[np.float64]

__all__ = ["CASES", "SHOTS", "momentum", "stays"]

SHOTS = "rods: shots"
LENGTH, SPEED = 1e-3, 5.0
THICK = 2.0 * RADIUS
HARD = Penalty(1e8)
MESH = {"elements": 6, "discrete": 12}
# Nodes of a cubic element have these parts of its mass.
LOBATTO = np.array([1.0, 5.0, 5.0, 1.0]) / 12.0
# Error of implicit Euler where a contact is passed in hundreds of steps.
COARSE = 2e-2


def momentum(result: Result) -> Array:
    """Of all rods at the stored times, shape (n_t, 3) [kg m/s]."""
    model, scene = result.formulation.model, result.scene
    return np.sum([_of(h, rod, model) for h, rod in zip(result.rods, scene.rods, strict=True)], axis=0)


def _of(h: RodHistory, rod: Rod, model: str) -> Array:
    n = len(h.s)
    weights = np.full(n, 1.0 / (n - 1))
    weights[[0, -1]] *= 0.5
    if model == "continuum":
        weights = np.zeros(n)
        for first in range(0, n - 1, 3):
            weights[first : first + 4] += 3.0 * LOBATTO / (n - 1)
    assert h.v is not None
    assert rod.section.rhoA is not None
    return np.asarray(rod.section.rhoA * rod.length * np.einsum("s,tsi->ti", weights, h.v))


def stays(result: Result, first: int, second: int, along: Array) -> bool:
    """Whether, wherever two rods cross as seen along a direction, the first has stayed behind the second."""
    across = np.eye(3) - np.outer(along, along)
    for a, b in zip(*(_finely(result.rods[k]) for k in (first, second)), strict=True):
        seen = np.linalg.norm((a[:, None] - b) @ across, axis=-1)
        i, j = np.unravel_index(seen.argmin(), seen.shape)
        if seen[i, j] < 0.5 * RADIUS and (b[j] - a[i]) @ along < 0.0:
            return False
    return True


def _finely(h: RodHistory, n: int = 300) -> Array:
    at = np.linspace(0.0, h.s[-1], n)
    return np.stack([[np.interp(at, h.s, r[:, i]) for i in range(3)] for r in h.r]).transpose(0, 2, 1)


def kept(pairs: Sequence[tuple[int, int]], along: Array) -> Exact:
    """No rod passes through another, momentum stays, and no energy is made."""

    def off(result: Result) -> float:
        if not all(stays(result, a, b, along) for a, b in pairs):
            return np.inf
        p = momentum(result)
        sizes = [abs(rod.section.rhoA or 0.0) * rod.length for rod in result.scene.rods]
        size = max(np.linalg.norm(p[0]), SPEED * min(sizes))
        *_, made = audit(result.energy)
        return max(float(np.abs(p - p[0]).max() / size), made)

    return Exact("none passes another; momentum, no energy made", off)


def motion(step: float, steps: int) -> Dynamic:
    """All of its steps are kept."""
    return Dynamic(step * steps, step, output=tuple(step * k for k in range(steps + 1)))


def shot(diameters: float, seed: int, mu: float | None = None) -> HardContact:
    """A fibre shot at another from a random side, askew, off both middles."""
    random = np.random.default_rng(seed)
    frame, _ = np.linalg.qr(random.normal(size=(3, 3)))
    angle, aside = random.uniform(0.3, 0.5 * np.pi), random.uniform(0.2, 0.8, size=2)
    first, along = frame[0], frame[2]
    second = np.cos(angle) * first + np.sin(angle) * frame[1]
    slide = 0.3 * SPEED * (frame[0] * random.normal() + frame[1] * random.normal())
    begin = -3.0 * THICK * along - aside[0] * LENGTH * first
    rods = [
        Rod.straight(LENGTH, FIBRE, start=tuple(begin), direction=tuple(first)),
        Rod.straight(LENGTH, FIBRE, start=tuple(-aside[1] * LENGTH * second), direction=tuple(second)),
    ]

    def scene() -> Scene:
        contacts = [RodContact(HARD, None if mu is None else Coulomb(mu))]
        velocities = [Velocity(tuple(SPEED * along + slide), rod=0)]
        steps = motion(diameters * THICK / SPEED, 8)
        return Scene(rods, contacts=contacts, velocities=velocities, motion=steps)

    title = f"Shot over {diameters:g} diameters a step at {np.degrees(angle):.0f}°, μ = {mu or 0.0:g}"
    answer = kept([(0, 1)], along)
    return HardContact(f"shot-{diameters:g}-{seed}", SHOTS, title, scene, answer, limit=LOSS, **MESH)


def placed(
    name: str,
    group: str,
    title: str,
    rods: Sequence[Rod],
    velocities: Sequence[Velocity],
    *,
    pairs: Sequence[tuple[int, int]],
    mu: float | None = None,
) -> HardContact:
    """Shots along z at a diameter a step."""

    def scene() -> Scene:
        touching = [RodContact(HARD, None if mu is None else Coulomb(mu))]
        return Scene(rods, contacts=touching, velocities=velocities, motion=motion(THICK / SPEED, 10))

    return HardContact(name, group, title, scene, kept(pairs, np.array([0.0, 0.0, 1.0])), limit=LOSS, **MESH)


def bar(direction: tuple[float, float, float], z: float, y: float = 0.0, section: Section = FIBRE) -> Rod:
    """Its place 0.45 of its length from its start on the z axis."""
    along = np.asarray(direction) / np.linalg.norm(direction)
    start = np.array([0.0, y, z]) - 0.45 * LENGTH * along
    return Rod.straight(LENGTH, section, start=tuple(start), direction=tuple(along))


def grazing() -> HardContact:
    """Side by side past one another, but for a twentieth of a diameter."""
    rods = [bar((1.0, 0.0, 0.0), -2.0 * THICK, 0.95 * THICK), bar((1.0, 0.0, 0.0), 0.0)]
    velocities = [Velocity((0.0, 0.0, SPEED), rod=0)]
    return placed("grazing", SHOTS, "Grazes one side by side with it", rods, velocities, pairs=())


def over_an_end() -> HardContact:
    """Hits only the last tenth of a diameter of another."""
    rods = [bar((1.0, 0.0, 0.0), -2.0 * THICK), Rod.straight(LENGTH, FIBRE, (0.0, -0.4 * THICK, 0.0), (0.0, 1.0, 0.0))]
    velocities = [Velocity((0.0, 0.0, SPEED), rod=0)]
    return placed("over-an-end", "rods: an end", "Hits the very end of another", rods, velocities, pairs=())


def end_on() -> HardContact:
    """Like an arrow, into the side of another."""
    upright = Rod.straight(LENGTH, FIBRE, (0.0, 0.0, -LENGTH - 2.0 * THICK), (0.0, 0.0, 1.0))
    rods, velocities = [upright, bar((1.0, 0.0, 0.0), 0.0)], [Velocity((0.0, 0.0, 0.2 * SPEED), rod=0)]
    return placed("end-on", "rods: an end", "Like an arrow into the side of another", rods, velocities, pairs=())


def both_sides() -> HardContact:
    """One hit from both sides at one spot at one time."""
    rods = [bar((1.0, 0.5, 0.0), -2.0 * THICK), bar((1.0, 0.0, 0.0), 0.0), bar((1.0, -0.5, 0.0), 2.0 * THICK)]
    velocities = [Velocity((0.0, 0.0, SPEED), rod=0), Velocity((0.0, 0.0, -SPEED), rod=2)]
    title = "Hit from both sides at one spot"
    return placed("both-sides", "rods: three at one spot", title, rods, velocities, pairs=((0, 1), (1, 2), (0, 2)))


def unlike(factors: tuple[float, float]) -> HardContact:
    """Radii 1:10."""
    sections = tuple(map(thick, factors))
    reach = RADIUS * sum(factors)
    rods = [bar((1.0, 0.0, 0.0), -reach - THICK, 0.0, sections[0]), bar((0.2, 1.0, 0.0), 0.0, 0.0, sections[1])]
    velocities = [Velocity((0.0, 0.0, SPEED), rod=0)]
    words = "thin at thick" if factors[0] < factors[1] else "thick at thin"
    title, group = f"Shot {words}, 1:10", "rods: radii and meshes 1:10"
    return placed(words.replace(" ", "-"), group, title, rods, velocities, pairs=((0, 1),))


def oblique(mu: float) -> HardContact:
    """Comes down across another at 45° to it and is braked."""
    rods = [bar((1.0, 0.0, 0.0), -1.2 * THICK), bar((0.0, 1.0, 0.0), 0.0)]
    velocities = [Velocity((0.7 * SPEED, 0.3 * SPEED, 0.7 * SPEED), rod=0)]
    title = f"Comes down aslant, μ = {mu:g}"
    return placed(f"oblique-{mu:g}", "rods: μ = 0 … 5", title, rods, velocities, pairs=((0, 1),), mu=mu)


def onto_the_floor() -> HardContact:
    """One that lies on a floor is hit from above: a wall and a rod at once."""
    rods = [bar((1.0, 0.0, 0.0), -RADIUS), bar((0.2, 1.0, 0.0), -5.0 * RADIUS)]
    velocities = [Velocity((0.0, 0.0, SPEED), rod=1)]

    def scene() -> Scene:
        touching = Contact(Plane((0.0, 0.0, 0.0), (0.0, 0.0, -1.0)), HARD), RodContact(HARD)
        return Scene(rods, contacts=touching, velocities=velocities, motion=motion(THICK / SPEED, 10))

    def off(result: Result) -> float:
        if not stays(result, 1, 0, np.array([0.0, 0.0, 1.0])):
            return np.inf
        highest = max(float(h.r[..., 2].max()) for h in result.rods)
        return max(highest / RADIUS, audit(result.energy)[2])

    words = Exact("none passes the other nor the floor; no energy made", off)
    group, title = "rods: a wall and a rod", "Hit where it lies on a floor"
    return HardContact("onto-the-floor", group, title, scene, words, limit=LOSS, **MESH)


def thrown(part: float) -> HardContact:
    """Side by side, 5 µm within one another: they throw each other off with δ √(2 ε_N/ρA) between them.

    Args:
        part: Of the time √(ρA/2 ε_N) in a step.
    """
    assert FIBRE.rhoA is not None
    time, δ = sqrt(FIBRE.rhoA / (2.0 * TIGHT.eps_N)), 5e-6
    fast = δ / time
    t_end = max(np.pi * time, 4.0 * part * time)
    rods = [Rod.straight(LENGTH, FIBRE, start=(0.0, 0.0, z)) for z in (0.0, THICK + TIGHT.g_0 - δ)]

    def scene() -> Scene:
        return Scene(rods, contacts=[RodContact(TIGHT)], motion=Dynamic(t_end, part * time))

    def off(result: Result) -> float:
        speeds = [float(np.asarray(h.v)[-1, :, 2].mean()) for h in result.rods]
        parting, together = (speeds[1] - speeds[0]) / fast, abs(speeds[1] + speeds[0]) / fast
        return max(abs(parting - 1.0) if part < 1.0 else max(0.0, parting - 1.0), together)

    title = f"Start 5 µm within one another, Δt = {part:g} √(ρA/2ε_N)"
    words = Exact("v = δ √(2ε_N/ρA)" if part < 1.0 else "v ≤ δ √(2ε_N/ρA)", off)
    return HardContact(f"apart-{part:g}", "rods: start in one another", title, scene, words, limit=COARSE, **MESH)


CASES = (
    *(shot(k, seed) for k, seed in ((1.2, 1), (1.2, 2), (3.0, 3), (3.0, 4), (8.0, 5), (8.0, 6))),
    shot(3.0, 7, 0.64),
    grazing(),
    end_on(),
    over_an_end(),
    both_sides(),
    *map(unlike, ((1.0, 10.0), (10.0, 1.0))),
    *map(oblique, (0.0, 0.3, 1.0, 5.0)),
    onto_the_floor(),
    *(thrown(part) for part in (100.0, 0.01)),
)
