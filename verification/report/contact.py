"""Rods on surfaces with known answers: errors over levels and over time, and a table of limits and orders."""

from __future__ import annotations

from html import escape
from itertools import groupby
from typing import TYPE_CHECKING

from verification.report.canvas import Curve, log_log
from verification.report.tables import Column, Group, Mark, Row, Swatch, count, ms, power, scientific, table

if TYPE_CHECKING:
    from collections.abc import Sequence

    from verification.contact import ContactStudy

__all__ = ["TITLE", "WORDS", "contact_cases"]

TITLE = "Contact cases"
WORDS = (
    "Rods on rigid surfaces with known answers, by both models on finer and finer levels. To see: closed forms are met "
    "to round-off where no mesh enters, and with the order of the model where one does; a stated limit holds on the "
    "last level, a stated order between the last two. Seconds are those of the stepping, warm, one thread."
)
NUMBER, PROSE = "number", "prose"
LOWEST = 1e-16
# Lines of the models, one a run of the same model.
KINDS = {"continuum": ("p4", "p3", "p5", "p2"), "discrete": ("chord", "paper", "p1")}
# Levels, and error of the coarsest, from which a picture says more than the table.
ENOUGH, WORTH = 3, 1e-10
# Least order that a picture names: errors that grow are round-off.
LEAST_NAMED = 0.01


def contact_cases(found: Sequence[ContactStudy]) -> str:
    """Diagrams of what converges, and every case in the table."""
    panels = []
    for (_, title), group in groupby(found, key=lambda s: (s.case, s.title)):
        members = [s for s in group if len(s.records) >= ENOUGH and max(_errors(s), default=0.0) > WORTH]
        if members:
            unit = "levels" if len({s.unit for s in members}) > 1 else members[0].unit
            drawn = _figure(title, _drawn(members, unit, title, timed=False))
            drawn += _figure("The same over wall time", _drawn(members, "stepping [ms]", title, timed=True))
            panels.append(f'<div class="panels wide">{drawn}</div>')
    lines = " ".join(Swatch(kinds[0], False, model).html for model, kinds in KINDS.items())
    note = "Numbers are observed orders; further lines of a model are other settings, named by the pointer."
    return f'<p class="soft">{lines}. {note}</p>{"".join(panels)}{_table(found)}{_references(found)}'


def _errors(study: ContactStudy) -> list[float]:
    """Of the levels with a solution."""
    return [r.error for r in study.records if not r.failure]


def _figure(title: str, drawing: str) -> str:
    """A small figure."""
    return f"<figure><figcaption>{escape(title)}</figcaption>{drawing}</figure>"


def _drawn(members: Sequence[ContactStudy], x: str, title: str, *, timed: bool) -> str:
    """Errors of the runs of a case over their levels or over milliseconds."""
    curves, used = [], dict.fromkeys(KINDS, 0)
    for s in members:
        good = [r for r in s.records if not r.failure]
        kinds = KINDS[s.model]
        kind, used[s.model] = kinds[used[s.model] % len(kinds)], used[s.model] + 1
        curves.append(
            Curve(
                kind=kind,
                x=tuple(r.ms if timed else float(r.level) for r in good),
                y=tuple(max(r.error, LOWEST) for r in good),
                title=f"{s.model}, {s.label}: order {power(s.order)}",
                label="" if timed or s.order is None or s.order < LEAST_NAMED else power(s.order),
            )
        )
    return log_log(curves, x=x, y="relative error", alt=f"{title}: relative error over {x}")


def _table(found: Sequence[ContactStudy]) -> str:
    """Every case by every run."""
    columns = (
        Column("model"),
        Column("solved by", kind=PROSE),
        Column("levels"),
        Column("errors", "coarse to fine"),
        Column("order", "(least)", NUMBER),
        Column("limit", "on the last", NUMBER),
        Column("iterations", "a step, most", NUMBER),
        Column("cuts", "all", NUMBER),
        Column("last level", "s", NUMBER),
        Column(""),
    )
    rows: list[Row] = []
    for (_, title), group in groupby(found, key=lambda s: (s.case, s.title)):
        rows.append(Group(title))
        rows += [_row(s) for s in group]
    return table(columns, rows)


def _row(s: ContactStudy) -> Row:
    """One run."""
    missed = [r.missed for r in s.records if r.missed]
    order = power(s.order) if s.least is None else f"{power(s.order)} ({s.least:g})"
    return (
        s.model,
        s.label,
        f"{', '.join(count(r.level) for r in s.records)} {s.unit}",
        ", ".join(scientific(r.error) for r in s.records),
        order,
        scientific(s.limit, 0),
        f"{max(r.a_step for r in s.records):.1f}",
        count(sum(r.cuts for r in s.records)),
        ms(1e-3 * s.records[-1].ms),
        Mark(s.holds, bad=missed[0] if missed else "missed"),
    )


def _references(found: Sequence[ContactStudy]) -> str:
    """Of every case, what is read off, where its reference comes from, and what there is to note."""
    items = []
    for _, group in groupby(found, key=lambda s: s.case):
        s = next(group)
        note = f" {s.note}" if s.note else ""
        words = f"{s.title}: {s.quantity}. Reference: {s.provenance}; {s.digits} digits trusted.{note}"
        items.append(f"<li>{escape(words)}</li>")
    return f"<details><summary>What is read off, and the references</summary><ul>{''.join(items)}</ul></details>"
