"""Runs sorted by what they share: a setting is a scenario without its kind and its seed, and the model."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from dolfinrod.groove.described import described
from dolfinrod.groove.runs import Run
from dolfinrod.groove.scenario import Scenario

__all__ = ["KINDS", "Setting", "settings"]

# The one that should wind first.
KINDS = ("lateral", "intermediate", "lateral_steep")
# What tells runs of one setting apart.
OWN = ("kind", "seed")


@dataclass(frozen=True)
class Setting:
    """Runs that differ by kind and seed alone.

    Args:
        model: That solved them.
        table: Parameters by dotted names.
        runs: All of them, failed ones included.
        changes: Parameters that differ from those of the first setting, with values there and here.
    """

    model: str
    table: dict[str, Any]
    runs: tuple[Run, ...]
    changes: dict[str, tuple[Any, Any]]

    @property
    def kinds(self) -> tuple[str, ...]:
        """Of the runs that have an end, in the order of `KINDS`."""
        found = {run.kind for run in self.runs if run.failed is None}
        return tuple(kind for kind in KINDS if kind in found)

    def of(self, kind: str) -> tuple[Run, ...]:
        """Runs of one kind that have an end."""
        return tuple(run for run in self.runs if run.kind == kind and run.failed is None)

    def values(self, name: str, kind: str) -> tuple[float, ...]:
        """A number of each run of one kind, those without left out."""
        return tuple(float(value) for run in self.of(kind) if (value := getattr(run, name)) is not None)

    @property
    def words(self) -> str:
        """The model, and how it differs from the first setting."""
        told = [f"{name} {_word(now)}, not {_word(then)}" for name, (then, now) in self.changes.items()]
        return f"{self.model} model" + "".join(f"; {each}" for each in told)


def settings(runs: Sequence[Run]) -> tuple[Setting, ...]:
    """All settings, first the one that most can be said of: both kinds, most runs, nearest to the defaults.

    Args:
        runs: Of a folder.

    Returns:
        Settings; none where there are no runs.
    """
    grouped: dict[str, list[Run]] = {}
    for run in runs:
        grouped.setdefault(repr((run.model, _table(run.scenario))), []).append(run)
    usual = _table(described(Scenario()))
    found = [Setting(group[0].model, _table(group[0].scenario), tuple(group), {}) for group in grouped.values()]

    def rank(setting: Setting) -> tuple[Any, ...]:
        counts = [len(setting.of(kind)) for kind in KINDS[:2]]
        return -min(counts), -sum(counts), len(_changes(usual, setting.table)), setting.words

    found.sort(key=rank)
    return tuple(Setting(s.model, s.table, s.runs, _changes(found[0].table, s.table)) for s in found)


def _table(scenario: dict[str, Any]) -> dict[str, Any]:
    """Parameters by dotted names, without what is each run's own."""
    return {name: value for name, value in _flat(scenario, "") if name not in OWN}


def _flat(value: Any, name: str) -> Iterator[tuple[str, Any]]:
    if isinstance(value, dict):
        for key, entry in value.items():
            inner = f"{name}.{key}" if name else key
            # What kind of part it is stands under the part's own name.
            yield from _flat(entry, (name or inner) if key == "is" else inner)
    else:
        yield name, value


def _changes(then: dict[str, Any], now: dict[str, Any]) -> dict[str, tuple[Any, Any]]:
    """What differs; what a part has that the other lacks goes without saying."""
    names = [name for name in now if name in then] + [name for name in then if name not in now and "." not in name]
    return {name: (then.get(name), now.get(name)) for name in names if then.get(name) != now.get(name)}


def _word(value: Any) -> str:
    return "none" if value is None else f"{value:g}" if isinstance(value, float) else str(value)
