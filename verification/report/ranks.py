"""One rank against two: how far answers are apart, and what two cost where there is little to share."""

from __future__ import annotations

from typing import TYPE_CHECKING

from verification.bundles import SAME
from verification.report.tables import Column, Mark, Row, figure, scientific, table

if TYPE_CHECKING:
    from collections.abc import Sequence

    from verification.ranks import RankRow

__all__ = ["TITLE", "WORDS", "ranks"]

TITLE = "One rank and two"
WORDS = (
    "Every kind of scene that the continuum model solves, on one rank and on two. Apart: the largest difference of "
    f"positions, strains, moments or eigenvalues, over the largest of them; at most {scientific(SAME, 0)}. Seconds are "
    "those of a warm call by the clock. To see: the answers are the same, and a single short rod is slower on two "
    "ranks, as they spend longer waiting for each other than they save; ranks are for bundles and ensembles, below."
)
NUMBER = "number"


def ranks(found: Sequence[RankRow]) -> str:
    """The table."""
    columns = (
        Column("scene", kind="prose"),
        Column("apart", "", NUMBER),
        Column("one rank", "s", NUMBER),
        Column("two ranks", "s", NUMBER),
        Column("two / one", "", NUMBER),
        Column(""),
    )
    rows: list[Row] = [
        (row.title, row.failure or "–", "–", "–", "–", Mark(False))
        if row.failure
        else (
            row.title,
            scientific(row.apart),
            figure(float(f"{row.seconds[0]:.2g}")),
            figure(float(f"{row.seconds[1]:.2g}")),
            figure(round(row.seconds[1] / row.seconds[0], 1)),
            Mark(row.holds),
        )
        for row in found
    ]
    return table(columns, rows)
