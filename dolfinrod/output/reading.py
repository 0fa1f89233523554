"""A result read back from the files that `write` left: checked piece by piece, nothing in them is ever run."""

from __future__ import annotations

import json
from dataclasses import MISSING, fields
from itertools import pairwise
from types import UnionType
from typing import TYPE_CHECKING, Any, get_args, get_origin, get_type_hints

import numpy as np

from dolfinrod.output.arrays import read_arrays
from dolfinrod.output.contacts import read_contact, summarised, weight
from dolfinrod.output.meetings import meeting_table, read_meeting, spot_sums
from dolfinrod.output.record import FORMAT, RECORD, SCENE, STATE, rod_table
from dolfinrod.output.rows import ROUND_OFF
from dolfinrod.output.table import read_table
from dolfinrod.result import ContactHistory, Formulation, MeetingHistory, Result, RodHistory, Statistics, StepLog
from dolfinrod.scene import Scene, SceneError, toml

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["load"]


def load(folder: Path, *, scene: Scene | None = None) -> Result:
    """The result that `write` left in a folder, to the same doubles.

    Args:
        folder: Where it was written.
        scene: What was solved, where a scene with functions could not be written; None: the scene of the folder.

    Returns:
        The result.

    Raises:
        SceneError: A file that is missing, damaged, foreign, or does not go with the others.
    """
    try:
        return _load(folder, scene)
    except OSError as error:
        place = error.filename or folder
        raise SceneError(f"cannot be read: {error.strerror or error}", field=str(place)) from None


def _load(folder: Path, scene: Scene | None) -> Result:
    path = folder / RECORD
    record = _record(path)
    scene = _scene(folder, record) if scene is None else scene
    t = _ascending(record, "t", path)
    rods = tuple(read_table(folder / rod_table(k), t) for k in range(len(scene.rods)))
    _check_lengths(scene, rods, folder)
    if not np.array_equal(_doubles(record, "tip", path), rods[0].r[-1, -1]):
        raise SceneError("must belong to rod-0.csv, got the tip of another result", field=str(path))
    energy = _taken(record, "energy", dict, path)
    return Result(
        scene=scene,
        t=t,
        rods=rods,
        converged=_taken(record, "converged", bool, path),
        log=tuple(_made(StepLog, row, f"{path}: log[{i}]") for i, row in enumerate(_taken(record, "log", list, path))),
        energy={name: _ledger(energy, name, t, path) for name in energy},
        statistics=_made(Statistics, _taken(record, "statistics", dict, path), f"{path}: statistics"),
        formulation=_made(Formulation, _taken(record, "formulation", dict, path), f"{path}: formulation"),
        state=read_arrays(folder / STATE),
        contacts=_contacts(folder, record, scene, t, tuple(rod.s for rod in rods)),
        meetings=_meetings(folder, record, scene, t),
    )


def _record(path: Path) -> dict[str, Any]:
    """What the JSON says, of the format this version reads."""
    try:
        record = json.loads(path.read_text(encoding="utf-8"))
    except (ValueError, RecursionError) as error:
        raise SceneError(f"must be JSON: {error}", field=str(path)) from None
    found = record.get("format") if isinstance(record, dict) else None
    if found != FORMAT:
        raise SceneError(f"must be the record of a result, of format {FORMAT!r}, got {found!r}", field=str(path))
    return dict(record)


def _scene(folder: Path, record: dict[str, Any]) -> Scene:
    """The scene beside the record."""
    if record.get("scene") is None:
        reason = record.get("scene_not_written", "")
        missing = f"holds no scene ({reason}); load the result with scene="
        raise SceneError(missing, field=str(folder / RECORD))
    try:
        return toml.load(folder / SCENE)[0]
    except SceneError as error:
        raise SceneError(str(error), field=f"{folder / SCENE}:") from None


def _check_lengths(scene: Scene, rods: tuple[RodHistory, ...], folder: Path) -> None:
    """Tables and scene are of the same rods."""
    for k, (rod, history) in enumerate(zip(scene.rods, rods, strict=True)):
        if abs(history.s[-1] - rod.length) > ROUND_OFF * rod.length:
            wrong = f"must end at the length of rod {k} of the scene, {rod.length} m, got {history.s[-1]} m"
            raise SceneError(wrong, field=str(folder / rod_table(k)))


def _contacts(
    folder: Path, record: dict[str, Any], scene: Scene, t: Array, nodes: tuple[Array, ...]
) -> tuple[ContactHistory, ...]:
    """Tables of all contacts, which go with the record, the scene and its rods; none where none were written."""
    path = folder / RECORD
    told = _taken(record, "contacts", list, path) if "contacts" in record else []
    if not told:
        return ()
    if len(told) != len(scene.walls):
        raise SceneError(f"must have the {len(scene.walls)} contacts of the scene, got {len(told)}", field=str(path))
    found = tuple(read_contact(folder, k, contact, t, nodes) for k, contact in enumerate(scene.walls))
    for k, (contact, entry) in enumerate(zip(found, told, strict=True)):
        where, tables = f"{path}: contacts[{k}]", f"contact-{k}-rod-….csv"
        _check_summary(summarised(contact), weight(contact), entry, where, tables)
    return found


def _meetings(folder: Path, record: dict[str, Any], scene: Scene, t: Array) -> tuple[MeetingHistory, ...]:
    """Tables of all contacts among rods, as `_contacts`."""
    path = folder / RECORD
    told = _taken(record, "meetings", list, path) if "meetings" in record else []
    if not told:
        return ()
    if len(told) != len(scene.meetings):
        wrong = f"must have the {len(scene.meetings)} contacts among rods of the scene, got {len(told)}"
        raise SceneError(wrong, field=str(path))
    found = tuple(read_meeting(folder, k, scene, t) for k in range(len(told)))
    for k, (meeting, entry) in enumerate(zip(found, told, strict=True)):
        sums = spot_sums(meeting)
        most = {name: float(values.max()) for name, values in sums.items()}
        _check_summary(sums, most, entry, f"{path}: meetings[{k}]", meeting_table(k))
    return found


def _check_summary(sums: dict[str, Array], most: dict[str, float], entry: Any, where: str, tables: str) -> None:
    """Record and tables are of the same contact; sums differ by round-off of what they are made of at most."""
    if not isinstance(entry, dict):
        raise SceneError(f"must be a table, got {entry!r}", field=where)
    for name, values in sums.items():
        told = _taken(entry, name, list[float] if values.ndim == 1 else list[list[float]], where)
        try:
            doubles = np.array(told, dtype=np.float64)
            same = doubles.shape == values.shape and bool((np.abs(doubles - values) <= ROUND_OFF * most[name]).all())
        except (ValueError, OverflowError):  # rows of different lengths, numbers beyond doubles
            same = False
        if not same:
            raise SceneError(f"must have the {name} of the tables {tables}, got another", field=where)


def _taken(record: dict[str, Any], name: str, kind: Any, path: Path | str) -> Any:
    """A value that must be there, of its kind."""
    if name not in record:
        raise SceneError(f"must have an entry {name!r}, got none", field=str(path))
    if not _fits(record[name], kind):
        raise SceneError(f"must have another kind of value for {name!r}, got {record[name]!r}", field=str(path))
    return record[name]


def _doubles(record: dict[str, Any], name: str, path: Path) -> Array:
    """A list of numbers."""
    try:
        return np.array(_taken(record, name, list[float], path), dtype=np.float64)
    except OverflowError:
        raise SceneError(f"must have doubles for {name!r}, got larger numbers", field=str(path)) from None


def _ascending(record: dict[str, Any], name: str, path: Path) -> Array:
    """Times, at least one and each later than the one before."""
    times = _doubles(record, name, path)
    if not times.size or not np.isfinite(times).all() or any(b <= a for a, b in pairwise(times)):
        raise SceneError(f"must have ascending times for {name!r}, got {times.tolist()}", field=str(path))
    return times


def _ledger(energy: dict[str, Any], name: str, t: Array, path: Path) -> Array:
    """Energies at the stored times."""
    values = _doubles(energy, name, path)
    if values.shape != t.shape:
        raise SceneError(f"must have an energy {name!r} for each of {len(t)} times, got {len(values)}", field=str(path))
    return values


def _made(kind: Any, values: Any, path: str) -> Any:
    """A flat record of numbers, words and lists of them, from what JSON holds."""
    hints = get_type_hints(kind)
    if not isinstance(values, dict) or not values.keys() <= hints.keys():
        raise SceneError(f"must have the entries {', '.join(hints)}, got {values!r}", field=path)
    for field in fields(kind):
        needed = field.default is MISSING and field.default_factory is MISSING
        if field.name in values and not _fits(values[field.name], hints[field.name]):
            wrong = f"must have another kind of value for {field.name!r}, got {values[field.name]!r}"
            raise SceneError(wrong, field=path)
        if needed and field.name not in values:
            raise SceneError(f"must have an entry {field.name!r}, got none", field=path)
    return kind(**{name: _as(value, hints[name]) for name, value in values.items()})


def _as(value: Any, hint: Any) -> Any:
    """Lists as tuples and whole numbers as doubles where the record has them so."""
    return tuple(value) if get_origin(hint) is tuple else float(value) if hint is float else value


def _fits(value: Any, hint: Any) -> bool:
    """Whether a value of JSON is of a kind: a class, a union, a list or table of one kind."""
    origin, inner = get_origin(hint), get_args(hint)
    if origin is UnionType:
        return any(_fits(value, kind) for kind in inner)
    if origin in (list, tuple):
        return isinstance(value, list) and all(_fits(entry, inner[0]) for entry in value)
    if origin is dict:
        return isinstance(value, dict) and all(_fits(entry, inner[1]) for entry in value.values())
    if hint in (int, float):
        return isinstance(value, int if hint is int else int | float) and not isinstance(value, bool)
    return isinstance(value, hint)
