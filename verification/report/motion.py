"""The section on motions: errors over time step and wall time, frequencies, what is kept, what a step costs."""

from __future__ import annotations

from html import escape
from itertools import groupby
from typing import TYPE_CHECKING, Any

from verification.motions import swing
from verification.report.canvas import Curve, log_log
from verification.report.motiontables import drifts, fibres, frequencies, paces
from verification.report.tables import Column, Group, Mark, Row, Swatch, count, ms, power, scientific, table

if TYPE_CHECKING:
    from collections.abc import Sequence

    from verification.motion import MotionStudy
    from verification.suite import Report

__all__ = ["TITLES", "WORDS", "contents", "outcomes"]

TITLES = {"motion": "Motion"}
WORDS = {
    "motion": "Rods in motion by implicit Euler (both models) and by the midpoint rule (continuum model), against "
    "closed forms, spectral and method-of-lines solutions. To see: errors of implicit Euler fall with the time step, "
    "those of the midpoint rule with its square, and both models lie on one line where steps are all that is wrong.",
}
NUMBER = "number"
LOWEST = 1e-12
# Line of each scheme in the diagrams.
KINDS = {"continuum midpoint": "p4", "continuum Euler": "p1", "discrete Euler": "chord"}
SWING_ERROR, SWING_AIM = 1e-3, 0.3


def contents(report: Report) -> dict[str, str]:
    """The section, left out where nothing was moved."""
    parts = [
        ("Errors against time step and time", diagrams(report.moved) + studies(report.moved) if report.moved else ""),
        ("Frequencies of small vibrations", frequencies(report.frequencies) if report.frequencies else ""),
        ("What a free flying rod keeps", drifts(report.drifts) if report.drifts else ""),
        ("The paper's fibre", fibres(report.fibres) if report.fibres else ""),
        ("Milliseconds a step", paces(report.paces) + seconds(report.moved) if report.paces else ""),
    ]
    shown = "".join(f"<h3>{title}</h3>{text}" for title, text in parts if text)
    return {"motion": shown} if shown else {}


def outcomes(report: Report) -> tuple[tuple[str, Sequence[Any], str], ...]:
    """Section, rows, and what it says of them that they hold."""
    rows = (*report.moved, *report.frequencies, *report.drifts, *report.fibres)
    return (("motion", rows, "motions within their limits, with the order of the scheme where it shows"),)


def diagrams(found: Sequence[MotionStudy]) -> str:
    """A pair of panels for every case that is taken in steps of several lengths."""
    panels = []
    for (_, title), group in groupby(found, key=lambda s: (s.case, s.title)):
        members = [s for s in group if len(s.records) > 1]
        if members:
            drawn = panel(f"{title}: over time step", over_step(members, title))
            drawn += panel("The same over wall time", over_time(members, title))
            panels.append(f'<div class="panels wide">{drawn}</div>')
    legend = " ".join(Swatch(kind, False, name).html for name, kind in KINDS.items())
    note = "Numbers are observed orders, the dotted line to one has the slope of theory."
    return f'<p class="soft">{legend}. {note}</p>{"".join(panels)}'


def panel(title: str, drawing: str) -> str:
    """A small figure."""
    return f"<figure><figcaption>{escape(title)}</figcaption>{drawing}</figure>"


def over_step(members: Sequence[MotionStudy], title: str) -> str:
    """Errors over the length of the steps."""
    return log_log(
        [curve(s, [r.dt for r in s.records], labelled=True) for s in members],
        x="time step [s]",
        y="relative error",
        alt=f"{title}: relative error over the time step",
    )


def over_time(members: Sequence[MotionStudy], title: str) -> str:
    """Errors over the wall time of all steps."""
    return log_log(
        [curve(s, [r.ms for r in s.records], labelled=False) for s in members],
        x="all steps, warm, one thread [ms]",
        y="relative error",
        alt=f"{title}: relative error over milliseconds",
    )


def curve(study: MotionStudy, across: list[float], *, labelled: bool) -> Curve:
    """A study as a line."""
    points = [(x, max(r.error, LOWEST)) for x, r in zip(across, study.records, strict=True) if not r.failure]
    shown = labelled and study.ordered and study.order is not None
    return Curve(
        kind=KINDS.get(study.model, "paper"),
        x=tuple(x for x, _ in points),
        y=tuple(y for _, y in points),
        title=f"{study.model}, {study.mesh}: order {power(study.order)}, by theory {study.theory}",
        label=power(study.order) if shown else "",
        theory=float(study.theory) if shown else None,
    )


def studies(found: Sequence[MotionStudy]) -> str:
    """Every case by every model."""
    columns = (
        Column("model"),
        Column("mesh"),
        Column("steps"),
        Column("errors", "long to short steps"),
        Column("order", "(theory)", NUMBER),
        Column("error without steps", "(extrapolated)", NUMBER),
        Column("limit", kind=NUMBER),
        Column("a step", "ms, finest", NUMBER),
        Column(""),
    )
    rows: list[Row] = []
    for _, group in groupby(found, key=lambda s: s.case):
        members = list(group)
        rows.append(Group(members[0].title))
        rows += [study_row(s) for s in members]
    return table(columns, rows) + references(found)


def study_row(s: MotionStudy) -> Row:
    """One model."""
    finest = s.records[-1]
    failures = [r.failure for r in s.records if r.failure]
    return (
        s.model,
        s.mesh,
        ", ".join(count(r.steps) for r in s.records),
        ", ".join(scientific(r.error) for r in s.records),
        f"{power(s.order)} ({s.theory})" if s.ordered else power(s.order),
        scientific(s.rest),
        scientific(s.limit, 0),
        ms(finest.ms / finest.steps),
        Mark(s.holds, bad=failures[0] if failures else "missed"),
    )


def references(found: Sequence[MotionStudy]) -> str:
    """Of every case, what is read off, where its reference comes from, and what there is to note."""
    items = []
    for _, group in groupby(found, key=lambda s: s.case):
        s = next(group)
        note = f" {s.note}" if s.note else ""
        words = f"{s.title}: {s.quantity}. Reference: {s.provenance}; {s.digits} digits trusted.{note}"
        items.append(f"<li>{escape(words)}</li>")
    return f"<details><summary>Quantities, references and notes</summary><ul>{''.join(items)}</ul></details>"


def seconds(found: Sequence[MotionStudy]) -> str:
    """The swinging rod's seconds per simulated second at the error that is aimed at."""
    reached = [
        (1e-3 * r.ms / s.seconds, s.model, s.mesh, r)
        for s in found
        if s.case == swing.SWING.name
        for r in s.records
        if r.error <= SWING_ERROR
    ]
    if not reached:
        return ""
    taken, model, mesh, r = min(reached, key=lambda one: one[0])
    words = f"{taken:.2g} s per simulated second by {model}, {mesh}, in {r.steps} steps, error {scientific(r.error)}"
    aim = f"the aim is {SWING_AIM:g} s, {taken / SWING_AIM:.2g} times that"
    return f'<p class="soft">Swinging rod in space to {scientific(SWING_ERROR, 0)}: {words}; {aim}.</p>'
