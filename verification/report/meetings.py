"""Rods on rods: both models beside the reference, then errors over levels and over time as of rods on surfaces."""

from __future__ import annotations

from itertools import groupby
from typing import TYPE_CHECKING

from verification.meetings import CASES
from verification.report.contact import contact_cases
from verification.report.tables import Column, Group, Mark, Row, figure, ms, scientific, table

if TYPE_CHECKING:
    from collections.abc import Sequence

    from verification.contact import ContactStudy

__all__ = ["TITLE", "WORDS", "meeting_cases"]

TITLE = "Rods on rods"
WORDS = (
    "Rods that press, turn, squeeze and hit one another, by both models beside answers that neither has a part in: "
    "pairs of elasticas by collocation and by SciPy's shooting, an even helix by algebra, circles in a groove, rolling "
    "and impacts in closed form. First what either finds on its finest level, side by side; then errors over levels "
    "and over time. Lifts and forces of crossed rods must come within 1e-3 and converge."
)
NUMBER, PROSE = "number", "prose"
# Numbers of a case in the table side by side; what there are more of is in the errors.
SHOWN = 5


def meeting_cases(found: Sequence[ContactStudy]) -> str:
    """All of it."""
    return _beside(found) + contact_cases(found)


def _beside(found: Sequence[ContactStudy]) -> str:
    """What is read off on the finest level, under the reference."""
    columns = (
        Column("by"),
        Column("on"),
        Column("found", kind=PROSE),
        Column("error", kind=NUMBER),
        Column("one solve", "ms", NUMBER),
        Column(""),
    )
    known = {case.name: case for case in CASES}
    rows: list[Row] = []
    for name, group in groupby(found, key=lambda s: s.case):
        studies = list(group)
        rows.append(Group(f"{studies[0].title}: {studies[0].quantity}"))
        if name in known:
            rows.append(("reference", "", _numbers(known[name].reference.value), "–", "–", ""))
        rows += [_row(study) for study in studies]
    return table(columns, rows)


def _row(study: ContactStudy) -> Row:
    """A model on its finest level."""
    last = study.records[-1]
    where = f"{study.label}, {last.level} {study.unit}"
    return (
        study.model,
        where,
        _numbers(last.found),
        scientific(last.error),
        ms(last.ms),
        Mark(study.holds, bad="no solution" if last.failure else "missed"),
    )


def _numbers(values: Sequence[float]) -> str:
    """The first of them."""
    more = ", …" if len(values) > SHOWN else ""
    return ", ".join(figure(value) for value in values[:SHOWN]) + more
