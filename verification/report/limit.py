"""What an iteration and a process cost: stacked bars against LAPACK alone, growth on finer meshes, cold starts."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

from verification.cold import SECONDS, Cold
from verification.growth import FROM, POWER, GrowthStudy
from verification.limit import TWICE, Limit
from verification.report.canvas import WIDTH, Curve, log_log, svg, text
from verification.report.families import panel
from verification.report.tables import Column, Group, Mark, Row, Swatch, count, figure, ms, power, table

if TYPE_CHECKING:
    from collections.abc import Sequence

    from verification.suite import Report

__all__ = ["TITLES", "WORDS", "bars", "contents", "growths"]

TITLES = {
    "limit": "Where the time of an iteration goes",
    "growth": "What an iteration costs on finer meshes",
    "cold": "Whole processes from nothing",
}
WORDS = {
    "limit": "An iteration of Newton's method on a cantilever under 10 EI/L², warm, on the processor, each mesh in a "
    "process of its own. Assembly is residual and tangent of all elements; factors are the way of the entries into the "
    "band, LAPACK's factors and the solution; PETSc is its loop with its vectors; Python all else. The floor is "
    f"scipy.linalg.solve_banded on the same matrix in the same order; the aim is {TWICE:g} times that at most. Pivots "
    "are needed: at zero compliance the diagonal has zeros.",
    "growth": "A beam over ten supports, under a line load, on ever more elements. (A cantilever would do in the mixed "
    "form of the continuum. From some 2·10⁴ elements on, what rounds 12 EI/l³ off in the discrete model is stiffer "
    "than all of a cantilever, and it says so.) Time is that of an iteration on the processor, memory the most at any "
    "time of the whole solve, less what the program had before; growth is the power of the number of "
    f"elements from {FROM} on, the aim {POWER:g} at most.",
    "cold": "From the start of Python to its end. The clock is that of the wall, which a busy machine slows; compiling "
    "is what the first run takes longer on the processor with an empty cache of forms, once on a machine, and `./run` "
    f"does it at set-up. The aim for a cantilever with compiled forms is {SECONDS:g} s.",
}
NUMBER = "number"
# Name, what it is called, and its colour in the bars.
PARTS = (
    ("assembly", "assembly", "p4"),
    ("factors", "factors", "p3"),
    ("petsc", "PETSc", "p1"),
    ("python", "Python", "p5"),
)
KINDS = {"planar": "p2", "spatial": "p3", "discrete": "chord"}
# Of a bar and its place [px].
THICK, EVERY, LEFT, RIGHT = 15, 34, 8, 12


def contents(report: Report) -> dict[str, str]:
    """The sections by key, empty where nothing was measured."""
    iterations = [row for row in report.costs if isinstance(row, Limit)]
    starts = [row for row in report.costs if isinstance(row, Cold)]
    return {
        "limit": _limits(iterations) if iterations else "",
        "growth": _growths(growths(report)) if growths(report) else "",
        "cold": _starts(starts) if starts else "",
    }


def growths(report: Report) -> Sequence[GrowthStudy]:
    """Of the costs in a report those on finer and finer meshes."""
    return [row for row in report.costs if isinstance(row, GrowthStudy)]


def _limits(found: Sequence[Limit]) -> str:
    columns = (
        Column("model"),
        Column("mesh"),
        Column("unknowns", "", NUMBER),
        Column("half-band", "", NUMBER),
        Column("iteration", "ms", NUMBER),
        *(Column(words, "ms", NUMBER) for _, words, _ in PARTS),
        Column("solve_banded", "ms", NUMBER),
        Column("factors over it", "", NUMBER),
        Column(""),
    )
    rows: list[Row] = [_row(row) for row in found]
    sound = [row for row in found if not row.failure]
    key = " ".join(f'<span style="color:var(--{colour})">■</span> {words}' for _, words, colour in PARTS)
    drawn = f'<p class="soft">{key}; the stroke below is solve_banded.</p><div class="panels wide">{bars(sound)}</div>'
    return (drawn if sound else "") + table(columns, rows)


def _row(row: Limit) -> Row:
    if row.failure:
        return (row.model, row.mesh, *("–",) * 9, Mark(False, bad=row.failure))
    times = (row.ms, *(getattr(row, name) for name, _, _ in PARTS), row.banded)
    sizes = (count(row.unknowns), count(row.half))
    verdict = Mark(row.within, good="within", bad="slower", severity="slow")
    return (row.model, row.mesh, *sizes, *map(ms, times), figure(round(row.ratio, 2)), verdict)


def bars(found: Sequence[Limit]) -> str:
    """Iterations as stacked bars, each to a scale of its own: shares are what is to be seen."""
    height, parts = EVERY * len(found) + 8.0, []
    for k, row in enumerate(found):
        top, x, scale = EVERY * k + 16.0, float(LEFT), (WIDTH - LEFT - RIGHT) / row.ms
        parts.append(text(LEFT, top - 4, f"{row.model}, {row.mesh}: {ms(row.ms)} ms"))
        for name, words, colour in PARTS:
            wide = scale * getattr(row, name)
            title = f"<title>{escape(words)}: {getattr(row, name) / row.ms:.0%}</title>"
            style = f"fill:var(--{colour})"
            parts.append(f'<path style="{style}" d="M{x:.1f},{top:.1f}h{wide:.1f}v{THICK}h-{wide:.1f}z">{title}</path>')
            x += wide
        begin = LEFT + scale * row.assembly
        line = f"M{begin:.1f},{top + THICK + 2:.1f}h{scale * row.banded:.1f}"
        parts.append(f'<path style="stroke:var(--ink);stroke-width:2" d="{line}"/>')
    return panel(svg("".join(parts), "shares of assembly, factors, PETSc and Python in iterations", height), "Shares")


def _growths(found: Sequence[GrowthStudy]) -> str:
    columns = (
        Column("elements", "", NUMBER),
        Column("unknowns", "", NUMBER),
        Column("iterations", "", NUMBER),
        Column("an iteration", "ms", NUMBER),
        Column("memory", "MB", NUMBER),
        Column(""),
    )
    rows: list[Row] = []
    for study in found:
        grows = ", ".join(f"{name} {power(study.slope(key))}" for name, key in (("time", "ms"), ("memory", "memory")))
        verdict = f"within {POWER:g}" if study.within else f"beyond {POWER:g}"
        rows.append(Group(f"{_who(study)}: growth of {grows}, {verdict}"))
        for row in study.rows:
            sizes = (count(row.elements), count(row.unknowns), count(row.iterations))
            costs = ("–", "–") if row.failure else (ms(row.ms), count(round(row.memory)))
            rows.append((*sizes, *costs, Mark(not row.failure, bad=row.failure)))
    lines = " ".join(Swatch(KINDS[s.model], False, _who(s)).html for s in found)
    drawn = panel(_diagram(found, "ms", "iteration [ms]"), "Time") + panel(_diagram(found, "memory", "MB"), "Memory")
    return (
        f'<p class="soft">{lines}. Numbers are growths.</p><div class="panels wide">{drawn}</div>{table(columns, rows)}'
    )


def _who(study: GrowthStudy) -> str:
    """A model in words."""
    return study.model if study.model == "discrete" else f"{study.model} P{study.degree}"


def _diagram(found: Sequence[GrowthStudy], quantity: str, y: str) -> str:
    """A property of the runs over the number of elements."""
    curves = []
    for study in found:
        rows = [row for row in study.rows if not row.failure and getattr(row, quantity) > 0.0]
        grows = power(study.slope(quantity))
        along = tuple(float(row.elements) for row in rows), tuple(float(getattr(row, quantity)) for row in rows)
        curves.append(Curve(KINDS[study.model], *along, title=f"{_who(study)}: growth {grows}", label=grows))
    return log_log(curves, x="elements", y=y, alt=f"{y} over the number of elements")


def _starts(found: Sequence[Cold]) -> str:
    columns = (
        Column("process"),
        Column("clock", "s, least", NUMBER),
        Column("processor", "s, least", NUMBER),
        Column("compiling", "s, once", NUMBER),
        Column("limit", "s", NUMBER),
        Column(""),
    )
    rows: list[Row] = []
    for row in found:
        times = (row.clock, row.processor, row.compiling, row.limit)
        shown = ("–" if t is None or row.failure else figure(round(t, 2)) for t in times)
        verdict = Mark(row.within, good="within", bad=row.failure or "slower", severity="slow")
        rows.append((row.words, *shown, verdict if row.limit or row.failure else ""))
    return table(columns, rows)
