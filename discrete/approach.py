"""A better first guess of a long step: the iteration of `equilibrium`, with the forces of inertia and air.

Where inertia is small against stiffness a step is as hard to find as an equilibrium under a large load increment, and
for the same reason. Every element keeps its own direction and axial force here too, until the chords all but join the
nodes; the iteration of the step goes on from there.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from discrete.assembly import gather
from discrete.rotation import exp
from discrete.step import StepLostError
from discrete.turning import LARGEST_TURN, chord_spin
from discrete.unknowns import SPIN, SPIN_I, SPIN_J, X_I, X_J, X
from discrete.watch import ALIASED, WANDERING, Watch

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from discrete.constitution import Element
    from discrete.mesh import Mesh
    from discrete.step import Step

    Array = NDArray[np.float64]
    Solve = Callable[[Step, Array, Array], Array]

__all__ = ["approach"]

# Increment, in L and radians, from which the iteration of the step finds its way.
NEAR = 1e-3
MOST_ITERATIONS = 60


def approach(step: Step, mesh: Mesh, law: Element, solve: Solve) -> int:
    """Move a step to where its own iteration converges, if it can.

    Args:
        step: Its first guess; moves.
        mesh: Nodes and elements.
        law: Of the elements in this step.
        solve: Increments by rows for given end forces and their derivative.

    Returns:
        Linear systems solved.

    Raises:
        StepLostError: The sections turned back and forth, or too far to tell which way.
    """
    node_i = mesh.elements.node_i
    x, R = _configuration(step)
    e = x[node_i + 1] - x[node_i]
    u = e / np.sqrt(np.einsum("ni,ni->n", e, e))[:, None]
    change, spent, watch = np.inf, 0, Watch(mesh.elements, R)
    while change >= NEAR and spent < MOST_ITERATIONS:
        d, N, spin = _asked_for(step, x, R, u, mesh, law, solve)
        turn = max(_largest(d[:, SPIN]), _largest(spin))
        bite = min(1.0, LARGEST_TURN / turn) if turn > 0.0 else 1.0
        d[:, SPIN] *= bite
        step.move(d.T)
        x, R = _configuration(step)
        u = np.matmul(exp(bite * spin), u[:, :, None])[:, :, 0]
        step.F_n = law.axial(N, u, mesh.elements.triads(R))
        change, spent = max(turn, float(np.abs(d[:, X]).max())), spent + 1
        watch.see(d[:, SPIN], R)
    if watch.aliased or watch.wandering or watch.strayed:
        raise StepLostError(ALIASED if watch.aliased else WANDERING)
    return spent


def _asked_for(
    step: Step, x: Array, R: Array, u: Array, mesh: Mesh, law: Element, solve: Solve
) -> tuple[Array, Array, Array]:
    """Increments of the nodes, new force vectors and spins of the chords of one iteration, as in `equilibrium`."""
    node_i = mesh.elements.node_i
    E = mesh.elements.triads(R)
    e = law.chord(u, E, step.F_n)
    gap = x[node_i + 1] - x[node_i] - e
    force, tangent = law.respond(e, E, step.F_n)
    end = tangent[:, X_J].copy()
    force += np.matmul(tangent[:, :, X_J], gap[:, :, None])[:, :, 0]
    d = solve(step, force, tangent).T
    own = gather(d, node_i)
    N = force[:, X_J] + np.matmul(end, own[:, :, None])[:, :, 0]
    return d, N, chord_spin(u, own[:, X_J] - own[:, X_I] + gap, 0.5 * (own[:, SPIN_I] + own[:, SPIN_J]), e)


def _configuration(step: Step) -> tuple[Array, Array]:
    """Positions and section frames, shapes (n_nodes, 3) and (n_nodes, 3, 3)."""
    x, R = step.configuration()
    return x.T, R.transpose(2, 0, 1)


def _largest(vectors: Array) -> float:
    """Largest length."""
    return float(np.sqrt(np.einsum("ni,ni->n", vectors, vectors).max()))
