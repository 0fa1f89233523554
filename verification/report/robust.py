"""Hard cases, loads taken at once and fewest steps, beside other people's solvers, as tables."""

from __future__ import annotations

from itertools import groupby
from typing import TYPE_CHECKING

from verification.hard import SHARE, share
from verification.references.robustness import PEER_LOADS, PEER_PROBLEMS, peer_loads, peer_steps, robustness_measured
from verification.report.misses import verdict
from verification.report.tables import Column, Group, Mark, Row, count, ms, scientific, table
from verification.robustness import LOADS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from verification.hard import HardRow
    from verification.robustness import OneStepLoads, Steps

__all__ = ["fewest", "hard", "largest", "verdict_on_hard"]

NUMBER, PROSE = "number", "prose"
DASH = "–"


def hard(found: Sequence[HardRow]) -> str:
    """Every hard case by both models."""
    columns = (
        Column("case", kind=PROSE),
        Column("model"),
        Column("mesh"),
        Column("outcome"),
        Column("load", "steps", NUMBER),
        Column("Newton", "iterations", NUMBER),
        Column("cuts", kind=NUMBER),
        Column("state"),
        Column("error", kind=NUMBER),
        Column("against, or why refused", kind=PROSE),
        Column("call", "ms", NUMBER),
    )
    rows: list[Row] = []
    for name, group in groupby(found, key=lambda r: r.group):
        rows.append(Group(name))
        for _, members in groupby(group, key=lambda r: r.case):
            rows += [hard_row(r, r.title if k == 0 else "") for k, r in enumerate(members)]
    return f"<p>{verdict_on_hard(tuple(found))}</p>" + table(columns, rows)


def hard_row(r: HardRow, title: str) -> Row:
    """A hard case by one model."""
    return (
        title,
        r.model,
        r.mesh,
        Mark(r.converged, good=r.outcome, bad=r.outcome, severity="bad" if not r.holds else "slow"),
        count(r.steps),
        count(r.iterations),
        count(r.cuts),
        verdict(r.stable),
        scientific(r.error),
        r.reason or r.check,
        ms(r.ms),
    )


def verdict_on_hard(found: tuple[HardRow, ...]) -> str:
    """How many of the rows of each model converge, in a sentence."""
    parts = []
    for model in dict.fromkeys(r.model for r in found):
        rows = [r for r in found if r.model == model]
        lies = sum(not r.holds for r in rows)
        good = sum(r.converged for r in rows)
        parts.append(f"{model}: {good} of {len(rows)} rows converge ({100 * share(found, model):.0f} %), {lies} wrong")
    return "; ".join(parts) + f". Asked of the continuum model: {100 * SHARE:.0f} %, none wrong."


def largest(ours: Sequence[OneStepLoads]) -> str:
    """Loads at once, beside other people's solvers."""
    columns = (
        Column("model"),
        Column("up to", "EI/L²", NUMBER),
        *(Column(f"{load:g}", kind=NUMBER) for load in LOADS),
        Column(""),
    )
    rows: list[Row] = [Group("ours, measured in this run")]
    for r in ours:
        cells = (DASH if n is None else count(n) for n in r.iterations)
        rows.append((r.model, f"{r.largest:g}", *cells, Mark(r.holds)))
    rows.append(Group(f"published: {robustness_measured()}"))
    for peer in peer_loads():
        cells = (DASH if n is None else count(n) for n in peer.iterations)
        rows.append((peer.who, f"{peer.largest:g}", *cells, *[""] * (len(LOADS) - len(PEER_LOADS)), ""))
    return table(columns, rows)


def fewest(ours: Sequence[Steps]) -> str:
    """Load steps, beside other people's."""
    columns = (
        Column("model"),
        Column("elements", kind=NUMBER),
        Column("load steps", kind=NUMBER),
        Column("limit", kind=NUMBER),
        Column("iterations", kind=NUMBER),
        Column("limit", kind=NUMBER),
        Column("cuts", kind=NUMBER),
        Column("error", kind=NUMBER),
        Column(""),
    )
    rows: list[Row] = []
    for title, group in groupby(ours, key=lambda r: r.title):
        rows.append(Group(title))
        for r in group:
            rows.append(
                (
                    r.model,
                    count(r.mesh),
                    count(r.steps),
                    limit(r.most_steps),
                    count(r.iterations),
                    limit(r.most_iterations),
                    count(r.cuts),
                    scientific(r.error),
                    Mark(r.holds, bad="refused" if r.failure else "missed", severity="bad" if r.missed else "slow"),
                )
            )
    return table(columns, rows) + others(ours)


def limit(most: int | None) -> str:
    """A limit, where there is one."""
    return DASH if most is None else count(most)


def others(ours: Sequence[Steps]) -> str:
    """Steps of other people's solvers, those of ours above, on the problems that both were tried on; or nothing."""
    problems = tuple(dict.fromkeys(r.peer for r in ours if r.peer))
    who = tuple(dict.fromkeys(p.who for problem in problems for p in peer_steps(problem)))
    rows: list[Row] = [Group("ours, measured in this run")]
    for model in dict.fromkeys(r.model for r in ours):
        taken = {r.peer: r.steps for r in reversed(ours) if r.model == model and not r.failure}
        rows.append((model, *(str(taken.get(problem, "")) for problem in problems)))
    rows.append(Group(f"published, fewest equal steps: {robustness_measured()}"))
    for name in who:
        found = ({p.who: p.steps for p in peer_steps(problem)} for problem in problems)
        rows.append((name, *("" if name not in steps else limit(steps[name]) for steps in found)))
    columns = (Column("model"), *(Column(PEER_PROBLEMS[problem], kind=NUMBER) for problem in problems))
    return table(columns, rows) if problems else ""
