"""The page: one HTML file that needs nothing else, and the record as JSON beside it."""

from __future__ import annotations

import json
from dataclasses import asdict
from html import escape
from importlib.resources import files
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any

from verification.report import sections, times
from verification.report.curves import against_dofs, against_time
from verification.report.remarks import literal_remark, remarks
from verification.report.shapes import deformed

if TYPE_CHECKING:
    from collections.abc import Sequence

    from verification.suite import Report

__all__ = ["write"]

CONTENTS = {
    "shapes": "Deformed shapes",
    "limits": "Errors against their limits",
    "orders": "Orders of convergence",
    "work": "Error against time",
    "speed": "Milliseconds",
    "step": "One load step",
    "cross": "Model against model",
    "cases": "Every case",
    "references": "References",
    "machine": "Machine",
}


def write(report: Report, folder: Path) -> Path:
    """Leave `index.html` and `report.json` in a folder.

    Args:
        report: What was found.
        folder: Made where it does not exist.

    Returns:
        Path of the page.
    """
    folder.mkdir(parents=True, exist_ok=True)
    record = plain(asdict(report) | {"shapes": None, "holds": not report.missed})
    del record["shapes"]
    text = json.dumps(record, indent=1, ensure_ascii=False, allow_nan=False)
    (folder / "report.json").write_text(text + "\n", encoding="utf-8")
    page = folder / "index.html"
    page.write_text(html(report), encoding="utf-8")
    return page


def plain(value: Any) -> Any:
    """The same with null for every number that JSON cannot hold."""
    if isinstance(value, dict):
        return {key: plain(entry) for key, entry in value.items()}
    if isinstance(value, list | tuple):
        return [plain(entry) for entry in value]
    return None if isinstance(value, float) and not isfinite(value) else value


def html(report: Report) -> str:
    """The whole page."""
    css = files("verification.report").joinpath("style.css").read_text(encoding="utf-8")
    links = "".join(f'<a href="#{key}">{title}</a>' for key, title in CONTENTS.items())
    kind = "Quick run: fewer meshes, degrees and repetitions, every limit checked. " if report.quick else ""
    body = "\n".join(section(key, content) for key, content in contents(report).items())
    return f"""<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>dolfinrod: verification</title>
<style>
{css}</style>
</head>
<body>
<h1>Two rod models, verified</h1>
<p class="lead">The continuum model (DOLFINx and PETSc SNES) and the paper's discrete 12 × 12 model solve the same
scenes. Here are their errors against independent references, against time, and against each other.</p>
<p class="soft">{kind}{escape(report.machine.date)}, {escape(report.machine.processor)}, one thread.</p>
{verdicts(report)}
<nav aria-label="Contents">{links}</nav>
{body}
<footer>Made by <code>python -m verification</code>; the same numbers in <a href="report.json">report.json</a>.
Errors are |tip − reference| divided by the length of the rod. The exit code never depends on time.</footer>
</body>
</html>
"""


def verdicts(report: Report) -> str:
    """The outcome in five boxes."""
    errors = [c for c in report.checks if c.quantity.startswith("error")]
    orders = [c for c in report.checks if c.quantity.startswith("order")]
    boxes = (
        verdict(errors, "error limits of issue 2 hold"),
        verdict(orders, "observed orders reach theory"),
        verdict(report.one_step, "whole loads taken in one step, within the iterations allowed"),
        verdict(report.crosschecks, "differences between the models explained by refinement"),
        verdict(report.speeds, "speed figures within their limit on this machine, now", miss="slow"),
    )
    return f'<div class="verdicts">{"".join(boxes)}</div>'


def verdict(rows: Sequence[Any], words: str, miss: str = "bad") -> str:
    """How many hold."""
    good = sum(row.holds for row in rows)
    mark = "" if good == len(rows) else f" {miss}"
    sign = "✓" if good == len(rows) else "✗"
    return f'<div class="verdict{mark}"><b>{sign} {good} of {len(rows)}</b><span>{words}</span></div>'


def section(key: str, content: str) -> str:
    """One section with its heading."""
    return f'<section id="{key}">\n<h2>{CONTENTS[key]}</h2>\n{content}\n</section>'


def figure(drawing: str, caption: str) -> str:
    """A figure with one sentence on what to see."""
    return f"<figure>{drawing}<figcaption>{caption}</figcaption></figure>"


def contents(report: Report) -> dict[str, str]:
    """The sections by key."""
    odd = "".join(f"<li>{escape(text)}</li>" for text in remarks(report.headlines))
    return {
        "shapes": figure(
            deformed(report), "To see: the discrete nodes lie on the continuum's lines, and both end in the crosses."
        ),
        "limits": "<p>Limits of issue 2, whole load in one step, nothing tuned.</p>" + sections.errors(report),
        "orders": figure(
            against_dofs(report),
            "To see: the tip of the spatial elements falls with the power 2k of the element length, the centreline "
            "with k + 1; grey is round-off.",
        )
        + sections.orders(report)
        + f"<h3>Where the observed order is not that of theory</h3><ul>{odd or '<li>Nowhere.</li>'}</ul>"
        + f"<p>{escape(literal_remark(report.headlines))}</p>",
        "work": figure(
            against_time(report),
            "To see: raising the degree buys digits at almost no time; stars are published figures of other people's "
            "solvers, measured in November 2026 on a like machine, not in this run.",
        ),
        "speed": "<p>Solve is the load stepping alone, by which solvers with a built model are timed; the whole call "
        "goes from scene to result. Compile is what a model spent once on making its forms, or on loading what an "
        "earlier run had made.</p>"
        + times.speeds(report)
        + "<h3>Beside other people's solvers</h3>"
        + times.published(report),
        "step": "<p>Total Newton iterations of 8 × P3 (a turn), defaults only; planar problems lie in a skew plane, "
        "solved with planar and with spatial kinematics.</p>" + sections.one_step(report),
        "cross": "<p>No reference enters: if the models differ by more than the discrete model's own refinement "
        "explains, one of them is wrong.</p>" + sections.crosschecks(report),
        "cases": f"<p>On the standard mesh: {sections.standard()}; the order is that of three meshes.</p>"
        f"<details open><summary>All runs</summary>{sections.all_cases(report)}</details>",
        "references": "<p>None of these was computed with finite elements or with this code's models.</p>"
        + sections.references(report),
        "machine": sections.machine(report),
    }
