"""Where rods touch as files: a table a contact and rod, and in the record what each contact carries."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from dolfinrod.output.rows import ROUND_OFF, read_rows, write_rows
from dolfinrod.result import ContactHistory, Touching
from dolfinrod.scene import SceneError

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from dolfinrod.result import Result
    from dolfinrod.scene import Contact

    Array = NDArray[np.float64]

__all__ = ["contact_table", "read_contact", "summarised", "weight", "write_contacts"]

COLUMNS = (
    "share [m]",
    "gap [m]",
    "pressure [N/m]",
    *(f"normal{axis}" for axis in "xyz"),
    *(f"traction{axis} [N/m]" for axis in "xyz"),
    "slip [m]",
    "state",
)
STATES = (0, 1, 2)


def contact_table(k: int, j: int) -> str:
    """File name of the table of rod j against contact k."""
    return f"contact-{k}-rod-{j}.csv"


def write_contacts(result: Result, folder: Path) -> dict[str, Any]:
    """Write the tables of all contacts.

    Args:
        result: What was found.
        folder: Where they are made.

    Returns:
        What the record says of them: nothing where there are none.
    """
    for k, contact in enumerate(result.contacts):
        for j, rod in enumerate(contact.rods):
            if rod is not None:
                _write_table(folder / contact_table(k, j), result.t, rod)
    if not result.contacts:
        return {}
    return {"contacts": [_told(*pair) for pair in zip(result.scene.walls, result.contacts, strict=True)]}


def summarised(contact: ContactHistory) -> dict[str, Array]:
    """Length in contact and resultant force at the stored times, shapes (n_t,) [m] and (n_t, 3) [N]."""
    return {"length": contact.length, "force": contact.force}


def weight(contact: ContactHistory) -> dict[str, float]:
    """Largest sums of magnitudes of which length [m] and force [N] are made: round-off is a small part of them."""
    rods = [rod for rod in contact.rods if rod is not None]
    length = sum(float(rod.share.sum()) for rod in rods)
    loads = (np.abs(rod.pressure)[:, :, None] * np.abs(rod.normal) + np.abs(rod.traction) for rod in rods)
    force = sum(float((load.sum(axis=2) @ rod.share).max()) for load, rod in zip(loads, rods, strict=True))
    return {"length": length, "force": force}


def read_contact(folder: Path, k: int, contact: Contact, t: Array, nodes: tuple[Array, ...]) -> ContactHistory:
    """Read back one contact of a scene.

    Args:
        folder: Where the tables are.
        k: Number of the contact.
        contact: As posed.
        t: Pseudo-times or times that the tables must hold.
        nodes: Arc lengths of the nodes of each rod.

    Returns:
        The same arrays.

    Raises:
        SceneError: A file that is no such table, not of these times, or not of as many points as the rod has nodes.
        OSError: A file cannot be read.
    """
    concerned = range(len(nodes)) if contact.rod is None else (contact.rod,)
    rods = [_read_table(folder / contact_table(k, j), t) if j in concerned else None for j in range(len(nodes))]
    for j, (rod, s) in enumerate(zip(rods, nodes, strict=True)):
        if rod is not None and not (len(rod.s) == len(s) and np.allclose(rod.s, s, rtol=0.0, atol=ROUND_OFF * s[-1])):
            wrong = f"must be of the {len(s)} nodes of rod-{j}.csv, got {len(rod.s)} others"
            raise SceneError(wrong, field=str(folder / contact_table(k, j)))
    return ContactHistory(tuple(rods))


def _told(contact: Contact, history: ContactHistory) -> dict[str, Any]:
    """One contact in the record."""
    return {
        "surface": type(contact.surface).__name__,
        "law": str(contact.law),
        "friction": None if contact.friction is None else str(contact.friction),
        **{name: values.tolist() for name, values in summarised(history).items()},
    }


def _write_table(path: Path, t: Array, rod: Touching) -> None:
    """One rod against one surface."""
    share = np.broadcast_to(rod.share, rod.gap.shape)
    scalars = {name: getattr(rod, name)[:, :, None] for name in ("gap", "pressure", "slip", "state")}
    first, last = (scalars["gap"], scalars["pressure"]), (scalars["slip"], scalars["state"])
    write_rows(path, COLUMNS, t, rod.s, (share[:, :, None], *first, rod.normal, rod.traction, *last))


def _read_table(path: Path, t: Array) -> Touching:
    """One rod against one surface."""
    s, values, _ = read_rows(path, COLUMNS, t)
    share, gap, pressure, normal, traction, slip, state = (
        np.ascontiguousarray(part) for part in np.split(values, [1, 2, 3, 6, 9, 10], axis=2)
    )
    if (share != share[0]).any():
        raise SceneError("must have the same shares at each time, got others", field=str(path))
    if not np.isin(state, STATES).all():
        raise SceneError("must have states 0 open, 1 sticking or 2 sliding only, got others", field=str(path))
    return Touching(
        s=s,
        share=share[0, :, 0].copy(),
        gap=gap[:, :, 0],
        pressure=pressure[:, :, 0],
        normal=normal,
        traction=traction,
        slip=slip[:, :, 0],
        state=state[:, :, 0].astype(np.int8),
    )
