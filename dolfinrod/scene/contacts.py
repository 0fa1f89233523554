"""What the contacts of a scene ask of its rods."""

from __future__ import annotations

from typing import TYPE_CHECKING

from dolfinrod.scene.errors import SceneError
from dolfinrod.scene.friction import CreepingCoulomb
from dolfinrod.scene.motion import Static
from dolfinrod.scene.rodcontact import RodContact
from dolfinrod.scene.surfaces import refuse_sharp

if TYPE_CHECKING:
    from dolfinrod.scene.contact import Contact
    from dolfinrod.scene.scene import Scene

__all__ = ["check_contacts"]


def check_contacts(scene: Scene) -> None:
    """What touches has a surface of its own, and friction against the velocity a motion in time.

    Args:
        scene: Any scene.

    Raises:
        SceneError: A rod that is not there, or not round; a groove too sharp for it; what statics cannot do.
    """
    for i, contact in enumerate(scene.contacts):
        path = f"contacts[{i}]"
        if isinstance(contact, RodContact):
            _check_rods(scene, contact, path)
        else:
            _check_wall(scene, contact, path)


def _check_wall(scene: Scene, contact: Contact, path: str) -> None:
    if contact.rod is not None and contact.rod >= len(scene.rods):
        below = f"must be below {len(scene.rods)}, the number of rods, got {contact.rod}"
        raise SceneError(below, field=f"{path}.rod")
    for k in range(len(scene.rods)) if contact.rod is None else (contact.rod,):
        refuse_sharp(contact.surface, _radius(scene, k, path), contact.law.g_0, f"{path}.surface")
    if isinstance(contact.friction, CreepingCoulomb) and isinstance(scene.motion, Static):
        raise SceneError(
            "must not be CreepingCoulomb, since motion is Static: it acts against velocities", field=f"{path}.friction"
        )


def _check_rods(scene: Scene, contact: RodContact, path: str) -> None:
    for j, k in enumerate(contact.among(len(scene.rods))):
        if k >= len(scene.rods):
            below = f"must be below {len(scene.rods)}, the number of rods, got {k}"
            raise SceneError(below, field=f"{path}.rods[{j}]")
        _radius(scene, k, path)


def _radius(scene: Scene, rod: int, path: str) -> float:
    """Radius of a rod that may touch something [m]."""
    radius = scene.rods[rod].section.radius
    if radius is None:
        needed = f"must be given [m], since the rod may touch {path}, got None"
        raise SceneError(needed, field=f"rods[{rod}].section.radius")
    return radius
