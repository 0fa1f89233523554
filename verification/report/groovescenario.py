"""Bundles in the groove: what they should show and do, ensembles in numbers, both models side by side."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

from dolfinrod.groove.statistics import of_mean
from verification.groovepaper import PaperRun
from verification.groovescenario import GrooveEnsemble
from verification.groovescenariobeside import AGREES, MIRRORED, GrooveImage, GrooveModels
from verification.groovescenarioclaims import GrooveClaim
from verification.groovescenariosteps import GrooveSteps
from verification.report.groove import figure as panel
from verification.report.groovescenariopaper import rows_of
from verification.report.groovescenariosteps import stepped
from verification.report.lines import Trace, linear
from verification.report.tables import Column, Mark, Row, Swatch, count, figure, scientific, table

if TYPE_CHECKING:
    from collections.abc import Sequence

    from verification.groovescenarioclaims import Gathered

__all__ = ["TITLE", "WORDS", "outcomes", "ranged", "scenarios"]

TITLE = "Bundles in the groove"
WORDS = (
    "Fibres of the paper gathered by air in its lateral and its intermediate groove, with contact between fibres, "
    "friction and a central cylinder, many times with other noise of 1 µm at the start: contact is chaotic, so that "
    "means with intervals of 95 % are what can be compared, single runs are not. Groove, air, ends and core are "
    "assumptions; nothing is fitted to the measured yarns. Twist is that of crossings, half a turn each, which the "
    "angles at the ends do not bias. A report takes three bundles of three fibres on elements four times as long for "
    "1.5 ms, a quick one two of two for a blink; ./run report groove-acceptance takes ten of five on those of the "
    "paper until they are at rest, and again from the other side, with a core that rolls, with half the elements' "
    "length, half the step and twice the penalty, of which three small ones tell nothing."
)
NUMBER, PROSE = "number", "prose"
KINDS = (("continuum", "p3", False), ("discrete", "chord", True))


def outcomes(found: Sequence[Gathered]) -> tuple[tuple[str, Sequence[Gathered], str], ...]:
    """Of this section and that of the paper: their rows, and what is said of those that hold."""
    here = tuple(row for row in found if not isinstance(row, PaperRun))
    return (
        ("groove-scenarios", here, "claims on bundles in the groove hold, and runs of these ended"),
        ("groove-paper", rows_of(found), "readings of the paper that ran, or said why not"),
    )


def scenarios(found: Sequence[Gathered]) -> str:
    """Claims first, then the numbers they rest on; nothing where there are no rows."""
    parts = []
    if claims := [row for row in found if isinstance(row, GrooveClaim)]:
        parts.append(_claims(claims))
    if ensembles := [row for row in found if isinstance(row, GrooveEnsemble)]:
        parts += ["<h3>Ensembles</h3>", _ensembles(ensembles)]
    if images := [row for row in found if isinstance(row, GrooveImage)]:
        parts += ["<h3>Mirror images, built and solved</h3>", _images(images)]
    stepping = [row for row in found if isinstance(row, GrooveSteps)]
    parts += [f"<h3>In ever shorter steps: {escape(row.title)}</h3>{stepped(row)}" for row in stepping]
    models = [row for row in found if isinstance(row, GrooveModels)]
    parts += [f"<h3>{escape(row.title)}: both models</h3>{_models(row)}" for row in models]
    return "\n".join(parts)


def _claims(claims: Sequence[GrooveClaim]) -> str:
    """What should be, what is."""
    columns = Column("what should be", kind=PROSE), Column("what is", kind=PROSE), Column("")
    rows: list[Row] = [(c.title, c.found, Mark(c.holds) if c.asked else "not judged") for c in claims]
    return table(columns, rows)


def _ensembles(found: Sequence[GrooveEnsemble]) -> str:
    columns = (
        Column("bundles", kind=PROSE),
        Column("runs", "ended", NUMBER),
        Column("twist by crossings", "turns/m, mean and 95 %", NUMBER),
        Column("by pairs", "turns/m, end angles included", NUMBER),
        Column("pairs wound", "0.4 turns or more", NUMBER),
        Column("5 crosses 4", "runs", NUMBER),
        Column("width", "µm", NUMBER),
        Column("a run", "s", NUMBER),
    )
    return table(columns, [_ensemble(one) for one in found])


def _ensemble(one: GrooveEnsemble) -> Row:
    """One ensemble."""
    ended = len(one.most)
    return (
        one.title,
        f"{count(ended)} of {count(one.seeds)}",
        ranged(one.crossed, 1),
        ranged(one.paired, 1),
        ranged(one.wound, 1),
        count(round(sum(one.edge))),
        "–" if not ended else count(round(1e6 * sum(one.width) / ended)),
        figure(round(one.seconds / max(one.seeds, 1), 1)),
    )


def ranged(values: Sequence[float], digits: int) -> str:
    """Mean of values with its interval of 95 %, to so many digits; a dash where there are not even two."""
    if len(values) < 2:
        return "–"
    mean = of_mean(values)
    told = f"{mean.value:.{digits}f} ({mean.low:.{digits}f} to {mean.high:.{digits}f})"
    return told.replace("-", "−")


def _images(found: Sequence[GrooveImage]) -> str:
    columns = (
        Column("bundle"),
        Column("model"),
        Column("until", "fibres touch, ms", NUMBER),
        Column("moved by then", "µm", NUMBER),
        Column("apart", f"of the length, at most {scientific(MIRRORED, 0)}", NUMBER),
        Column(""),
    )
    rows: list[Row] = [
        (
            row.title,
            row.model,
            figure(round(1e3 * row.met, 3)),
            count(round(1e6 * row.moved)),
            scientific(row.apart),
            Mark(row.holds),
        )
        for row in found
    ]
    return table(columns, rows)


def _models(row: GrooveModels) -> str:
    """Width, winding and forces over time, then cost."""
    panels, first = [], row.width[0][0]
    for name, unit, factor, values in (
        (f"width less {1e6 * first:.4g} µm", "µm", 1e6, tuple([w - first for w in mine] for mine in row.width)),
        ("winding of pairs, mean", "turns", 1.0, row.wound),
        ("force of walls and core", "mN", 1e3, row.walls),
        ("force between fibres", "mN", 1e3, row.fibres),
    ):
        traces = [
            Trace(kind, tuple(1e3 * t for t in row.t), tuple(factor * v for v in mine), model, dashed=dashed)
            for (model, kind, dashed), mine in zip(KINDS, values, strict=True)
        ]
        panels.append(panel(name.capitalize(), linear(traces, "time [ms]", f"{name} [{unit}]")))
    lines = " ".join(Swatch(kind, dashed, model).html for model, kind, dashed in KINDS)
    cost = ", ".join(
        f"{model} {seconds:.1f} s for {steps} steps"
        for (model, _, _), seconds, steps in zip(KINDS, row.seconds, row.steps, strict=True)
    )
    apart = (
        f"On the processor: {cost}. Until fibres touch, {1e3 * row.met:.2f} ms, widths differ by "
        f"{scientific(row.apart)} of the first, at most {scientific(AGREES, 0)}; later both are samples of a chaotic "
        "motion and need not agree."
    )
    return f'<p class="soft">{lines}</p><div class="panels wide">{"".join(panels)}</div><p>{apart}</p>'
