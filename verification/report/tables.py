"""Tables in HTML: words left, numbers right, a mark that does not live by colour alone."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from html import escape
from math import isfinite

__all__ = [
    "Column",
    "Group",
    "Link",
    "Mark",
    "Row",
    "Swatch",
    "link",
    "count",
    "figure",
    "ms",
    "power",
    "scientific",
    "table",
]

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
        severity: Class of a miss: "bad", or "slow" where the machine may be to blame or the case says why.
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
class Link:
    """Words that lead somewhere.

    Args:
        target: Address; empty: words only.
        words: Shown.
    """

    target: str
    words: str

    @property
    def html(self) -> str:
        """An anchor."""
        return link(self.target, self.words) if self.target else escape(self.words)


@dataclass(frozen=True)
class Swatch:
    """A name beside the line that stands for it in the diagrams.

    Args:
        kind: Class of the line.
        dashed: Whether it is.
        words: The name.
    """

    kind: str
    dashed: bool
    words: str

    @property
    def html(self) -> str:
        """A short line and the name."""
        dashed = " dashed" if self.dashed else ""
        line = f'<polyline class="{self.kind}{dashed}" points="1,6 15,6 29,6"/>'
        return f'<svg class="swatch" viewBox="0 0 30 12" aria-hidden="true">{line}</svg>{escape(self.words)}'


@dataclass(frozen=True)
class Group:
    """A heading within a table, which may lead somewhere."""

    title: str
    target: str = ""


Row = Sequence[str | Mark | Link | Swatch] | Group


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
        return (
            f'<tr class="group"><td colspan="{len(columns)}"><span>{Link(row.target, row.title).html}</span></td></tr>'
        )
    missed = [cell.severity for cell in row if isinstance(cell, Mark) and not cell.holds]
    cells = "".join(
        f'<td class="{column.kind}">{escape(cell) if isinstance(cell, str) else cell.html}</td>'
        for column, cell in zip(columns, row, strict=True)
    )
    return f'<tr class="{missed[0]}">{cells}</tr>' if missed else f"<tr>{cells}</tr>"


def link(target: str, words: str) -> str:
    """An anchor."""
    return f'<a href="{escape(target)}">{escape(words)}</a>'


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


def figure(value: float) -> str:
    """Nine digits."""
    return f"{value:.9g}".replace("-", "−") if isfinite(value) else DASH


def count(value: int) -> str:
    """A whole number."""
    return f"{value:d}"
