"""Where a path leads from an equilibrium: rates of state and tangent as the loads go on in straight lines."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from discrete.rotation import exp
from discrete.state import State
from discrete.statics import corners
from discrete.unknowns import AXIAL, N_NODE, SPIN, X
from dolfinrod.scene import factor

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.equilibrium import Equilibrium
    from discrete.loads import LoadLevel
    from discrete.nodes import Tangent
    from dolfinrod.scene import Scene

    Array = NDArray[np.float64]

__all__ = ["moved", "rate_of_state", "rate_of_tangent", "varies"]

# Part of the whole pseudo-time over which histories are differenced; exact for straight lines.
AHEAD = 1e-4
# Rate of a factor, over all the pseudo-time, that is round-off of the difference.
UNCHANGED = 1e-9
# Turn of a section or chord in a difference step [rad], and part of itself by which a chord grows: its fourth power,
# the error, is below round-off over the step.
TURN = 1e-3
# Weights of f(jh)/h in f′(0).
DIFFERENCE = ((1, 8 / 12), (-1, -8 / 12), (2, -1 / 12), (-2, 1 / 12))


def varies(scene: Scene, t: float) -> bool:
    """Whether any load or prescribed motion changes from a pseudo-time on."""
    weights = _difference(scene, t)
    parts = [part for part in (*scene.supports, *scene.loads) if hasattr(part, "history")]
    if any(contact.surface.motion is not None for contact in scene.walls):
        return True
    rates = [sum(w * factor(part.history, t + a, scene.motion.t_end) for a, w in weights) for part in parts]
    return any(abs(rate) > UNCHANGED / scene.motion.t_end for rate in rates)


def rate_of_state(equilibrium: Equilibrium, scene: Scene, state: State, t: float, tangent: Tangent) -> Array:
    """How all unknowns change with the pseudo-time, x′ = K⁻¹ ∂Q/∂t and the motion of the supports.

    Args:
        equilibrium: Solver of the scene.
        scene: The problem.
        state: An equilibrium.
        t: Its pseudo-time.
        tangent: There.

    Returns:
        Rates, spins in the axes of the tangent, shape (n_nodes · 7,).

    Raises:
        SingularTangentError: The load is critical.
    """
    loads, supports = equilibrium.loads, equilibrium.supports
    weights = _difference(scene, t)
    pushed = np.sum([w * loads.level(t + a).at(state.R) for a, w in weights], axis=0)
    if equilibrium.contacts is not None:
        pushed += np.sum([w * equilibrium.contacts.at(state.x, state.R, t + a) for a, w in weights], axis=0)
    change = np.sum([w * supports.factors(t + a) for a, w in weights], axis=0)
    moved, still = (supports.increments(state.x, state.factors, state.factors + c) for c in (change, 0.0 * change))
    held = tangent.system.held
    right = tangent.in_axes(pushed).reshape(-1)
    right[held] = tangent.in_axes(moved - still).reshape(-1)[held]
    return tangent.inverse().times(right[:, None])[:, 0]


def rate_of_tangent(
    equilibrium: Equilibrium, scene: Scene, state: State, t: float, tangent: Tangent, rate: Array
) -> Array:
    """How the tangents of the elements change along the path, by differences of fourth order.

    Args:
        equilibrium: Solver of the scene.
        scene: The problem.
        state: An equilibrium.
        t: Its pseudo-time.
        tangent: There.
        rate: `rate_of_state` there.

    Returns:
        dK/dt, shape (n, 13, 13).
    """
    d = tangent.in_space(rate.reshape(-1, N_NODE))
    level = equilibrium.loads.level(t)
    ahead = [(w, equilibrium.loads.level(t + a)) for a, w in _difference(scene, t)]
    dead = np.sum([w * part.dead for w, part in ahead], axis=0)
    follower = np.sum([w * part.follower for w, part in ahead], axis=0)
    node_i = equilibrium.mesh.elements.node_i
    e = state.x[node_i + 1] - state.x[node_i]
    chords = (d[node_i + 1, X] - d[node_i, X]) / np.sqrt(np.einsum("ni,ni->n", e, e))[:, None]
    turn = np.sqrt(max(float(np.square(part).sum(axis=1).max()) for part in (d[:, SPIN], chords)))
    size = max(1.0, float(np.abs(state.F_n).max()))
    h = 1.0 / max(turn / TURN, float(np.abs(d[:, AXIAL]).max()) / size, 1.0 / scene.motion.t_end)

    def at(a: float) -> Array:
        grown: LoadLevel = replace(level, dead=level.dead + a * dead, follower=level.follower + a * follower)
        return equilibrium.tangent(moved(state, node_i, d, a), grown, t + a).elements

    return np.asarray(sum(w * at(j * h) for j, w in DIFFERENCE) / h)


def moved(state: State, node_i: NDArray[np.int64], rate: Array, a: float) -> State:
    """State after so much pseudo-time at constant rates.

    Args:
        state: The state.
        node_i: First nodes of the elements, shape (n,).
        rate: Rates, spins in space, shape (n_nodes, 7).
        a: Pseudo-time.

    Returns:
        State whose chords join its nodes.
    """
    x = state.x + a * rate[:, X]
    e = x[node_i + 1] - x[node_i]
    return replace(
        state,
        x=x,
        R=exp(a * rate[:, SPIN]) @ state.R,
        u=e / np.sqrt(np.einsum("ni,ni->n", e, e))[:, None],
        F_n=state.F_n + a * rate[node_i, AXIAL],
    )


def _difference(scene: Scene, t: float) -> tuple[tuple[float, float], ...]:
    """Times from t on, as (ahead, weight), whose weighted values sum up to a rate: one-sided, of second order.

    Behind the last row of a table nothing changes any more: at the end of the path the rate is that of the arrival.
    """
    t_end = scene.motion.t_end
    towards = 1.0 if t < t_end else -1.0
    ahead = [k - t for k in corners(scene)]
    h = towards * min([AHEAD * t_end, *(0.5 * abs(c) for c in ahead if c * towards > 0.0)])
    return (0.0, -1.5 / h), (h, 2.0 / h), (2.0 * h, -0.5 / h)
