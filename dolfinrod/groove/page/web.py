"""The page: one HTML file that needs nothing else."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape
from importlib.resources import files
from pathlib import Path

from dolfinrod.groove.page.along import course_panels, end_panels, ledger_panel
from dolfinrod.groove.page.crossing import by_pair, in_time
from dolfinrod.groove.page.cuts import cuts
from dolfinrod.groove.page.headline import headline
from dolfinrod.groove.page.listing import acceptance_table, failures, parameters, settings_table, yarn_table
from dolfinrod.groove.page.panels import Panel
from dolfinrod.groove.page.sentences import sentences
from dolfinrod.groove.page.show import Show
from dolfinrod.groove.page.views import across, from_above, in_space
from dolfinrod.versions import versions

__all__ = ["write_page"]

TITLE = "Additional twist in the pneumatic groove"
# The letters of the paper's Fig. 7, which has two views of either groove.
LETTERS = {"intermediate": ("a", "c"), "lateral": ("b", "d"), "lateral_steep": ("e", "f")}


def write_page(show: Show, path: Path) -> Path:
    """Write the page.

    Args:
        show: What it shows.
        path: File to write.

    Returns:
        The file.
    """
    part = path.with_suffix(".html.part")
    part.write_text(_html(show), encoding="utf-8")
    return part.replace(path)


def _html(show: Show) -> str:
    """The whole page."""
    css = files("dolfinrod.groove.page").joinpath("style.css").read_text(encoding="utf-8")
    parts = _parts(show)
    links = "".join(f'<a href="#{key}">{title}</a>' for key, (title, _) in parts.items())
    body = "\n".join(
        f'<section id="{key}">\n<h2>{title}</h2>\n{html}\n</section>' for key, (title, html) in parts.items()
    )
    return f"""<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{TITLE}</title>
<link rel="icon" href="data:,">
<style>
{css}</style>
</head>
<body>
<header>
<h1>{TITLE}</h1>
{_verdict(show)}
</header>
<nav aria-label="Contents">{links}<a href="three.html">3-D</a></nav>
<main>
{body}
</main>
<footer>{_footer()}</footer>
</body>
</html>
"""


def _verdict(show: Show) -> str:
    """The first screen: one picture and five sentences."""
    told = "".join(f"<li>{escape(sentence)}</li>" for sentence in sentences(show.base, show.films))
    lead = _without_title(headline(show.base))
    return f'<div class="verdict">{lead}<ol>{told}</ol></div>'


def _without_title(panel: Panel) -> str:
    return panel.html.replace(f"<h3>{escape(panel.title)}</h3>", "", 1)


def _parts(show: Show) -> dict[str, tuple[str, str]]:
    """Sections by their anchors."""
    parts = {
        "acceptance": ("What should be, and is", _acceptance(show)),
        "views": ("The bundles: the views of the paper's Fig. 7", _views(show)),
        "cuts": (
            "Cross-sections",
            _note(show) + _grid(cuts(film, _name(kind)) for kind, (_, film) in show.shown.items()),
        ),
        "along": ("Along the machine direction", _grid(end_panels(show.films))),
        "crossings": ("Crossings", _crossings(show)),
        "course": ("In the course of time", _grid(course_panels(show.films))),
        "energy": ("Energy", _grid(ledger_panel(film, _name(kind)) for kind, (_, film) in show.shown.items())),
        "settings": ("All runs", settings_table(show) + failures(show.runs)),
        "yarns": ("Table 1, recomputed", yarn_table()),
        "parameters": ("Parameters", parameters(show)),
        "files": ("Files", _files(show)),
    }
    return {key: value for key, value in parts.items() if value[1]}


def _acceptance(show: Show) -> str:
    words = (
        "<p>Judged from the runs in this folder alone. “Not run” means that the folder lacks the runs it takes; what "
        "there is stands beside it.</p>"
    )
    return words + acceptance_table(show.judged)


def _views(show: Show) -> str:
    """(a) and (b) in space, (c) and (d) along X, the intermediate groove on the left as in the paper."""
    films = {kind: film for kind, (_, film) in show.shown.items()}
    panels = [in_space(film, _name(kind), LETTERS[kind][0]) for kind, film in films.items()]
    panels += [across(film, _name(kind), LETTERS[kind][1]) for kind, film in films.items()]
    above = [from_above(film, _name(kind)) for kind, film in films.items() if _several(show)]
    link = '<p>The same bundles can be turned and played in <a href="three.html">three dimensions</a>.</p>'
    return _note(show) + link + _grid(panels + above)


def _crossings(show: Show) -> str:
    if not _several(show):
        return ""
    panels = [in_time(film, _name(kind)) for kind, (_, film) in show.shown.items()]
    return _grid(panels + [by_pair(films, _name(kind)) for kind, films in show.films.items()])


def _several(show: Show) -> bool:
    """Whether there are fibres to cross."""
    return all(film.paths.shape[1] > 1 for films in show.films.values() for film in films)


def _note(show: Show) -> str:
    """Which runs single pictures show."""
    told = ", ".join(f"{_name(kind)} seed {run.seed}" for kind, (run, _) in show.shown.items())
    return f'<p class="soft">One run of each kind: {escape(told)}; {escape(show.base.words)}.</p>'


def _name(kind: str) -> str:
    return kind.replace("_", " ").capitalize()


def _grid(panels: Iterable[Panel] | Sequence[Panel]) -> str:
    return f'<div class="panels">{"".join(panel.html for panel in panels)}</div>'


def _files(show: Show) -> str:
    kinds = ", ".join(f'<a href="paraview/{kind}.pvd">paraview/{kind}.pvd</a>' for kind in show.shown)
    names = ("runs", "along", "course", "crossings", "sections", "energy")
    tables = ", ".join(f'<a href="data/{name}.csv">{name}.csv</a>' for name in names)
    return (
        f"<p>Every number that is drawn, with its unit: {tables}; all of them, the acceptance and the parameters in "
        f'<a href="data/groove.json">groove.json</a>. For ParaView: {kinds}. Each run: its <code>.json</code> and '
        "<code>.npz</code> beside this page.</p>"
    )


def _footer() -> str:
    told = ", ".join(f"{name} {version}" for name, version in versions().items())
    return (
        "Made by <code>dolfinrod.groove.report</code> from the stored runs. Paper: Lyu, Cheng &amp; Xu, CMES 127(2), "
        f"2021, DOI 10.32604/cmes.2021.015153. {escape(told)}."
    )
