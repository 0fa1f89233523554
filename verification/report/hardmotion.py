"""Hard cases in motion as a table."""

from __future__ import annotations

from itertools import groupby
from typing import TYPE_CHECKING

from verification.report.tables import Column, Group, Mark, Row, count, ms, scientific, table

if TYPE_CHECKING:
    from collections.abc import Sequence

    from verification.hardmotion import MotionRow

__all__ = ["hard_motions", "verdict_on_motions"]

NUMBER, PROSE = "number", "prose"


def hard_motions(found: Sequence[MotionRow]) -> str:
    """Every hard motion by every model and scheme."""
    columns = (
        Column("motion", kind=PROSE),
        Column("solver"),
        Column("outcome"),
        Column("steps", kind=NUMBER),
        Column("Newton", "iterations", NUMBER),
        Column("cuts", kind=NUMBER),
        Column("ledger", "gap", NUMBER),
        Column("lost", "to the steps", NUMBER),
        Column("most made", "by the steps", NUMBER),
        Column("error", kind=NUMBER),
        Column("against, or why refused", kind=PROSE),
        Column("step", "ms", NUMBER),
    )
    rows: list[Row] = []
    for name, group in groupby(found, key=lambda r: r.group):
        rows.append(Group(name))
        for _, members in groupby(group, key=lambda r: r.case):
            rows += [_row(r, r.title if k == 0 else "") for k, r in enumerate(members)]
    return f"<p>{verdict_on_motions(found)}</p>" + table(columns, rows)


def _row(r: MotionRow, title: str) -> Row:
    """A motion by one model and scheme."""
    good = r.outcome in ("finished", "damped", "swings")
    return (
        title,
        r.solver,
        Mark(good, good=r.outcome, bad=r.outcome, severity="bad" if not r.holds else "slow"),
        count(r.steps),
        count(r.iterations),
        count(r.cuts),
        scientific(r.gap),
        scientific(r.lost),
        scientific(r.gained),
        scientific(r.error),
        r.reason or r.check,
        ms(r.ms),
    )


def verdict_on_motions(found: Sequence[MotionRow]) -> str:
    """How many rows there are of each kind, in a sentence."""
    kinds = ("finished", "damped", "swings", "coarse", "refused", "crawls", "WRONG")
    parts = [f"{sum(r.outcome == kind for r in found)} {kind.lower()}" for kind in kinds]
    return f"{len(found)} rows: {', '.join(parts)}."
