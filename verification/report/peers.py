"""The section on other people's solvers, measured in the same run: who is ahead where, then problem by problem."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from html import escape
from math import inf, isfinite
from typing import TYPE_CHECKING

from verification.peers.onestep import ONCE, largest
from verification.peers.rods import RODS
from verification.peers.rough import ROUGH
from verification.peers.standing import Aim, Standing, aims, named, standings
from verification.peers.swing import SWING
from verification.report import race, swing
from verification.report.tables import Column, Group, Mark, Row, table

if TYPE_CHECKING:
    from verification.peers.contest import Contender
    from verification.peers.rods import RodProblem
    from verification.peers.rough import RoughProblem

__all__ = ["TITLES", "WORDS", "contents", "summary", "verdict"]

TITLES = {"peers": "Beside other people's solvers, in this run"}
WORDS = {
    "peers": "All solve the same rods: a cantilever under a tip force (P1), rolled up once and twice (P2a, P2b), "
    "the 45° bend (P3), a column beyond its Euler load (P4), a rod that swings for a second (P5), a slender fibre in "
    "SI and without units (P6, P6n), a rod pushed along a rough plane (P7a, P7b) and a rope drawn over a drum "
    "(capstan). Each is held against the solution of its own assumptions: the rod shears and "
    "stretches (sheared), only stretches (stretched), or neither (rigid); errors are distances of the tip over the "
    "length, of the way for P7, and of the pull over its value for the capstan. Seconds are those of the steps, one "
    "thread, in a process that is warm, the quickest repetition, in the better of the two fewest numbers of load steps "
    "that find the equilibrium; nothing is interpolated. Alone: nobody else got there with the meshes of this "
    "sweep, which in a quick run are two or three a solver and say nothing about finer ones. Cold: a whole process "
    "with its imports, compiled code at hand: of the others the quickest element of each, of ours rods that shear.",
}
NUMBER = "number"


def contents(found: Sequence[Contender]) -> str:
    """Verdict, aims, seconds, loads in one step, and a fold for each problem.

    Args:
        found: Who took part, ours and others, or could not.

    Returns:
        HTML; empty where nobody was asked.
    """
    if not found:
        return ""
    moving = [c for c in found if c.problem == SWING.name]
    parts = [f"<p><b>{escape(verdict(found))}</b></p>"]
    parts += [f"<p>{escape(swing.summary(moving))}</p>"] if moving else []
    parts += [asked(rows)] if (rows := aims(found)) else []
    parts += folds(found, RODS)
    once = [c for c in found if c.problem == ONCE]
    parts += ["<h3>Tip loads taken in one load step</h3>", at_once(once)] if once else []
    parts += [f"<h3>P5: {swing.TITLE}</h3>", swing.contents(moving)] if moving else []
    parts += folds(found, ROUGH)
    return "\n".join(parts)


def folds(found: Sequence[Contender], problems: Iterable[RodProblem | RoughProblem]) -> Iterator[str]:
    """Figure, seconds and a fold with every setting, problem by problem."""
    for problem in problems:
        if there := [c for c in found if c.problem == problem.name]:
            title = f"{problem.name}: {problem.title}"
            yield from (f"<h3>{escape(title)}</h3>", race.panel(there, title), race.seconds(there))
            yield f"<details><summary>Every setting</summary>{race.settings(there)}</details>"


def summary(found: Iterable[Contender]) -> str:
    """The outcome in a sentence or two.

    Args:
        found: Who took part.

    Returns:
        Plain text.
    """
    return verdict(tuple(found))


def verdict(found: Sequence[Contender]) -> str:
    """Who is ahead where, from the numbers.

    Args:
        found: Who took part.

    Returns:
        Plain text.
    """
    rows = [s for s in standings(found) if s.ours is not None or s.theirs is not None]
    if not rows:
        absent = sorted({c.absent for c in found if c.absent and not c.taker.ours})
        return f"Nobody else took part: {'; '.join(absent) or 'see the settings below'}."
    said = []
    for where in dict.fromkeys(s.where for s in rows):
        mine = [phrase(s) for s in rows if s.where == where and s.ahead >= 1.0]
        theirs = [phrase(s) for s in rows if s.where == where and s.ahead < 1.0]
        words = "Among those who move in space" if where == "in space" else "Plane elements counted too"
        said.append(f"{words}, ours are ahead on {listed(mine)}; others are ahead on {listed(theirs)}.")
    return " ".join(said)


def listed(words: Sequence[str]) -> str:
    """With commas, or nothing."""
    return ", ".join(words) if words else "nothing"


def phrase(s: Standing) -> str:
    """Such as "P3 to 1e-05 (44 ×)" or "P1 to 0.001 (OpenSees corot 2D, 12 ×)"."""
    if s.ahead >= 1.0:
        return f"{named(s.problem)} to {s.target:g} ({'alone' if s.ahead == inf else times(s.ahead)})"
    name = "" if s.theirs is None else s.theirs[0].taker.name
    return f"{named(s.problem)} to {s.target:g} ({name}, {times(1.0 / s.ahead) if s.ahead > 0.0 else 'alone'})"


def times(ratio: float) -> str:
    """Such as "4.2 ×"."""
    return f"{race.figures(ratio)} ×"


def asked(rows: Sequence[Aim]) -> str:
    """What ours should reach, and what they do; on a busy machine a miss says little."""
    columns = (
        Column("what", kind="prose"),
        Column("ours", "quickest", "prose"),
        Column("ahead by", kind=NUMBER),
        Column("asked for", kind=NUMBER),
        Column(""),
    )
    lines: list[Row] = []
    for a in rows:
        ahead = times(a.ahead) if isfinite(a.ahead) else "alone"
        lines.append((a.words, a.why, ahead, f"≥ {race.figures(a.least)} ×", Mark(a.holds, severity="slow")))
    missed = [f"{a.words}: {a.profile}." for a in rows if not a.holds and a.profile]
    return table(columns, lines) + "".join(f"<p>{escape(words)}</p>" for words in missed)


def at_once(found: Sequence[Contender]) -> str:
    """Rows of loads, ✓ where a load was taken at once."""
    heads = list(dict.fromkeys(a.stepping for c in found for a in c.attempts))
    columns = (Column("solver"), Column("assumes"), *(Column(load, kind=NUMBER) for load in heads), Column("up to"))
    lines: list[Row] = []
    for title, ours in (("Ours", True), ("Other people's", False)):
        lines.append(Group(title))
        for c in found:
            if c.taker.ours is not ours:
                continue
            if c.absent:
                lines.append((c.taker.name, c.taker.assumes, *("–" for _ in heads), "not here"))
                continue
            taken = {a.stepping: "✓" if a.found is not None else "×" for a in c.attempts}
            marks = (taken.get(load, "–") for load in heads)
            lines.append((c.taker.name, c.taker.assumes, *marks, f"{largest(c):g}"))
    return table(columns, lines)
