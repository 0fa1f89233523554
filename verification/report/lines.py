"""Diagrams with even axes as inline SVG: quantities along a rod."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from html import escape
from math import ceil, floor, log10

from verification.report.canvas import HEIGHT, WIDTH, svg, text

__all__ = ["Trace", "linear"]

LEFT, RIGHT, TOP, BOTTOM = 60, 14, 26, 40
# About how many ticks an axis has.
TICKS = 5


@dataclass(frozen=True)
class Trace:
    """A line without markers.

    Args:
        kind: Class of the style sheet, as of `Curve`.
        x: Ascending.
        y: Of each x.
        title: Said where the pointer rests.
        width: Of the line [px].
        dashed: So that a line beneath it shows.
    """

    kind: str
    x: tuple[float, ...]
    y: tuple[float, ...]
    title: str
    width: float = 1.6
    dashed: bool = False


def linear(traces: Sequence[Trace], x: str, y: str, rows: Sequence[tuple[float, str]] = ()) -> str:
    """A diagram with even axes.

    Args:
        traces: What is shown.
        x: Quantity and unit below it.
        y: Quantity and unit above it.
        rows: Names at heights, in place of numbers.

    Returns:
        SVG.
    """
    if not traces:
        return svg(text(WIDTH / 2, HEIGHT / 2, "nothing to show", "middle"), x)
    height = HEIGHT if not rows else TOP + BOTTOM + 42.0 * len(rows)
    across = _spread([v for t in traces for v in t.x], 0.0)
    up = (rows[-1][0] - 0.6, rows[0][0] + 0.6) if rows else _spread([v for t in traces for v in t.y], 0.06)
    right, bottom = WIDTH - RIGHT, height - BOTTOM

    def place(a: float, b: float) -> tuple[float, float]:
        u, v = (a - across[0]) / (across[1] - across[0]), (b - up[0]) / (up[1] - up[0])
        return LEFT + u * (right - LEFT), bottom - v * (bottom - TOP)

    parts = [text((LEFT + right) / 2, height - 6, x, "middle"), text(4, 14, y)]
    for tick in _ticks(*across):
        pixel = place(tick, up[0])[0]
        parts.append(f'<path class="grid" d="M{pixel:.1f},{TOP}V{bottom:.1f}"/>')
        parts.append(text(pixel, bottom + 15, _number(tick), "middle"))
    for tick in () if rows else _ticks(*up):
        pixel = place(across[0], tick)[1]
        parts.append(f'<path class="grid" d="M{LEFT},{pixel:.1f}H{right}"/>')
        parts.append(text(LEFT - 5, pixel + 4, _number(tick), "end"))
    parts += [text(LEFT, place(across[0], at)[1] - 9, words) for at, words in rows]
    for t in traces:
        points = " ".join(f"{a:.1f},{b:.1f}" for a, b in map(place, t.x, t.y))
        style = f"stroke-width:{t.width:g};marker:none"
        title = f"<title>{escape(t.title)}</title>"
        kind = f"{t.kind} dashed" if t.dashed else t.kind
        parts.append(f'<polyline class="{kind}" style="{style}" points="{points}">{title}</polyline>')
    return svg("".join(parts), f"{y} over {x}", height)


def _spread(values: Sequence[float], margin: float) -> tuple[float, float]:
    """Range of values with a margin, at least a little wide."""
    low, high = min(values), max(values)
    wide = max(high - low, 1e-9 * max(abs(low), abs(high))) or 1.0
    return low - margin * wide, high + margin * wide


def _ticks(low: float, high: float) -> Iterable[float]:
    """Round numbers between two."""
    rough = (high - low) / TICKS
    decade = 10.0 ** floor(log10(rough))
    step = next(m * decade for m in (1.0, 2.0, 5.0, 10.0) if m * decade >= rough)
    return [k * step for k in range(ceil(low / step - 1e-9), floor(high / step + 1e-9) + 1)]


def _number(value: float) -> str:
    """Short, with a proper minus."""
    return f"{value:.6g}".replace("-", "−")
