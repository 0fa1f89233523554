"""Supports as prescribed degrees of freedom: which are held, and at what value at a given time."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.continuum.placement import ALIGNED, AXES, exact_zeros
from dolfinrod.scene import Prescribed
from dolfinrod.scene.history import factor

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from dolfinrod.continuum.kinematics import Kinematics
    from dolfinrod.continuum.placement import Placement
    from dolfinrod.scene import Scene
    from dolfinrod.scene.supports import Support

    Locate = Callable[[int, float], dict[str, NDArray[np.int32]] | None]

__all__ = ["Constraints"]


class Constraints:
    """The held dofs of a scene on this rank.

    A spatial rotation is measured from the stress-free frame, so holding rotation about one axis in space means
    that one imaginary component of p stays zero; a full clamp holds p and with it the multiplier of its norm.

    Args:
        scene: Supports and histories.
        kinematics: Dimension.
        placement: Working units.
        locate: Dofs of the node at (rod, s) on this rank, or None.

    Attributes:
        dofs: Held dofs.
        places: Rod and dofs of every supported node on this rank.
    """

    def __init__(self, scene: Scene, kinematics: Kinematics, placement: Placement, locate: Locate) -> None:
        self._kin, self._place = kinematics, placement
        self._t_end = scene.motion.t_end
        places: dict[tuple[int, float], list[Support]] = {}
        for support in scene.supports:
            for rod, s in scene.location(support.at, support.rod):
                places.setdefault((rod, s), []).append(support)
        here = [
            (rod, node, scene.rods[rod].centerline(np.array([s]))[0], supports)
            for (rod, s), supports in places.items()
            if (node := locate(rod, s)) is not None
        ]
        self.places = [(rod, node) for rod, node, _, _ in here]
        self._nodes = [(node, x_0, supports) for _, node, x_0, supports in here]
        self._turning = [
            (s.history, float(np.linalg.norm(np.asarray(s.rotation))))
            for s in scene.supports
            if isinstance(s, Prescribed) and s.rotation is not None
        ]
        self._moving = any(isinstance(s, Prescribed) for s in scene.supports)
        at_rest = self._parts(0.0)
        self.dofs = np.concatenate([np.zeros(0, np.int32), *(d for d, _ in at_rest)]).astype(np.int32)
        self._at_rest = _joined(at_rest)

    def values(self, t: float) -> NDArray[np.float64]:
        """Values of `dofs` at time t."""
        return _joined(self._parts(t)) if self._moving else self._at_rest

    def largest_turn(self, t_0: float, t_1: float) -> float:
        """Largest change of a prescribed rotation between two times [rad]."""
        turns = [
            abs(factor(history, t_1, self._t_end) - factor(history, t_0, self._t_end)) * angle
            for history, angle in self._turning
        ]
        return max(turns, default=0.0)

    def _parts(self, t: float) -> list[tuple[NDArray[np.int32], NDArray[np.float64]]]:
        parts = []
        for node, x_0, supports in self._nodes:
            parts.append(self._translation(node["r"], x_0, supports, t))
            parts += self._rotation(node, supports, t)
        return parts

    def _translation(
        self, dofs: NDArray[np.int32], x_0: NDArray[np.float64], supports: list[Support], t: float
    ) -> tuple[NDArray[np.int32], NDArray[np.float64]]:
        held = sorted({a for s in supports for a in s.held() if a in AXES})
        if not held:
            return dofs[:0], np.zeros(0)
        rows = self._place.axes[[AXES[a] for a in held]]
        displacement = np.zeros(3)
        for s in supports:
            if isinstance(s, Prescribed) and s.displacement is not None:
                given = np.array([0.0 if u is None else u for u in s.displacement])
                displacement += factor(s.history, t, self._t_end) * given
        u = exact_zeros(np.linalg.lstsq(rows, displacement[[AXES[a] for a in held]], rcond=None)[0])
        components = np.flatnonzero(np.abs(rows).max(axis=0) > ALIGNED)
        x = self._place.points(x_0) + u / self._place.length
        return dofs[components], x[components]

    def _rotation(
        self, node: dict[str, NDArray[np.int32]], supports: list[Support], t: float
    ) -> list[tuple[NDArray[np.int32], NDArray[np.float64]]]:
        held = sorted({AXES[a[1]] for s in supports for a in s.held() if a.startswith("r")})
        spin = self._place.spin_axes
        if not held or np.abs(spin[held]).max() <= ALIGNED:
            return []
        turns = [
            factor(s.history, t, self._t_end) * exact_zeros(np.asarray(s.rotation) @ spin)
            for s in supports
            if isinstance(s, Prescribed) and s.rotation is not None
        ]
        q = self._kin.compose(turns)
        if len(q) == 1 or len(held) == 3:
            parts = [(node["q"], q)]
            return parts + ([(node["multiplier"], np.zeros(1))] if "multiplier" in node else [])
        return [(node["q"][[1 + a for a in held]], np.zeros(len(held)))]


def _joined(parts: list[tuple[NDArray[np.int32], NDArray[np.float64]]]) -> NDArray[np.float64]:
    """The values of all parts."""
    return np.concatenate([np.zeros(0), *(values for _, values in parts)])
