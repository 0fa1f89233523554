"""By how much a law of motion does not hold: free rods, falling ones, damped ones."""

from __future__ import annotations

import numpy as np

import dolfinrod as dr
from tests.mutations.measures import Solve
from tests.scenes import SKEW, Array, largest

# A rigid top spread along a rod: every section turns like every other one, so that nothing bends.
J = (1.0, 2.0, 3.0)
TOP = dr.Section(EA=1e4, GA=1e4, GJ=1e4, EI=1e4, rhoA=1e-2, rhoI=J)
# Three different inertias and stiffnesses, thick enough for its turning to count.
THICK = dr.Section(EA=1200.0, GA=(400.0, 300.0), GJ=0.8, EI=(1.0, 2.0), rhoA=1.0, rhoI=(3e-2, 1e-2, 2e-2))
DAMPED = dr.Section(EA=900.0, GA=400.0, GJ=0.8, EI=1.0, rhoA=1.0, damping=0.5)
EULER, MIDPOINT = dr.ImplicitEuler(), dr.Midpoint()
# K7 of shared/reference/cases.json: J = (1, 2, 3), Ω in the body at t = 0 and t = 1; Euler's equations by DOP853.
SPUN, SPUN_AT_1 = np.array([0.1, 1.0, 0.1]), np.array([0.011223551541003313, 1.0049248886811426, 0.0819063858096416])


def _free(section: dr.Section, motion: dr.Dynamic, loads: tuple[dr.Load, ...] = (), Ω: Array | None = None) -> dr.Scene:
    """A rod that nothing holds, its middle at rest, turning with Ω in section axes."""
    rod = SKEW.straight(section, start=(-0.5, 0, 0))
    ω = np.zeros(3) if Ω is None else rod.frames(np.zeros(1))[0] @ Ω
    turning = dr.Velocity(omega=tuple(ω), about=SKEW.placed((0, 0, 0)))
    return dr.Scene([rod], [], loads, motion=motion, velocities=[turning])


def _in_body(h: dr.RodHistory) -> Array:
    """Angular velocities in section axes, shape (n_t, n_s, 3)."""
    return np.einsum("tsji,tsj->tsi", h.frames, h.omega)


def top(scheme: dr.ImplicitEuler | dr.Midpoint, solve: Solve) -> float:
    """Case K7, the error of first order in Δt taken out."""
    coarse, fine = (
        _in_body(solve(_free(TOP, dr.Dynamic(1.0, dt, scheme=scheme, output=1.0), Ω=SPUN), elements=2).rods[0])[-1]
        for dt in (0.1, 0.05)
    )
    return largest(2.0 * fine - coarse - SPUN_AT_1)


def spun_up(solve: Solve) -> float:
    """Mean spin by a couple at both ends, R J Rᵀ ω = M t while nothing has turned far; over its size."""
    M, t = np.array([1.0, -2.0, 3.0]) * 1e-4, 1.0
    ends = tuple(dr.PointMoment(tuple(0.5 * M), at) for at in ("start", "end"))
    scene = _free(TOP, dr.Dynamic(t, 0.1, output=t), ends)
    R = scene.rods[0].frames(np.zeros(1))[0]
    ω = R @ (R.T @ M / J) * t
    mean = solve(scene, elements=1).rods[0].omega[-1][[0, -1]].mean(axis=0)
    return largest(mean - ω) / largest(ω)


def energy_gained(solve: Solve) -> float:
    """By a free top that turns by a third of a turn in ten steps, over what it has."""
    kinetic = solve(_free(TOP, dr.Dynamic(1.0, 0.1), Ω=np.array([1.0, -1.5, 1.0])), elements=2).energy["kinetic"]
    return float(np.diff(kinetic).max() / kinetic[0])


def moment_of_momentum(solve: Solve) -> float:
    """What a free rod that bends and turns changes of it, over its size; Gauss-Lobatto weights of cubic elements."""
    n = 2
    thrown = dr.Velocity(v=lambda r: np.stack([0 * r[:, 0], 2 * r[:, 2] ** 2, r[:, 1] * r[:, 0]], axis=1))
    scene = _free(THICK, dr.Dynamic(0.2, 0.02, scheme=MIDPOINT), Ω=np.array([4.0, 2.0, -3.0]))
    scene = dr.Scene(scene.rods, [], [], motion=scene.motion, velocities=(*scene.velocities, thrown))
    h = solve(scene, elements=n).rods[0]
    weights = np.zeros(len(h.s))
    for e in range(n):
        weights[3 * e : 3 * e + 4] += np.array([1.0, 5.0, 5.0, 1.0]) / 12.0 / n
    turning = np.einsum("tsij,j,tsj->tsi", h.frames, THICK.rhoI, _in_body(h))
    L = np.einsum("s,tsi->ti", weights, np.cross(h.r, h.v) + turning)
    return largest(L - L[0]) / largest(L[0])


def fall(scheme: dr.ImplicitEuler | dr.Midpoint, solve: Solve) -> float:
    """Of every point of a free rod from rest: ½ g t² by the midpoint rule, ½ g t (t + Δt) by backward Euler."""
    g, t, dt = np.array(SKEW.turned((0, -2.0, 0))), 0.5, 0.05
    late = dt if scheme is EULER else 0.0
    scene = _free(THICK, dr.Dynamic(t, dt, scheme=scheme, output=t), (dr.Gravity(tuple(g)),))
    h = solve(scene, elements=4).rods[0]
    return largest(h.r[-1] - h.r[0] - 0.5 * g * t * (t + late)) / (0.5 * 2.0 * t * t)


def terminal_speed(solve: Solve) -> float:
    """0.08695 m/s across a level ramie fibre, process.md 2.4, after 23 times the time in which the rest of it fades."""
    fibre = dr.Rod.straight(0.04, dr.Section.ramie(), start=(0, 0, 0), direction=(1, 0, 0))
    motion = dr.Dynamic(0.2, 0.01, output=0.2)
    v = solve(dr.Scene([fibre], [], [dr.Gravity((0, 0, -9.81))], air=dr.Air(), motion=motion), elements=2).rods[0].v
    return largest(v[-1] - [0, 0, -0.08695]) / 0.08695


def settled(solve: Solve) -> float:
    """u = F L/EA of a damped bar under a steady pull, after a time in which every vibration has died out."""
    F = 9.0
    rod = SKEW.straight(DAMPED)
    pull = dr.PointForce(SKEW.turned((F, 0, 0)), "end")
    scene = dr.Scene([rod], [dr.Clamp("start")], [pull], motion=dr.Dynamic(100.0, 5.0, output=100.0))
    tip = SKEW.back(solve(scene, elements=2).tip)
    return abs(float(tip[0]) - 1.0 - F / 900.0) / (F / 900.0)
