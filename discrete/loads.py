"""Loads of a scene at the nodes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from discrete.rotation import skew
from discrete.unknowns import N_NODE, SPIN, X
from dolfinrod.scene import FollowerForce, FollowerMoment, Gravity, LineForce, PointForce, PointMoment, factor

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from discrete.mesh import Mesh
    from dolfinrod.scene import Load, Scene
    from dolfinrod.scene.loads import PointLoad

    Array = NDArray[np.float64]
    Indices = NDArray[np.int64]

__all__ = ["LoadLevel", "Loads"]


@dataclass(frozen=True, eq=False)
class LoadLevel:
    """All loads at one pseudo-time.

    Args:
        dead: Forces and moments in global axes, the place of F_n empty, shape (n_nodes, 7).
        line: Force on each element, half of it at either end, shape (n, 3).
        followed: Nodes with a load fixed to the section, shape (m,).
        follower: Its force and moment in section axes, shape (m, 2, 3).
    """

    dead: Array
    line: Array
    followed: Indices
    follower: Array

    def at(self, R: Array) -> Array:
        """Loads in global axes for given section frames.

        Args:
            R: Section frames, shape (n_nodes, 3, 3).

        Returns:
            Forces and moments, shape (n_nodes, 7).
        """
        total = self.dead.copy()
        if len(self.followed):
            turned = self._turned(R)
            total[self.followed, X] += turned[:, 0]
            total[self.followed, SPIN] += turned[:, 1]
        return total

    def stiffness(self, R: Array) -> Array:
        """What follower loads add to the tangent of their node, −∂(R f)/∂ω = [R f]×, shape (m, 6, 6)."""
        blocks = np.zeros((len(self.followed), 6, 6))
        blocks[:, :, 3:] = skew(self._turned(R)).reshape(-1, 6, 3)
        return blocks

    def _turned(self, R: Array) -> Array:
        return np.matmul(self.follower, np.swapaxes(R[self.followed], 1, 2))


@dataclass
class Loads:
    """Loads of a scene, ready to be evaluated at any pseudo-time.

    Args:
        scene: The problem.
        mesh: Its nodes and elements.
    """

    scene: Scene
    mesh: Mesh
    followed: Indices = field(init=False)
    _acts: list[Callable[[LoadLevel, float], None]] = field(init=False, default_factory=list)
    _last: tuple[list[float], LoadLevel] | None = field(init=False, default=None)

    def __post_init__(self) -> None:
        follow = [part for part in self.scene.loads if isinstance(part, (FollowerForce, FollowerMoment))]
        self.followed = np.unique([node for load in follow for node in self._nodes(load)]).astype(np.int64)
        for load in self.scene.loads:
            self._add(load)

    def level(self, t: float) -> LoadLevel:
        """Loads at a pseudo-time, in the units of the model; the same record as long as no factor changes."""
        t_end = self.scene.motion.t_end
        factors = [factor(load.history, t, t_end) for load in self.scene.loads]
        if self._last is None or self._last[0] != factors:
            self._last = factors, self._level(factors)
        return self._last[1]

    def _level(self, factors: Sequence[float]) -> LoadLevel:
        """Loads of given factors."""
        level = LoadLevel(
            dead=np.zeros((len(self.mesh.x), N_NODE)),
            line=np.zeros((len(self.mesh.elements.l), 3)),
            followed=self.followed,
            follower=np.zeros((len(self.followed), 2, 3)),
        )
        for f, act in zip(factors, self._acts, strict=True):
            act(level, f)
        node_i = self.mesh.elements.node_i
        level.dead[node_i, X] += 0.5 * level.line
        level.dead[node_i + 1, X] += 0.5 * level.line
        return level

    def _nodes(self, load: PointLoad) -> Indices:
        return np.array([self.mesh.node(rod, s) for rod, s in self.scene.location(load.at, load.rod)], dtype=np.int64)

    def _add(self, load: Load) -> None:
        """Remember how a load acts: it adds its factor times its full value."""
        units = self.mesh.units
        match load:
            case PointForce():
                self._act("dead", self._nodes(load), X, np.array(load.force) / units.force)
            case PointMoment():
                self._act("dead", self._nodes(load), SPIN, np.array(load.moment) / units.moment)
            case FollowerForce():
                rows = np.searchsorted(self.followed, self._nodes(load))
                self._act("follower", rows, 0, np.array(load.force) / units.force)
            case FollowerMoment():
                rows = np.searchsorted(self.followed, self._nodes(load))
                self._act("follower", rows, 1, np.array(load.moment) / units.moment)
            case LineForce() | Gravity():
                self._act("line", np.arange(len(self.mesh.elements.l)), slice(None), self._per_element(load))

    def _act(self, name: str, rows: Indices, columns: slice | int, value: Array) -> None:
        def act(level: LoadLevel, f: float) -> None:
            getattr(level, name)[rows, columns] += f * value

        self._acts.append(act)

    def _per_element(self, load: LineForce | Gravity) -> Array:
        """Force on each element, shape (n, 3)."""
        elements, units = self.mesh.elements, self.mesh.units
        if isinstance(load, Gravity):
            ρA = np.array([rod.section.rhoA for rod in self.scene.rods], dtype=float)[elements.rod]
            return (ρA * elements.l * units.length / units.force)[:, None] * np.array(load.g)
        middle = np.concatenate([0.5 * (s[1:] + s[:-1]) for s in self.mesh.s])
        length = np.array([rod.length for rod in self.scene.rods])[elements.rod]
        a, b = load.between or (0.0, np.inf)
        # Nodes lie at a and b, so that an element is either loaded or not.
        loaded = (middle > a) & (middle < np.minimum(b, length))
        if load.rod is not None:
            loaded &= elements.rod == load.rod
        return (loaded * elements.l * units.length / units.force)[:, None] * np.array(load.force)
