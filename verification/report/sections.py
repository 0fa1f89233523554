"""The sections of the page: each turns rows of the record into a table."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby
from typing import TYPE_CHECKING

from verification.report.tables import Column, Group, Mark, Row, count, ms, power, scientific, table
from verification.suite import STANDARD

if TYPE_CHECKING:
    from verification.order import Order
    from verification.suite import Report
    from verification.workprecision import Record, Study

__all__ = ["all_cases", "crosschecks", "errors", "machine", "one_step", "orders", "references"]

NUMBER = "number"
KINEMATICS = ("planar", "spatial")


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
    for title, group in groupby(checks, key=lambda c: c.title):
        rows.append(Group(title))
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
    missed = {(c.title, c.model) for c in report.checks if c.quantity.startswith("order") and not c.holds}
    rows: list[Row] = []
    for title, group in groupby(report.headlines, key=lambda s: s.title):
        rows.append(Group(title))
        studies = sorted(group, key=lambda s: (s.family, s.degree))
        for name, pair in groupby(studies, key=lambda s: s.model.removesuffix(" planar").removesuffix(" spatial")):
            both = {s.model.rpartition(" ")[2] if s.family == "continuum" else "spatial": s for s in pair}
            holds = not any((title, s.model) in missed for s in both.values())
            cells = (*order_cells(both, "tip"), *order_cells(both, "centreline"))
            rows.append((name, *cells, Mark(holds, bad="falls short")))
    return table(columns, rows)


def order_cells(both: dict[str, Study], quantity: str) -> Iterator[str]:
    """Theory, then what planar and spatial kinematics show."""
    theory: Order | None = getattr(next(iter(both.values())), quantity)
    yield "–" if theory is None else count(theory.theory)
    for k in KINEMATICS:
        order: Order | None = getattr(both[k], quantity) if k in both else None
        yield "–" if order is None else observed(order)


def observed(order: Order) -> str:
    """An order, or that round-off hides it."""
    return "round-off" if order.observed is None and order.worst < 1e-9 else power(order.observed)


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
    for title, group in groupby(report.one_step, key=lambda r: r.title):
        both = {r.kinematics: r for r in group}
        in_order = [both.get(k) for k in KINEMATICS]
        some = next(iter(both.values()))
        failure = "; ".join(r.failure for r in both.values() if r.failure)
        rows.append(
            (
                title,
                some.mesh,
                count(some.limit),
                *("–" if r is None else count(r.iterations) for r in in_order),
                count(max(r.steps for r in both.values())),
                *("–" if r is None else scientific(r.error) for r in in_order),
                Mark(all(r.holds for r in both.values()), bad=failure or "missed"),
            )
        )
    return table(columns, rows)


def crosschecks(report: Report) -> str:
    """Both models against each other."""
    columns = (
        Column("discrete elements", kind=NUMBER),
        Column("difference of the tips", "/L", NUMBER),
        Column("discrete error", "estimated", NUMBER),
        Column("continuum error", "estimated", NUMBER),
        Column("ratio", kind=NUMBER),
        Column(""),
    )
    rows: list[Row] = []
    for title, group in groupby(report.crosschecks, key=lambda r: r.title):
        rows.append(Group(title))
        for r in group:
            total = r.discrete_error + r.continuum_error
            ratio = power(r.difference / total) if total > 1e-9 else "–"
            figures = map(scientific, (r.difference, r.discrete_error, r.continuum_error))
            rows.append((count(r.elements), *figures, ratio, Mark(r.holds, bad=r.failure or "unexplained")))
    return table(columns, rows)


def all_cases(report: Report) -> str:
    """Every case by every model that poses it, on the standard mesh."""
    columns = (
        Column("model"),
        Column("elements", kind=NUMBER),
        Column("unknowns", kind=NUMBER),
        Column("error", "tip", NUMBER),
        Column("order", "tip", NUMBER),
        Column("theory", kind=NUMBER),
        Column("iterations", kind=NUMBER),
        Column("steps", kind=NUMBER),
        Column("solve", "ms", NUMBER),
        Column("setup", "ms", NUMBER),
        Column("compile", "ms, once", NUMBER),
        Column(""),
    )
    rows: list[Row] = []
    for title, group in groupby(report.cases, key=lambda s: s.title):
        rows.append(Group(title))
        rows += [case_row(s, report.compile_ms(s.model)) for s in group]
    return table(columns, rows)


def case_row(study: Study, compile_ms: float | None) -> Row:
    """The timed mesh of a study, or, where nothing converged, its finest."""
    r: Record = next((r for r in study.records if r.timing is not None), study.records[-1])
    t = r.timing
    times = map(ms, (t.solve, t.setup, compile_ms) if t else 3 * (None,))
    return (
        study.model,
        count(r.elements),
        count(r.dofs),
        scientific(r.error),
        observed(study.tip),
        count(study.tip.theory),
        count(r.iterations),
        count(r.steps),
        *times,
        Mark(r.failure is None, good="converged", bad=r.failure or ""),
    )


def references(report: Report) -> str:
    """Where every reference comes from."""
    columns = (
        Column("case"),
        Column("reference"),
        Column("x", kind=NUMBER),
        Column("y", kind=NUMBER),
        Column("z", kind=NUMBER),
        Column("digits trusted", kind=NUMBER),
        Column("two methods differ by", kind=NUMBER),
        Column("method and source", kind="prose"),
    )
    rows: list[Row] = [
        (
            title,
            r.id,
            *(f"{v:.12g}".replace("-", "−") for v in r.value),
            count(r.digits_trusted),
            scientific(r.agreement, 0),
            f"{r.method}. {r.source}",
        )
        for title, r in report.references.items()
    ]
    return table(columns, rows)


def machine(report: Report) -> str:
    """Machine and versions."""
    m = report.machine
    facts = {
        "date": m.date,
        "processor": f"{m.processor}, {m.cores} cores",
        "threads": f"OMP_NUM_THREADS = {m.threads}, one MPI rank",
        "load average at the start": f"{m.load:.2f}" + (" (others were busy: times are noisy)" if m.load > 1.2 else ""),
        "system": m.system,
        **m.versions,
    }
    return table((Column("what"), Column("value", kind="prose")), facts.items())


def standard() -> str:
    """The standard meshes in words."""
    return f"{STANDARD['continuum']} continuum elements (a turn), {STANDARD['discrete']} discrete ones"
