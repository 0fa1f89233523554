"""By how much a law does not hold: scenes solved by a given solver, their answers against what must come out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

import discrete
import dolfinrod as dr
from discrete import frames
from discrete.frames import direction_cosines
from tests.mutations.scenes import (
    BOTH_PLANES,
    GENERAL,
    PULLED_FORCE,
    PULLED_TENSION,
    Pose,
    clamped,
    composed,
    heavy,
    loaded_in_every_way,
    moved_and_loaded,
    pulled_aside,
    turned_about,
)
from tests.scenes import FLAT, KIRCHHOFF, SKEW, Array, differences, largest, tip_loaded
from verification.case import SKEW as CASE_POSE
from verification.case import Case
from verification.cases import elastica

Solve = Callable[..., dr.Result]

SOLVERS: dict[str, Solve] = {
    "planar": partial(dr.solve, elements=4, degree=3, kinematics=dr.Planar()),
    "spatial": partial(dr.solve, elements=4, degree=3, kinematics=dr.Spatial()),
    "planar P2": partial(dr.solve, elements=8, degree=2, kinematics=dr.Planar()),
    "spatial P2": partial(dr.solve, elements=8, degree=2, kinematics=dr.Spatial()),
    "discrete": partial(discrete.solve, elements=20),
    "discrete node_i": partial(discrete.solve, elements=20, frame="node_i"),
    "discrete letter": partial(discrete.solve, elements=20, frame="node_i", axial="paper"),
    "discrete increments": partial(discrete.solve, elements=20, equilibrium=False),
}


def stretch(solve: Solve) -> float:
    F, EA = 18.0, 900.0
    scene = clamped(SKEW.straight(GENERAL), dr.PointForce(SKEW.turned((F, 0, 0)), "end"))
    return abs(float(SKEW.back(solve(scene).tip)[0]) - 1.0 - F / EA) / (F / EA)


def small_deflection(solve: Solve) -> float:
    """Of both planes; the discrete model knows no shear."""
    F, off = 1e-5, []
    for axis, EI, GA in BOTH_PLANES:
        rod = SKEW.straight(replace(GENERAL, GA=(40.0, 30.0)))
        result = solve(clamped(rod, dr.PointForce(SKEW.turned(F * np.eye(3)[axis]), "end")))
        shear = F / GA if result.formulation.model == "continuum" else 0.0
        exact = F / (3 * EI) + shear
        off.append(float(np.linalg.norm(SKEW.back(result.tip) - [1, 0, 0] - exact * np.eye(3)[axis])) / exact)
    return max(off)


def small_line_load(solve: Solve) -> float:
    """w L⁴/8EI from half of the rod: q/(6EI) (b³ − b⁴/4) under q on [0, b]."""
    q, b = 1e-3, 0.5
    load = dr.LineForce(SKEW.turned((0, q, 0)), between=(0.0, b))
    tip = SKEW.back(solve(clamped(SKEW.straight(KIRCHHOFF), load)).tip)
    exact = q / 6 * (b**3 - b**4 / 4)
    return abs(float(tip[1]) - exact) / exact


def small_twist(solve: Solve) -> float:
    T, GJ = 1e-3, 0.7
    scene = clamped(SKEW.straight(GENERAL), dr.PointMoment(SKEW.turned((T, 0, 0)), "end"))
    R = SKEW.Q.T @ solve(scene).rods[0].frames[-1, -1]
    return abs(float(np.arctan2(R[2, 1] - R[1, 2], R[1, 1] + R[2, 2])) - T / GJ) / (T / GJ)


def string(solve: Solve) -> float:
    """w = F/T (L − tanh(kL)/k), k² = T/EI."""
    F, T = PULLED_FORCE, PULLED_TENSION
    k = np.sqrt(T)
    exact = F / T * (1 - np.tanh(k) / k)
    return abs(float(SKEW.back(solve(pulled_aside()).tip)[1]) - exact) / exact


def rest(rod: dr.Rod, solve: Solve) -> float:
    h = solve(clamped(rod)).rods[0]
    gaps = (h.r[-1] - rod.centerline(h.s), h.frames[-1] - rod.frames(h.s), h.n[-1] / 900.0, h.m[-1])
    return max(map(largest, gaps))


def objectivity(scene: Callable[[Pose], dr.Scene], solve: Solve) -> float:
    here, there = (solve(scene(pose)).rods[0] for pose in (FLAT, SKEW))
    gaps = [SKEW.back(there.r[-1]) - here.r[-1], SKEW.Q.T @ there.frames[-1] - here.frames[-1]]
    return max(map(largest, (*gaps, there.n[-1] - here.n[-1], there.m[-1] - here.m[-1])))


def balance(solve: Solve) -> float:
    """Force and moment of the clamp against those of all loads about it, at the deformed shape."""
    result = solve(loaded_in_every_way(SKEW))
    h = result.rods[0]
    r, R, F, M = h.r[-1], h.frames[-1], np.zeros(3), np.zeros(3)
    for load in result.scene.loads:
        ((_, s),) = result.scene.location(load.at, load.rod)
        node = int(np.argmin(np.abs(h.s - s)))
        turn = R[node] if isinstance(load, dr.FollowerForce | dr.FollowerMoment) else np.eye(3)
        if isinstance(load, dr.PointForce | dr.FollowerForce):
            F += turn @ load.force
            M += np.cross(r[node] - r[0], turn @ load.force)
        else:
            M += turn @ load.moment
    return max(largest(R[0] @ h.n[-1, 0] - F), largest(R[0] @ h.m[-1, 0] - M))


def weights(load: str, solve: Solve) -> float:
    """What each of two rods' clamps carries, against its own weight."""
    result = solve(heavy(load))
    off = []
    for rod, h in zip(result.scene.rods, result.rods, strict=True):
        weight = rod.length * (rod.section.rhoA if load == "gravity" else 1.0) * np.array(SKEW.turned((0, -1, 0)))
        off.append(largest(h.frames[-1, 0] @ h.n[-1, 0] - weight) / float(np.linalg.norm(weight)))
    return max(off)


def in_space(h: dr.RodHistory, name: str) -> Array:
    return np.einsum("sij,sj->si", h.frames[-1], getattr(h, name)[-1])


def force_along(solve: Solve) -> float:
    F = np.array(SKEW.turned((1.0, 5.0, 0.0)))
    h = solve(clamped(SKEW.straight(GENERAL), dr.PointForce(F, "end"))).rods[0]
    return largest(in_space(h, "n") - F)


def moment_along(solve: Solve) -> float:
    """m(s) = (r(L) − r(s)) × F."""
    F = np.array(SKEW.turned((1.0, 5.0, 0.0)))
    h = solve(clamped(SKEW.straight(GENERAL), dr.PointForce(F, "end"))).rods[0]
    return largest(in_space(h, "m") - np.cross(h.r[-1, -1] - h.r[-1], F))


def orthonormal(solve: Solve) -> float:
    """After a turn so small that Newton's method forgives everything."""
    F = SKEW.turned((0, 0.05, 0.05))
    R = solve(clamped(SKEW.straight(GENERAL), dr.PointForce(F, "end"))).rods[0].frames[-1]
    return largest(np.swapaxes(R, 1, 2) @ R - np.eye(3))


def half_way(solve: Solve) -> float:
    """The state at half of the pseudo-time is the answer to half of everything."""
    whole, half = (solve(moved_and_loaded(f, steps=2 if f == 1.0 else 1)) for f in (1.0, 0.5))
    return largest(whole.rods[0].r[1] - half.rods[0].r[-1])


def same_in_steps(solve: Solve) -> float:
    one, many = (solve(loaded_in_every_way(SKEW, dr.Static(steps=k))) for k in (1, 8))
    return max(differences(many, one).values())


def same_in_space(solve: Solve) -> float:
    """Moments among it: they tell on which side of the plane its normal stands."""
    load = dr.PointMoment(SKEW.turned((0, 0, 2.0)), "end"), dr.PointForce(SKEW.turned((1, 3, 0)), "end")
    scene = clamped(SKEW.arc(GENERAL, angle=1.0), *load)
    return max(differences(solve(scene), SOLVERS["spatial"](scene)).values())


def composition(solve: Solve) -> float:
    """Prescribed rotations, and so the frame of the section, follow each other in the order listed."""
    a, b = np.array([1.5, 0, 0]), np.array([0, 0, 0.8])
    R = solve(composed(a, b)).rods[0].frames[-1, 0]
    return largest(R - turned_about(b) @ turned_about(a))


def work(solve: Solve) -> float:
    """U = ½ F·u where everything is linear."""
    F = np.array(SKEW.turned((0, 1e-3, 0)))
    result = solve(clamped(SKEW.straight(GENERAL), dr.PointForce(F, "end")))
    done = 0.5 * float(F @ (result.tip - result.rods[0].r[0, -1]))
    return abs(float(result.energy["strain"][-1]) - done) / done


def mirror(solve: Solve) -> float:
    """Of an arc pushed to either side of its plane."""
    tips = [
        SKEW.back(solve(clamped(SKEW.arc(GENERAL), dr.PointForce(SKEW.turned((0, 0, side)), "end"))).tip)
        for side in (3.0, -3.0)
    ]
    return largest(tips[0] - tips[1] * [1, 1, -1])


def iterations(scene: dr.Scene, solve: Solve) -> float:
    return float(solve(scene).statistics.newton_iterations)


def error(case: Case, solve: Solve) -> float:
    return case.error(solve(case.scene(CASE_POSE)), CASE_POSE)


def lost_accuracy(solve: Solve) -> float:
    """Error of the elastica in space over that in the plane, on the same elements, k = 2."""
    cases = [elastica.inextensible(α) for α in (1.0, 10.0)]
    return max(error(case, solve) / error(case, SOLVERS["planar P2"]) for case in cases)


def inertia(_solve: Solve) -> float:
    """ω·J ω = ω*·J* ω* with ω* = A ω; no scene: the inertia of Eq. 10 waits for dynamics."""
    A, J_star, ω = direction_cosines(SKEW.Q), np.diag([1.0, 2.0, 4.0]), np.array([0.3, -0.5, 0.7])
    return abs(float(ω @ frames.inertia(J_star, A) @ ω - (A @ ω) @ J_star @ (A @ ω)))


def lost_order(solve: Solve) -> float:
    """2k less the observed order of the tip of the elastica, k = 2, from 4 to 16 elements."""
    tips = [solve(tip_loaded(KIRCHHOFF, 5.0), elements=n).tip for n in (4, 8, 16)]
    return 4.0 - float(np.log2(np.linalg.norm(tips[1] - tips[0]) / np.linalg.norm(tips[2] - tips[1])))
