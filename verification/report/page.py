"""The page: one HTML file that needs nothing else, and the record as JSON beside it."""

from __future__ import annotations

import json
import os
from dataclasses import asdict
from html import escape
from importlib.resources import files
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any

from verification.report.canvas import markers
from verification.report.contents import TITLES, contents
from verification.report.families import of_family
from verification.report.misses import sentence
from verification.report.outcomes import outcomes
from verification.report.schema import schema
from verification.report.summary import CAPTION
from verification.report.tables import link
from verification.report.verdict import panels, sentences

if TYPE_CHECKING:
    from verification.suite import Report

__all__ = ["write"]

# Unfolds the case that a link leads to, where the browser does not.
SCRIPT = """
function unfold() {
  const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
  const fold = target && target.closest("details");
  if (fold && !fold.open) { fold.open = true; target.scrollIntoView(); }
}
addEventListener("hashchange", unfold);
unfold();
"""


def write(report: Report, folder: Path) -> Path:
    """Leave `index.html`, and `report.json` with its schema, in a folder.

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
    described = json.dumps(schema(), indent=1, ensure_ascii=False)
    (folder / "report.schema.json").write_text(described + "\n", encoding="utf-8")
    page = folder / "index.html"
    page.write_text(html(report, tests_seen_from(folder)), encoding="utf-8")
    return page


def plain(value: Any) -> Any:
    """The same with null for every number that JSON cannot hold."""
    if isinstance(value, dict):
        return {key: plain(entry) for key, entry in value.items()}
    if isinstance(value, list | tuple):
        return [plain(entry) for entry in value]
    return None if isinstance(value, float) and not isfinite(value) else value


def tests_seen_from(folder: Path) -> Path | None:
    """The project's tests, as a link from a page in that folder; None where they are not on this machine."""
    tests = Path(__file__).parents[2] / "tests"
    return Path(os.path.relpath(tests, folder.resolve())) if tests.is_dir() else None


def html(report: Report, tests: Path | None = None) -> str:
    """The whole page."""
    css = files("verification.report").joinpath("style.css").read_text(encoding="utf-8")
    parts = contents(report, tests)
    body = "\n".join(section(key, content) for key, content in parts.items())
    return f"""<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>dolfinrod: verification</title>
<link rel="icon" href="data:,">
<style>
{css}</style>
</head>
<body>
{markers()}
<header>
{heading(report)}
</header>
{navigation(report, parts)}
<main>
{body}
<footer>Made by <code>dolfinrod verify</code>; the same numbers in <a href="report.json">report.json</a>, described by
<a href="report.schema.json">its schema</a>.
Errors are |found − reference| divided by the length of the rod. The exit code never depends on time.</footer>
</main>
<script>{SCRIPT}</script>
</body>
</html>
"""


def heading(report: Report) -> str:
    """The first screen: what was verified, the verdict in numbers, and what was missed."""
    kind = "Quick run: fewer meshes, degrees and repetitions, every limit checked. " if report.quick else ""
    found = of_family(report)
    scope = f"{len(report.statements)} cases of {len(found)} families" if found else "No case studied"
    return f"""<h1>Two rod models, verified</h1>
<p class="lead">The continuum model (DOLFINx and PETSc SNES) and the paper's discrete 12 × 12 model solve the same
scenes. Here are their errors against independent references, against time, and against each other.</p>
<p class="soft">{scope}. {kind}{escape(report.machine.date)}, {escape(report.machine.processor)}, one thread.</p>
{first(report)}
{verdicts(report)}
{misses(report)}"""


def verdicts(report: Report) -> str:
    """The outcome in boxes, each of which leads to its rows."""
    boxes = "".join(
        f'<a class="verdict {o.mark}" href="#{o.key}"><b>{o.sign} {o.good} of {o.total}</b><span>{o.words}</span></a>'
        for o in outcomes(report)
    )
    return f'<div class="verdicts">{boxes}</div>'


def first(report: Report) -> str:
    """The figure and the sentences that come before everything else."""
    drawn = "".join(f"<figure><figcaption>{escape(title)}</figcaption>{svg}</figure>" for title, svg in panels(report))
    said = "".join(f"<li>{escape(words)}</li>" for words in sentences(report))
    words = f'<p class="soft">{escape(CAPTION)}</p>' if drawn else ""
    return f'<ul class="said">{said}</ul><div class="panels">{drawn}</div>{words}'


def misses(report: Report) -> str:
    """Every number beyond its limit, with the case it belongs to."""
    if not report.missed:
        limited = any(kind.total for kind in outcomes(report))
        return '<p class="mark good">✓ No number is beyond its limit.</p>' if limited else ""
    stated = {s.name for s in report.statements}
    items = []
    for row in report.missed:
        case = getattr(row, "case", "")
        words = sentence(row)
        items.append(f"<li>{link(f'#case-{case}', words) if case in stated else escape(words)}</li>")
    return f'<div class="misses"><h2>Beyond their limits: {len(items)}</h2><ul>{"".join(items)}</ul></div>'


def navigation(report: Report, parts: dict[str, str]) -> str:
    """Links to sections and families."""
    links = []
    for key in parts:
        links.append(link(f"#{key}", TITLES[key]))
        if key == "cases":
            links += [
                f'<a class="family" href="#family-{family}">{escape(family)} <small>{len(members)}</small></a>'
                for family, members in of_family(report).items()
            ]
    return f'<nav aria-label="Contents">{"".join(links)}</nav>'


def section(key: str, content: str) -> str:
    """One section with its heading."""
    return f'<section id="{key}">\n<h2>{TITLES[key]}</h2>\n{content}\n</section>'
