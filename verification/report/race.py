"""Everybody on one problem: errors over seconds, seconds to an error, every setting."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from html import escape
from itertools import cycle
from math import inf
from typing import TYPE_CHECKING

from verification.peers.contest import TARGETS
from verification.report.canvas import Curve, log_log
from verification.report.diagrams import LETTERS
from verification.report.tables import Column, Group, Link, Row, scientific, table

if TYPE_CHECKING:
    from verification.peers.contest import Attempt, Contender, Measured

__all__ = ["diagram", "figures", "front", "panel", "seconds", "settings"]

NUMBER = "number"
OURS, OTHERS = ("p3", "p4", "p5", "p2", "p1", "chord"), ("paper", "chord", "p1", "p2", "p5")
# What is nearer to the solution is round-off and drawn there.
LOWEST = 1e-15


@dataclass(frozen=True)
class Strong(Link):
    """Words in bold; they lead nowhere."""

    @property
    def html(self) -> str:
        """Bold."""
        return f"<b>{escape(self.words)}</b>"


def panel(found: Sequence[Contender], title: str) -> str:
    """The figure of a problem.

    Args:
        found: Everybody on it.
        title: Of the problem.

    Returns:
        HTML.
    """
    drawing = diagram(found, "seconds", f"{title}: error over seconds, ours and other people's solvers")
    return f'<div class="panels wide"><figure>{drawing}</figure></div>'


def diagram(found: Sequence[Contender], x: str, alt: str) -> str:
    """Errors over seconds; of each solver the settings of which no other is both quicker and more exact.

    Args:
        found: Everybody on a problem.
        x: What is below.
        alt: For readers who do not see it.

    Returns:
        SVG.
    """
    kinds = {True: cycle(OURS), False: cycle(OTHERS)}
    curves = []
    for k, (letter, c) in enumerate(zip(LETTERS, found, strict=False)):
        points = front([a.found for a in c.attempts if a.found is not None])
        kind = next(kinds[c.taker.ours])
        if points:
            xs, ys = tuple(p.solve for p in points), tuple(max(p.error, LOWEST) for p in points)
            title = f"{letter}: {c.taker.name}, {c.taker.assumes}"
            curves.append(Curve(kind, xs, ys, title, not c.taker.ours, letter, -(k % 2)))
    return log_log(curves, x=x, y="error, dashed: other people's solvers", alt=alt)


def front(points: Sequence[Measured]) -> list[Measured]:
    """From quick to exact."""
    kept: list[Measured] = []
    for p in sorted(points, key=lambda p: (p.solve, p.error)):
        if p.error < (kept[-1].error if kept else inf):
            kept.append(p)
    return kept


def seconds(found: Sequence[Contender]) -> str:
    """The quickest setting of everybody to each error, the quickest of all in bold.

    Args:
        found: Everybody on a problem.

    Returns:
        HTML.
    """
    columns = (
        Column("", "in the figure"),
        Column("solver"),
        Column("assumes"),
        *(Column(f"to {target:g}", "ms, setting", NUMBER) for target in TARGETS),
        Column("least error", "of the sweep", NUMBER),
        Column("set-up", "s", NUMBER),
        Column("import, compile", "once, s", NUMBER),
        Column("cold", "whole process, s", NUMBER),
    )
    fastest = [min((spent(c.quickest(t)) for c in found), default=inf) for t in TARGETS]
    # Nobody's whole process was timed: no column of dashes.
    kept = 4 if any(c.cold is not None for c in found) else 3
    rows: list[Row] = []
    for title, ours in (("Ours", True), ("Other people's", False)):
        rows.append(Group(title))
        for letter, c in zip(LETTERS, found, strict=False):
            if c.taker.ours is ours:
                rows.append((letter, c.taker.name, c.taker.assumes, *reached(c, fastest), *besides(c)[:kept]))
    return table(columns[: len(columns) - len(besides(found[0])) + kept], rows) + absences(found)


def absences(found: Iterable[Contender]) -> str:
    """Why some did not take part, each reason once."""
    reasons: dict[str, list[str]] = {}
    for c in found:
        if c.absent:
            reasons.setdefault(c.absent, []).append(c.taker.name)
    words = (f"{', '.join(names)}: {reason}" for reason, names in reasons.items())
    return f"<p><small>Not here: {escape('; '.join(words))}.</small></p>" if reasons else ""


def reached(c: Contender, fastest: Sequence[float]) -> list[str | Link]:
    """Milliseconds to each error and the setting; a reason where there is none."""
    cells: list[str | Link] = []
    for target, least in zip(TARGETS, fastest, strict=True):
        best = c.quickest(target)
        if best is None or best.found is None:
            cells.append("not here" if c.absent else "–")
            continue
        setting = ", ".join(filter(None, (best.mesh, best.stepping)))
        words = f"{figures(1e3 * best.found.solve)}, {setting}"
        cells.append(Strong("", words) if best.found.solve == least else words)
    return cells


def besides(c: Contender) -> tuple[str, ...]:
    """Least error, set-up, what is spent once, and the whole process."""
    best = c.quickest() or next((a for a in c.attempts if a.found is not None), None)
    whole = "–" if c.cold is None else figures(c.cold)
    if best is None or best.found is None:
        return scientific(c.nearest), "–", "–", whole
    return scientific(c.nearest), figures(best.found.setup), figures(best.found.once), whole


def spent(attempt: Attempt | None) -> float:
    """Seconds, infinite where there is no attempt or it gave up [s]."""
    return inf if attempt is None or attempt.found is None else attempt.found.solve


def settings(found: Iterable[Contender]) -> str:
    """Every setting, refusals with their reason.

    Args:
        found: Everybody on a problem.

    Returns:
        HTML.
    """
    columns = (
        Column("elements"),
        Column("steps"),
        Column("error", kind=NUMBER),
        Column("ms", kind=NUMBER),
        Column("", kind="prose"),
    )
    rows: list[Row] = []
    for c in found:
        rows.append(Group(f"{c.taker.name}, {c.taker.assumes}" + (f": {c.absent}" if c.absent else "")))
        for a in c.attempts:
            if a.found is None:
                rows.append((a.mesh, a.stepping, "–", "–", f"refused: {a.refused}"))
            else:
                rows.append((a.mesh, a.stepping, scientific(a.found.error), figures(1e3 * a.found.solve), ""))
    return table(columns, rows)


def figures(value: float) -> str:
    """Two digits that mean something."""
    return f"{value:.0f}" if value >= 9.5 else f"{value:.1f}" if value >= 0.95 else f"{value:.2g}"
