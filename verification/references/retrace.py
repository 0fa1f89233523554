"""A collocated equilibrium walked through once more: steps of DOP853, section frames instead of quaternions.

Nothing of `collocation` but its solution enters. The rod is integrated from each support or load to the next, from the
state the solution has there: it must arrive with the state of the next, and at its end with no force or moment left
over. Starting anew at every place keeps the walk from magnifying round-off, as it does where rods are long or pressed.
"""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

if TYPE_CHECKING:
    from verification.references.bvp import Solution
    from verification.references.posed import Problem

__all__ = ["retraced"]

Array = NDArray[np.float64]


def retraced(solution: Solution) -> float:
    """How far the walk ends up from the solution.

    Args:
        solution: An equilibrium.

    Returns:
        The largest difference of position [L], section axes, force [EI/L²] and moment [EI/L] on arrival.
    """
    problem = solution.problem
    units = _units(problem)
    before = [_framed(y) for y in solution.at(problem.places)]
    # At its start, where nothing is before, the solution gives the state behind the jump.
    after = [before[0], *(y - _jump(solution, s, y) for s, y in zip(problem.places[1:], before[1:], strict=True))]
    off = [np.abs(after[-1] / units)[12:].max()]
    for i, (a, b) in enumerate(pairwise(problem.places)):
        f = sum((np.array(line.force) for line in problem.lines if line.a <= a < line.b), start=np.zeros(3))
        walk = solve_ivp(_slope, (a, b), after[i], method="DOP853", rtol=1e-13, atol=1e-15 * units, args=(problem, f))
        off.append(np.abs((walk.y[:, -1] - before[i + 1]) / units).max())
    return float(max(off))


def _framed(y: Array) -> Array:
    """State r, p, n, m with the section frame R for its quaternion p, shape (18,)."""
    w, *u = y[3:7]
    return np.concatenate([y[:3], Rotation.from_quat([*u, w]).as_matrix().ravel(), y[7:]])


def _slope(s: float, state: Array, problem: Problem, f: Array) -> Array:
    """r′, R′, n′ and m′, shape (18,)."""
    R, n, m = state[3:12].reshape(3, 3), state[12:15], state[15:]
    r_s = R @ (np.array([1.0, 0.0, 0.0]) + problem.compliance_n * (R.T @ n))
    κ = problem.curvature(np.array([s]))[0] + problem.compliance_m * (R.T @ m)
    return np.concatenate([r_s, np.cross(R, κ).ravel(), -f, -np.cross(r_s, n)])


def _jump(solution: Solution, s: float, state: Array) -> Array:
    """Force and moment on the rod at a place, in the last six of 18: loads there and the reaction of a support."""
    R = state[3:12].reshape(3, 3)
    total = np.zeros(18)
    for one in solution.problem.loads:
        if one.s == s:
            total[12:15] += np.array(one.force) + R @ np.array(one.follower_force)
            total[15:] += np.array(one.moment) + R @ np.array(one.follower_moment)
    if any(held.s == s for held in solution.problem.supports):
        total[12:] += np.concatenate(solution.reaction(s))
    return total


def _units(problem: Problem) -> Array:
    """L, 1, EI/L² and EI/L."""
    L, EI = problem.length, problem.stiffness
    return np.repeat([L, 1.0, EI / L**2, EI / L], (3, 9, 3, 3))
