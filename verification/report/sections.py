"""The sections of the page: each turns rows of the record into a table."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby
from math import isfinite, log10
from typing import TYPE_CHECKING

from verification.reach import TARGETS
from verification.report.canvas import power_of_ten
from verification.report.diagrams import model_words
from verification.report.tables import Column, Group, Link, Mark, Row, count, power, scientific, table

if TYPE_CHECKING:
    from pathlib import Path

    from verification.checks import Check
    from verification.order import Order
    from verification.reach import Reach
    from verification.suite import Report
    from verification.workprecision import Study

__all__ = ["crosschecks", "errors", "laws", "machine", "observed", "one_step", "orders", "reached"]

NUMBER = "number"
KINEMATICS = ("planar", "spatial")


def anchor(report: Report, case: str) -> str:
    """Where a case stands on the page; empty where it has no section of its own."""
    return f"#case-{case}" if any(s.name == case for s in report.statements) else ""


def errors(report: Report) -> str:
    """Errors against the limits of the issue."""
    columns = (
        Column("mesh"),
        Column("limit", "|tip − reference|/L", NUMBER),
        Column("planar", kind=NUMBER),
        Column("spatial", kind=NUMBER),
        Column(""),
    )
    rows: list[Row] = []
    checks = [c for c in report.checks if c.quantity.startswith("error")]
    for (case, title), group in groupby(checks, key=lambda c: (c.case, c.title)):
        rows.append(Group(title, anchor(report, case)))
        for mesh, pair in groupby(group, key=lambda c: c.mesh):
            both = {c.model.rpartition(" ")[2]: c for c in pair}
            limit = scientific(max(c.limit for c in both.values()), 0)
            found = (scientific(both[k].found) if k in both else "–" for k in KINEMATICS)
            rows.append((mesh, limit, *found, Mark(all(c.holds for c in both.values()))))
    return table(columns, rows)


def orders(report: Report) -> str:
    """Observed orders of every degree against theory."""
    columns = (
        Column("model"),
        Column("tip", "theory", NUMBER),
        *(Column(k, kind=NUMBER) for k in KINEMATICS),
        Column("r in L2", "theory", NUMBER),
        *(Column(k, kind=NUMBER) for k in KINEMATICS),
        Column(""),
    )
    short: dict[tuple[str, str], Check] = {
        (c.case, c.model): c for c in report.checks if c.quantity.startswith("order") and not c.holds
    }
    rows: list[Row] = []
    for (case, title), group in groupby(report.deep, key=lambda s: (s.case, s.title)):
        rows.append(Group(title, f"#case-{case}"))
        studies = sorted(group, key=lambda s: (s.family, s.degree))
        for name, pair in groupby(studies, key=lambda s: s.model.removesuffix(" planar").removesuffix(" spatial")):
            both = {s.model.rpartition(" ")[2] if s.family == "continuum" else "spatial": s for s in pair}
            found = [short[case, s.model] for s in both.values() if (case, s.model) in short]
            cells = (*order_cells(both, "tip"), *order_cells(both, "centreline"))
            rows.append((model_words(name), *cells, order_mark(found)))
    return table(columns, rows)


def order_mark(short: list[Check]) -> Mark:
    """A miss, a deviation that the case explains, or neither."""
    if any(c.missed for c in short):
        return Mark(False, bad="falls short")
    return Mark(not short, bad="explained at the case", severity="slow")


def order_cells(both: dict[str, Study], quantity: str) -> Iterator[str]:
    """Theory, then what planar and spatial kinematics show."""
    theory: Order | None = getattr(next(iter(both.values())), quantity)
    yield "–" if theory is None else count(theory.theory)
    for k in KINEMATICS:
        order: Order | None = getattr(both[k], quantity) if k in both else None
        yield "–" if order is None else observed(order)


def observed(order: Order) -> str:
    """An order, or that what cannot be told apart from the reference hides it."""
    return "hidden" if order.observed is None and isfinite(order.worst) else power(order.observed)


def one_step(report: Report) -> str:
    """Whole loads at once."""
    columns = (
        Column("load"),
        Column("mesh"),
        Column("limit", "iterations", NUMBER),
        *(Column(k, "iterations", NUMBER) for k in KINEMATICS),
        Column("load steps", kind=NUMBER),
        *(Column(k, "error", NUMBER) for k in KINEMATICS),
        Column(""),
    )
    rows: list[Row] = []
    for (case, title), group in groupby(report.one_step, key=lambda r: (r.case, r.title)):
        both = {r.kinematics: r for r in group}
        in_order = [both.get(k) for k in KINEMATICS]
        some = next(iter(both.values()))
        failure = "; ".join(r.failure for r in both.values() if r.failure)
        rows.append(
            (
                Link(anchor(report, case), title),
                some.mesh,
                count(some.limit),
                *("–" if r is None else count(r.iterations) for r in in_order),
                count(max(r.steps for r in both.values())),
                *("–" if r is None else scientific(r.error) for r in in_order),
                Mark(all(r.holds for r in both.values()), bad=failure or "missed"),
            )
        )
    return table(columns, rows)


def crosschecks(report: Report, cases: set[str]) -> str:
    """Both models against each other on some cases; empty where there is none."""
    columns = (
        Column("case"),
        Column("elements", "discrete", NUMBER),
        Column("difference", "/L", NUMBER),
        Column("discrete error", "estimated", NUMBER),
        Column("continuum error", "estimated", NUMBER),
        Column("elongation", "of the discrete model", NUMBER),
        Column("ratio", kind=NUMBER),
        Column(""),
    )
    chosen = [r for r in report.crosschecks if r.case in cases]
    rows: list[Row] = []
    for (case, title), group in groupby(chosen, key=lambda r: (r.case, r.title)):
        for k, r in enumerate(group):
            name = Link("", "") if k else Link(anchor(report, case), title)
            ratio = power(r.difference / r.estimate) if r.estimate > 10.0 * r.tolerance else "–"
            figures = map(scientific, (r.difference, r.discrete_error, r.continuum_error, r.elongation))
            rows.append((name, count(r.elements), *figures, ratio, Mark(r.holds, bad=r.failure or "unexplained")))
    return table(columns, rows) if rows else ""


def laws(report: Report, tests: Path | None) -> str:
    """Laws against their bounds, with links to the tests that assert them on more inputs."""
    columns = (
        Column("law and model"),
        Column("violation", "relative", NUMBER),
        Column("bound", kind=NUMBER),
        Column(""),
        Column("asserted by"),
    )
    rows: list[Row] = []
    for _, group in groupby(report.laws, key=lambda r: r.name):
        members = list(group)
        first = members[0]
        words = first.statement[:1].lower() + first.statement[1:].rstrip(".")
        rows.append(Group(f"{first.title}: {words}"))
        file, _, test = first.test.partition("::")
        address = "" if tests is None else f"{tests / file}"
        for r in members:
            where = Link(address, f"{file.rpartition('/')[2]}::{test}")
            rows.append((model_words(r.model), scientific(r.found), scientific(r.bound, 0), Mark(r.holds), where))
    return table(columns, rows)


def reached(report: Report, cases: set[str]) -> str:
    """Seconds to given errors, some cases by every model."""
    columns = (
        Column("model"),
        *(Column(f"to {power_of_ten(round(log10(target)))}", "s, on", NUMBER) for target in TARGETS),
        Column("least error", kind=NUMBER),
        Column("order", "tip", NUMBER),
        Column("theory", kind=NUMBER),
    )
    titles = {s.name: s.title for s in report.statements}
    rows: list[Row] = []
    for case, group in groupby((r for r in report.reaches if r.case in cases), key=lambda r: r.case):
        rows.append(Group(titles[case], f"#case-{case}"))
        for model, members in groupby(group, key=lambda r: r.model):
            rows.append(reached_row(report, case, model, list(members)))
    return table(columns, rows)


def reached_row(report: Report, case: str, model: str, members: list[Reach]) -> Row:
    """One model of one case."""
    studies = [s for s in report.studies if s.case == case and fits(s, model)]
    best = min(studies, key=lambda s: s.smallest)
    cells = (f"{seconds(r.seconds)} · {r.mesh}" if r.seconds is not None else "not reached" for r in members)
    return (model, *cells, scientific(best.smallest), observed(best.tip), count(best.tip.theory))


def fits(study: Study, model: str) -> bool:
    """Whether a study is of a model as `reach` names it."""
    family, _, kinematics = model.partition(" ")
    return study.family == family and study.model.endswith(kinematics or "chord")


def seconds(value: float) -> str:
    """Two digits: 0.0042."""
    return f"{value:.2g}" if value < 1.0 else f"{value:.1f}"


def machine(report: Report) -> str:
    """Machine and versions, and what the suite itself took."""
    m = report.machine
    at_once = "one" if report.jobs == 1 else f"{report.jobs}, so that times are noisier than with one"
    facts = {
        "date": m.date,
        "processor": f"{m.processor}, {m.cores} cores",
        "threads": f"OMP_NUM_THREADS = {m.threads}, one MPI rank",
        "load average at the start": f"{m.load:.2f}" + (" (others were busy: times are noisy)" if m.load > 1.2 else ""),
        "units of work at once": at_once,
        "source": m.source or "not under git",
        "system": m.system,
        **m.versions,
    }
    return table((Column("what"), Column("value", kind="prose")), facts.items()) + took(report)


def took(report: Report) -> str:
    """Seconds of the suite by kind of work."""
    if not report.spent:
        return ""
    columns = (
        Column("kind of work"),
        Column("units", "", "number"),
        Column("all", "s", "number"),
        Column("longest", kind="prose"),
        Column("it took", "s", "number"),
    )
    rows = ((s.topic, count(s.units), seconds(s.seconds), s.longest, seconds(s.most)) for s in report.spent)
    whole = sum(s.seconds for s in report.spent)
    return f"<h3>What the suite took: {seconds(whole / 60.0)} min of work</h3>" + table(columns, rows)
