"""Supports of a scene at the nodes: which unknowns are held, and where to."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from discrete.rotation import exp, log, tangents
from discrete.unknowns import N_NODE
from dolfinrod.scene import Prescribed, factor
from dolfinrod.scene.history import slope

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.mesh import Mesh
    from dolfinrod.scene import Scene

    Array = NDArray[np.float64]
    Indices = NDArray[np.int64]

__all__ = ["Guides", "Supports", "Turn"]

_PLACES = {"x": 0, "y": 1, "z": 2, "rx": 3, "ry": 4, "rz": 5}


@dataclass(frozen=True, eq=False)
class Turn:
    """Section turned by prescribed rotations, R = exp(f_m θ_m) … exp(f_1 θ_1) R_0.

    The factors f are a state of the solution, so that a turn is taken in several bites and beyond 2π.

    Args:
        node: Its node.
        which: Numbers of the prescribed rotations, in the order listed.
        theta: Their rotation vectors in global axes, shape (m, 3) [rad].
        R_0: Stress-free section frame, shape (3, 3).
    """

    node: int
    which: Indices
    theta: Array
    R_0: Array

    def frame(self, factors: Array) -> Array:
        """Section frame at given factors of all prescribed rotations."""
        R = self.R_0
        for f, θ in zip(factors[self.which], self.theta, strict=True):
            R = exp(f * θ) @ R
        return R

    def spin(self, factors: Array, change: Array) -> Array:
        """Spin ω of the section as the factors change, Σ exp(f_m θ_m) … exp(f_{k+1} θ_{k+1}) θ_k δf_k, shape (3,)."""
        spin = np.zeros(3)
        for k, θ in zip(self.which, self.theta, strict=True):
            spin = exp(factors[k] * θ) @ spin + change[k] * θ
        return spin


@dataclass(frozen=True, eq=False)
class Guides:
    """Sections that keep one component of their rotation vector at zero: θ_a = e_a·log(R R_0ᵀ) = 0.

    Args:
        nodes: Their nodes, shape (m,).
        axis: The component a, shape (m,).
        R_0: Stress-free section frames, shape (m, 3, 3).
    """

    nodes: Indices
    axis: Indices
    R_0: Array

    def linearized(self, R: Array) -> tuple[Array, Array, Array]:
        """Held component, its gradient c = Θ(θ)ᵀ e_a with respect to the spin, and ∂c/∂ω.

        Args:
            R: Section frames at all nodes, shape (n_nodes, 3, 3).

        Returns:
            Shapes (m,), (m, 3) and (m, 3, 3).
        """
        θ = log(R[self.nodes] @ np.swapaxes(self.R_0, 1, 2))
        e_a = np.eye(3)[self.axis]
        Θ, N = tangents(θ, e_a)
        rows = np.arange(len(θ))
        return θ[rows, self.axis], Θ[rows, self.axis], N @ Θ


class Supports:
    """Supports of a scene.

    Args:
        scene: The problem.
        mesh: Its nodes.

    Attributes:
        held: Held unknowns, ascending; a guide's is the first spin in its own axes.
        firm: Components that are held in global axes, shape (n_nodes, 6).
        firm_rows: Where these stand among all components of one kind, then all of the next.
        askew: Nodes with some but not all of three displacements or spins held, which cannot be told in turned axes.
        turns: Prescribed rotations.
        guides: Sections with one held and two free rotations.
    """

    def __init__(self, scene: Scene, mesh: Mesh) -> None:
        self._scene, self._mesh = scene, mesh
        self._places = np.zeros((len(mesh.x), 6), dtype=bool)
        for support in scene.supports:
            for rod, s in scene.location(support.at, support.rod):
                self._places[mesh.node(rod, s), [_PLACES[name] for name in support.held()]] = True
        rotations = self._places[:, 3:]
        one = np.flatnonzero(rotations.sum(axis=1) == 1)
        self.guides = Guides(one, np.argmax(rotations[one], axis=1), mesh.R[one])
        held = self._places.copy()
        held[one, 3:] = (True, False, False)
        node, place = np.nonzero(held)
        self.held = node * N_NODE + place
        self.firm = self._places.copy()
        self.firm[one, 3:] = False
        threes = self._places.reshape(-1, 2, 3)
        self.askew = np.flatnonzero((threes.any(axis=2) & ~threes.all(axis=2)).any(axis=1))
        self.firm_rows = np.flatnonzero(self.firm.T)
        self._moved = [part for part in scene.supports if isinstance(part, Prescribed)]
        self.turns = self._turns()

    def resisted(self, R: Array) -> tuple[Indices, Array]:
        """Velocities (v, ω) that supports resist.

        Args:
            R: Section frames, shape (n_nodes, 3, 3).

        Returns:
            Nodes, shape (m,), and the directions held there, shape (m, 6).
        """
        node, place = np.nonzero(self.firm)
        turned = np.zeros((len(self.guides.nodes), 6))
        turned[:, 3:] = self.guides.linearized(R)[1]
        return np.concatenate([node, self.guides.nodes]), np.concatenate([np.eye(6)[place], turned])

    @property
    def n_factors(self) -> int:
        """Number of prescribed motions."""
        return len(self._moved)

    def factors(self, t: float) -> Array:
        """Factors of all prescribed motions at a pseudo-time, shape (n_factors,)."""
        return np.array([factor(part.history, t, self._scene.motion.t_end) for part in self._moved])

    def slopes(self, t: float) -> Array:
        """Rates of all factors from a time on, shape (n_factors,)."""
        return np.array([slope(part.history, t, self._scene.motion.t_end) for part in self._moved])

    def increments(self, x: Array, factors: Array, goal: Array) -> Array:
        """What is missing at the supports: displacements and spins.

        Args:
            x: Positions, shape (n_nodes, 3).
            factors: Factors that the sections have been turned by, shape (n_factors,).
            goal: Factors to be reached, shape (n_factors,).

        Returns:
            Increments where held, zero elsewhere, shape (n_nodes, 7).
        """
        missing = np.zeros((len(x), N_NODE))
        missing[:, :3] = np.where(self._places[:, :3], self._mesh.x - x, 0.0)
        for part, f in zip(self._moved, goal, strict=True):
            if part.displacement is not None:
                u = np.array([0.0 if c is None else c for c in part.displacement]) / self._mesh.units.length
                missing[self._nodes(part), :3] += f * u
        for turn in self.turns:
            missing[turn.node, 3:6] = turn.spin(factors, goal - factors)
        return missing

    def _nodes(self, part: Prescribed) -> list[int]:
        return [self._mesh.node(rod, s) for rod, s in self._scene.location(part.at, part.rod)]

    def _turns(self) -> tuple[Turn, ...]:
        """One record for each node whose rotation is prescribed."""
        at: dict[int, list[int]] = {}
        for k, part in enumerate(self._moved):
            if part.rotation is not None:
                for node in self._nodes(part):
                    at.setdefault(node, []).append(k)
        return tuple(
            Turn(node, np.array(which), np.array([self._moved[k].rotation for k in which]), self._mesh.R[node])
            for node, which in at.items()
        )
