"""How a wall moves: as a rigid body, pushed and turned over a history or at constant speed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.errors import SceneError, quoted
from dolfinrod.scene.history import History, factor, history
from dolfinrod.scene.quantity import VectorLike, assign, direction, vector

__all__ = ["REST", "Pose", "WallMotion", "moving"]

Array = NDArray[np.float64]

# An angle between axes that is only round-off of the input [rad].
SAME_AXIS = 1e-9


@dataclass(frozen=True, eq=False)
class Pose:
    """Where a wall is, X ↦ x = Q X + c, X a place on the wall at rest.

    Args:
        Q: Its turn, shape (3, 3).
        c: Its shift, shape (3,) [m].
    """

    Q: Array
    c: Array

    def out(self, X: Array) -> Array:
        """Places at rest to where they are, shape (n, 3)."""
        return X @ self.Q.T + self.c

    def back(self, x: Array) -> Array:
        """The reverse."""
        return (x - self.c) @ self.Q


REST = Pose(np.eye(3), np.zeros(3))


@dataclass(frozen=True)
class WallMotion:
    """Motion of a wall as a rigid body: turned about a point, then shifted.

    x = about + exp(f(t) rotation + t spin) (X − about) + f(t) displacement + t velocity.

    Args:
        displacement: Shift where the history is 1 [m].
        rotation: Rotation vector there [rad].
        history: f; None: t/t_end, in a Dynamic motion, too.
        velocity: Constant speed [m/s], or [m] per unit of the pseudo-time.
        spin: Constant angular velocity [rad/s], or [rad] per unit of the pseudo-time.
        about: Point about which the wall turns [m].

    Raises:
        SceneError: No vectors of finite numbers, or turns about two axes at once.
    """

    displacement: VectorLike = (0.0, 0.0, 0.0)
    rotation: VectorLike = (0.0, 0.0, 0.0)
    history: History = None
    velocity: VectorLike = (0.0, 0.0, 0.0)
    spin: VectorLike = (0.0, 0.0, 0.0)
    about: VectorLike = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        units = {"displacement": "m", "rotation": "rad", "velocity": "m/s", "spin": "rad/s", "about": "m"}
        vectors = {name: vector(getattr(self, name), f"WallMotion.{name}", unit) for name, unit in units.items()}
        assign(self, history=history(self.history, "WallMotion.history"), **vectors)
        if not _along(self.rotation, self.spin):
            raise SceneError(
                f"must be along rotation {self.rotation} rad, got {self.spin} rad/s", field="WallMotion.spin"
            )

    def turn(self, t: float, t_end: float) -> Array:
        """Rotation vector at a time, shape (3,) [rad]."""
        f = factor(self.history, t, t_end)
        return np.asarray(f * np.asarray(self.rotation) + t * np.asarray(self.spin))

    def pose(self, t: float, t_end: float) -> Pose:
        """Where the wall is.

        Args:
            t: Time [s] or pseudo-time.
            t_end: Where it ends.

        Returns:
            Turn and shift.
        """
        Q, about = _exponential(self.turn(t, t_end)), np.asarray(self.about)
        shift = factor(self.history, t, t_end) * np.asarray(self.displacement) + t * np.asarray(self.velocity)
        return Pose(Q, about - Q @ about + shift)


def moving(value: object, field: str) -> WallMotion | None:
    """A motion or None.

    Raises:
        SceneError: Anything else.
    """
    if value is None or isinstance(value, WallMotion):
        return value
    raise SceneError(f"must be WallMotion or None, got {quoted(value)}", field=field)


def _along(a: VectorLike, b: VectorLike) -> bool:
    """Whether one vector is along the other, either way; zero is along every one."""
    if not any(a) or not any(b):
        return True
    return bool(np.linalg.norm(np.cross(direction(a, ""), direction(b, ""))) <= SAME_AXIS)


def _exponential(θ: Array) -> Array:
    """Rotation matrix of a rotation vector, Rodrigues' formula."""
    angle = float(np.linalg.norm(θ))
    if angle == 0.0:
        return np.eye(3)
    x, y, z = θ / angle
    K = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + np.sin(angle) * K + 2.0 * np.sin(angle / 2) ** 2 * K @ K
