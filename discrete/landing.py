"""Rods that loads push where nothing holds them yet: as rigid bodies, until surfaces do; a first guess, no more."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Protocol

import numpy as np

from discrete.rotation import exp

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.mesh import Mesh
    from discrete.state import State

    Array = NDArray[np.float64]

__all__ = ["Pushed", "landed"]

# Ways in a row after which a rod lies as well as it may: it has six motions.
MOST_WAYS = 6
# Strides towards a surface, and halvings of the last one.
MOST_STRIDES, HALVINGS = 200, 50
# Way, in L and radians, on which no surface has balanced the loads that ever will.
FAR = 1e2


class Pushed(Protocol):
    """What pushes rigid rods."""

    def ways(self, state: State) -> list[Array]:
        """Motions (v, ω) of each rod that nothing resists and that it is pushed along, shape (6,); zero if none."""
        ...

    def works(self, state: State) -> list[Array]:
        """Work of loads and surfaces on each rod in unit motions, shape (6,)."""
        ...

    def clearance(self, state: State, rod: int) -> float:
        """Least distance of a rod from where a surface acts on it; negative where one does, infinite without one."""
        ...


def landed(state: State, mesh: Mesh, pushed: Pushed) -> State:
    """Move rods the way they are pushed, up to where surfaces balance the loads.

    Args:
        state: Where the rods are.
        mesh: Their nodes.
        pushed: What pushes them.

    Returns:
        The state moved; the same one where no surface is met.
    """
    for _ in range(MOST_WAYS):
        before = state
        for rod, way in enumerate(pushed.ways(state)):
            if way.any():
                state = _balanced(state, mesh, pushed, rod, way)
        if state is before:
            break
    return state


def _balanced(state: State, mesh: Mesh, pushed: Pushed, rod: int, way: Array) -> State:
    """One rod moved along one way, to where it is pushed no further."""
    mine = slice(int(mesh.first[rod]), int(mesh.first[rod + 1]))
    speed = float(np.linalg.norm(way[:3] + np.cross(way[3:], state.x[mine]), axis=1).max())
    shortest = float(mesh.elements.l.min())
    reached, stride = 0.0, 0.5e-3 * shortest / speed
    for _ in range(MOST_STRIDES):
        # No surface is nearer than the clearance; in touch with one, strides double.
        clear = pushed.clearance(_moved(state, mesh, rod, way, reached), rod)
        if not np.isfinite(clear) or reached * speed > FAR:
            return state
        stride = max(clear / speed, 2.0 * stride if clear <= 0.0 else stride)
        if not pushed.works(_moved(state, mesh, rod, way, reached + stride))[rod] @ way > 0.0:
            break
        reached += stride
    else:
        return state
    for _ in range(HALVINGS):
        stride *= 0.5
        if pushed.works(_moved(state, mesh, rod, way, reached + stride))[rod] @ way > 0.0:
            reached += stride
    return _moved(state, mesh, rod, way, reached + stride)


def _moved(state: State, mesh: Mesh, rod: int, way: Array, a: float) -> State:
    """A rod moved as a rigid body: turned about the axis of the motion and shifted along it."""
    v, ω = way[:3], way[3:]
    square = float(ω @ ω)
    centre = np.cross(ω, v) / square if square > 0.0 else np.zeros(3)
    along = v if square == 0.0 else (v @ ω / square) * ω
    Q = exp(a * ω[None])[0]
    x, R, u = state.x.copy(), state.R.copy(), state.u.copy()
    mine, elements = slice(int(mesh.first[rod]), int(mesh.first[rod + 1])), mesh.elements.rod == rod
    x[mine] = centre + (x[mine] - centre) @ Q.T + a * along
    R[mine] = Q @ R[mine]
    u[elements] = u[elements] @ Q.T
    return replace(state, x=x, R=R, u=u)
