"""Where rods touch rods as files: a table a contact, points for ParaView, and what the record says of them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from dolfinrod.output.contacts import STATES
from dolfinrod.output.rows import ROUND_OFF, read_numbers, write_numbers
from dolfinrod.output.vtk import write_collection
from dolfinrod.result import MeetingHistory, Meetings
from dolfinrod.scene import SceneError

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from dolfinrod.result import Result
    from dolfinrod.scene import RodContact, Scene

    Array = NDArray[np.float64]

__all__ = ["meeting_table", "read_meeting", "spot_sums", "write_meetings", "write_spots"]

# What a row of `Meetings` has, with the names of its columns.
PARTS = {
    "rod_a": ("rod a",),
    "s_a": ("s_a [m]",),
    "rod_b": ("rod b",),
    "s_b": ("s_b [m]",),
    "point": tuple(f"{axis} [m]" for axis in "xyz"),
    "gap": ("gap [m]",),
    "length": ("length [m]",),
    "force": tuple(f"force{axis} [N]" for axis in "xyz"),
    "normal": tuple(f"normal{axis}" for axis in "xyz"),
    "traction": tuple(f"traction{axis} [N]" for axis in "xyz"),
    "state": ("state",),
}
COLUMNS = ("t", *(name for names in PARTS.values() for name in names))
WHOLE = {"rod_a": np.int64, "rod_b": np.int64, "state": np.int8}
COLLECTION = "meetings.pvd"


def meeting_table(k: int) -> str:
    """File name of the table of contact k among rods."""
    return f"meeting-{k}.csv"


def write_meetings(result: Result, folder: Path) -> dict[str, Any]:
    """Write the tables of all contacts among rods, time after time.

    Args:
        result: What was found.
        folder: Where they are made.

    Returns:
        What the record says of them: nothing where there are none.
    """
    for k, meeting in enumerate(result.meetings):
        rows = [
            np.concatenate([np.full((len(met.gap), 1), t), *(_columns(met, name) for name in PARTS)], axis=1)
            for t, met in zip(result.t, meeting.times, strict=True)
        ]
        write_numbers(folder / meeting_table(k), COLUMNS, np.concatenate(rows))
    if not result.meetings:
        return {}
    return {"meetings": [_told(*pair) for pair in zip(result.scene.meetings, result.meetings, strict=True)]}


def spot_sums(meeting: MeetingHistory) -> dict[str, Array]:
    """Number of spots, length of all rods in contact [m] and magnitudes of forces summed [N], shapes (n_t,)."""
    times = range(len(meeting.times))
    return {
        "spots": np.array([meeting.n_spots(i) for i in times], dtype=np.float64),
        "length": np.array([met.length.sum() for met in meeting.times]),
        "force": np.array([meeting.total(i) for i in times]),
    }


def read_meeting(folder: Path, k: int, scene: Scene, t: Array) -> MeetingHistory:
    """Read back one contact among rods.

    Args:
        folder: Where the table is.
        k: Its number among the meetings of the scene.
        scene: As posed.
        t: Pseudo-times or times of which the rows may be.

    Returns:
        The same arrays.

    Raises:
        SceneError: A file that is no such table, not of these times, or of other rods.
        OSError: The file cannot be read.
    """
    path = folder / meeting_table(k)
    _, rows = read_numbers(path, COLUMNS)
    rows = rows.reshape(-1, len(COLUMNS))
    if (np.diff(rows[:, 0]) < 0.0).any() or not np.isin(rows[:, 0], t).all():
        raise SceneError("must go through the times of result.json, got others", field=str(path))
    ends = np.cumsum([len(names) for names in PARTS.values()])[:-1]
    parts = dict(zip(PARTS, np.split(rows[:, 1:], ends, axis=1), strict=True))
    _check(parts, scene, scene.meetings[k], str(path))
    return MeetingHistory(tuple(_met(parts, rows[:, 0] == time) for time in t))


def write_spots(result: Result, folder: Path) -> None:
    """Write `meetings.pvd` and `meetings-0000.vtu`, …: all that touches at one stored time in each, as points.

    Point data: `contact`, counted from 0 among the contacts of rods with rods, and all that `Meetings` has, in SI
    units. Results without such contacts leave nothing.

    Args:
        result: What was found.
        folder: Where the files are made.
    """
    if not result.meetings:
        return
    # It takes a fifth of a second to load.
    import meshio

    names = [f"meetings-{i:04d}.vtu" for i in range(len(result.t))]
    for i, name in enumerate(names):
        met = [meeting.times[i] for meeting in result.meetings]
        data = {part: np.concatenate([getattr(one, part) for one in met]) for part in PARTS}
        points = data.pop("point")
        data["contact"] = np.repeat(np.arange(len(met)), [len(one.gap) for one in met])
        cells = [("vertex", np.arange(len(points))[:, None])]
        meshio.write(folder / name, meshio.Mesh(points, cells, point_data=data))
    write_collection(folder / COLLECTION, result.t, [[name] for name in names])


def _columns(met: Meetings, name: str) -> Array:
    return np.asarray(getattr(met, name), dtype=np.float64).reshape(len(met.gap), len(PARTS[name]))


def _told(contact: RodContact, meeting: MeetingHistory) -> dict[str, Any]:
    """One contact in the record."""
    return {
        "law": str(contact.law),
        "friction": None if contact.friction is None else str(contact.friction),
        "rods": None if contact.rods is None else list(contact.rods),
        **{name: values.tolist() for name, values in spot_sums(meeting).items()},
    }


def _check(parts: dict[str, Array], scene: Scene, contact: RodContact, path: str) -> None:
    """Rows are of the rods that may touch, and on them."""
    among = contact.among(len(scene.rods))
    lengths = np.array([rod.length for rod in scene.rods])
    for side in "ab":
        rod, s = parts[f"rod_{side}"][:, 0], parts[f"s_{side}"][:, 0]
        if not np.isin(rod, among).all():
            wrong = f"must name rods {', '.join(map(str, among))} only, got others"
            raise SceneError(wrong, field=path)
        most = lengths[rod.astype(np.int64)] * (1.0 + ROUND_OFF)
        if (s < -ROUND_OFF * most).any() or (s > most).any():
            raise SceneError("must have arc lengths on the rods, got some beyond their ends", field=path)
    if not np.isin(parts["state"], STATES).all():
        raise SceneError("must have states 0 open, 1 sticking or 2 sliding only, got others", field=path)


def _met(parts: dict[str, Array], chosen: NDArray[np.bool_]) -> Meetings:
    """What touches at one time."""
    values = {
        name: part[chosen] if len(PARTS[name]) > 1 else part[chosen, 0].astype(WHOLE.get(name, np.float64))
        for name, part in parts.items()
    }
    return Meetings(**{name: np.ascontiguousarray(part) for name, part in values.items()})
