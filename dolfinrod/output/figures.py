"""Pictures of a result: shapes, resultants along the rods, ways of their tips, the ledger of a motion, contacts."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from mpl_toolkits import mplot3d

from dolfinrod.output.contactpanels import CAPTION, draw_contacts, n_rows
from dolfinrod.output.ledger import draw_ledger
from dolfinrod.output.meetingpanels import draw_meetings, mark_spots
from dolfinrod.output.palette import COMPONENTS, RODS, STYLES
from dolfinrod.output.scale import Scale, scale
from dolfinrod.output.trace import COLOR, draw_surfaces
from dolfinrod.output.view import View, view
from dolfinrod.scene import Dynamic

if TYPE_CHECKING:
    from pathlib import Path

    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    from dolfinrod.result import Result

    Array = NDArray[np.float64]

__all__ = ["plot"]

FREE = {"color": "0.55", "linestyle": (0, (4, 3)), "linewidth": 1.1}
# Beyond so many, shapes between the first and the last would be a grey cloud.
MOST_SHAPES = 12
# So many points look like a curve; fewer nodes are joined by the cubics between them.
SMOOTH = 201
# Relative to what else acts or moves: the rest is round-off, not worth a scale of its own.
ROUND_OFF = 1e-9
# A box in space is never thinner than this part of its longest side.
THINNEST = 0.25
MARGIN = 0.06


def plot(result: Result, path: str | Path | None = None) -> Figure:
    """Deformed over stress-free shape, resultants along the rods, ways of the tips, energies over time, and contacts.

    Args:
        result: What was found.
        path: Where to save the picture; None: nowhere.

    Returns:
        The figure, made without a window.
    """
    panels = 4 if len(result.energy) > 1 else 3
    rows = panels + n_rows(result) + bool(result.meetings)
    figure = Figure(figsize=(11.0, 2.2 * rows + 1.0), layout="constrained")
    figure.get_layout_engine().set(w_pad=0.12, h_pad=0.1, wspace=0.03, hspace=0.03)
    grid = figure.add_gridspec(rows, 2, width_ratios=(1.25, 1.0))
    drawn = _shapes(result)
    seen = view(np.concatenate([points for rod in drawn for points in rod]))
    plane = len(seen.axes) == 2
    shape = figure.add_subplot(grid[:panels, 0], projection="rectilinear" if plane else mplot3d.Axes3D.name)
    _draw_shapes(shape, drawn, seen, result)
    along = [figure.add_subplot(grid[i, 1]) for i in range(2)]
    _draw_resultants(along, result)
    _draw_tips(figure.add_subplot(grid[2, 1]), result)
    if panels == 4:
        draw_ledger(figure.add_subplot(grid[3, 1]), result.t, result.energy)
    if result.contacts:
        draw_contacts(figure, grid, result, panels)
    if result.meetings:
        draw_meetings(figure, grid, result)
    figure.suptitle(_headline(result), fontsize=11)
    if path is not None:
        figure.savefig(path, dpi=130)
    return figure


def _headline(result: Result) -> str:
    """What was solved, and what to look for."""
    first, *later = (f"{t:.4g}" for t in result.t)
    moving = _moving(result)
    unit = " s" if moving else ""
    states = f"{len(result.t)} stored states from t = {first} to {later[-1]}" if later else f"the state at t = {first}"
    end = "" if result.converged else ", not converged beyond"
    said = f"{result.formulation.model} model, {result.formulation.kinematics}: {states}{unit}{end}"
    rule = "the energies change by the works alone" if moving else "the flatter the load path, the stiffer the rod"
    contact = f"\n{CAPTION}" if result.contacts else ""
    return f"{said}\nResultants may jump at supports and point loads only; {rule}.{contact}"


def _moving(result: Result) -> bool:
    return isinstance(result.scene.motion, Dynamic)


def _shapes(result: Result) -> list[list[Array]]:
    """Points of each rod: stress free, then the stored states, evenly thinned out, the last one always."""
    n_t = len(result.t)
    kept = np.unique(np.linspace(0, n_t - 1, min(n_t, MOST_SHAPES)).round().astype(int))
    shapes = []
    for rod, history in zip(result.scene.rods, result.rods, strict=True):
        coarse = len(history.s) < SMOOTH
        s = np.linspace(0.0, history.s[-1], SMOOTH) if coarse else history.s
        r = np.stack([history.at(x) for x in s], axis=1) if coarse else history.r
        shapes.append([rod.centerline(s), *r[kept]])
    return shapes


def _length(result: Result) -> Scale:
    return scale(max(float(np.ptp(history.r, axis=(0, 1)).max()) for history in result.rods), "m")


def _draw_shapes(axes: Any, rods: list[list[Array]], seen: View, result: Result) -> None:
    """Every rod in its colour: last state thick, earlier ones pale, stress free dashed; one scale in all directions."""
    unit = _length(result)
    for k, (free, *states) in enumerate(rods):
        color = RODS[k % len(RODS)]
        axes.plot(*(unit.factor * seen.seen(free)), **FREE)
        for points in states[:-1]:
            axes.plot(*(unit.factor * seen.seen(points)), color=color, linewidth=0.9, alpha=0.35)
        axes.plot(*(unit.factor * seen.seen(states[-1])), color=color, linewidth=2.4)
    points = unit.factor * np.concatenate([seen.seen(points) for rod in rods for points in rod], axis=1)
    _frame(axes, points)
    for axis, name in zip("xyz", seen.names, strict=False):
        getattr(axes, f"set_{axis}label")(f"{name} [{unit.unit}]")
    key = [Line2D([], [], **FREE, label="stress free")]
    if len(rods[0]) > 2:
        key.append(Line2D([], [], color="0.3", linewidth=0.9, alpha=0.5, label="on the way"))
    if draw_surfaces(axes, result, seen, rods[0][0][0], unit.factor):
        key.append(Line2D([], [], color=COLOR, linewidth=1.3, label="surface"))
    key += mark_spots(axes, result, seen, unit.factor)
    few = 1 < len(rods) <= len(RODS)
    names = [f"rod {k}" for k in range(len(rods))] if few else ["deformed"]
    for name, color in zip(names, RODS if few or len(rods) == 1 else ("0.3",), strict=False):
        key.append(Line2D([], [], color=color, linewidth=2.4, label=name))
    axes.set_title("Deformed over stress-free shape", fontsize=11, pad=10 + 16 * -(-len(key) // 4))
    axes.legend(handles=key, fontsize=8, frameon=False, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=4)


def _frame(axes: Any, points: Array) -> None:
    """Limits around all points with one scale for all axes, flat shapes given some room."""
    low, high = points.min(axis=1), points.max(axis=1)
    size = np.maximum(high - low, THINNEST * (high - low).max()) * (1 + 2 * MARGIN)
    middle = (low + high) / 2
    for axis, centre, width in zip("xyz", middle, size, strict=False):
        getattr(axes, f"set_{axis}lim")(centre - width / 2, centre + width / 2)
    if len(points) == 3:
        axes.set_box_aspect(size, zoom=0.78)
        axes.locator_params(nbins=4)
        axes.xaxis.labelpad = axes.yaxis.labelpad = 7
        axes.zaxis.labelpad = 1
    else:
        axes.set_aspect("equal")
        axes.grid(alpha=0.25)


def _draw_resultants(panels: list[Axes], result: Result) -> None:
    """Forces and moments of the last state over arc length, components by colour, rods by line style."""
    length = max(history.s[-1] for history in result.rods)
    n, m = (max(float(np.abs(getattr(history, name)[-1]).max()) for history in result.rods) for name in "nm")
    along = scale(length, "m")
    sizes = {"n": n if n > ROUND_OFF * m / length else 0.0, "m": m if m > ROUND_OFF * n * length else 0.0}
    words = {"n": ("Force", "N"), "m": ("Moment", "N m")}
    parts = {
        "n": ("$n_1$ axial", "$n_2$ shear", "$n_3$ shear"),
        "m": ("$m_1$ torsion", "$m_2$ bending", "$m_3$ bending"),
    }
    for axes, name in zip(panels, "nm", strict=True):
        unit = scale(sizes[name], words[name][1])
        for k, history in enumerate(result.rods):
            values = getattr(history, name)[-1] * (unit.factor if sizes[name] else 0.0)
            for component, color in enumerate(COMPONENTS):
                axes.plot(
                    along.factor * history.s, values[:, component], color=color, linestyle=STYLES[k % len(STYLES)]
                )
        axes.set(xlabel=f"arc length s [{along.unit}]", ylabel=f"{words[name][0].lower()} {name} [{unit.unit}]")
        at = f"t = {result.t[-1]:.4g}{' s' * _moving(result)}"
        axes.set_title(f"{words[name][0]} along the rods in the section frame, {at}")
        _finish(axes, sizes[name], parts[name], len(result.rods))


def _draw_tips(axes: Axes, result: Result) -> None:
    """Displacement of the end of each rod against time, or against pseudo-time with a dot at each equilibrium."""
    moves = [h.r[:, -1] - rod.centerline(rod.length) for rod, h in zip(result.scene.rods, result.rods, strict=True)]
    size = float(np.abs(moves).max())
    size = size if size > ROUND_OFF * max(rod.length for rod in result.scene.rods) else 0.0
    unit = scale(size, "m")
    for k, move in enumerate(moves):
        for component, color in enumerate(COMPONENTS):
            values = move[:, component] * (unit.factor if size else 0.0)
            style = STYLES[k % len(STYLES)]
            marker = None if _moving(result) else "o"
            axes.plot(result.t, values, color=color, linestyle=style, marker=marker, markersize=3.5)
    axes.set(
        xlabel="time t [s]" if _moving(result) else "pseudo-time t [1]",
        ylabel=f"displacement u [{unit.unit}]",
        title="Way of the tips" if _moving(result) else "Load path of the tips, each dot an equilibrium",
    )
    _finish(axes, size, ("$u_x$", "$u_y$", "$u_z$"), len(moves))


def _finish(axes: Axes, size: float, names: tuple[str, ...], n_rods: int) -> None:
    """Grid, the line of zero and the key; a panel in which all is zero keeps to ±1."""
    if not size:
        axes.set_ylim(-1.0, 1.0)
    axes.title.set_fontsize(11)
    axes.axhline(0.0, color="0.75", linewidth=0.8, zorder=0)
    axes.grid(alpha=0.25)
    key = [Line2D([], [], color=color, label=name) for color, name in zip(COMPONENTS, names, strict=True)]
    if n_rods > 1:
        styles = STYLES[:n_rods]
        more = ", …" if n_rods > len(STYLES) else ""
        key += [Line2D([], [], color="0.3", linestyle=style, label=f"rod {k}{more}") for k, style in enumerate(styles)]
    axes.legend(handles=key, fontsize=8, frameon=False, loc="center left", bbox_to_anchor=(1.0, 0.5))
