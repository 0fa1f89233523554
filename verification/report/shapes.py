"""Deformed shapes of the five families."""

from __future__ import annotations

from typing import TYPE_CHECKING

import matplotlib as mpl
import numpy as np

from verification.report.canvas import CHAIN, DEGREES, INK, PEER, STYLE, figure, finish, svg

if TYPE_CHECKING:
    from collections.abc import Iterable

    from matplotlib.axes import Axes

    from verification.case import Array
    from verification.suite import Report, Shape

__all__ = ["deformed"]

# Families in the x-y plane, with their titles.
FLAT = {
    "elastica": "Elastica, PL²/EI = 1, 2, 5, 10",
    "follower": "Follower, PL²/EI = 1, 2, 5, 10, 20",
    "heavy": "Heavy, wL³/EI = 1, 5, 10, 20, 50",
    "rollup": "Roll-up, M = π, 2π, 4π, 10π EI/L",
}
UNSHRUNK = {"shrinkA": 0, "shrinkB": 0}
# Direction from which the bend is seen: azimuth and elevation [rad].
AZIMUTH, ELEVATION = np.radians(-112.0), np.radians(20.0)


def deformed(report: Report) -> str:
    """Both models on the five problems, the references' tips as crosses.

    Args:
        report: With shapes.

    Returns:
        SVG.
    """
    with mpl.rc_context(STYLE):
        canvas, axes = figure(3, rows=2, size=(11.4, 7.6), gridspec_kw={"width_ratios": (1.0, 1.0, 1.12)})
        for ax, (family, title) in zip(axes, FLAT.items(), strict=False):
            flat(ax, (s for s in report.shapes if s.family == family))
            finish(ax, title=title, x="x / L", y="y / L")
        seen(axes[4], (s for s in report.shapes if s.family == "bend45"))
        axes[4].set_title("45° bend, F = 300 and 600 along z")
        axes[5].set_axis_off()
        handles = [
            mpl.lines.Line2D([], [], color=DEGREES[4], label="continuum, 16 × P5 a turn"),
            mpl.lines.Line2D([], [], color=CHAIN, marker="o", ls="", ms=3.4, label="discrete, 40 elements a turn"),
            mpl.lines.Line2D([], [], color=PEER, lw=1.0, ls=(0, (4, 2)), label="stress free"),
            mpl.lines.Line2D([], [], color=INK, marker="+", ls="", ms=9, label="reference tip"),
        ]
        axes[5].legend(handles=handles, loc="center")
        canvas.get_layout_engine().set(h_pad=0.06, w_pad=0.08)
    return svg(canvas, f"Deformed shapes by both models: {', '.join(FLAT.values())}, 45 degree bend")


def flat(axes: Axes, shapes: Iterable[Shape]) -> None:
    """Shapes in the x-y plane."""
    for shape in shapes:
        draw(axes, shape.model, shape.points[:, :2])
        if shape.model == "continuum":
            axes.plot(*shape.tip[:2], "+", color=INK, ms=9, mew=1.1, zorder=5)
    axes.set_aspect("equal", adjustable="datalim")


def seen(axes: Axes, shapes: Iterable[Shape]) -> None:
    """Shapes in space, in parallel projection, with the axes they are posed in."""
    axes.set_axis_off()
    axes.set_aspect("equal", adjustable="datalim")
    for direction, length, name in ((0, 80.0, "x"), (1, 50.0, "y"), (2, 62.0, "z")):
        end = np.zeros((2, 3))
        end[1, direction] = length
        u = projected(end)
        axes.plot(*u.T, lw=0.0)
        axes.annotate("", u[1], u[0], arrowprops={"arrowstyle": "-|>", "color": INK, "lw": 0.8} | UNSHRUNK)
        axes.annotate(f"${name}$ = {length:g} m", u[1], textcoords="offset points", xytext=(4, 2), fontsize=8.5)
    for shape in shapes:
        draw(axes, shape.model, projected(shape.points))
        if shape.model == "continuum":
            axes.plot(*projected(np.array([shape.tip]))[0], "+", color=INK, ms=9, mew=1.1, zorder=5)
            ground = shape.points * (1.0, 1.0, 0.0)
            axes.plot(*projected(ground).T, color=PEER, lw=0.8, alpha=0.6)
            axes.plot(*projected(np.array([shape.points[-1], ground[-1]])).T, color=PEER, lw=0.8, ls=":", alpha=0.8)


def draw(axes: Axes, model: str, points: Array) -> None:
    """One centreline in the manner of its model."""
    if model == "continuum":
        axes.plot(*points.T, color=DEGREES[4])
    elif model == "discrete":
        axes.plot(*points[::2].T, "o", color=CHAIN, ms=2.9, zorder=4)
    else:
        axes.plot(*points.T, color=PEER, lw=1.0, ls=(0, (4, 2)))


def projected(points: Array) -> Array:
    """Points (n, 3) in the plane of the picture, shape (n, 2)."""
    right = np.array([-np.sin(AZIMUTH), np.cos(AZIMUTH), 0.0])
    toward = np.array([np.cos(AZIMUTH) * np.cos(ELEVATION), np.sin(AZIMUTH) * np.cos(ELEVATION), np.sin(ELEVATION)])
    return points @ np.stack([right, np.cross(toward, right)], axis=1)
