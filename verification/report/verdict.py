"""What a reader should know first: one figure, and sentences made of the numbers."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

from verification.reach import TARGETS
from verification.report.canvas import Curve, log_log
from verification.report.diagrams import LOWEST
from verification.report.outcomes import outcomes
from verification.report.tables import scientific

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from verification.reach import Reach
    from verification.suite import Report

__all__ = ["panels", "sentences"]

# What the mission names, as family and case: cantilever, in space, buckling; the groove has studies of its own.
PANELS = (
    ("Cantilever bent over by its tip load", "elastica"),
    ("Curved cantilever, in space", "bend45"),
    ("Column beyond its critical load", "postbuckling"),
)
KINDS = {"continuum": "p3", "discrete": "chord"}
Point = tuple[float, float]


def panels(report: Report) -> tuple[tuple[str, str], ...]:
    """Title and diagram, error over seconds, of each benchmark that was solved for.

    Every curve is the front of all runs of a model: none of the others is both quicker and nearer.
    """
    drawn = []
    for title, family in PANELS:
        if case := _case(report, family):
            found = {model: front(_timed(report, case, model)) for model in KINDS}
            drawn.append((title, _diagram(found, title, "load stepping, warm [ms]")))
    sweeps = [s for s in report.grooves if s.over != "penalty"]
    if sweeps:
        runs = {
            model: [
                (p.seconds, p.error) for s in sweeps if s.solver.startswith(model) for p in s.points if not p.failure
            ]
            for model in KINDS
        }
        title = "Fibre dragged into the groove"
        found = {model: front(points) for model, points in runs.items()}
        drawn.append((title, _diagram(found, title, "whole solve [s]")))
    return tuple(drawn)


def front(points: Iterable[Point]) -> tuple[Point, ...]:
    """Runs of which no other is both quicker and nearer, the quickest first."""
    kept: list[Point] = []
    for time, error in sorted(points):
        if not kept or error < kept[-1][1]:
            kept.append((time, error))
    return tuple(kept)


def sentences(report: Report) -> tuple[str, ...]:
    """Five at most: what holds, cantilevers, buckling, the groove, which model for what."""
    return tuple(
        sentence
        for sentence in (_held(report), _bent(report), _buckled(report), _grooved(report), _chosen(report))
        if sentence
    )


def _held(report: Report) -> str:
    kinds = outcomes(report)
    good, total, missed = sum(k.good for k in kinds), sum(k.total for k in kinds), len(report.missed)
    if not total:
        return ""
    slow = sum(k.total - k.good for k in kinds if k.mark == "slow")
    rest = {"explained at their cases": total - good - missed - slow, "of times on this machine": slow}
    others = "".join(f", {n} {words}" for words, n in rest.items() if n > 0)
    beyond = f"{missed} {'is' if missed == 1 else 'are'} beyond, each listed below" if missed else "none is beyond"
    return f"Of {total} numbers with a limit, {good} hold{others}; {beyond}."


def _bent(report: Report) -> str:
    case = _case(report, "elastica")
    return f"A cantilever bent over by its tip load: {_quickest(report, case)}." if case else ""


def _buckled(report: Report) -> str:
    case, critical = _case(report, "postbuckling"), [row for row in report.critical if row.holds]
    parts = []
    if critical:
        parts.append(f"{len(critical)} of {len(report.critical)} critical loads and frequencies are right")
    if case:
        parts.append(f"beyond the critical load, {_quickest(report, case)}")
    return f"Buckling: {'; '.join(parts)}." if parts else ""


def _grooved(report: Report) -> str:
    if not report.beside:
        return ""
    worst = max(report.beside, key=lambda pair: pair.forces)
    times = ", ".join(f"{p.solver} {p.seconds:.1f} s" for p in worst.profiles)
    return (
        f"In the groove, forces of contact of the two models differ by {scientific(worst.forces)} at most ({times} for "
        "the same way)."
    )


def _chosen(report: Report) -> str:
    """How often each model is the quicker one to an error, of the cases that both take."""
    parts = []
    for target in TARGETS:
        wins = dict.fromkeys(KINDS, 0)
        for rows in _by_case(report, target):
            there = [(row.seconds, row.model) for row in rows if row.seconds is not None]
            if there:
                wins[min(there)[1].split()[0]] += 1
        if any(wins.values()):
            counted = ", ".join(f"{model} in {n}" for model, n in wins.items())
            parts.append(f"to {scientific(target, 0)} {counted}")
    return f"The quicker model of the cases that both solve: {'; '.join(parts)}." if parts else ""


def _by_case(report: Report, target: float) -> Iterator[list[Reach]]:
    """Runs to an error, of each case that both models take."""
    cases: dict[str, list[Reach]] = {}
    for row in report.reaches:
        if row.target == target:
            cases.setdefault(row.case, []).append(row)
    yield from (rows for rows in cases.values() if {row.model.split()[0] for row in rows} == set(KINDS))


def _quickest(report: Report, case: str) -> str:
    """How soon each model reaches the least error asked for that it reaches."""
    words = []
    for model in KINDS:
        there = [r for r in report.reaches if r.case == case and r.model.startswith(model) and r.seconds is not None]
        if there:
            best = min(there, key=lambda r: (r.target, r.seconds))
            words.append(
                f"{model} to {scientific(best.target, 0)} in {1e3 * (best.seconds or 0.0):.2g} ms ({best.mesh})"
            )
        else:
            words.append(f"{model} not to {scientific(TARGETS[0], 0)}")
    return ", ".join(words)


def _case(report: Report, family: str) -> str:
    """The case of a family that was studied in depth, or the first; "" where none was."""
    solved = {study.case for study in report.studies}
    found = [s.name for s in report.statements if s.family == family and s.name in solved]
    deep = [case for case in found if case in report.headlines]
    return (deep + found + [""])[0]


def _timed(report: Report, case: str, model: str) -> Iterator[Point]:
    """Milliseconds and errors of all runs; those of the paper's axial form left out."""
    for study in report.studies:
        if study.case == case and study.family == model and not study.model.endswith("paper"):
            for r in study.records:
                if r.timing is not None and r.failure is None:
                    yield r.timing.solve_min, max(r.error, LOWEST)


def _diagram(found: dict[str, tuple[Point, ...]], title: str, axis: str) -> str:
    curves = [
        Curve(KINDS[model], tuple(x for x, _ in points), tuple(y for _, y in points), model, label=model, at=0)
        for model, points in found.items()
        if points
    ]
    return log_log(curves, x=axis, y="relative error", alt=f"{escape(title)}: relative error over {axis}")
