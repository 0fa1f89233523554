"""Equilibrium of one rod in space as a boundary-value problem, to round-off and without finite elements.

The Simo–Reissner rod, r′ = R (e1 + C_n Rᵀ n), R′ = R skew(κ₀ + C_m Rᵀ m), n′ + f = 0, m′ + r′ × n = 0, is collocated
between its supports and loads (`collocation`); a strain whose compliance is zero is rigid. The load grows from the
stress-free shape, so that the equilibrium found is the one connected to it.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from verification.references.collocation import SIZE, Gauss, Panels, State, corrected, product, rotated, slope
from verification.references.posed import AXES, Held, PointLoad, Problem

__all__ = ["Joint", "Solution", "solve"]

Array = NDArray[np.float64]

# Panels a rod, at least, and Gauss points a panel.
PANELS, POINTS = 6, 12
MAX_ITERATIONS = 15
# Newton converges quadratically: after so small a change only round-off is left. Below the full load less will do.
CONVERGED, ON_THE_WAY = 1e-8, 1e-3
SMALLEST_STEP = 1e-4
NOWHERE = Held(0.0, along=())


@dataclass(frozen=True, eq=False)
class Joint:
    """Loads and supports at a place, in units of L, EI/L² and EI/L.

    Args:
        place: 0 at the start of the rod, 1 at its end, between otherwise.
        loads: That act there.
        held: What holds it.
        r_0: Its stress-free position.
        p_0: Quaternion of the stress-free section.
    """

    place: float
    loads: tuple[PointLoad, ...]
    held: Held
    r_0: Array
    p_0: Array

    @property
    def n_reactions(self) -> int:
        """One for each component held."""
        return len(self.held.along) + len(self.held.about)

    def residual(self, joined: Array, load: float) -> Array:
        """Balance n⁺ − n⁻ + F = 0 and m⁺ − m⁻ + M = 0, continuity of r and p, and what is held."""
        before, after, reactions = np.split(joined, [SIZE, 2 * SIZE], axis=-1)
        here = before if self.place == 1.0 else after
        force, moment = self.acting(here[..., 3:7], reactions, load)
        balance = after[..., 7:] - before[..., 7:] + np.concatenate([force, moment], axis=-1)
        return np.concatenate([balance, self._joining(before, after), self._offence(here, load)], axis=-1)

    def acting(self, p: Array, reactions: Array, load: float) -> tuple[Array, Array]:
        """Force and moment on the rod in space, reactions included, shape (..., 3) each."""
        force, moment = self.holding(reactions)
        for one in self.loads:
            force = force + load * (np.array(one.force) + rotated(p, np.array(one.follower_force)))
            moment = moment + load * (np.array(one.moment) + rotated(p, np.array(one.follower_moment)))
        return force, moment

    def holding(self, reactions: Array) -> tuple[Array, Array]:
        """Force and moment of the support on the rod in space, shape (..., 3) each."""
        n = len(self.held.along)
        return reactions[..., :n] @ _rows(self.held.along), reactions[..., n:] @ _rows(self.held.about)

    def _joining(self, before: Array, after: Array) -> Array:
        """Continuity; at the start |p| = 1, from where it never changes."""
        if self.place == 0.0:
            return np.asarray((after[..., 3:7] ** 2).sum(axis=-1, keepdims=True) - 1.0)
        return after[..., :0] if self.place == 1.0 else after[..., :7] - before[..., :7]

    def _offence(self, here: Array, load: float) -> Array:
        """Displacement along and rotation about what is held."""
        u = (here[..., :3] - self.r_0 - load * np.array(self.held.moved)) @ _rows(self.held.along).T
        about, back = _rows(self.held.about), self.p_0 * (1.0, -1.0, -1.0, -1.0)
        if len(about) == 2:
            turned = rotated(here[..., 3:7], rotated(back, np.cross(*about)))
        else:
            turned = product(here[..., 3:7], back)[..., 1:]
        return np.concatenate([u, turned @ about.T], axis=-1)


@dataclass(frozen=True, eq=False)
class Solution:
    """An equilibrium.

    Args:
        problem: Whose.
        gauss: Points of the panels.
        panels: In units of L, EI/L² and EI/L.
        joints: Between them and at both ends, in the same units.
        state: In the same units.
    """

    problem: Problem
    gauss: Gauss
    panels: Panels
    joints: tuple[Joint, ...]
    state: State

    def centreline(self, s: Array) -> Array:
        """Points of the rod.

        Args:
            s: Arc lengths, shape (n,) [m].

        Returns:
            r, shape (n, 3) [m].
        """
        return self.at(s)[:, :3]

    def at(self, s: Array) -> Array:
        """r, p, n and m in space; before the jump where there is one, at the start behind it.

        Args:
            s: Arc lengths, shape (n,) [m].

        Returns:
            States, shape (n, 13) [m, –, N, N m].
        """
        p, L = self.panels, self.problem.length
        x = np.asarray(s, dtype=float) / L
        k = np.clip(np.searchsorted(p.start, x) - 1, 0, None)
        weights = self.gauss.integral_to((x - p.start[k]) / p.length[k])
        slopes = slope(self.state.stages, p.kappa, p.force, p)[k]
        y = self.state.first[k] + p.length[k, None] * np.einsum("nq,nqa->na", weights, slopes)
        EI = self.problem.stiffness
        return np.asarray(y * np.repeat([L, 1.0, EI / L**2, EI / L], (3, 4, 3, 3)))

    def reaction(self, s: float) -> tuple[Array, Array]:
        """Force and moment in space by which the support at s holds the rod, shape (3,) each [N, N m]."""
        L, EI = self.problem.length, self.problem.stiffness
        counts = np.cumsum([0, *(joint.n_reactions for joint in self.joints)])
        j = [joint.place for joint in self.joints].index(s / L)
        force, moment = self.joints[j].holding(self.state.reactions[counts[j] : counts[j + 1]])
        return force * EI / L**2, moment * EI / L


def solve(problem: Problem, *, panels: int = PANELS, points: int = POINTS) -> Solution:
    """The equilibrium under the full load, reached from the stress-free shape.

    Args:
        problem: The rod.
        panels: How many, at least.
        points: Gauss points a panel.

    Returns:
        The solution.

    Raises:
        ArithmeticError: Newton's method fails however small the step of the load.
    """
    gauss, posed = Gauss(points), problem.in_units()
    stretches = _panels(posed, gauss, panels)
    joints, state = _stress_free(posed, stretches, gauss)
    load, step = 0.0, 1.0 / problem.steps
    while load < 1.0:
        target = min(load + step, 1.0)
        found = _equilibrium(state, stretches, joints, gauss, target)
        if found is not None:
            load, state, step = target, found, min(2.0 * step, 1.0 / problem.steps)
            continue
        step *= 0.5
        if step < SMALLEST_STEP:
            raise ArithmeticError(f"no equilibrium found beyond load factor {load:g}")
    return Solution(problem, gauss, stretches, joints, state)


def _panels(posed: Problem, gauss: Gauss, n: int) -> Panels:
    """At least n panels, a joint under every place."""
    gaps = list(pairwise(posed.places))
    cuts = [np.linspace(a, b, 1 + max(1, int(np.ceil(n * (b - a) - 1e-9))))[:-1] for a, b in gaps]
    ends = np.append(np.concatenate(cuts), 1.0)
    start, length = ends[:-1], np.diff(ends)
    s: Array = start[:, None] + length[:, None] * gauss.points
    force = np.zeros((len(start), 1, 3))
    for line in posed.lines:
        force[:, 0] += np.outer(np.logical_and(line.a <= start, start < line.b), line.force)
    kappa = posed.curvature(s.ravel()).reshape(*s.shape, 3)
    return Panels(start, length, kappa, force, np.array(posed.compliance_n), np.array(posed.compliance_m))


def _stress_free(posed: Problem, panels: Panels, gauss: Gauss) -> tuple[tuple[Joint, ...], State]:
    """Joints, and the state without load, which a rod clamped at its start finds from wherever Newton begins."""
    n = len(panels.start)
    x, y, z, w = Rotation.from_matrix(np.stack([posed.d1, posed.d2, np.cross(posed.d1, posed.d2)], axis=1)).as_quat()
    p_0 = np.array([w, x, y, z])
    first = np.tile(np.concatenate([np.zeros(3), p_0, np.zeros(6)]), (n, 1))
    guess = State(first, np.repeat(first[:, None], len(gauss.points), axis=1), np.zeros(6))
    clamped = Held(0.0, about=AXES)
    places = [*panels.start.tolist(), 1.0]
    free = tuple(Joint(s, (), NOWHERE if s else clamped, np.zeros(3), p_0) for s in places)
    state = _equilibrium(guess, panels, free, gauss, 0.0)
    if state is None:
        raise ArithmeticError("the stress-free shape is not resolved: more panels are needed")
    rod = Solution(posed, gauss, panels, free, state).at(np.array(places))
    held = {h.s: h for h in posed.supports}
    joints = tuple(
        Joint(s, tuple(one for one in posed.loads if one.s == s), held.get(s, NOWHERE), y[:3], y[3:7])
        for s, y in zip(places, rod, strict=True)
    )
    return joints, State(state.first, state.stages, np.zeros(sum(joint.n_reactions for joint in joints)))


def _equilibrium(state: State, panels: Panels, joints: tuple[Joint, ...], gauss: Gauss, load: float) -> State | None:
    """Newton's method; None where it does not converge."""
    for _ in range(MAX_ITERATIONS):
        state, change = corrected(state, panels, joints, gauss, load)
        if not change < 1e6:
            return None
        if change < (ON_THE_WAY if 0.0 < load < 1.0 else CONVERGED):
            return state
    return None


def _rows(vectors: tuple[tuple[float, float, float], ...]) -> Array:
    """Vectors as rows, shape (n, 3), n = 0 included."""
    return np.array(vectors, dtype=float).reshape(-1, 3)
