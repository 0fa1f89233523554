"""Where a path has lost its stability: whether the loads push the rod to another branch, and which way that is."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from discrete.ahead import critical_ahead
from discrete.assembly import SingularTangentError
from discrete.onward import moved, rate_of_state
from discrete.predictor import shape_change
from discrete.unknowns import N_NODE, SPIN

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from discrete.equilibrium import Equilibrium
    from discrete.nodes import Tangent
    from discrete.stability import Judge
    from discrete.state import Outcome, State
    from dolfinrod.scene import Scene

    Array = NDArray[np.float64]

__all__ = ["Branches"]

# Part of the length of the rod, a unit of pseudo-time, by which the path leads the way in which a state gives way.
PUSHED = 1e-7
# Turns by which a rod is sent ahead the way the loads push it, one after the other [rad]: just beyond a critical point
# the other branch is near.
SENT = (0.5, 0.05, 5e-3, 5e-4)
# Cosine between the rate and the change of shape below which they point apart, and a change that is round-off.
SAME_WAY, SLIGHT = 0.5, 1e-9


class Branches:
    """Branches of the paths of a scene.

    Args:
        equilibrium: Solver of the scene.
        judge: Tells stable states.
        scene: The problem.
    """

    def __init__(self, equilibrium: Equilibrium, judge: Judge, scene: Scene) -> None:
        self._equilibrium, self._judge, self._scene = equilibrium, judge, scene

    def missed(self, last: State, t_last: float, found: Outcome, t: float) -> bool:
        """Whether there is a branch that the loads push the rod to other than the one on which it was found.

        Args:
            last: The last equilibrium, stable.
            t_last: Its pseudo-time.
            found: One found from there that gives way.
            t: Its pseudo-time.

        Returns:
            False where a symmetry keeps the loads from pushing that way, as on a perfect column.
        """
        try:
            rate = self._rate(found.state, t, found.tangent)
            pushed = self._judge.pushed(found.tangent, found.state.R, rate) > PUSHED
            return pushed or self.strayed(last, t_last, found.state)
        except SingularTangentError:
            return True

    def sent_ahead(self, last: State, t_last: float) -> Iterator[State]:
        """A stable state moved on the way that it takes, so far as to be on no other branch, and less far.

        Args:
            last: The state.
            t_last: Its pseudo-time.

        Yields:
            First guesses for an equilibrium beyond the critical point.
        """
        rate = self._onward(last, t_last)
        turn = float(np.sqrt(np.square(rate[:, SPIN]).sum(axis=1).max()))
        for sent in SENT:
            yield moved(last, self._equilibrium.mesh.elements.node_i, rate, sent / max(turn, sent))

    def next_critical(self, last: State, t_last: float) -> float:
        """Pseudo-time at which the loads are critical next, seen from an equilibrium; infinite where they never are."""
        if self._scene.meetings:
            # How rods answer to one another changes along the path in ways that nothing here knows.
            return np.inf
        try:
            tangent = self._tangent(last, t_last)
            μ = critical_ahead(self._equilibrium, self._scene, last, t_last, tangent, 1).way
        except SingularTangentError:
            return t_last
        return t_last + float(min(μ.real, default=np.inf))

    def strayed(self, last: State, t_last: float, found: State) -> bool:
        """Whether a rod has bent another way than it set out, as to the mirrored branch of an imperfect column.

        Args:
            last: An equilibrium.
            t_last: Its pseudo-time.
            found: One found from there.

        Returns:
            True from some 60° between the change of shape and the rate at which it began.

        Raises:
            SingularTangentError: The loads are critical at the first.
        """
        onward, node_i = self._onward(last, t_last), self._equilibrium.mesh.elements.node_i
        gone = shape_change(last, found, node_i)
        set_out = np.matmul((onward[node_i + 1, SPIN] - onward[node_i, SPIN])[:, None], last.R[node_i])[:, 0]
        along, size = float(np.vdot(gone, set_out)), float(np.linalg.norm(gone) * np.linalg.norm(set_out))
        return along < SAME_WAY * size - SLIGHT

    def _onward(self, state: State, t: float) -> Array:
        """Rates of all unknowns, spins in space, shape (n_nodes, 7)."""
        tangent = self._tangent(state, t)
        return tangent.in_space(self._rate(state, t, tangent).reshape(-1, N_NODE))

    def _rate(self, state: State, t: float, tangent: Tangent) -> Array:
        return rate_of_state(self._equilibrium, self._scene, state, t, tangent)

    def _tangent(self, state: State, t: float) -> Tangent:
        return self._equilibrium.tangent(state, self._equilibrium.loads.level(t), t)
