"""The paper's groove as printed: what each reading gives."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

from verification.groovepaper import PaperRun
from verification.report.tables import Column, Group, Mark, Row, count, figure, scientific, table

if TYPE_CHECKING:
    from collections.abc import Sequence

    from verification.groovescenarioclaims import Gathered

__all__ = ["TITLE", "WORDS", "paper", "rows_of"]

TITLE = "The paper's groove as printed"
WORDS = (
    "Steps of 1 µs, 200 elements of 0.5 or 0.2 mm, start at (0, 0, −1) mm, friction against the velocity of nodes that "
    "never sticks, c = 2e4 and ε₀ = 7.5e-5 in each unit they may be meant in. No equation of the paper has air: as "
    "printed nothing moves but what 0.1 mN stretches; with our air added fibres fall. To see: how far each reading "
    "gets in the steps asked for. What follows of the numbers alone, and not of these runs: read as SI, walls hold "
    "fibres up to 75 µm off, nearly four diameters, so that none could touch another; in mm and mN or N the contact's "
    "own period is 0.5 or 0.015 µs, far below a step, which implicit Euler damps away rather than resolves."
)
NUMBER = "number"
READ = {"SI": "N/m², m", "mm_mN": "mN/mm², mm", "mm_N": "N/mm², mm"}
MESHED = {"zone": "200 × 0.2 mm", "long": "200 × 0.5 mm, 60 mm of them before A"}


def rows_of(found: Sequence[Gathered]) -> tuple[PaperRun, ...]:
    """What this section shows."""
    return tuple(row for row in found if isinstance(row, PaperRun))


def paper(found: Sequence[Gathered]) -> str:
    """One table, grouped by whether there is air; nothing where there are no rows."""
    runs = rows_of(found)
    if not runs:
        return ""
    columns = (
        Column("units"),
        Column("mesh"),
        Column("model"),
        Column("steps", "of those asked", NUMBER),
        Column("iterations", "a step", NUMBER),
        Column("moved across", "µm", NUMBER),
        Column("speed", "m/s, at the end", NUMBER),
        Column("least gap", "µm", NUMBER),
        Column("walls", "µN", NUMBER),
        Column("a step", "ms", NUMBER),
        Column(""),
    )
    rows: list[Row] = []
    for air, words in (
        (False, "As printed: no air"),
        (True, "With our air, 20 m/s at 0.5 mm from the bottom, at once"),
    ):
        members = [row for row in runs if row.air is air]
        rows += [Group(words)] if members else []
        rows += [_row(row) for row in members]
    return table(columns, rows) + _failures(runs)


def _row(row: PaperRun) -> Row:
    return (
        READ[row.reading],
        MESHED[row.mesh],
        row.model,
        f"{count(row.taken)} of {count(row.asked)}",
        figure(round(row.iterations, 1)),
        scientific(1e6 * row.moved),
        scientific(row.speed),
        figure(round(1e6 * row.gap, 3)),
        figure(round(1e6 * row.walls, 2)),
        figure(round(1e3 * row.seconds / max(row.taken, 1), 1)),
        Mark(not row.failure, good="ran", bad="stopped", severity="slow"),
    )


def _failures(found: Sequence[PaperRun]) -> str:
    """Why some stopped."""
    told = [f"{READ[row.reading]}, {MESHED[row.mesh]}, {row.model}: {row.failure}" for row in found if row.failure]
    return "".join(f'<p class="soft">{escape(words)}</p>' for words in told)
