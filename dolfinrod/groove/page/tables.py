"""Every number that the report draws, as CSV with units in its first line, and all together as JSON."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from dataclasses import asdict
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np

from dolfinrod.groove.comparison import measured
from dolfinrod.groove.film import Film
from dolfinrod.groove.page.show import Show
from dolfinrod.groove.runs import Run
from dolfinrod.versions import versions

__all__ = ["write_tables"]

FORMAT = "dolfinrod groove report 1"
RUN = (
    "key", "kind", "seed", "model", "failed", "t [s]", "T_crossed [turns/m]", "T_pair [turns/m]", "wound [pairs]",
    "edge_crosses", "crossings", "width [m]", "seconds [s]",
)  # fmt: skip
ALONG = ("X_begin [m]", "X_end [m]", "T_pairs [turns/m]", "width [m]", "tension [N]", "walls [N/m]", "fibres [N/m]")
COURSE = {
    "t": "t [s]", "width": "width [m]", "T_pair": "T_pair [turns/m]", "wound": "wound [turns]", "walls": "walls [N]",
    "fibres": "fibres [N]", "speed": "speed [m/s]",
}  # fmt: skip
CROSSINGS = ("t [s]", "fibre", "other", "over", "X [m]", "sign")
SECTIONS = ("t [s]", "fibre", "s [m]", "X [m]", "Y [m]", "Z [m]", "tension [N]", "walls [N/m]")
WHOSE = ("kind", "seed", "run")

Table = tuple[tuple[str, ...], list[tuple[Any, ...]]]


def write_tables(show: Show, folder: Path) -> None:
    """Write `runs.csv`, `along.csv`, `course.csv`, `crossings.csv`, `sections.csv`, `energy.csv`, `groove.json`.

    Fibres are numbered from 1 on, from the right to the left. What is not known is empty in CSV, null in JSON.

    Args:
        show: What the report shows.
        folder: Made where it does not exist.
    """
    folder.mkdir(parents=True, exist_ok=True)
    tables = _tables(show)
    for name, (heads, rows) in tables.items():
        lines = [",".join(heads), *(",".join(_cell(value) for value in row) for row in rows)]
        (folder / f"{name}.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
    record = {
        "format": FORMAT,
        "versions": versions(),
        "measured": asdict(measured()),
        "acceptance": [{**asdict(row), "outcome": row.outcome} for row in show.judged],
        "settings": [
            {"model": s.model, "changes": s.changes, "runs": [run.key for run in s.runs]} for s in show.settings
        ],
        "parameters": show.base.table,
        "runs": [asdict(run) for run in show.runs],
        "tables": {name: {"columns": heads, "rows": rows} for name, (heads, rows) in tables.items() if name != "runs"},
    }
    text = json.dumps(_plain(record), ensure_ascii=False, allow_nan=False)
    (folder / "groove.json").write_text(text + "\n", encoding="utf-8")


def _tables(show: Show) -> dict[str, Table]:
    """By the names of their files; nodes in space of the runs alone that are shown by themselves."""
    filmed = [
        (run, film) for kind, films in show.films.items() for run, film in zip(show.base.of(kind), films, strict=True)
    ]
    alone = list(show.shown.values())
    energies = list(dict.fromkeys(name for _, film in filmed for name in film.energy))
    return {
        "runs": (RUN, [_run(run) for run in show.runs]),
        "along": ((*WHOSE, *ALONG), _rows(filmed, _along)),
        "course": ((*WHOSE, *COURSE.values()), _rows(filmed, _course)),
        "crossings": ((*WHOSE, *CROSSINGS), _rows(filmed, _crossings)),
        "sections": ((*WHOSE, *SECTIONS), _rows(alone, _nodes)),
        "energy": (
            (*WHOSE, "t [s]", *(f"{name} [J]" for name in energies)),
            [(*_whose(run), *row) for run, film in filmed for row in _energy(film, energies)],
        ),
    }


def _rows(filmed: Sequence[tuple[Run, Film]], of: Any) -> list[tuple[Any, ...]]:
    return [(*_whose(run), *row) for run, film in filmed for row in of(film)]


def _whose(run: Run) -> tuple[str, int, str]:
    return run.kind, run.seed, run.key


def _run(run: Run) -> tuple[Any, ...]:
    return (
        run.key, run.kind, run.seed, run.model, run.failed or "", run.t, run.T_crossed, run.T_pair, run.wound,
        run.edge_crosses, run.crossings, run.width, run.seconds,
    )  # fmt: skip


def _along(film: Film) -> Iterator[tuple[float, ...]]:
    """Of the last frame."""
    X = film.X[-1]
    yield from zip(X[:-1].tolist(), X[1:].tolist(), film.T[-1].tolist(), *film.along[-1].tolist(), strict=True)


def _course(film: Film) -> Iterator[tuple[float, ...]]:
    yield from zip(*(film.course[name].tolist() for name in COURSE), strict=True)


def _crossings(film: Film) -> Iterator[tuple[Any, ...]]:
    for frame, k, l, over, X, sign in film.crossed.tolist():
        yield film.times[int(frame)], int(k) + 1, int(l) + 1, int(over) + 1, X, int(sign)


def _nodes(film: Film) -> Iterator[tuple[Any, ...]]:
    """Of the first and the last frame."""
    for frame in (0, -1):
        for k, r in enumerate(film.paths[frame]):
            pull, pressed = film.pull[frame, k], film.pressed[frame, k]
            for s, place, n, p in zip(film.s.tolist(), r.tolist(), pull.tolist(), pressed.tolist(), strict=True):
                yield film.times[frame], k + 1, s, *place, n, p


def _energy(film: Film, names: Sequence[str]) -> Iterator[tuple[float, ...]]:
    t = film.course["t"]
    columns = [film.energy.get(name, np.full(len(t), np.nan)) for name in names]
    yield from zip(t.tolist(), *(values.tolist() for values in columns), strict=True)


def _cell(value: Any) -> str:
    """Digits that read back to the same double; words in quotes where they need them."""
    if value is None or (isinstance(value, float) and not isfinite(value)):
        return ""
    if isinstance(value, float):
        return f"{float(value):.17g}"
    text = str(value)
    return '"' + text.replace('"', '""') + '"' if any(mark in text for mark in ',"\n') else text


def _plain(value: Any) -> Any:
    """The same with null for every number that JSON cannot hold."""
    if isinstance(value, dict):
        return {key: _plain(entry) for key, entry in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(entry) for entry in value]
    if isinstance(value, float):
        return float(value) if isfinite(value) else None
    return value
