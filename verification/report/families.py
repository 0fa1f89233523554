"""The cases, family by family: picture, errors, statement, notes."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

from verification.report.diagrams import against_resolution, against_time, kind, model_words
from verification.report.misses import sentence
from verification.report.remarks import REASONS, deviations
from verification.report.sections import observed
from verification.report.shapes import drawn
from verification.report.tables import Column, Mark, Row, Swatch, count, ms, scientific, table
from verification.statement import family_title

if TYPE_CHECKING:
    from verification.statement import Statement
    from verification.suite import Report
    from verification.workprecision import Study

__all__ = ["families", "of_family"]

NUMBER = "number"


def of_family(report: Report) -> dict[str, list[Statement]]:
    """Cases by family, in the order of the report."""
    found: dict[str, list[Statement]] = {}
    for s in report.statements:
        found.setdefault(s.family, []).append(s)
    return found


def families(report: Report) -> str:
    """All families, each a section with one fold a case; headline cases lie open."""
    return "\n".join(
        f'<section id="family-{family}">\n<h3><code>{escape(family)}</code> {escape(family_title(family))}</h3>\n'
        + "\n".join(case(report, s) for s in members)
        + "\n</section>"
        for family, members in of_family(report).items()
    )


def case(report: Report, stated: Statement) -> str:
    """One case."""
    studies = [s for s in report.studies if s.case == stated.name]
    misses = [row for row in report.missed if getattr(row, "case", "") == stated.name]
    unfolded = " open" if stated.name in report.headlines or misses else ""
    return f"""<details class="case" id="case-{escape(stated.name)}"{unfolded}>
<summary><span class="title">{escape(stated.title)}</span> {digest(studies, len(misses))}</summary>
{notes(stated, studies, [sentence(row) for row in misses])}
<div class="panels">{panels(report, stated, studies)}</div>
{runs(studies)}
{statement(stated)}
</details>"""


def digest(studies: list[Study], misses: int) -> str:
    """The least errors of both models, and misses, in the heading of a folded case."""
    words = []
    for family in ("continuum", "discrete"):
        errors = [s.smallest for s in studies if s.family == family and s.model != "discrete paper"]
        if errors:
            words.append(f"{family} {scientific(min(errors))}")
    mark = f' <span class="mark bad">✗ {misses} missed</span>' if misses else ""
    return f'<span class="digest">{" · ".join(words)}{mark}</span>'


def panels(report: Report, stated: Statement, studies: list[Study]) -> str:
    """Picture, error against resolution, error against time."""
    shape = next((s for s in report.shapes if s.case == stated.name), None)
    parts = [] if shape is None else [panel(drawn(shape, stated.title), "Stress free and deformed")]
    if studies:
        parts.append(panel(against_resolution(studies, stated.title), "Error over resolution"))
        parts.append(panel(against_time(studies, stated.title), "Error over time"))
    return "".join(parts)


def panel(drawing: str, title: str) -> str:
    """A small figure."""
    return f"<figure><figcaption>{escape(title)}</figcaption>{drawing}</figure>"


def runs(studies: list[Study]) -> str:
    """A row a study: its curve, its errors from mesh to mesh, its orders, and the cost of its finest mesh."""
    columns = (
        Column("model"),
        Column("elements"),
        Column("errors", "from mesh to mesh"),
        Column("order", "(theory)", NUMBER),
        Column("of r in L2", "(theory)", NUMBER),
        Column("unknowns", "finest", NUMBER),
        Column("iterations", "in steps", NUMBER),
        Column("solve", "ms", NUMBER),
        Column("setup", "ms", NUMBER),
        Column(""),
    )
    return table(columns, map(run, studies))


def run(study: Study) -> Row:
    """One study."""
    finest = study.records[-1]
    failures = [f"{r.elements}: {r.failure}" for r in study.records if r.failure]
    line = study.centreline
    t = finest.timing
    return (
        Swatch(kind(study), study.model.endswith("planar"), model_words(study.model)),
        ", ".join(count(r.elements) for r in study.records),
        ", ".join(scientific(r.error) for r in study.records),
        f"{observed(study.tip)} ({study.tip.theory})",
        "–" if line is None else f"{observed(line)} ({line.theory})",
        count(finest.dofs),
        f"{finest.iterations} in {finest.steps}",
        *map(ms, (t.solve_min, t.setup) if t else (None, None)),
        Mark(False, bad="; ".join(failures), severity="slow") if failures else "",
    )


def notes(stated: Statement, studies: list[Study], misses: list[str]) -> str:
    """Misses, what the case says of deviations, and what is seen of them."""
    parts = [f'<p class="miss">Missed: {escape(words)}.</p>' for words in misses]
    if stated.note:
        parts.append(f'<p class="note">{escape(stated.note)}</p>')
    odd = deviations(studies)
    if odd:
        reason = REASONS.get(stated.family, "")
        why = f" The reason: {escape(reason)}." if reason else ""
        parts.append(f'<p class="soft">Orders that are not those of theory: {escape("; ".join(odd))}.{why}</p>')
    return "\n".join(parts)


def statement(stated: Statement) -> str:
    """What is posed, and what is known of the answer."""
    r = stated.reference
    value = ", ".join(f"{v:.{min(r.digits_trusted + 1, 15)}g}".replace("-", "−") for v in r.value)
    posed = "<br>".join(escape(line) for line in stated.posed)
    facts = {
        "Posed": posed,
        "Read off": f"{escape(stated.quantity)}, errors divided by {stated.length:g} m",
        "Reference": f"({value}) m, {r.digits_trusted} digits trusted, two ways to it differ by "
        f"{scientific(r.agreement, 0)}; <code>{escape(r.id)}</code>",
        "Method": escape(r.method),
        "Source": escape(r.source),
        "Posed by": escape(" and ".join(stated.models)),
        "Again": f"<code>dolfinrod verify {escape(stated.name)}</code>",
    }
    return "<dl>" + "".join(f"<dt>{name}</dt><dd>{words}</dd>" for name, words in facts.items()) + "</dl>"
