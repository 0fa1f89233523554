"""Surfaces that leave rods in the plane they lie in."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene.surfaces import Cylinder, Groove, Plane

if TYPE_CHECKING:
    from dolfinrod.scene.contact import Contact
    from dolfinrod.scene.quantity import VectorLike
    from dolfinrod.scene.surfaces import Surface, WallMotion

__all__ = ["TOLERANCE", "keeps_plane", "normal_to", "parallel", "planes_through"]

# An angle out of the plane that is only round-off of the input [rad].
TOLERANCE = 1e-10


def keeps_plane(contact: Contact, N: np.ndarray, origin: np.ndarray) -> bool:
    """Whether mirroring at a plane leaves a surface and its motion as they are, with normals in the plane.

    So it is with surfaces that are straight along N, and with cylinders whose axis lies in the plane. Grooves along the
    plane are taken to lead out of it: rods that fill them touch either flank.

    Args:
        contact: Of the surface.
        N: Unit normal of the plane, shape (3,).
        origin: One of its points, shape (3,) [m].

    Returns:
        True where rods in the plane stay there.
    """
    surface = contact.surface
    return _mirrored(surface, N, origin) and (surface.motion is None or _moves_within(surface.motion, N))


def planes_through(contact: Contact, start: np.ndarray, d1: np.ndarray) -> list[np.ndarray]:
    """Normals, of any length, of planes that a surface and its motion suggest for a rod from `start` along `d1`."""
    surface, motion = contact.surface, contact.surface.motion
    along, across = [], []
    if isinstance(surface, Plane):
        across.append(surface.normal)
    elif isinstance(surface, Cylinder | Groove):
        along.append(surface.axis)
    if isinstance(surface, Cylinder):
        across += [surface.axis, np.asarray(surface.point) - start]
    if motion is not None:
        along += [motion.rotation, motion.spin]
        across += [motion.displacement, motion.velocity]
    return [*(np.asarray(v) for v in along), *(np.cross(d1, v) for v in across)]


def _mirrored(surface: Surface, N: np.ndarray, origin: np.ndarray) -> bool:
    if isinstance(surface, Plane):
        return normal_to(surface.normal, N)
    if isinstance(surface, Cylinder):
        off = float((np.asarray(surface.point) - origin) @ N)
        within = normal_to(surface.axis, N) and abs(off) <= TOLERANCE * surface.radius
        return within or parallel(surface.axis, N)
    return isinstance(surface, Groove) and surface.roller is None and parallel(surface.axis, N)


def _moves_within(motion: WallMotion, N: np.ndarray) -> bool:
    shifted = normal_to(motion.displacement, N) and normal_to(motion.velocity, N)
    return shifted and parallel(motion.rotation, N) and parallel(motion.spin, N)


def normal_to(v: VectorLike, N: np.ndarray) -> bool:
    """Whether a vector lies in the plane with unit normal N."""
    return bool(abs(np.dot(v, N)) <= TOLERANCE * np.linalg.norm(v))


def parallel(v: VectorLike, N: np.ndarray) -> bool:
    """Whether a vector is along a unit normal N, either way."""
    return bool(np.linalg.norm(np.cross(v, N)) <= TOLERANCE * np.linalg.norm(v))
