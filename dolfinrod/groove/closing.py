"""What an ensemble has found, in sentences that are made from its numbers."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby
from math import comb

import numpy as np

from dolfinrod.groove.comparison import difference, measured
from dolfinrod.groove.ensemble import Ensemble
from dolfinrod.groove.measures import CROSSED
from dolfinrod.groove.rows import flat, units
from dolfinrod.groove.runs import Run
from dolfinrod.groove.statistics import Interval, of_mean, welch
from dolfinrod.groove.tables import Measure

__all__ = ["Group", "closing", "groups"]

# What tells runs of a group apart, or is told anyway.
TOLD = ("seed", "kind")


@dataclass(frozen=True)
class Group:
    """Runs that differ by their seeds alone.

    Args:
        kind: Of groove.
        others: What tells it from other groups besides, the model first, in words.
        runs: Failed ones included.
    """

    kind: str
    others: str
    runs: tuple[Run, ...]

    @property
    def finished(self) -> tuple[Run, ...]:
        """Runs that have an end."""
        return tuple(run for run in self.runs if run.failed is None)

    def values(self, name: str) -> list[float]:
        """A number of each finished run that has it."""
        found = [getattr(run, name) for run in self.finished]
        return [float(value) for value in found if value is not None]


def closing(found: Ensemble) -> tuple[str, ...]:
    """Sentences on every group of runs, and on lateral against intermediate where both are there.

    Args:
        found: Runs.

    Returns:
        A line each.
    """
    several = groups(found)
    lines = [_told(group) for group in several]
    for _, pair in groupby(sorted(several, key=lambda group: group.others), key=lambda group: group.others):
        by_kind = {group.kind: group for group in pair}
        if {"lateral", "intermediate"} <= by_kind.keys():
            lines += _verdict(by_kind["lateral"], by_kind["intermediate"])
    return tuple(lines)


def groups(found: Ensemble) -> tuple[Group, ...]:
    """Runs by everything but their seeds, in the order in which they were asked for."""
    sorted_out: dict[str, list[Run]] = {}
    for run in found.runs:
        name = json.dumps([run.model, {**run.scenario, "seed": None}], sort_keys=True)
        sorted_out.setdefault(name, []).append(run)
    first = [runs[0] for runs in sorted_out.values()]
    tables = [dict(flat(run.scenario)) for run in first]
    # What differs between kinds of groove alone belongs to them, such as where their fibres begin.
    differ = [name for name in dict.fromkeys(name for table in tables for name in table) if _varies(tables, name)]
    return tuple(
        Group(run.kind, ", ".join([run.model, *_differences(table, differ)]), tuple(runs))
        for run, table, runs in zip(first, tables, sorted_out.values(), strict=True)
    )


def _varies(tables: Sequence[Mapping[str, object]], name: str) -> bool:
    """Whether a parameter differs among groups of one kind."""
    values = {(table["kind"], table.get(name)) for table in tables}
    return name not in TOLD and len(values) > len({kind for kind, _ in values})


def _differences(table: Mapping[str, object], names: Sequence[str]) -> Iterator[str]:
    """Parameters with their values, in everyday units."""
    unit = units()
    for name in names:
        value = table.get(name)
        measure = Measure(unit[name].replace("²", "**2")) if name in unit and isinstance(value, float) else None
        yield f"{name} {value if measure is None else measure.write(value, name)}"


def _told(group: Group) -> str:
    """How many runs of a group ended, and how."""
    name, done = f"{group.kind}, {group.others}", group.finished
    count = f"{name}: {len(done)} of {_counted(len(group.runs), 'run')} finished"
    if not done:
        return f"{count}."
    fibres = len(done[0].winding)
    crossed, wound, width = (group.values(each) for each in ("T_crossed", "wound", "width"))
    edge = int(sum(group.values("edge_crosses")))
    of_pairs = f"{np.mean(wound):.1f} of {_counted(comb(fibres, 2), 'pair')} wind by {CROSSED} turns or more"
    said = [f"crossings twist the bundle by {_mean(crossed)} turns/m", of_pairs] if crossed else [of_pairs]
    if fibres > 1:
        said.append(f"fibre {fibres} crosses fibre {fibres - 1} in {edge} of {_counted(len(done), 'run')}")
    return f"{count}; {', '.join(said)}; the bundle is {1e3 * float(np.mean(width)):.3g} mm wide."


def _verdict(lateral: Group, intermediate: Group) -> list[str]:
    """Lateral against intermediate, beside the yarns."""
    name, yarns = f"lateral against intermediate, {lateral.others}", measured().comparison.difference
    a, b = lateral.values("T_crossed"), intermediate.values("T_crossed")
    if min(len(a), len(b)) < 2:
        return [f"{name}: too few runs for a verdict, at least two of each are needed."]
    apart, p = _difference(a, b)
    by = "have more twist" if apart.low > 0.0 else "have less twist" if apart.high < 0.0 else ""
    found = f"lateral bundles {by}" if by else "the simulated bundles show no difference in twist beyond chance"
    agrees = "meets" if apart.meets(yarns) else "does not meet"
    wound = [group.values("wound") for group in (lateral, intermediate)]
    more, p_wound = _difference(*wound)
    surely = "more" if more.low > 0.0 else "fewer" if more.high < 0.0 else "neither surely more nor fewer"
    return [
        f"{name}: {found}: {_interval(apart)} turns/m, {p}; the yarns of Table 1 differ by {_interval(yarns)}, "
        f"an interval which this one {agrees}.",
        f"{name}: {surely} pairs wind in the lateral groove: {np.mean(wound[0]):.1f} against {np.mean(wound[1]):.1f}, "
        f"{p_wound}.",
        "A few fibres over a few milliseconds are no yarn: only the sign of a difference can be compared.",
    ]


def _difference(a: Sequence[float], b: Sequence[float]) -> tuple[Interval, str]:
    """Of the means, by Welch's test, which needs some scatter."""
    if np.ptp(a) == np.ptp(b) == 0.0:
        return difference(a, b), "no run differs from another of its groove"
    return difference(a, b), f"{welch(a, b).printed_p} (Welch)"


def _mean(values: Sequence[float]) -> str:
    """With its interval where there is one."""
    return _interval(of_mean(values)) if len(values) > 1 else f"{values[0]:+.1f}"


def _interval(found: Interval) -> str:
    return f"{found.value:+.1f} ({found.low:.1f} to {found.high:.1f})"


def _counted(n: int, word: str) -> str:
    return f"{n} {word}" if n == 1 else f"{n} {word}s"
