"""How twist is measured: errors over points in a diagram, and every measure against its reference in a table."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

from verification.report.canvas import Curve, log_log
from verification.report.families import panel
from verification.report.tables import Column, Group, Mark, Row, Swatch, count, figure, power, scientific, table

if TYPE_CHECKING:
    from collections.abc import Sequence

    from verification.twist import TwistStudy

__all__ = ["TITLE", "WORDS", "twists"]

TITLE = "How twist is measured"
WORDS = (
    "Curves of known twist through dolfinrod.twist, no rod and no solver: positive is right-handed about +X (Z). "
    "Windings of polygons from end to end, their linking numbers and Tw + Wr do not depend on how many points they "
    "have; twist and writhe of polygons through points of a smooth curve are off by the square of their distance, and "
    "extrapolated to none they have all the digits the references are trusted to."
)
NUMBER, PROSE = "number", "prose"
# Lines of the measures that converge.
KINDS = {"twist": "p4", "writhe": "chord", "winding": "p3"}
LOWEST = 1e-16


def twists(found: Sequence[TwistStudy]) -> str:
    """One diagram of what converges, and the table of all."""
    converging = [s for s in found if s.order is not None]
    drawing = ""
    if converging:
        lines = " ".join(Swatch(kind, False, measure).html for measure, kind in KINDS.items())
        note = "All fall with the square of the distance; each curve is named by the pointer."
        drawn = panel(_diagram(converging), "Polygons through points of smooth curves")
        drawing = f'<p class="soft">{lines}. {note}</p><div class="panels wide">{drawn}</div>'
    return drawing + _table(found) + _references(found)


def _diagram(found: Sequence[TwistStudy]) -> str:
    """Errors over numbers of points."""
    curves = [
        Curve(
            kind=KINDS[s.measure],
            x=tuple(float(n) for n in s.levels),
            y=tuple(max(e, LOWEST) for e in s.errors),
            title=f"{s.title}: order {power(None if s.order is None else s.order.observed)}",
        )
        for s in found
    ]
    return log_log(curves, x="points", y="error [turns]", alt="errors of twist and writhe over points")


def _table(found: Sequence[TwistStudy]) -> str:
    """Measures that are exact first, then those with an order."""
    columns = (
        Column("what", kind=PROSE),
        Column("measure"),
        Column("reference", "turns, or turns/m", NUMBER),
        Column("levels"),
        Column("errors", "coarse to fine"),
        Column("order", "(theory)", NUMBER),
        Column("extrapolated", "error", NUMBER),
        Column("limit", "", NUMBER),
        Column(""),
    )
    rows: list[Row] = [Group("The same on every level")]
    rows += [_row(s) for s in found if s.order is None]
    rows.append(Group("Polygons that come nearer to a curve"))
    rows += [_row(s) for s in found if s.order is not None]
    return table(columns, rows)


def _row(s: TwistStudy) -> Row:
    """One measure."""
    return (
        s.title,
        s.measure,
        figure(s.reference if abs(s.reference) > LOWEST else 0.0) + s.unit.removeprefix("turns"),
        f"{count(s.levels[0])} … {count(s.levels[-1])} {s.points}",
        ", ".join(scientific(e) for e in s.errors),
        "–" if s.order is None else f"{power(s.order.observed)} ({count(s.order.theory)})",
        scientific(s.extrapolated),
        scientific(s.limit, 0),
        Mark(s.holds),
    )


def _references(found: Sequence[TwistStudy]) -> str:
    """Where each comes from."""
    items = "".join(f"<li>{escape(f'{s.title}: {s.provenance}.')}</li>" for s in found)
    return f"<details><summary>The references</summary><ul>{items}</ul></details>"
