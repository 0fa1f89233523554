"""Where a scene lies and in which units it is solved: lengths in L, forces in EI/L², moments in EI/L."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import Planar, detect

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.scene import Scene, Spatial

__all__ = ["Placement", "exact_zeros"]

AXES = {"x": 0, "y": 1, "z": 2}
# Components this small against the largest are round-off of the input, and would grow in an unstable direction.
ROUND_OFF = 1e-15
# A direction counts as lying in a plane, or along its normal, up to this sine.
ALIGNED = 1e-9


@dataclass(frozen=True, eq=False)
class Placement:
    """Working coordinates of a scene.

    Args:
        origin: Point of space at the working origin [m].
        axes: Working directions as columns, shape (3, d).
        spin_axes: Directions of the spin components as columns, shape (3, n_spin).
        length: Unit of length L, the longest rod [m].
        stiffness: Unit of bending stiffness EI, the largest in the scene [N m²].
    """

    origin: NDArray[np.float64]
    axes: NDArray[np.float64]
    spin_axes: NDArray[np.float64]
    length: float
    stiffness: float

    @classmethod
    def of(cls, scene: Scene, kinematics: Planar | Spatial) -> Placement:
        """Units and directions for `scene`.

        In a plane the directions follow supports that hold only one of them. In space they are those of the plane in
        which the scene lies, if it does: then nothing leads out of it, not even round-off. Supports that hold some
        directions of space and not others ask for these.
        """
        length = max(rod.length for rod in scene.rods)
        stiffness = max(max(rod.section.EI) for rod in scene.rods)
        origin = scene.rods[0].centerline(np.zeros(1))[0]
        if not isinstance(kinematics, Planar):
            plane = detect(scene) if _holds_all_or_nothing(scene) else None
            axes = np.eye(3)
            if isinstance(plane, Planar):
                flat = cls.of(scene, plane)
                axes = np.concatenate([flat.axes, flat.spin_axes], axis=1)
            return cls(origin, axes, axes, length, stiffness)
        normal = np.asarray(kinematics.normal, dtype=float)
        normal = normal / np.linalg.norm(normal)
        e1 = _single_direction(scene, normal)
        if e1 is None:
            e1 = scene.rods[0].frames(np.zeros(1))[0, :, 0]
        e1 = e1 - (e1 @ normal) * normal
        e1 /= np.linalg.norm(e1)
        axes = np.stack([e1, np.cross(normal, e1)], axis=1)
        return cls(origin, axes, normal[:, None], length, stiffness)

    def coincides(self, other: Placement) -> bool:
        """Whether both are the same to the last bit."""
        return all(np.array_equal(value, getattr(other, name)) for name, value in vars(self).items())

    @property
    def force(self) -> float:
        """Unit of force EI/L² [N]."""
        return self.stiffness / self.length**2

    @property
    def moment(self) -> float:
        """Unit of moment EI/L [N m]."""
        return self.stiffness / self.length

    def points(self, x: NDArray[np.float64]) -> NDArray[np.float64]:
        """Points of space in working coordinates, (..., 3) → (..., d)."""
        return exact_zeros((x - self.origin) @ self.axes) / self.length

    def to_space(self, r: NDArray[np.float64]) -> NDArray[np.float64]:
        """Working coordinates back to space, (..., d) → (..., 3) [m]."""
        return self.origin + self.length * r @ self.axes.T


def exact_zeros(v: NDArray[np.float64], *, axis: int | tuple[int, ...] = -1) -> NDArray[np.float64]:
    """Vectors whose components that are nothing but round-off of the others are zero, or matrices with two axes."""
    size = np.abs(v)
    return np.where(size > ROUND_OFF * size.max(axis=axis, keepdims=True), v, 0.0)


def _holds_all_or_nothing(scene: Scene) -> bool:
    """Whether every support holds all translations or none, and all rotations or none."""
    counts = [len([a for a in s.held() if a.startswith("r") == turning]) for s in scene.supports for turning in (0, 1)]
    return all(n in (0, 3) for n in counts)


def _single_direction(scene: Scene, normal: NDArray[np.float64]) -> NDArray[np.float64] | None:
    """The in-plane direction that some support holds alone, if any; another held alone is along or across it.

    `dolfinrod.scene.kinematics.obstacle` lets no other support into a plane.
    """
    for support in scene.supports:
        held = [np.eye(3)[AXES[a]] for a in sorted(support.held()) if a in AXES]
        rows = np.array([e - (e @ normal) * normal for e in held]).reshape(-1, 3)
        if np.linalg.matrix_rank(rows, tol=ALIGNED) == 1:
            return np.asarray(rows[np.argmax(np.linalg.norm(rows, axis=1))])
    return None
