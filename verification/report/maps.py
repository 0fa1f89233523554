"""Stability maps as pictures, and the explicit limits beside their formulas as a table."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from itertools import groupby, pairwise
from math import log10, sqrt
from typing import TYPE_CHECKING

from verification.report.canvas import WIDTH, power_of_ten, svg, text
from verification.report.tables import Column, Group, Mark, Row, scientific, table

if TYPE_CHECKING:
    from verification.explicitlimit import ExplicitLimit
    from verification.maps import Cell

__all__ = ["limits", "maps"]

# Height of a panel, its margins, and the sign in a cell that says what its colour says.
HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 210, 46, 10, 22, 40
SIGNS = {"converged": "✓", "dissipated": "↓", "off": "≈", "failed": "✗"}
WORDS = {
    "converged": "converged",
    "dissipated": "dissipated: the steps took more than 1 % of the energy",
    "off": "off by more than 1 %",
    "failed": "failed",
}


def limits(found: Sequence[ExplicitLimit]) -> str:
    """Longest stable steps: measured, from the matrices, in closed form."""
    columns = (
        Column("waves"),
        Column("measured", "s", "number"),
        Column("2/ω_max", "s", "number"),
        Column("measured/that", kind="number"),
        Column("long chain", "s", "number"),
        Column("measured/that", kind="number"),
        Column("process.md 1.1", "s", "number"),
        Column(""),
    )
    rows: list[Row] = []
    for l, group in groupby(found, key=lambda r: r.l):
        rows.append(Group(f"elements of {1e3 * l:g} mm"))
        for r in group:
            three = scientific(r.measured, 3), scientific(r.matrices, 3), f"{r.ratio:.4f}"
            long = scientific(r.closed, 3), f"{r.measured / r.closed:.4f}", scientific(r.stated, 3)
            rows.append((r.wave, *three, *long, Mark(r.holds)))
    return table(columns, rows)


def maps(found: Sequence[Cell]) -> str:
    """A panel for every scheme and rise of the load, and what the signs mean."""
    panels: dict[tuple[str, float], list[Cell]] = {}
    for cell in found:
        panels.setdefault((cell.scheme, cell.rise), []).append(cell)
    figures = []
    for (scheme, rise), members in panels.items():
        title = f"{scheme}, load {f'within {1e3 * rise:g} ms' if rise else 'at once'}"
        figures.append(f"<figure><figcaption>{escape(title)}</figcaption>{panel(members, title)}</figure>")
    signs = " · ".join(f"{SIGNS[outcome]} {words}" for outcome, words in WORDS.items())
    legend = f'<p class="soft">{escape(signs)}. Line: 2/ω_max.</p>'
    return f'{legend}<div class="panels">{"".join(figures)}</div>{costs(panels)}'


def costs(panels: dict[tuple[str, float], list[Cell]]) -> str:
    """Seconds for a simulated second of the quickest step that converged, by scheme and length of the elements."""
    lengths = sorted({c.l for members in panels.values() for c in members})
    columns = (
        Column("quickest step that converges"),
        Column("load within", "ms", "number"),
        *(Column(f"{1e3 * l:g} mm", "s per s · step", "number") for l in lengths),
    )
    rows: list[Row] = []
    for (scheme, rise), members in panels.items():
        cells = []
        for l in lengths:
            good = [c for c in members if c.l == l and c.outcome == "converged"]
            best = min(good, key=lambda c: c.seconds, default=None)
            cells.append("–" if best is None else f"{best.seconds:.0f} · {best.dt:g}")
        rows.append((scheme, f"{1e3 * rise:g}", *cells))
    return table(columns, rows)


def panel(found: Sequence[Cell], title: str) -> str:
    """One map: steps across, lengths of elements up, the explicit limit as a line."""
    steps, lengths = sorted({c.dt for c in found}), sorted({c.l for c in found})
    across, up = bounds(steps), bounds(lengths)
    right, bottom = WIDTH - RIGHT, HEIGHT - BOTTOM
    parts = []
    for c in found:
        i, k = steps.index(c.dt), lengths.index(c.l)
        x0, x1 = (between(across, across[j], LEFT, right) for j in (i, i + 1))
        y1, y0 = (between(up, up[j], bottom, TOP) for j in (k, k + 1))
        parts.append(
            f'<g class="cell {c.outcome}"><rect x="{x0:.1f}" y="{y0:.1f}" width="{x1 - x0 - 1:.1f}" '
            f'height="{y1 - y0 - 1:.1f}"/>{text((x0 + x1) / 2, (y0 + y1) / 2 + 4, SIGNS[c.outcome], "middle")}'
            f"<title>{escape(told(c))}</title></g>"
        )
    parts += [text(LEFT - 5, between(up, l, bottom, TOP) + 4, f"{1e3 * l:g}", "end") for l in lengths]
    for d in range(round(log10(across[0])), round(log10(across[-1])) + 1):
        if across[0] <= 10.0**d <= across[-1]:
            parts.append(text(between(across, 10.0**d, LEFT, right), bottom + 15, power_of_ten(d), "middle"))
    parts.append(text((LEFT + right) / 2, HEIGHT - 6, "step [s]", "middle"))
    parts.append(text(4, 14, "length of the elements [mm]"))
    for l, limit in sorted({(c.l, c.limit) for c in found if c.limit is not None}):
        if across[0] <= limit <= across[-1]:
            k = lengths.index(l)
            x, y1, y0 = between(across, limit, LEFT, right), *(between(up, up[j], bottom, TOP) for j in (k, k + 1))
            parts.append(f'<path class="bound" d="M{x:.1f},{y0:.1f}V{y1:.1f}"><title>2/ω_max</title></path>')
    return svg("".join(parts), f"{title}: outcome over step and length of the elements", HEIGHT)


def told(c: Cell) -> str:
    """A cell in words."""
    if c.outcome == "failed":
        return f"{c.dt:g} s, {1e3 * c.l:g} mm: failed, {c.reason}"
    energy = f"energy made by the steps {scientific(c.lost)}"
    cost = f"{c.seconds:.0f} s per simulated second"
    return f"{c.dt:g} s, {1e3 * c.l:g} mm: {c.outcome}, error {scientific(c.error)}, {energy}, {cost}"


def bounds(values: Sequence[float]) -> list[float]:
    """Edges of cells about values, halfway between neighbours on a logarithmic axis."""
    inner = [sqrt(a * b) for a, b in pairwise(values)]
    if not inner:
        return [values[0] / 2.0, values[0] * 2.0]
    return [values[0] ** 2 / inner[0], *inner, values[-1] ** 2 / inner[-1]]


def between(edges: Sequence[float], value: float, begin: float, end: float) -> float:
    """Pixel of a value on a logarithmic axis that ends at the outer edges."""
    part = (log10(value) - log10(edges[0])) / (log10(edges[-1]) - log10(edges[0]))
    return begin + part * (end - begin)
