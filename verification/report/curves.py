"""Errors against dofs and against milliseconds."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import matplotlib as mpl
import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patheffects import withStroke
from matplotlib.ticker import LogLocator, NullFormatter

from verification.order import FLOOR
from verification.references import peers
from verification.report.canvas import CHAIN, DEGREES, INK, PAPER, PAPER_CHAIN, PEER, STYLE, figure, finish, svg

if TYPE_CHECKING:
    from collections.abc import Iterable

    from matplotlib.axes import Axes

    from verification.suite import Report
    from verification.workprecision import Study

__all__ = ["against_dofs", "against_time"]

MARKERS = {1: "o", 2: "s", 3: "^", 4: "D", 5: "v"}
# Keeps a name legible on a line.
HALO = withStroke(linewidth=2.5, foreground=PAPER)
# Milliseconds shown, wide enough for the published figures and their names.
X_LIMITS = {"elastica": (0.09, 200.0), "bend": (1.0, 4000.0)}
# What lies below is round-off and drawn at the edge.
BOTTOM = 1e-15


def against_dofs(report: Report) -> str:
    """Tip and L2 errors over the number of unknowns, orders in the legends.

    Args:
        report: With headline studies.

    Returns:
        SVG.
    """
    elastica, rollup, bend = (of_family(report, f) for f in ("elastica", "rollup", "bend45"))
    panels = (
        ("Elastica, PL²/EI = 10: tip", spatial(elastica), "tip"),
        ("Elastica, PL²/EI = 10: centreline in L2", spatial(elastica), "centreline"),
        ("Roll-up to half a turn: tip", spatial(rollup), "tip"),
        ("45° bend, 600: tip", spatial(bend), "tip"),
    )
    with mpl.rc_context(STYLE):
        canvas, axes = figure(2, rows=2, size=(11.4, 8.6))
        for ax, (title, studies, quantity) in zip(axes, panels, strict=True):
            for study in studies:
                plot_over_dofs(ax, study, quantity)
            logarithmic(ax)
            finish(ax, title=title, x="unknowns", y="relative error")
            ax.legend(title="order observed (theory)", loc="center left", bbox_to_anchor=(1.0, 0.5), handlelength=1.6)
    return svg(canvas, "Relative errors over the number of unknowns for every degree and the discrete model")


def plot_over_dofs(axes: Axes, study: Study, quantity: str) -> None:
    """One line of a study."""
    order = study.tip if quantity == "tip" else study.centreline
    if order is None:
        return
    errors = [r.error if quantity == "tip" else r.centreline_error for r in study.records]
    dofs = [r.dofs for r in study.records]
    seen = "round-off" if order.observed is None else f"{order.observed:.2f}"
    label = f"{short(study)}  {seen} ({order.theory})"
    axes.plot(dofs, np.maximum(np.array(errors, dtype=float), BOTTOM), label=label, **manner(study))


def against_time(report: Report) -> str:
    """Tip errors over the time of a warm solve, other people's solvers beside.

    Args:
        report: With headline studies.

    Returns:
        SVG.
    """
    with mpl.rc_context(STYLE):
        canvas, axes = figure(2, size=(11.4, 5.0))
        for ax, family, title in (
            (axes[0], "elastica", "Elastica, PL²/EI = 10"),
            (axes[1], "bend45", "45° bend, 600"),
        ):
            for study in of_family(report, family):
                plot_over_time(ax, study)
            annotate_peers(ax, "bend" if family == "bend45" else family)
            logarithmic(ax)
            finish(
                ax, title=title, x="load stepping, warm, least of the repetitions [ms]", y="relative error of the tip"
            )
        canvas.legend(handles=legend(), loc="center right", handlelength=2.4)
        canvas.get_layout_engine().set(w_pad=0.06, h_pad=0.06, rect=(0, 0, 0.83, 1))
    return svg(canvas, "Relative tip error over milliseconds of a warm solve")


def plot_over_time(axes: Axes, study: Study) -> None:
    """One line of a study, where it was timed."""
    timed = [(r.timing.solve_min, max(r.error, BOTTOM)) for r in study.records if r.timing is not None]
    if timed:
        axes.plot(*zip(*timed, strict=True), **manner(study))


def annotate_peers(axes: Axes, problem: str) -> None:
    """Published figures as grey stars with names."""
    for peer in peers(problem):
        axes.plot(peer.ms, peer.error, "*", color=PEER, ms=10, zorder=6)
        axes.annotate(
            peer.who,
            (peer.ms, peer.error),
            textcoords="offset points",
            xytext=(0, 7 if peer.kinematics == "spatial" else -7),
            ha="center",
            va="bottom" if peer.kinematics == "spatial" else "top",
            fontsize=7.5,
            color=PEER,
            zorder=7,
            path_effects=[HALO],
        )
    axes.set_xlim(*X_LIMITS[problem])


def legend() -> list[Line2D]:
    """What the lines of the time diagram mean."""
    degrees = [Line2D([], [], color=c, marker=MARKERS[k], label=f"continuum P{k}") for k, c in DEGREES.items()]
    return [
        *degrees,
        Line2D([], [], color=INK, label="spatial"),
        Line2D([], [], color=INK, ls=(0, (3, 1.6)), label="planar"),
        Line2D([], [], color=CHAIN, marker="o", label="discrete chord"),
        Line2D([], [], color=PAPER_CHAIN, marker="x", label="discrete Eq. 16"),
        Line2D([], [], color=PEER, marker="*", ls="", ms=10, label="published, others"),
    ]


def manner(study: Study) -> dict[str, Any]:
    """Colour, line and marker of a study."""
    if study.family == "discrete":
        literal = study.model.endswith("paper")
        return {"color": PAPER_CHAIN if literal else CHAIN, "marker": "x" if literal else "o"}
    dashes: Any = (0, (3, 1.6)) if study.model.endswith("planar") else "-"
    return {"color": DEGREES[study.degree], "marker": MARKERS[study.degree], "ls": dashes}


def short(study: Study) -> str:
    """Name within a legend of spatial studies."""
    return study.model.removeprefix("continuum ").removesuffix(" spatial").replace("discrete paper", "Eq. 16")


def logarithmic(axes: Axes) -> None:
    """Both axes in decades, the floor of round-off shaded."""
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_ylim(BOTTOM / 2, 1.0)
    axes.axhspan(BOTTOM / 2, FLOOR, color=PEER, alpha=0.13, lw=0)
    axes.yaxis.set_major_locator(LogLocator(numticks=9))
    axes.yaxis.set_minor_formatter(NullFormatter())


def of_family(report: Report, family: str) -> list[Study]:
    """Headline studies of one family."""
    return [study for study in report.headlines if study.case.startswith(family)]


def spatial(studies: Iterable[Study]) -> list[Study]:
    """Those that are not planar."""
    return [study for study in studies if not study.model.endswith("planar")]
