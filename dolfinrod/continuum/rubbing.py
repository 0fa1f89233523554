"""What contact adds to the equations of a scene."""

from __future__ import annotations

from typing import TYPE_CHECKING

from dolfinrod.scene import AugmentedLagrangian

if TYPE_CHECKING:
    from dolfinrod.scene import Scene

__all__ = ["contact_terms", "remembers", "rubs"]


def rubs(scene: Scene) -> bool:
    """Whether anything in a scene resists sliding."""
    return any(contact.friction is not None for contact in scene.contacts)


def remembers(scene: Scene) -> bool:
    """Whether contact forces depend on more than where the rods are."""
    return rubs(scene) or any(isinstance(contact.law, AugmentedLagrangian) for contact in scene.contacts)


def contact_terms(scene: Scene) -> tuple[str, ...]:
    """What contact adds to the balance of a scene, in words."""
    return (
        *(("Contact",) if scene.walls else ()),
        *(("Rod contact",) if scene.meetings else ()),
        *(("Friction",) if rubs(scene) else ()),
    )
