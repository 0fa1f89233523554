"""Stability maps of contact as pictures: outcome over step and penalty, a panel for every scheme and mesh."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from math import log10
from typing import TYPE_CHECKING

from verification.contactmaps import period
from verification.report.canvas import WIDTH, power_of_ten, svg, text
from verification.report.maps import between, bounds
from verification.report.tables import Column, Mark, Row, scientific, table

if TYPE_CHECKING:
    from verification.contactmaps import ContactCell

__all__ = ["TITLE", "WORDS", "contact_maps"]

TITLE = "Stability maps of contact"
WORDS = (
    "A centimetre of the paper's fibre, clamped 20 µm above a floor with μ = 0.64 and pressed onto it by 9.3 mN/m, "
    "aslant by less than friction bears, in something as thick as oil, where every motion dies out within 20 µs; what "
    "is not at rest in the last third of 0.6 ms is of the steps' making. Chatters: the resultant swings by more than "
    "1 % of its mean, or a node changes between open, sticking and sliding more than once. Creeps: comes to rest but "
    "along the floor, by more than a thousandth of the radius. Failed: refused, more attempts failed than steps were "
    "asked for, or the steps made half as much energy as went in. To see: implicit Euler comes to rest whatever the "
    "step and the wall, the paper's friction against the velocity creeps everywhere, and the midpoint rule needs steps "
    "a few times shorter than a touch, π √(ρA/ε_N), the line. Missed is implicit Euler that fails, the midpoint rule "
    "that fails to the left of the line, and friction with anchors that creeps. Rest the pointer on a cell."
)
# Height of a panel, its margins, and the sign in a cell that says what its colour says.
HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 230, 46, 10, 22, 40
SIGNS = {"converged": "✓", "creeps": "→", "chatters": "≈", "failed": "✗"}
# Classes of the style sheet that the outcomes are painted with.
PAINTED = {"converged": "converged", "creeps": "dissipated", "chatters": "off", "failed": "failed"}


def contact_maps(found: Sequence[ContactCell]) -> str:
    """A row of panels for every scheme, and what the signs mean."""
    panels: dict[str, dict[float, list[ContactCell]]] = {}
    for cell in found:
        panels.setdefault(cell.scheme, {}).setdefault(cell.l, []).append(cell)
    parts = []
    for scheme, meshes in panels.items():
        figures = []
        for l, members in sorted(meshes.items(), reverse=True):
            title = f"{scheme}, elements of {1e3 * l:g} mm"
            figures.append(f"<figure><figcaption>{escape(title)}</figcaption>{panel(members, title)}</figure>")
        parts.append(f'<div class="panels">{"".join(figures)}</div>')
    signs = " · ".join(f"{sign} {outcome}" for outcome, sign in SIGNS.items())
    return f'<p class="soft">{escape(signs)}. Line: a touch, π √(ρA/ε_N).</p>{"".join(parts)}{summary(panels)}'


def summary(panels: dict[str, dict[float, list[ContactCell]]]) -> str:
    """Every scheme in a line: cells by outcome, most iterations, and what the resultant is."""
    columns = (
        Column("scheme"),
        *(Column(outcome, "cells", "number") for outcome in SIGNS),
        Column("iterations", "a step, most", "number"),
        Column("a step", "ms, most", "number"),
        Column("made by the steps", "most", "number"),
        Column(""),
    )
    rows: list[Row] = []
    for scheme, meshes in panels.items():
        members = [c for cells in meshes.values() for c in cells]
        done = [c for c in members if c.iterations == c.iterations]
        counts = (str(sum(c.outcome == outcome for c in members)) for outcome in SIGNS)
        most = max((c.iterations for c in done), default=float("nan"))
        slow, made = (max((getattr(c, name) for c in done), default=float("nan")) for name in ("ms", "made"))
        good = all(c.holds for c in members)
        rows.append((scheme, *counts, f"{most:.1f}", f"{slow:.0f}", scientific(made), Mark(good)))
    return table(columns, rows)


def panel(found: Sequence[ContactCell], title: str) -> str:
    """One map: steps across, penalties up, the time of a touch as a line."""
    steps, walls = sorted({c.dt for c in found}), sorted({c.eps_N for c in found})
    across, up = bounds(steps), bounds(walls)
    right, bottom = WIDTH - RIGHT, HEIGHT - BOTTOM
    parts = []
    for c in found:
        i, k = steps.index(c.dt), walls.index(c.eps_N)
        x0, x1 = (between(across, across[j], LEFT, right) for j in (i, i + 1))
        y1, y0 = (between(up, up[j], bottom, TOP) for j in (k, k + 1))
        parts.append(
            f'<g class="cell {PAINTED[c.outcome]}"><rect x="{x0:.1f}" y="{y0:.1f}" width="{x1 - x0 - 1:.1f}" '
            f'height="{y1 - y0 - 1:.1f}"/>{text((x0 + x1) / 2, (y0 + y1) / 2 + 4, SIGNS[c.outcome], "middle")}'
            f"<title>{escape(told(c))}</title></g>"
        )
    parts += [text(LEFT - 5, between(up, e, bottom, TOP) + 4, power_of_ten(round(log10(e))), "end") for e in walls]
    parts += [text(between(across, dt, LEFT, right), bottom + 15, f"{1e6 * dt:g}", "middle") for dt in steps]
    parts.append(text((LEFT + right) / 2, HEIGHT - 6, "step [µs]", "middle"))
    parts.append(text(4, 14, "penalty ε_N [N/m²]"))
    points = [(period(e), e) for e in up if across[0] <= period(e) <= across[-1]]
    points += [(dt, e) for dt in (across[0], across[-1]) if up[0] <= (e := _wall(dt)) <= up[-1]]
    line = "L".join(
        f"{between(across, x, LEFT, right):.1f},{between(up, y, bottom, TOP):.1f}" for x, y in sorted(points)
    )
    if len(points) > 1:
        parts.append(f'<path class="bound" d="M{line}"><title>π √(ρA/ε_N)</title></path>')
    return svg("".join(parts), f"{title}: outcome over step and penalty", HEIGHT)


def _wall(dt: float) -> float:
    """Penalty at which a touch takes so long [N/m²]."""
    return (period(1.0) / dt) ** 2


def told(c: ContactCell) -> str:
    """A cell in words."""
    place = f"{1e6 * c.dt:g} µs, {c.eps_N:g} N/m², {1e3 * c.l:g} mm: {c.outcome}"
    if c.iterations != c.iterations:
        return f"{place}, {c.reason}"
    swing = f"resultant {c.pressed:.3f} of the load, swings by {scientific(c.swing)}"
    rest = f"{c.flips} changes of state, {scientific(c.crept)} m along the floor"
    return f"{place}, {swing}, {rest}, {c.iterations:.1f} iterations and {c.ms:.1f} ms a step"
