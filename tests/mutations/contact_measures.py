"""By how much a law of contact does not hold."""

from __future__ import annotations

import numpy as np
import pytest

import dolfinrod as dr
from dolfinrod.scene import Touch
from tests.mutations import contact_scenes as on
from tests.mutations.contact_scenes import EPS, EPS_T, G_0, MU, RADIUS, Q
from tests.mutations.measures import Solve
from tests.scenes import FLAT, SKEW, Array, largest


def _touching(result: dr.Result) -> dr.Touching:
    (touching,) = result.contacts[0].rods
    assert touching is not None
    return touching


def _soles(h: dr.RodHistory) -> Array:
    """Places along x of the points of a rod's surface that face the floor, shape (n_t, n_s)."""
    return np.asarray(h.r[:, :, 0] - RADIUS * h.frames[:, :, 0, 1])


def rests(friction: dr.Coulomb | None, solve: Solve) -> float:
    """p = q at every node, the surface of the rod g_0 − q/ε above the wall; by their sizes."""
    held = {} if friction is None else {"supports": [dr.Guide("start", free={"y", "rz"})]}
    result = solve(on.lying(FLAT, on.floor(FLAT, friction=friction), **held), elements=2)
    c, h = _touching(result), result.rods[0]
    height = h.r[-1, :, 1] - RADIUS - (G_0 - Q / EPS)
    return max(largest(c.pressure[-1] - Q) / Q, largest(height) / (Q / EPS))


def sticks(motion: dr.Static | dr.Dynamic, solve: Solve) -> float:
    """Way of the surface of a rod that friction holds, u = t/ε_T, and its slip, by their size; the force that holds."""
    result = solve(on.pushed(motion), elements=2)
    c, soles, u = _touching(result), _soles(result.rods[0]), 0.9 * MU * Q / EPS_T
    way = soles[-1] - soles[0] + c.traction[-1, :, 0] / EPS_T
    held = float(result.contacts[0].force[-1, 0]) / (0.9 * MU * Q) + 1.0
    return max(largest(way) / u, float(c.slip[-1].max()) / u, abs(held))


def drawn_along(solve: Solve) -> float:
    """Resultant of friction on a rod held still, forth and back, by μ q L."""
    result = solve(on.drawn(), elements=2)
    force = result.contacts[0].force[[int(np.argmin(np.abs(result.t - t))) for t in (1.0, 2.0)], 0]
    return largest(force - [MU * Q, -MU * Q]) / (MU * Q)


def moments(solve: Solve) -> float:
    """Of all that acts on a rod dragged along, about its start, which is free to turn; by r μ q L."""
    result = solve(on.drawn(), elements=2)
    c, h = _touching(result), result.rods[0]
    r, n = h.r[-1] - h.r[-1, 0], c.normal[-1]
    surface = np.cross(r - RADIUS * n, c.pressure[-1, :, None] * n + c.traction[-1])
    total = c.share @ (surface + np.cross(r, (0.0, -Q, 0.0)))
    return abs(float(total[2])) / (RADIUS * MU * Q)


def carried_along(solve: Solve) -> float:
    """Distance of a rod carried by a turning wall from where that has taken it, by that from its anchors."""
    result = solve(on.carried(), elements=2)
    h, (a, b) = result.rods[0], (int(np.argmin(np.abs(result.t - t))) for t in (1.0, 3.0))
    c, s = np.cos(2 * on.TURN), np.sin(2 * on.TURN)
    turned = SKEW.back(h.r[a]) @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
    return largest(SKEW.back(h.r[b]) - turned) / (largest(_touching(result).traction[a]) / EPS_T)


def lifted_off(solve: Solve) -> float:
    """Distance from where it would be without the wall.

    With friction: without it a set of nodes that is wrong is put right with every linear step.
    """
    rough = on.floor(FLAT, dr.Penalty(1e4), dr.Coulomb(0.3))
    there, never = (solve(on.lifted(*c), elements=2) for c in ([rough], []))
    return largest(there.tip - never.tip)


def iterations(solve: Solve) -> float:
    """Of a small step on a drum."""
    result = solve(on.bent(1e3), elements=8)
    return float(sum(row.iterations for row in result.log if row.t > 1.0))


def presses(solve: Solve) -> float:
    """Pressures of a hard drum, to which softer ones have led, less ε (g_0 − g), by their largest."""
    c = _touching(solve(on.bent(1e8), elements=48))
    p = c.pressure[1:]
    return largest(p - np.maximum(-1e8 * c.gap[1:], 0.0)) / largest(p)


def tangent(_solve: Solve) -> float:
    """Slopes of what acts on points that stick and slide on a turning drum, from their differences, by their size.

    No scene: both models ask for the slopes at a point.
    """
    random, n, h = np.random.default_rng(1), 40, 1e-7
    wall = dr.WallMotion(rotation=(0, 0, 1e-3))
    contact = dr.Contact(dr.Cylinder((0, 0, 0), (0, 0, 1), on.DRUM, motion=wall), on.PENALTY, on.ROUGH)
    touch = Touch(contact, np.full(n, RADIUS), dr.Static())
    φ = 2.0 * np.pi * random.random(n)
    out = np.stack([np.cos(φ), np.sin(φ), np.zeros(n)], axis=1)
    x, way, spin = (on.DRUM + RADIUS) * out, *random.standard_normal((2, n, 3))
    touch.place(x, 0.0)
    touch.begin(1.0)
    x = x + 2e-4 * random.standard_normal((n, 3))

    def acting(a: float) -> Array:
        reply = touch.respond(x + a * way, 1e-2 * spin + a * spin)
        return np.concatenate([reply.force, reply.moment / RADIUS], axis=1)

    acting(0.0)
    change = touch.gradient()
    slope = ((acting(h) - acting(-h)) / (2.0 * h))[change.points]
    v, ω = way[change.points, :, None], spin[change.points, :, None]
    force, moment = (change.f_x @ v + change.f_turn @ ω), (change.m_x @ v + change.m_turn @ ω) / RADIUS
    return largest(np.concatenate([force, moment], axis=1)[:, :, 0] - slope) / largest(slope)


def lands(solve: Solve) -> float:
    """t = ε_T times the part of its way along the wall on which it touched, for every node."""
    result = solve(on.landing(), elements=2)
    c, soles = _touching(result), _soles(result.rods[0])
    part = -c.gap[-1] / (c.gap[0] - c.gap[-1])
    return largest(c.traction[-1, :, 0] / (-on.SOFT * part * (soles[-1] - soles[0])) - 1.0)


def penetrates(solve: Solve) -> float:
    """Depth over the tolerance of an augmented Lagrangian."""
    law = dr.AugmentedLagrangian(20.0, 1e-6)
    result = solve(on.lying(SKEW, on.floor(SKEW, law), height=RADIUS), elements=2)
    return largest(_touching(result).gap[-1]) / law.tolerance


def tries_again(_solve: Solve) -> float:
    """Difference of what acts when a step is tried again after an attempt that came to nothing, by its size.

    No scene: how steps come to fail is a matter of solvers. Shorter attempts begin anew, or from what was remembered.
    """
    part, still = np.linspace(0.5, 1.0, 5), np.zeros((5, 3))
    touch = Touch(on.floor(FLAT, dr.AugmentedLagrangian(EPS, 1e-9), on.ROUGH), np.full(5, RADIUS), dr.Static(t_end=2.0))

    def led(along: float, deep: float) -> Array:
        """What acts where the points have been led, and then becomes their multipliers; deep by less each time."""
        force = touch.respond(np.stack([along * part, RADIUS - deep * part, 0.0 * part], axis=1), still).force
        touch.renew()
        return force

    touch.place(np.stack([0.0 * part, RADIUS + 0.0 * part, 0.0 * part], axis=1), 0.0)
    touch.begin(1.0)
    led(1e-4, 1e-4)
    led(2e-4, 1e-5)
    touch.accept()
    remembered, forces = touch.memory(), []
    for recalled in (False, False, True):
        if recalled:
            touch.recall(remembered, 1.0)
        touch.begin(1.5)
        forces.append(led(2.5e-4, 1.5e-4))
        led(3e-4, 1e-5)
    return max(largest(force - forces[0]) for force in forces[1:]) / largest(forces[0])


def bounces(solve: Solve) -> float:
    """Change of kinetic energy and that of contact in an impact, by what there was."""
    energy = solve(on.dropped(on.MIDPOINT), elements=1).energy
    total = energy["kinetic"] + energy["contact"]
    return largest(total - total[0]) / float(total[0])


def stores(solve: Solve) -> float:
    """Energy of contact, ½ ε δ² per length, by its largest."""
    result = solve(on.dropped(on.EULER), elements=1)
    c = _touching(result)
    stored = 0.5 * EPS * np.maximum(G_0 - c.gap, 0.0) ** 2 @ c.share
    return largest(result.energy["contact"] - stored) / float(stored.max())


def taken_along(solve: Solve) -> float:
    """Velocity of a rod that a belt has taken along, work of the belt and loss: v, ρA v², ½ ρA v² (1 − μ q Δt/ρA v).

    The last is backward Euler's, which sees the slower sliding at the end of each step.
    """
    result = solve(on.on_a_belt(), elements=1)
    v = result.rods[0].v[-1, :, 0]
    off = [largest(v - on.BELT) / on.BELT]
    late = on.BELT_MU * Q * on.STEP / on.BELT
    for name, part in (("wall work", 1.0), ("friction", -0.5 * (1.0 - late))):
        off.append(abs(float(result.energy[name][-1]) / (part * on.BELT**2) - 1.0))
    return max(off)


def goes_on(motion: dr.Static | dr.Dynamic, solve: Solve) -> float:
    """Difference of what a solve that was interrupted half way and gone on with leaves from that of a whole one."""

    def interrupt(row: dr.StepLog, end: float) -> None:
        if row.t >= 0.5 * end:
            raise KeyboardInterrupt

    scene = on.pushed(motion)
    whole = solve(scene, elements=2)
    with pytest.raises(dr.NotConverged) as caught:
        solve(scene, elements=2, progress=interrupt)
    rest = solve(scene, elements=2, start=caught.value.result)
    return largest(rest.rods[0].r[-1] - whole.rods[0].r[-1]) / (0.9 * MU * Q / EPS_T)
