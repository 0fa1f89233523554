"""The verdict in a page of Markdown and a picture, to be kept with the project."""

from __future__ import annotations

import re
from importlib.resources import files
from typing import TYPE_CHECKING

from verification.report.canvas import HEIGHT, WIDTH, markers
from verification.report.groovekept import bundles_kept
from verification.report.misses import sentence
from verification.report.outcomes import outcomes
from verification.report.verdict import panels, sentences

if TYPE_CHECKING:
    from pathlib import Path

    from verification.suite import Report

__all__ = ["CAPTION", "summarise"]

PICTURE, PAGE = "results.svg", "RESULTS.md"
CAPTION = (
    "Relative error over time, one thread, warm. Triangles: continuum model, the best of degrees 1 to 5; circles: "
    "discrete model. Lower and further left is better."
)
# Room for a title above each diagram, and between them [px].
ABOVE, BETWEEN = 24, 16


def summarise(report: Report, folder: Path, command: str) -> Path:
    """Write RESULTS.md and the picture in it.

    Args:
        report: What was found.
        folder: Where they are kept.
        command: By which they were made.

    Returns:
        Path of the Markdown.
    """
    folder.mkdir(parents=True, exist_ok=True)
    drawn = panels(report)
    if drawn:
        (folder / PICTURE).write_text(picture(drawn), encoding="utf-8")
    page = folder / PAGE
    page.write_text(markdown(report, command, pictured=bool(drawn)), encoding="utf-8")
    return page


def markdown(report: Report, command: str, *, pictured: bool) -> str:
    """The page."""
    m = report.machine
    facts = {"date": m.date, "source": m.source, "processor": f"{m.processor}, {m.cores} cores", "system": m.system}
    facts["load at the start"] = f"{m.load:.1f} busy processes" + (": times are noisy" if m.load > 1.2 else "")
    facts |= m.versions
    parts = [
        "# Results",
        f"Written by `{command}`; not edited by hand. "
        + ("A quick run: fewer meshes, degrees and repetitions; every limit is checked." if report.quick else ""),
        "\n".join(f"- {words}" for words in sentences(report)),
    ]
    if pictured:
        parts += [f"![{CAPTION}]({PICTURE})", f"*{CAPTION}*"]
    rows = [f"| {o.sign} | {o.good} of {o.total} | {o.words} |" for o in outcomes(report)]
    parts.append("\n".join(["| | numbers | what holds |", "|---|---|---|", *rows]))
    if report.missed:
        parts += ["## Beyond their limits", "\n".join(f"- {sentence(row)}" for row in report.missed)]
    parts += bundles_kept(report.scenarios)
    parts += ["## Environment", "\n".join(["| | |", "|---|---|", *(f"| {k} | {v} |" for k, v in facts.items())])]
    return "\n\n".join(part.rstrip() for part in parts) + "\n"


def picture(drawn: tuple[tuple[str, str], ...]) -> str:
    """Diagrams two and two in one SVG that needs no page around it."""
    columns = min(2, len(drawn))
    width = columns * (WIDTH + BETWEEN)
    height = -(-len(drawn) // columns) * (HEIGHT + ABOVE + BETWEEN)
    css = files("verification.report").joinpath("style.css").read_text(encoding="utf-8")
    parts = []
    for k, (title, diagram) in enumerate(drawn):
        x, y = (k % columns) * (WIDTH + BETWEEN), (k // columns) * (HEIGHT + ABOVE + BETWEEN)
        size = f'<svg x="{x}" y="{y + ABOVE}" width="{WIDTH}" height="{HEIGHT}"'
        parts.append(f'<text x="{x + 6}" y="{y + 16}" font-weight="600">{title}</text>')
        parts.append(re.sub("^<svg", size, diagram))
    kinds = re.sub(r"^<svg[^>]*>|</svg>$", "", markers())
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" '
        f'font-family="sans-serif"><style>{css}</style><rect width="100%" height="100%" style="fill: var(--paper)"/>'
        f"{kinds}{''.join(parts)}</svg>\n"
    )
