"""Contacts as a user reads of them: in the record of a solve, and in its formulation."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.result import ContactHistory, Touching
from dolfinrod.scene import AugmentedLagrangian

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from discrete.mesh import Mesh
    from dolfinrod.scene import Scene

    Array = NDArray[np.float64]

__all__ = ["contact_histories", "contact_terms", "energetic"]


def contact_histories(scene: Scene, mesh: Mesh, path: Sequence[Array]) -> tuple[ContactHistory, ...]:
    """One history per contact.

    Args:
        scene: The problem.
        mesh: Its nodes.
        path: What `Contacts.record` gave at the stored states.

    Returns:
        Histories in SI units; none where the scene has no contacts.
    """
    if not path:
        return ()
    felt, behind, histories = np.stack(path), 0, []
    for contact in scene.walls:
        rods: list[Touching | None] = [None] * len(scene.rods)
        for k in range(len(scene.rods)) if contact.rod is None else (contact.rod,):
            n = len(mesh.s[k])
            rods[k] = _touching(mesh, k, felt[:, behind : behind + n])
            behind += n
        histories.append(ContactHistory(tuple(rods)))
    return tuple(histories)


def _touching(mesh: Mesh, k: int, felt: Array) -> Touching:
    """One rod against one surface."""
    return Touching(
        s=mesh.s[k],
        share=mesh.share[mesh.first[k] : mesh.first[k + 1]] * mesh.units.length,
        gap=felt[..., 0],
        pressure=felt[..., 1],
        normal=felt[..., 2:5],
        traction=felt[..., 5:8],
        slip=felt[..., 8],
        state=felt[..., 9].astype(np.int8),
    )


def contact_terms(scene: Scene) -> tuple[str, ...]:
    """What contacts add to the terms of a formulation."""
    rubs = any(contact.friction is not None for contact in scene.contacts)
    return ("Contact",) * bool(scene.contacts) + ("Friction",) * rubs


def energetic(scene: Scene) -> bool:
    """Whether the tangent tells which equilibria are stable: contacts have an energy, no friction nor multipliers."""
    return not any(
        contact.friction is not None or isinstance(contact.law, AugmentedLagrangian) for contact in scene.contacts
    )
