"""Hard cases of contact as a table."""

from __future__ import annotations

from itertools import groupby
from typing import TYPE_CHECKING

from verification.contact import MOST_ITERATIONS
from verification.report.tables import Column, Group, Mark, Row, count, ms, scientific, table

if TYPE_CHECKING:
    from collections.abc import Sequence

    from verification.hardcontact import ContactRow

__all__ = ["TITLE", "WORDS", "hard_contacts", "verdict_on_contacts"]

TITLE = "Hard cases of contact"
WORDS = (
    "Contacts that solvers stumble over, default settings, nothing tuned: every end is held against a closed form, the "
    "other model on twice the elements, or another way through the loads. Elsewhere: another equilibrium, which the "
    "solver itself calls unstable. Deepest: how far rods came into one another at stored times, over the sum of their "
    "radii. Missed is another end without that warning, a motion "
    f"whose steps mostly fail, a refusal without a reason, and more than {MOST_ITERATIONS:g} Newton iterations a step "
    "on average, those of failed attempts included."
)
NUMBER, PROSE = "number", "prose"


def hard_contacts(found: Sequence[ContactRow]) -> str:
    """Every hard contact by every model and scheme."""
    columns = (
        Column("contact", kind=PROSE),
        Column("solver"),
        Column("outcome"),
        Column("steps", kind=NUMBER),
        Column("iterations", "a step", NUMBER),
        Column("cuts", kind=NUMBER),
        Column("error", kind=NUMBER),
        Column("deepest", "radii", NUMBER),
        Column("against, or why not", kind=PROSE),
        Column("all steps", "ms", NUMBER),
    )
    rows: list[Row] = []
    for name, group in groupby(found, key=lambda r: r.group):
        rows.append(Group(name))
        for _, members in groupby(group, key=lambda r: r.case):
            rows += [_row(r, r.title if k == 0 else "") for k, r in enumerate(members)]
    return f"<p>{verdict_on_contacts(found)}</p>" + table(columns, rows)


def _row(r: ContactRow, title: str) -> Row:
    """A contact by one model and scheme."""
    slow = r.outcome == "converged" and not r.holds
    mark = Mark(
        r.outcome == "converged" and r.holds,
        good=r.outcome,
        bad="many iterations" if slow else r.outcome,
        severity="slow" if r.holds else "bad",
    )
    taken = f"{r.a_step:.1f}" if r.steps else "–"
    error, words = scientific(r.error), r.reason or r.answer
    deepest = f"{r.deepest:.2g}" if r.deepest == r.deepest else "–"
    return title, r.solver, mark, count(r.steps), taken, count(r.cuts), error, deepest, words, ms(r.ms)


def verdict_on_contacts(found: Sequence[ContactRow]) -> str:
    """How many rows there are of each kind, in a sentence."""
    kinds = ("converged", "elsewhere", "refused", "crawls", "WRONG")
    parts = [f"{sum(r.outcome == kind for r in found)} {kind.lower()}" for kind in kinds]
    many = sum(r.outcome == "converged" and not r.holds for r in found)
    return f"{len(found)} rows: {', '.join(parts)}; {many} of the converged took more than {MOST_ITERATIONS:g} a step."
