"""Contacts as a user reads of them: in the record of a solve, and in its formulation."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.result import ContactHistory, MeetingHistory, Touching
from dolfinrod.scene import AugmentedLagrangian

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from discrete.mesh import Mesh
    from dolfinrod.meetings import Meetings
    from dolfinrod.scene import Scene

    Array = NDArray[np.float64]

__all__ = ["contact_histories", "contact_terms", "energetic", "meeting_histories", "unjudged"]


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


def meeting_histories(path: Sequence[tuple[Meetings, ...]]) -> tuple[MeetingHistory, ...]:
    """One history per contact of rods with rods, of what `Surroundings.meetings` gave at the stored states."""
    return tuple(MeetingHistory(times) for times in zip(*path, strict=True))


def contact_terms(scene: Scene) -> tuple[str, ...]:
    """What contacts add to the terms of a formulation."""
    kinds = dict.fromkeys(type(contact).__name__ for contact in scene.contacts)
    rubs = any(contact.friction is not None for contact in scene.contacts)
    return (*kinds, *("Friction",) * rubs)


def energetic(scene: Scene) -> bool:
    """Whether the tangent tells which equilibria are stable."""
    return not unjudged(scene)


def unjudged(scene: Scene) -> str:
    """Why it does not, in words; empty where contacts have an energy, no friction nor multipliers, with surfaces only.

    Rods that touch one another without friction have an energy, too; but negative directions are counted rod by rod.
    """
    if any(contact.friction is not None or isinstance(contact.law, AugmentedLagrangian) for contact in scene.contacts):
        return "friction, and AugmentedLagrangian, have no energy that would tell"
    return "rods that touch one another are not judged together" if scene.meetings else ""
