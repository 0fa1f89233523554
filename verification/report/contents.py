"""What the page holds, section by section, each with a sentence on what to see."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

from verification.crosscheck import BAND
from verification.report import peers, sections, times, trials
from verification.report.diagrams import against_time
from verification.report.families import families, of_family, panel
from verification.report.remarks import literal_remark
from verification.statement import family_title

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from verification.suite import Report

__all__ = ["TITLES", "contents"]

TITLES = {
    "reach": "Seconds to an error",
    "laws": "Laws",
    "cross": "Model against model",
    "limits": "Errors against their limits",
    "step": "One load step",
    "orders": "Orders of convergence",
    **trials.TITLES,
    "speed": "Milliseconds beside other people's solvers",
    **peers.TITLES,
    "cases": "The cases",
    "machine": "Machine",
}
WORDS = {
    "reach": "The quickest run that was measured and reaches the error, never an interpolation: load stepping alone, "
    "warm, one thread, least of the repetitions, with its mesh (elements × degree, or discrete elements). Not reached: "
    "by no mesh of this run; the least error of any stands beside, with the order of the study it comes from.",
    "laws": "What must hold whatever the numbers are, on a clamped arc under dead and follower loads with no two "
    "stiffnesses alike, by either model: 8 cubic elements, 20 discrete ones. Violations are relative to the length, "
    "the largest force and moment, or the energy; all are round-off but the energy's, which has a quadrature's error.",
    "cross": "No reference enters. Each model's error is estimated from its own refinement (Richardson), that of the "
    "discrete model on the mesh named; the difference of the two must be the sum. A ratio outside "
    f"{BAND[0]:g} to {BAND[1]:g} is a miss, beyond what the discrete model stretches rods that should not stretch (it "
    "lends them EA = 10⁸ EI/L²); no ratio is given where that stretch is a tenth of the difference or more.",
    "limits": "Errors of the tip on given meshes, whole load in one step, nothing tuned.",
    "step": "Total Newton iterations with 8 cubic elements (a turn), defaults only; planar problems lie in a skew "
    "plane, solved with planar and with spatial kinematics.",
    "orders": "The power of the element length with which errors fall, between the two finest meshes that round-off "
    "leaves alone (hidden: there are none), of one case a family: 2k at the tip and k + 1 in L2 for the continuum "
    "model of degree k, 2 for the discrete one.",
    **trials.WORDS,
    "speed": "Solve is the load stepping alone, by which solvers with a built model are timed; the whole call goes "
    "from scene to result. Compile is what a model spent once on making its forms, or on loading what an earlier run "
    "had made.",
    **peers.WORDS,
    "cases": "To see: the discrete nodes (dots) lie on the continuum's line (solid), and both meet the reference's "
    "cross where that is a place; dashed grey is the rod stress free, strokes stand along d2. In the error diagrams, "
    "numbers are observed orders and the dotted line to such a number has the slope of theory; dashed lines are "
    "planar kinematics, grey ground is round-off or beyond the reference. The table beneath names the lines.",
}
# Problems for which other people's solvers were published, by the family of ours.
PUBLISHED = {"elastica": "elastica", "bend45": "bend"}


def contents(report: Report, tests: Path | None) -> dict[str, str]:
    """The sections by key, those that nothing was solved for left out.

    Args:
        report: What was found.
        tests: The project's tests, as seen from the page; None: no links to them.

    Returns:
        HTML.
    """
    parts = {"machine": sections.machine(report)}
    if report.reaches:
        parts["reach"] = by_family(report, sections.reached)
    if report.laws:
        parts["laws"] = sections.laws(report, tests)
    if report.crosschecks:
        parts["cross"] = by_family(report, sections.crosschecks)
    if any(c.quantity.startswith("error") for c in report.checks):
        parts["limits"] = sections.errors(report)
    if report.one_step:
        parts["step"] = sections.one_step(report)
    if report.deep:
        parts["orders"] = sections.orders(report) + f"<p>{escape(literal_remark(report.deep))}</p>"
    parts |= trials.contents(report)
    if report.speeds:
        parts["speed"] = speed(report)
    if report.contenders:
        parts["peers"] = peers.contents(report.contenders)
    if report.statements:
        parts["cases"] = families(report)
    return {key: paragraph(key) + parts[key] for key in TITLES if key in parts}


def paragraph(key: str) -> str:
    """The sentence on what to see."""
    return f"<p>{escape(WORDS[key])}</p>" if key in WORDS else ""


def by_family(report: Report, content: Callable[[Report, set[str]], str]) -> str:
    """A long table cut into folds; the first lies open, and those with a miss."""
    folds: list[str] = []
    for family, members in of_family(report).items():
        names = {s.name for s in members}
        text = content(report, names)
        unfolded = " open" if not folds or '<tr class="bad">' in text else ""
        title = f"<code>{escape(family)}</code> {escape(family_title(family))}"
        if text:
            folds.append(f"<details{unfolded}><summary>{title}</summary>{text}</details>")
    return "\n".join(folds)


def speed(report: Report) -> str:
    """Our times against limits, and other people's solvers in diagram and table."""
    panels = []
    for family, problem in PUBLISHED.items():
        studies = [s for s in report.deep if s.case.startswith(family)]
        if studies:
            title = studies[0].title
            panels.append(panel(against_time(studies, title, problem), title))
    drawings = ""
    if panels:
        drawings = (
            f'<div class="panels wide">{"".join(panels)}</div><p class="soft">To see: raising the degree buys digits '
            "at almost no time. Stars are published figures of other people's solvers, named by their letters in the "
            "table, measured in November 2026 on a like machine and not in this run.</p>"
        )
    return times.speeds(report) + "<h3>Beside other people's solvers</h3>" + drawings + times.published(report)
