"""The swinging rod by everybody: ratios to ours at one error, and who they are."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from verification.peers.contest import AIM, TARGET
from verification.report.diagrams import LETTERS
from verification.report.race import diagram, figures
from verification.report.tables import Column, Group, Mark, Row, scientific, table

if TYPE_CHECKING:
    from verification.peers.contest import Attempt, Contender

__all__ = ["TITLE", "contents", "summary"]

TITLE = "a rod pinned at one end falls from the horizontal and swings for a second"
ALT = "Swinging rod: error over seconds, ours and other people's solvers"
NUMBER = "number"


def contents(found: Sequence[Contender]) -> str:
    """Figure, ratios and every setting; errors are the largest of twenty times, at the last one small by chance.

    Args:
        found: Who took part, ours and others, or could not.

    Returns:
        HTML; empty where nobody was asked.
    """
    if not found:
        return ""
    drawing = diagram(found, "seconds per simulated second", ALT)
    parts = (f'<div class="panels wide"><figure>{drawing}</figure></div>', ratios(found))
    every = f"<details><summary>Every setting that was tried</summary>{settings(found)}</details>"
    return "\n".join((*parts, every))


def summary(found: Iterable[Contender]) -> str:
    """The outcome in a sentence or two.

    Args:
        found: Who took part.

    Returns:
        Plain text.
    """
    found = tuple(found)
    mine, theirs = (soonest([c for c in found if c.taker.ours is ours]) for ours in (True, False))
    if mine is None:
        return f"None of our models came within {TARGET:g} with the settings tried."
    ours, seconds = mine
    words = f"Ours come within {TARGET:g} in {figures(seconds)} s per simulated second ({ours.taker.name}, "
    words += f"{ours.taker.assumes}); the aim of {AIM:g} s is {'met' if seconds <= AIM else 'missed'}."
    if theirs is None:
        absent = {c.absent for c in found if c.absent}
        return f"{words} Nobody else did: {'; '.join(sorted(absent)) or 'see the settings below'}."
    other, took = theirs
    return f"{words} The quickest of the others is {other.taker.name} with {figures(took)} s."


def soonest(found: Sequence[Contender]) -> tuple[Contender, float] | None:
    """Who is exact enough first, and after how many seconds a simulated second."""
    times = [(seconds(best), k) for k, c in enumerate(found) if (best := c.quickest()) is not None]
    return (found[min(times)[1]], min(times)[0]) if times else None


def seconds(attempt: Attempt) -> float:
    """Of its solve a simulated second, infinite where it gave up [s]."""
    return attempt.found.solve if attempt.found is not None else float("inf")


def ratios(found: Sequence[Contender]) -> str:
    """The quickest setting of each that is exact enough, beside ours; then who they are."""
    columns = (
        Column("", "in the figure"),
        Column("solver"),
        Column("assumes"),
        Column(f"quickest to {TARGET:g}", "elements, step"),
        Column("seconds", "per simulated second", NUMBER),
        Column("over ours", kind=NUMBER),
        Column("least error", "of the sweep", NUMBER),
        Column("seconds", "error at 1 s only", NUMBER),
        Column("set-up", "s", NUMBER),
        Column("import, compile", "once, s", NUMBER),
    )
    who = (
        *columns[:2],
        Column("kind"),
        Column("integrator", kind="prose"),
        Column("rod", kind="prose"),
        Column("version"),
    )
    mine = soonest([c for c in found if c.taker.ours])
    times: list[Row] = []
    takers: list[Row] = []
    for title, ours in (("Ours", True), ("Other people's", False)):
        times.append(Group(title))
        for letter, c in zip(LETTERS, found, strict=False):
            if c.taker.ours is ours:
                t, version = c.taker, next((a.found.version for a in c.attempts if a.found is not None), "–")
                times.append((letter, t.name, t.assumes, *measured(c, None if mine is None else mine[1])))
                takers.append((letter, t.name, "implicit" if t.implicit else "explicit", t.method, t.element, version))
    return table(columns, times) + "<h3>Who they are</h3>" + table(who, takers)


def measured(c: Contender, ours: float | None) -> tuple[str | Mark, ...]:
    """Setting, seconds, ratio and the rest of a row."""
    best, by_end = c.quickest(), c.quickest(final=True)
    least, at_end = scientific(c.nearest), "–" if by_end is None else figures(seconds(by_end))
    if best is None or best.found is None:
        why = "not here" if c.absent else "not reached"
        return Mark(False, bad=why, severity="slow"), "–", "–", least, at_end, "–", "–"
    m = best.found
    over = "–" if ours is None else f"{figures(m.solve / ours)} ×"
    return f"{best.mesh}, {best.stepping}", figures(m.solve), over, least, at_end, figures(m.setup), figures(m.once)


def settings(found: Iterable[Contender]) -> str:
    """Every setting, refusals with their reason."""
    columns = (
        Column("elements"),
        Column("step"),
        Column("steps", kind=NUMBER),
        Column("error", kind=NUMBER),
        Column("error at 1 s", kind=NUMBER),
        Column("seconds", "per simulated second", NUMBER),
        Column("", kind="prose"),
    )
    rows: list[Row] = []
    for c in found:
        rows.append(Group(f"{c.taker.name}, {c.taker.assumes}" + (f": {c.absent}" if c.absent else "")))
        for a in c.attempts:
            m = a.found
            if m is None:
                rows.append((a.mesh, a.stepping, "–", "–", "–", "–", f"refused: {a.refused}"))
            else:
                steps = "–" if m.steps is None else f"{m.steps}"
                errors = scientific(m.error), scientific(m.final)
                rows.append((a.mesh, a.stepping, steps, *errors, figures(m.solve), ""))
    return table(columns, rows)
