"""Matplotlib figures as inline SVG that takes its ink from the page, light or dark."""

from __future__ import annotations

import io
import re
from typing import TYPE_CHECKING, Any

import matplotlib as mpl

mpl.use("svg")

from matplotlib.figure import Figure

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["CHAIN", "DEGREES", "INK", "PAPER", "PAPER_CHAIN", "PEER", "figure", "finish", "svg"]

# Stand-ins, replaced by the page's own colours in the SVG.
INK, GRID, PAPER = "#010203", "#040506", "#070809"
# Degrees 1 to 5, discrete chord, discrete as printed, other people's solvers: mid-tones, legible on either ground.
DEGREES = {1: "#c29a1c", 2: "#6aa32d", 3: "#1f9a86", 4: "#3b7fcb", 5: "#8a5cc7"}
CHAIN, PAPER_CHAIN, PEER = "#d8602a", "#c2447e", "#8b929a"

STYLE = {
    "font.family": "DejaVu Sans",
    "font.size": 9.5,
    "axes.titlesize": 10.5,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.titlepad": 9,
    "axes.edgecolor": INK,
    "axes.linewidth": 0.8,
    "axes.labelcolor": INK,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": GRID,
    "grid.linewidth": 0.8,
    "text.color": INK,
    "xtick.color": INK,
    "ytick.color": INK,
    "legend.frameon": False,
    "legend.fontsize": 8.5,
    "lines.linewidth": 1.6,
    "lines.markersize": 4.5,
    "svg.fonttype": "path",
    "svg.hashsalt": "dolfinrod",
}


def figure(columns: int, *, rows: int = 1, size: tuple[float, float], **options: Any) -> tuple[Figure, list[Axes]]:
    """A figure and its axes, left to right and top to bottom.

    Args:
        columns: Axes side by side.
        rows: Axes above each other.
        size: Width and height [in].
        **options: Of `Figure.subplots`.

    Returns:
        Both.
    """
    with mpl.rc_context(STYLE):
        canvas = Figure(figsize=size, constrained_layout=True)
        axes = canvas.subplots(rows, columns, squeeze=False, **options)
    return canvas, list(axes.ravel())


def svg(canvas: Figure, description: str) -> str:
    """The figure for a page.

    Args:
        canvas: What is drawn.
        description: For readers who do not see it.

    Returns:
        One <svg> element.
    """
    target = io.StringIO()
    with mpl.rc_context(STYLE):
        canvas.savefig(target, format="svg", transparent=True, metadata={"Date": None})
    text = target.getvalue()
    text = (
        text[text.index("<svg") :]
        .replace(INK, "currentColor")
        .replace(GRID, "var(--grid)")
        .replace(PAPER, "var(--paper)")
    )
    text = re.sub(r'<svg ([^>]*?)width="[^"]*"', r"<svg \1", text, count=1)
    text = re.sub(r'<svg ([^>]*?)height="[^"]*"', r"<svg \1", text, count=1)
    text = re.sub(r"<metadata>.*?</metadata>", "", text, flags=re.DOTALL)
    return text.replace("<svg ", f'<svg role="img" aria-label="{description}" ', 1)


def finish(axes: Axes, *, title: str, x: str, y: str) -> None:
    """Title and labels of one diagram.

    Args:
        axes: The diagram.
        title: Above it, left.
        x: Quantity and unit.
        y: Quantity and unit.
    """
    axes.set_title(title)
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    axes.tick_params(which="minor", length=0)
