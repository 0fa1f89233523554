"""How much quicker ranks are: measured on one and two, estimated for more, and labelled as which."""

from __future__ import annotations

from typing import TYPE_CHECKING

from verification.report.tables import Column, Mark, Row, count, figure, scientific, table
from verification.scaling import ASKED, RANKS, EnsembleScaling, Scaling

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["WORDS", "scalings"]

WORDS = (
    "Strong: the same work on one rank and on two. Weak: the time that half the bundle takes alone, over that of both "
    "halves on two ranks. More ranks are an <strong>estimate</strong>, not a measurement: work that ranks share out by "
    "whole fibres, work that each of them repeats, and exchanges, all measured on one rank and two; a sum over p ranks "
    "takes log₂ p times the latency and carries 2(1 − 1/p) times its size (Thakur, Rabenseifner & Gropp 2005). Runs of "
    "ensembles tell each other nothing: who is free takes the next. Clocks depend on who else is at work, so that "
    f"nothing here is judged; {ASKED['bundle']:g} times are asked of bundles, {ASKED['ensemble']:g} of ensembles."
)
NUMBER = "number"


def scalings(found: Sequence[Scaling | EnsembleScaling]) -> str:
    """One table of what was measured and estimated, and one of what the estimate rests on."""
    columns = (
        Column("what"),
        Column("one rank", "s", NUMBER),
        Column("two", "s", NUMBER),
        Column("strong", "times", NUMBER),
        Column("weak", "", NUMBER),
        *(Column(f"{ranks}", "times, estimate", NUMBER) for ranks in RANKS),
        Column(""),
    )
    bundles = [row for row in found if isinstance(row, Scaling) and row.holds]
    parts = [f"<h3>More ranks</h3><p>{WORDS}</p>", table(columns, [_row(row) for row in found])]
    return "\n".join([*parts, *([_work(bundles)] if bundles else [])])


def _row(row: Scaling | EnsembleScaling) -> Row:
    if isinstance(row, Scaling):
        what, seconds = f"bundle of {row.fibres}, a step of {row.steps}", (row.one, row.two)
        weak = figure(round(row.weak, 2)) if row.holds else "–"
    else:
        what, seconds, weak = f"ensemble of {row.runs}", row.seconds, "–"
    if not row.holds:
        return (what, *("–",) * (len(RANKS) + 4), Mark(False))
    estimates = (figure(round(row.estimated(ranks), 1)) for ranks in RANKS)
    return (
        what,
        figure(round(seconds[0], 2)),
        figure(round(seconds[1], 2)),
        figure(round(row.strong, 2)),
        weak,
        *estimates,
        "ran",
    )


def _work(found: Sequence[Scaling]) -> str:
    columns = (
        Column("bundle", "a step of two ranks", NUMBER),
        Column("shared", "ms of one rank's", NUMBER),
        Column("repeated", "ms", NUMBER),
        Column("exchanges", "", NUMBER),
        Column("of", "kB", NUMBER),
        Column("take", "ms", NUMBER),
        Column("latency", "µs", NUMBER),
        Column("rate", "bytes/s", NUMBER),
    )
    rows: list[Row] = [
        (
            count(row.fibres),
            count(round(1e3 * row.shared)),
            count(round(1e3 * (row.one - row.shared))),
            count(round(row.calls)),
            figure(round(1e-3 * row.size, 1)),
            figure(round(1e3 * row.talk, 1)),
            figure(round(1e6 * row.latency, 1)),
            scientific(row.rate, 1),
        )
        for row in found
    ]
    return table(columns, rows)
