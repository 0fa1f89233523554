"""What rods touch, for ParaView: a mesh a surface, a mesh a stored time where it moves, and a collection of all."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.output.patches import patch
from dolfinrod.output.vtk import write_collection
from dolfinrod.scene.surfaces import REST, Pose

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from dolfinrod.result import Result
    from dolfinrod.scene import Contact

    Array = NDArray[np.float64]
    Cells = NDArray[np.int64]

__all__ = ["beside_rods", "poses", "write_surfaces"]

COLLECTION = "surfaces.pvd"


def write_surfaces(result: Result, folder: Path) -> None:
    """Write `surfaces.pvd` and `surface-0.vtu`, …, of a surface that moves `surface-0-0000.vtu`, …, one a stored time.

    Each is as large as the rods need on all their way. Cell data: `contact`, counted from 0. Results without contacts
    leave nothing.

    Args:
        result: What was found.
        folder: Where the files are made.
    """
    if not result.contacts:
        return
    # It takes a fifth of a second to load.
    import meshio

    shown: list[list[str]] = [[] for _ in result.t]
    for k, contact in enumerate(result.scene.walls):
        stations, (points, cells) = poses(contact, result), beside_rods(contact, result)
        still = contact.surface.motion is None
        names = [f"surface-{k}.vtu" if still else f"surface-{k}-{i:04d}.vtu" for i in range(len(result.t))]
        for name, pose in dict(zip(names, stations, strict=True)).items():
            data = {"contact": [np.full(len(cells), k)]}
            meshio.write(folder / name, meshio.Mesh(pose.out(points), [("quad", cells)], cell_data=data))
        for files, name in zip(shown, names, strict=True):
            files.append(name)
    write_collection(folder / COLLECTION, result.t, shown)


def poses(contact: Contact, result: Result) -> list[Pose]:
    """Where the surface of a contact is at each stored time."""
    motion = contact.surface.motion
    return [REST if motion is None else motion.pose(t, result.scene.motion.t_end) for t in result.t.tolist()]


def beside_rods(contact: Contact, result: Result) -> tuple[Array, Cells]:
    """The piece of a surface at rest that all rods need that may touch it, as `patch` gives it."""
    rods = result.rods if contact.rod is None else (result.rods[contact.rod],)
    places = np.concatenate([pose.back(rod.r[i]) for rod in rods for i, pose in enumerate(poses(contact, result))])
    return patch(contact.surface, np.stack([places.min(axis=0), places.max(axis=0)]))
