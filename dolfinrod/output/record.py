"""A result as files: tables, a series for ParaView, the scene, and the record that names them all."""

from __future__ import annotations

import json
import re
from dataclasses import asdict
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from dolfinrod.output.arrays import write_arrays
from dolfinrod.output.contacts import write_contacts
from dolfinrod.output.meetings import write_meetings, write_spots
from dolfinrod.output.surfaces import write_surfaces
from dolfinrod.output.table import write_table
from dolfinrod.output.vtk import write_series
from dolfinrod.scene import SceneError, toml
from dolfinrod.versions import versions

if TYPE_CHECKING:
    from dolfinrod.result import NotConverged, Result

__all__ = ["FORMAT", "RECORD", "SCENE", "STATE", "rod_table", "versions", "write"]

FORMAT = "dolfinrod result 1"
RECORD, SCENE, STATE = "result.json", "scene.toml", "state.npz"
# Names that a result gives to files, and so may take away again.
OURS = re.compile(
    r"rod-\d+\.csv|contact-\d+-rod-\d+\.csv|meeting-\d+\.csv|(rods|meetings)-\d+\.vtu|surface-\d+(-\d+)?\.vtu"
    r"|(rods|surfaces|meetings)\.pvd|scene\.toml|state\.npz"
)


def write(result: Result, folder: Path, *, failure: NotConverged | None = None) -> None:
    """Leave a result in a folder, replacing what an earlier result left there.

    `result.json` is the record, `rod-0.csv`, … the arrays along the rods, `rods.pvd` with `rods-0000.vtu`, … the same
    for ParaView, `scene.toml` the scene where a file can hold it, `state.npz` what a later solve can go on from. Of
    scenes with contacts there are also `contact-0-rod-0.csv`, … and, for ParaView, what is touched: `surfaces.pvd` with
    `surface-0.vtu`, …; where rods may touch one another `meeting-0.csv`, … and `meetings.pvd` with its
    `meetings-0000.vtu`, …. Every number is written with the digits that read back to the same double. Each file appears
    complete, the record last, so that several ranks may write the same result at the same time.

    Args:
        result: What was found.
        folder: Made where it does not exist.
        failure: Why the end was not reached.
    """
    folder.mkdir(parents=True, exist_ok=True)
    with TemporaryDirectory(prefix=".result-", dir=folder) as name:
        draft = Path(name)
        record = _record(result, failure) | _write_scene(result, draft)
        record |= write_contacts(result, draft) | write_meetings(result, draft)
        for k, rod in enumerate(result.rods):
            write_table(draft / rod_table(k), result.t, rod)
        write_series(result, draft)
        write_surfaces(result, draft)
        write_spots(result, draft)
        write_arrays(draft / STATE, result.state)
        made = sorted(path.name for path in draft.iterdir())
        text = json.dumps(record | {"files": made}, indent=2, ensure_ascii=False)
        (draft / RECORD).write_text(text + "\n", encoding="utf-8")
        for former in _files_of(folder / RECORD) - set(made):
            (folder / former).unlink(missing_ok=True)
        for file in (*made, RECORD):
            (draft / file).replace(folder / file)


def rod_table(k: int) -> str:
    """File name of the table of rod k."""
    return f"rod-{k}.csv"


def _write_scene(result: Result, folder: Path) -> dict[str, Any]:
    """Write the scene where TOML can hold it; what the record says of it."""
    try:
        text = toml.dumps(result.scene)
    except SceneError as error:
        return {"scene": None, "scene_not_written": str(error)}
    (folder / SCENE).write_text(text, encoding="utf-8")
    return {"scene": SCENE}


def _files_of(record: Path) -> set[str]:
    """Files that an earlier result left in a folder, none where its record cannot be read."""
    try:
        files = json.loads(record.read_text(encoding="utf-8"))["files"]
        return {name for name in files if OURS.fullmatch(name)}
    except (OSError, ValueError, RecursionError, LookupError, TypeError):
        return set()


def _record(result: Result, failure: NotConverged | None) -> dict[str, Any]:
    """Everything of a result but the arrays along the rods."""
    record = {
        "format": FORMAT,
        "converged": result.converged,
        "tip": result.tip.tolist(),
        "t": result.t.tolist(),
        "log": [asdict(step) for step in result.log],
        "energy": {name: values.tolist() for name, values in result.energy.items()},
        "statistics": asdict(result.statistics),
        "formulation": asdict(result.formulation),
        "versions": versions(),
    }
    if failure is not None:
        record["failure"] = {
            "t": failure.t,
            "step": failure.step,
            "reason": failure.reason,
            "advice": failure.advice,
        }
    return record
