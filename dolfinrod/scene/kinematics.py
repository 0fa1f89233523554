"""Whether a scene lives in a plane, and in which."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene.contact import Contact
from dolfinrod.scene.loads import FollowerForce, FollowerMoment, Gravity, LineForce, Load, PointForce, PointMoment
from dolfinrod.scene.quantity import VectorLike, assign, vector
from dolfinrod.scene.shape import unit
from dolfinrod.scene.supports import ROTATIONS, TRANSLATIONS, Prescribed, Support
from dolfinrod.scene.symmetry import TOLERANCE, keeps_plane, normal_to, parallel, planes_through

if TYPE_CHECKING:
    from dolfinrod.scene.rod import Rod
    from dolfinrod.scene.scene import Scene
    from dolfinrod.scene.section import Section
    from dolfinrod.scene.velocity import Velocity

__all__ = ["Kinematics", "Planar", "Spatial", "detect", "obstacle"]

# Places, as parts of a length, where a rod is asked how it moves: so unevenly that no wave has all its nodes there.
PLACES = (1.0 - np.cos(np.linspace(0.0, np.pi, 65))) / 2.0
DEAD = PointForce | LineForce | Gravity


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

    The normal of a plane must be a principal axis of every section; so d3 and then d2 of the first rod are tried, and
    where its section is the same in all directions, whatever plane its axis spans with a load, a prescribed motion, a
    velocity at the start, the air or a surface. Air whose flow is a function is taken to lead out of every plane.
    Rods that touch one another stay in a plane in which all of them lie: mirrored at it, they push each other along it.

    Args:
        scene: Any scene.

    Returns:
        The plane through the start of the first rod, or space.
    """
    origin = tuple(scene.rods[0].centerline(0.0))
    frame = scene.rods[0].frames(0.0)
    for normal in (frame[:, 2], frame[:, 1], *_spanned(scene, frame[:, 0])):
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
    for i, velocity in enumerate(scene.velocities):
        v = _moved(scene, velocity)
        if not parallel(velocity.omega, N) or np.abs(v @ N).max() > TOLERANCE * np.abs(v).max():
            return f"velocities[{i}] leads out of the plane"
    for i, contact in enumerate(scene.contacts):
        if isinstance(contact, Contact) and not keeps_plane(contact, N, origin):
            return f"contacts[{i}] may lead out of the plane"
    if scene.air is not None and (callable(scene.air.field) or not normal_to(scene.air.field, N)):
        return "air may flow out of the plane"
    return None


def _rod_fits(rod: Rod, N: np.ndarray, origin: np.ndarray) -> bool:
    """Starts in the plane, keeps d2 or d3 along the normal, and is not twisted."""
    s = np.array([*np.linspace(0.0, rod.length, 9), *rod.breakpoints])
    along = np.einsum("i,nij->nj", N, rod.frames(s))
    axis = 2 if abs(along[0, 2]) > abs(along[0, 1]) else 1
    across = [0] if _isotropic(rod.section) else [0, 3 - axis]
    # Frames between the samples: a curvature off the normal that turns them by less than this is none.
    off = rod.curvature(s) - np.einsum("ni,ni->n", rod.curvature(s), along)[:, None] * along
    bent = np.abs(off).max() * rod.length <= 1e-6
    offset = abs(float((rod.centerline(0.0) - origin) @ N))
    reach = rod.length + float(np.linalg.norm(rod.centerline(0.0) - origin))
    turned = np.abs(along[:, across]).max() > TOLERANCE
    return bool(rod.pretwist == 0.0 and bent and not turned and offset <= TOLERANCE * reach)


def _isotropic(section: Section) -> bool:
    """Every axis in the section is a principal one."""
    return section.EI[0] == section.EI[1] and section.GA[0] == section.GA[1]


def _spanned(scene: Scene, d1: np.ndarray) -> list[np.ndarray]:
    """Normals of the planes that the axis of the first rod spans with a force or motion, and moments themselves."""
    if not _isotropic(scene.rods[0].section):
        return []
    prescribed = [s for s in scene.supports if isinstance(s, Prescribed)]
    moments = [np.asarray(load.moment) for load in scene.loads if isinstance(load, PointMoment)]
    turns = [np.asarray(s.rotation) for s in prescribed if s.rotation is not None]
    forces = [load.g if isinstance(load, Gravity) else load.force for load in scene.loads if isinstance(load, DEAD)]
    moves: list[VectorLike] = [[u or 0.0 for u in s.displacement] for s in prescribed if s.displacement is not None]
    moves += [max(_moved(scene, v), key=lambda v: float(np.linalg.norm(np.cross(d1, v)))) for v in scene.velocities]
    moves += [] if scene.air is None or callable(scene.air.field) else [scene.air.field]
    spins = [np.asarray(velocity.omega) for velocity in scene.velocities]
    walls = [v for c in scene.walls for v in planes_through(c, scene.rods[0].centerline(0.0), d1)]
    normals = [*(np.cross(d1, v) for v in [*forces, *moves]), *moments, *turns, *spins, *walls]
    return [v / np.linalg.norm(v) for v in normals if np.linalg.norm(v) > 0.0]


def _moved(scene: Scene, velocity: Velocity) -> np.ndarray:
    """Velocities at the start that it gives along the rods, shape (n, 3) [m/s]."""
    rods = scene.rods if velocity.rod is None else (scene.rods[velocity.rod],)
    return np.concatenate([velocity.at(rod.centerline(rod.length * PLACES)) for rod in rods])


def _load_fits(scene: Scene, load: Load, N: np.ndarray) -> bool:
    """Forces in the plane, moments along its normal; follower loads in the stress-free shape and so ever after."""
    if isinstance(load, PointMoment):
        return parallel(load.moment, N)
    if isinstance(load, (FollowerForce, FollowerMoment)):
        frames = [scene.rods[k].frames(s) for k, s in scene.location(load.at, load.rod)]
        if isinstance(load, FollowerForce):
            return all(normal_to(R @ np.asarray(load.force), N) for R in frames)
        return all(parallel(R @ np.asarray(load.moment), N) for R in frames)
    return normal_to(load.g if isinstance(load, Gravity) else load.force, N)


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
    return normal_to(shifted, N) and (support.rotation is None or parallel(support.rotation, N))
