"""What bundles cost: time and memory over the number of fibres in diagrams, and where the time goes in a table."""

from __future__ import annotations

from typing import TYPE_CHECKING

from verification.bundles import FEW, GROWTH, MOST, SAME, BundleRanks, BundleStudy
from verification.report.canvas import Curve, log_log
from verification.report.families import panel
from verification.report.scaling import scalings
from verification.report.tables import Column, Group, Mark, Row, Swatch, count, figure, power, scientific, table
from verification.scaling import EnsembleScaling, Scaling

if TYPE_CHECKING:
    from collections.abc import Sequence

    from verification.bundles import BundleCost

__all__ = ["TITLE", "WORDS", "bundles"]

TITLE = "What bundles cost"
WORDS = (
    "The paper's fibres, free and slightly twisted about an axis as in a yarn, squeezed by a gentle load with friction "
    f"in steps of 1 µs, by more and more of them, each bundle in a process of its own. Growth is the power of the "
    f"number of fibres from {FEW} to {MOST}; the aim is {GROWTH:g} at most. Inner fibres have more neighbours, six, "
    "than those of small bundles, so contacts grow faster than fibres. Seconds are those of the processor: law is "
    "what both models share, where rods touch and what they feel; solver, factors and solutions; the rest, elements. "
    "Memory is the most at any time, less what the program had before."
)
NUMBER = "number"
KINDS = {"discrete": "chord", "continuum": "p3"}


def bundles(found: Sequence[BundleStudy | BundleRanks | Scaling | EnsembleScaling]) -> str:
    """Two diagrams, the table of all runs, and those of ranks."""
    parts, ranks = [], [row for row in found if isinstance(row, BundleRanks)]
    shared = [row for row in found if isinstance(row, (Scaling, EnsembleScaling))]
    studies = [row for row in found if isinstance(row, BundleStudy)]
    if studies:
        lines = " ".join(Swatch(KINDS[s.model], False, f"{s.model}, {s.mesh}").html for s in studies)
        drawn = panel(diagram(studies, "ms", "step [ms]"), "Time") + panel(diagram(studies, "memory", "MB"), "Memory")
        parts += [f'<p class="soft">{lines}. Numbers are growths.</p><div class="panels wide">{drawn}</div>']
        parts += [_costs(studies)]
    if ranks:
        parts += ["<h3>On one rank and on two</h3>", _ranks(ranks)]
    return "\n".join([*parts, *([scalings(shared)] if shared else [])])


def diagram(found: Sequence[BundleStudy], quantity: str, y: str) -> str:
    """A property of the runs over the number of fibres."""
    curves = []
    for study in found:
        rows, growth = [row for row in study.rows if not row.failure], study.slope(quantity)
        curves.append(
            Curve(
                kind=KINDS[study.model],
                x=tuple(float(row.fibres) for row in rows),
                y=tuple(float(getattr(row, quantity)) for row in rows),
                title=f"{study.model}: growth {power(growth)}",
                label="" if growth is None else power(growth),
            )
        )
    return log_log(curves, x="fibres", y=y, alt=f"{y} over the number of fibres")


def _costs(found: Sequence[BundleStudy]) -> str:
    columns = (
        Column("fibres", "", NUMBER),
        Column("steps", "", NUMBER),
        Column("tried in vain", "", NUMBER),
        Column("iterations", "a step", NUMBER),
        Column("factors", "a step", NUMBER),
        Column("spots", "at the end", NUMBER),
        Column("ms", "a step", NUMBER),
        Column("law", "%", NUMBER),
        Column("solver", "%", NUMBER),
        Column("memory", "MB", NUMBER),
        Column(""),
    )
    rows: list[Row] = []
    for study in found:
        growth = ", ".join(f"{name} {power(study.slope(key))}" for name, key in (("time", "ms"), ("memory", "memory")))
        rows.append(Group(f"{study.model}, {study.mesh}: growth of {growth}"))
        rows += [_row(row) for row in study.rows]
    return table(columns, rows)


def _row(row: BundleCost) -> Row:
    if row.failure:
        return (count(row.fibres), *("–",) * 9, Mark(False))
    return (
        count(row.fibres),
        count(row.steps),
        count(row.cuts),
        figure(round(row.iterations / row.steps, 1)),
        figure(round(row.factorizations / row.steps, 2)),
        count(row.spots),
        count(round(row.ms)),
        count(round(100 * row.law / row.seconds)),
        count(round(100 * row.solver / row.seconds)),
        count(round(row.memory)),
        Mark(True),
    )


def _ranks(ranks: Sequence[BundleRanks]) -> str:
    columns = (
        Column("fibres", "", NUMBER),
        Column("mesh"),
        Column("steps", "", NUMBER),
        Column("apart", f"of the length, at most {scientific(SAME, 0)}", NUMBER),
        Column("one rank", "s by the clock", NUMBER),
        Column("two ranks", "s", NUMBER),
        Column("quicker", "times", NUMBER),
        Column(""),
    )
    rows: list[Row] = [
        (
            count(row.fibres),
            row.mesh,
            count(row.steps),
            scientific(row.apart),
            figure(round(row.seconds[0], 1)),
            figure(round(row.seconds[1], 1)),
            figure(round(row.seconds[0] / row.seconds[1], 2)),
            Mark(row.holds),
        )
        for row in ranks
    ]
    return table(columns, rows)
