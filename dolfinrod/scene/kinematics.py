"""Whether a scene lives in a plane, and in which."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene.loads import FollowerForce, FollowerMoment, Gravity, Load, PointMoment
from dolfinrod.scene.quantity import VectorLike, assign, vector
from dolfinrod.scene.shape import unit
from dolfinrod.scene.supports import ROTATIONS, TRANSLATIONS, Prescribed, Support

if TYPE_CHECKING:
    from dolfinrod.scene.rod import Rod
    from dolfinrod.scene.scene import Scene

__all__ = ["Kinematics", "Planar", "Spatial", "detect", "obstacle"]

# An angle out of the plane that is only round-off of the input [rad].
TOLERANCE = 1e-10


@dataclass(frozen=True)
class Planar:
    """Motion within a plane: two displacements, one angle.

    Args:
        normal: Of the plane, of any length; None: found from the scene.
        origin: A point of the plane [m]; None: found from the scene.
    """

    normal: VectorLike | None = None
    origin: VectorLike | None = None

    def __post_init__(self) -> None:
        assign(
            self,
            normal=None if self.normal is None else vector(unit(self.normal, "Planar.normal"), "Planar.normal"),
            origin=None if self.origin is None else vector(self.origin, "Planar.origin", "m"),
        )


@dataclass(frozen=True)
class Spatial:
    """Motion in space: three displacements, a rotation."""


Kinematics = Planar | Spatial


def detect(scene: Scene) -> Planar | Spatial:
    """The least kinematics that holds the whole scene.

    The normal of a plane must be a principal axis of every section; so d3 and then d2 of the first rod are tried.

    Args:
        scene: Any scene.

    Returns:
        The plane through the start of the first rod, or space.
    """
    origin = tuple(scene.rods[0].centerline(0.0))
    frame = scene.rods[0].frames(0.0)
    for normal in (frame[:, 2], frame[:, 1]):
        plane = Planar(normal, origin)
        if obstacle(scene, plane) is None:
            return plane
    return Spatial()


def obstacle(scene: Scene, plane: Planar) -> str | None:
    """The first thing in a scene that leads out of a plane.

    Args:
        scene: Any scene.
        plane: With normal and origin.

    Returns:
        What it is, in words; None if the scene stays in the plane.
    """
    N, origin = np.asarray(plane.normal), np.asarray(plane.origin)
    for i, rod in enumerate(scene.rods):
        if not _rod_fits(rod, N, origin):
            return f"rods[{i}] does not lie in the plane with a principal axis along its normal"
    for i, load in enumerate(scene.loads):
        if not _load_fits(scene, load, N):
            return f"loads[{i}] acts out of the plane"
    for i, support in enumerate(scene.supports):
        if not _support_fits(support, N):
            return f"supports[{i}] couples motion in the plane with motion out of it"
    return None


def _rod_fits(rod: Rod, N: np.ndarray, origin: np.ndarray) -> bool:
    """Starts in the plane, keeps d2 or d3 along the normal, and is not twisted."""
    s = np.array([*np.linspace(0.0, rod.length, 9), *rod.breakpoints])
    along = np.einsum("i,nij->nj", N, rod.frames(s))
    axis = 2 if abs(along[0, 2]) > abs(along[0, 1]) else 1
    others = [0, 3 - axis]
    level = np.abs(along[:, others]).max() <= TOLERANCE
    # Nor does the frame turn out of the plane and back between the samples.
    steady = rod.pretwist == 0.0 and np.abs(rod.curvature(s)[:, others]).max() * rod.length <= 1e-6
    offset = abs(float((rod.centerline(0.0) - origin) @ N))
    reach = rod.length + float(np.linalg.norm(rod.centerline(0.0) - origin))
    return bool(level and steady and offset <= TOLERANCE * reach)


def _load_fits(scene: Scene, load: Load, N: np.ndarray) -> bool:
    """Forces in the plane, moments along its normal; follower loads in the stress-free shape and so ever after."""
    if isinstance(load, PointMoment):
        return _parallel(load.moment, N)
    if isinstance(load, (FollowerForce, FollowerMoment)):
        frames = [scene.rods[k].frames(s) for k, s in scene.location(load.at, load.rod)]
        if isinstance(load, FollowerForce):
            return all(_normal_to(R @ np.asarray(load.force), N) for R in frames)
        return all(_parallel(R @ np.asarray(load.moment), N) for R in frames)
    return _normal_to(load.g if isinstance(load, Gravity) else load.force, N)


def _support_fits(support: Support, N: np.ndarray) -> bool:
    """Held directions contain the normal or are across it, so that mirroring at the plane changes nothing."""
    held = support.held()
    for group in (TRANSLATIONS, ROTATIONS):
        among = np.array([name in held for name in group])
        if min(np.linalg.norm(N[among]), np.linalg.norm(N[~among])) > TOLERANCE:
            return False
    if not isinstance(support, Prescribed):
        return True
    moved = support.displacement or (0.0, 0.0, 0.0)
    shifted = [0.0 if u is None else u for u in moved]
    return _normal_to(shifted, N) and (support.rotation is None or _parallel(support.rotation, N))


def _normal_to(v: VectorLike, N: np.ndarray) -> bool:
    return bool(abs(np.dot(v, N)) <= TOLERANCE * np.linalg.norm(v))


def _parallel(v: VectorLike, N: np.ndarray) -> bool:
    return bool(np.linalg.norm(np.cross(v, N)) <= TOLERANCE * np.linalg.norm(v))
