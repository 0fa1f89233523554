"""The tables of milliseconds: ours against limits, and beside other people's."""

from __future__ import annotations

from typing import TYPE_CHECKING

from verification.references import peers, peers_measured
from verification.report.diagrams import LETTERS
from verification.report.tables import Column, Group, Mark, Row, ms, scientific, table

if TYPE_CHECKING:
    from verification.suite import Report

__all__ = ["published", "speeds"]

NUMBER = "number"


def speeds(report: Report) -> str:
    """Milliseconds, ours and other people's."""
    columns = (
        Column("problem"),
        Column("by"),
        Column("error", kind=NUMBER),
        Column("solve", "ms, min", NUMBER),
        Column("solve", "ms, median", NUMBER),
        Column("limit", "ms", NUMBER),
        Column("whole call", "ms, median", NUMBER),
        Column("setup", "ms", NUMBER),
        Column("compile", "ms, once", NUMBER),
        Column(""),
    )
    rows: list[Row] = []
    for s in report.speeds:
        t = s.record.timing
        times = map(ms, (t.solve_min, t.solve, s.limit, t.call, t.setup) if t else 5 * (None,))
        rows.append(
            (
                s.title,
                s.mesh,
                scientific(s.record.error),
                *times,
                ms(report.compile_ms(s.record.model)),
                Mark(s.holds, good="within", bad="slower", severity="slow"),
            )
        )
    return table(columns, rows)


def published(report: Report) -> str:
    """What other people's solvers take for the same problems."""
    columns = (
        Column("", "in the figure"),
        Column("solver"),
        Column("kinematics"),
        Column("error", kind=NUMBER),
        Column("solve", "ms", NUMBER),
        Column("ours to that error", "ms, min, in the diagram above", NUMBER),
        Column("by"),
    )
    letters = {
        p: letter for problem in ("elastica", "bend") for p, letter in zip(peers(problem), LETTERS, strict=False)
    }
    rows: list[Row] = []
    for s in report.speeds:
        if s.peers:
            rows.append(Group(f"{s.title}: {s.record.model.rpartition(' ')[2]}"))
        for p in s.peers:
            best = quickest(report, s.record.case, p.error, p.kinematics)
            ours = ("–", "–") if best is None else (ms(best[0]), best[1])
            rows.append((letters[p], p.who, p.kinematics, scientific(p.error, 0), ms(p.ms), *ours))
    note = f"Others were measured in {peers_measured()}; they were not repeated in this run."
    return table(columns, rows) + f'<p class="soft">{note}</p>'


def quickest(report: Report, case: str, error: float, kinematics: str) -> tuple[float, str] | None:
    """Least milliseconds, and the mesh, with which a headline study of the case's family reaches an error."""
    family = case.partition("-")[0]
    reached = [
        (r.timing.solve_min, f"{r.elements} × P{s.degree}")
        for s in report.deep
        if s.case.startswith(family) and s.model.endswith(kinematics)
        for r in s.records
        if r.timing is not None and r.error <= error
    ]
    return min(reached, default=None)
