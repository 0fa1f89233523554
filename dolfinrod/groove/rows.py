"""Runs as rows of a table: every parameter and every measure of each, with their units."""

from __future__ import annotations

import csv
import io
import json
import os
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import fields
from pathlib import Path

from dolfinrod.groove.parameters import UNIT, meanings, parameters
from dolfinrod.groove.runs import Run

__all__ = ["flat", "rows", "units", "write_rows"]

CSV, JSON = "runs.csv", "runs.json"
# Of a run: what is a column by itself, and what is none.
NAMED, LEFT_OUT = ("key", "model", "kind", "seed"), ("scenario", "winding")
Cell = float | int | str | bool | None


def rows(runs: Iterable[Run]) -> list[dict[str, Cell]]:
    """Parameters and measures of runs.

    Args:
        runs: Any, failed ones included.

    Returns:
        A table a run, all with the same names: those of the run, then parameters, then measures; None where a run has
        no such parameter, or failed.
    """
    measures = [field.name for field in fields(Run) if field.name not in (*NAMED, *LEFT_OUT)]
    told = [(run, dict(flat(run.scenario))) for run in runs]
    names = list(dict.fromkeys(name for _, table in told for name in table if name not in NAMED))
    return [
        {name: getattr(run, name) for name in NAMED}
        | {name: table.get(name) for name in names}
        | {name: _measured(run, name) for name in measures}
        for run, table in told
    ]


def units() -> dict[str, str]:
    """Unit of each parameter and measure that has one."""
    marked = {name: UNIT.search(words) for name, words in meanings(Run).items()}
    measures = {name: unit.group(1) for name, unit in marked.items() if unit is not None}
    return {parameter.name: parameter.unit for parameter in parameters() if parameter.unit} | measures


def write_rows(runs: Iterable[Run], folder: str | os.PathLike[str]) -> tuple[Path, Path]:
    """Write the rows, as CSV with the units in its head and as JSON.

    Args:
        runs: Any.
        folder: Where to.

    Returns:
        Both files.
    """
    table, unit = rows(runs), units()
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([f"{name} [{unit[name]}]" if name in unit else name for name in (table[0] if table else ())])
    writer.writerows(row.values() for row in table)
    paths = Path(folder) / CSV, Path(folder) / JSON
    listed = json.dumps({"units": unit, "runs": table}, indent=1, ensure_ascii=False)
    for path, content in zip(paths, (text.getvalue(), listed), strict=True):
        path.write_text(content, encoding="utf-8")
    return paths


def flat(table: Mapping[str, object], path: str = "") -> Iterator[tuple[str, Cell]]:
    """Names with dots, and values, of a scenario as `described`: a part is told by its kind, then by its fields."""
    for name, value in table.items():
        if isinstance(value, Mapping):
            yield path + name, str(value["is"])
            yield from flat({k: v for k, v in value.items() if k != "is"}, f"{path}{name}.")
        elif name != "is":
            yield path + name, value if isinstance(value, Cell) else json.dumps(value)


def _measured(run: Run, name: str) -> Cell:
    """A measure of a run that has an end."""
    value: Cell = getattr(run, name)
    return value if run.failed is None or name in ("failed", "t", "seconds") else None
