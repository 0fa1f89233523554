"""Critical loads and frequencies, and what lies below and above them, as tables."""

from __future__ import annotations

from itertools import groupby
from typing import TYPE_CHECKING

from verification.report.misses import verdict
from verification.report.tables import Column, Group, Mark, Row, count, figure, ms, power, scientific, table

if TYPE_CHECKING:
    from collections.abc import Sequence

    from verification.stability import Bracket, EigenStudy

__all__ = ["brackets", "eigenvalues"]

NUMBER = "number"
DASH = "–"


def eigenvalues(studies: Sequence[EigenStudy]) -> str:
    """Critical loads and frequencies against references, a case with its reference above the models."""
    columns = (
        Column("model"),
        Column("elements"),
        Column("found", kind=NUMBER),
        Column("reference", kind=NUMBER),
        Column("modes", kind=NUMBER),
        Column("errors", "coarse to fine", NUMBER),
        Column("order", kind=NUMBER),
        Column("theory", kind=NUMBER),
        Column("finest", "ms", NUMBER),
        Column(""),
    )
    rows: list[Row] = []
    for _, group in groupby(studies, key=lambda s: s.case):
        members = list(group)
        rows.append(Group(heading(members[0])))
        rows += [
            (
                s.model,
                ", ".join(map(count, s.meshes)),
                figure(s.found[-1]),
                figure(s.reference),
                f"{s.multiplicity} of {s.expected}",
                " · ".join(map(scientific, s.errors)),
                power(s.order.observed),
                count(s.order.theory),
                ms(s.ms),
                Mark(s.holds, bad="none found" if s.failure else "missed"),
            )
            for s in members
        ]
    return table(columns, rows)


def heading(study: EigenStudy) -> str:
    """A case, what is sought, where its reference comes from, and what there is to note."""
    note = f" {study.note}" if study.note else ""
    return f"{study.title}: {study.quantity}. Reference: {study.provenance}.{note}"


def brackets(found: Sequence[Bracket]) -> str:
    """Verdicts below and above critical loads."""
    columns = (
        Column("case"),
        Column("model"),
        Column("below"),
        Column("above"),
        Column("directions lost", kind=NUMBER),
        Column("modes", kind=NUMBER),
        Column(""),
    )
    rows = (
        (
            b.title,
            b.model,
            verdict(b.stable[0]),
            verdict(b.stable[1]),
            DASH if b.directions[1] is None else count(b.directions[1]),
            count(b.expected),
            Mark(b.holds, bad="no verdict" if b.failure else "missed"),
        )
        for b in found
    )
    return table(columns, rows)
