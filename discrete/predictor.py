"""First guess of the next state: the last two carried on, section by section along each rod.

What goes on evenly is the shape: turn of each section against the one before, place of the chord in it, F_n. Positions
and frames follow from these by walking along the rod; they themselves may have turned too far for a straight line.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from discrete.rotation import exp, log
from discrete.state import State

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.equilibrium import Equilibrium

    Array = NDArray[np.float64]

__all__ = ["Memory", "shape_change"]


@dataclass(frozen=True, eq=False)
class Guess:
    """An extrapolated state.

    Args:
        equilibrium: Solver of the scene.
        last: The state it was extrapolated from.
        state: The guess.
    """

    equilibrium: Equilibrium
    last: State
    state: State

    @property
    def turned(self) -> float:
        """Turn by which its sections differ from the last state, summed up along the rods at most [rad].

        A guess is worth no more than that: where the first iteration asks for a larger turn it is dropped.
        """
        change = shape_change(self.last, self.state, self.equilibrium.mesh.elements.node_i)
        return float(np.sqrt(np.einsum("ni,ni->n", change, change)).sum())


@dataclass
class Memory:
    """Accepted states since the last kink of a history.

    Args:
        equilibrium: Solver of the scene.
        t: Pseudo-time of the last one.
        state: The last one.
    """

    equilibrium: Equilibrium
    t: float
    state: State
    _t_before: float | None = None
    _before: State | None = None

    def add(self, t: float, state: State) -> None:
        """Accept a state."""
        self._t_before, self._before = self.t, self.state
        self.t, self.state = t, state

    def forget(self) -> None:
        """Extrapolate nothing over what comes now: a kink."""
        self._before = None

    @property
    def extrapolates(self) -> bool:
        """Whether there are two states to go by."""
        return self._before is not None

    def ahead(self, t: float) -> Guess | None:
        """The guess for a pseudo-time; None where there is nothing to go by."""
        if self._before is None or self._t_before is None:
            return None
        a = (t - self.t) / (self.t - self._t_before)
        return Guess(self.equilibrium, self.state, self._carried(self._before, a))

    def _carried(self, before: State, a: float) -> State:
        """The state that is farther on by a times the last step."""
        mesh, last = self.equilibrium.mesh, self.state
        first, node_i = mesh.first[:-1], mesh.elements.node_i
        turn, start = _carried_turns(_between(before.R, node_i), _between(last.R, node_i), a), last.R[first]
        begin = exp(a * log(start @ np.swapaxes(before.R[first], 1, 2))) @ start
        R = np.empty_like(last.R)
        for rod, (frame, node) in enumerate(zip(begin, first, strict=True)):
            R[node] = frame
            for k in range(node, mesh.first[rod + 1] - 1):
                R[k + 1] = R[k] @ turn[k - rod]
        factors = last.factors + a * (last.factors - before.factors)
        for section in self.equilibrium.supports.turns:
            R[section.node] = section.frame(factors)
        was, now = (_chords(state, node_i) for state in (before, last))
        e = np.matmul(R[node_i], (now + a * (now - was))[:, :, None])[:, :, 0]
        x = last.x + a * (last.x - before.x)
        for rod, node in enumerate(first):
            x[node + 1 : mesh.first[rod + 1]] = x[node] + np.cumsum(e[mesh.elements.rod == rod], axis=0)
        # A chord that has shrunk to nothing has no direction; no iteration gets anywhere from there.
        u = e / np.maximum(np.sqrt(np.einsum("ni,ni->n", e, e)), np.finfo(float).tiny)[:, None]
        return State(x, R, u, last.F_n + a * (last.F_n - before.F_n), factors)


def _chords(state: State, node_i: NDArray[np.int64]) -> Array:
    """Chords seen from the sections at which they begin, shape (n, 3)."""
    e = state.x[node_i + 1] - state.x[node_i]
    return np.matmul(e[:, None], state.R[node_i])[:, 0]


def shape_change(one: State, other: State, node_i: NDArray[np.int64]) -> Array:
    """Change of the turns between neighbouring sections, seen from the first of them, shape (n, 3)."""
    return log(_between(other.R, node_i) @ np.swapaxes(_between(one.R, node_i), 1, 2))


def _between(R: Array, node_i: NDArray[np.int64]) -> Array:
    """Turns from each section to the next, shape (n, 3, 3)."""
    return np.swapaxes(R[node_i], 1, 2) @ R[node_i + 1]


def _carried_turns(before: Array, last: Array, a: float) -> Array:
    """Turns that are farther on by a times the last change.

    They are multiplied along the rod: what they lack of a rotation would grow from node to node and step to step.
    """
    return exp(a * log(last @ np.swapaxes(before, 1, 2))) @ exp(log(last))
