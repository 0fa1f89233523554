"""Tables in HTML: words left, numbers right, a mark that does not live by colour alone."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from html import escape
from math import isfinite

__all__ = ["Column", "Group", "Mark", "Row", "count", "ms", "power", "scientific", "table"]

DASH = "–"


@dataclass(frozen=True)
class Column:
    """Head of a column.

    Args:
        title: What it holds.
        unit: In small print.
        kind: "word", "number" (right-aligned) or "prose" (may wrap).
    """

    title: str
    unit: str = ""
    kind: str = "word"


@dataclass(frozen=True)
class Mark:
    """A verdict in words.

    Args:
        holds: Whether it is good.
        good: Word for that.
        bad: Word for a miss.
        severity: Class of a miss: "bad", or "slow" where the machine may be to blame.
    """

    holds: bool
    good: str = "holds"
    bad: str = "missed"
    severity: str = "bad"

    @property
    def html(self) -> str:
        """✓ or ✗ with a word."""
        if self.holds:
            return f'<span class="mark good">✓ {escape(self.good)}</span>'
        return f'<span class="mark {self.severity}">✗ {escape(self.bad)}</span>'


@dataclass(frozen=True)
class Group:
    """A heading within a table."""

    title: str


Row = Sequence[str | Mark] | Group


def table(columns: Sequence[Column], rows: Iterable[Row]) -> str:
    """A table that scrolls sideways where the window is narrow.

    Args:
        columns: Heads.
        rows: Cells as text (escaped here) or marks; a row with a miss is tinted.

    Returns:
        HTML.
    """
    head = "".join(_head(column) for column in columns)
    body = "\n".join(_row(columns, row) for row in rows)
    return f'<div class="scroll"><table>\n<thead><tr>{head}</tr></thead>\n<tbody>\n{body}\n</tbody></table></div>'


def _head(column: Column) -> str:
    unit = f" <small>{escape(column.unit)}</small>" if column.unit else ""
    return f'<th class="{column.kind}" scope="col">{escape(column.title)}{unit}</th>'


def _row(columns: Sequence[Column], row: Row) -> str:
    if isinstance(row, Group):
        return f'<tr class="group"><td colspan="{len(columns)}">{escape(row.title)}</td></tr>'
    missed = [cell.severity for cell in row if isinstance(cell, Mark) and not cell.holds]
    cells = "".join(
        f'<td class="{column.kind}">{cell.html if isinstance(cell, Mark) else escape(cell)}</td>'
        for column, cell in zip(columns, row, strict=True)
    )
    return f'<tr class="{missed[0]}">{cells}</tr>' if missed else f"<tr>{cells}</tr>"


def scientific(value: float | None, digits: int = 1) -> str:
    """Such as 2.1e−8."""
    if value is None or not isfinite(value):
        return DASH
    if value == 0.0:
        return "0"
    mantissa, exponent = f"{value:.{digits}e}".split("e")
    return f"{mantissa}e{int(exponent)}".replace("-", "−")


def power(value: float | None) -> str:
    """An order, with two decimals."""
    return DASH if value is None or not isfinite(value) else f"{value:.2f}".replace("-", "−")


def ms(value: float | None) -> str:
    """Milliseconds with three digits that mean something."""
    if value is None or not isfinite(value):
        return DASH
    return f"{value:.0f}" if value >= 99.5 else f"{value:.1f}" if value >= 9.95 else f"{value:.2f}"


def count(value: int) -> str:
    """A whole number."""
    return f"{value:d}"
