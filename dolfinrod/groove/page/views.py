"""The four views of the paper's Fig. 7: bundles in space, and seen along the machine direction."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.patches import Circle
from mpl_toolkits import mplot3d

from dolfinrod.groove.page.panels import Panel, fibre_colours, panel

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    from dolfinrod.groove.film import Film

    Array = NDArray[np.float64]

__all__ = ["across", "draw_section", "from_above", "in_space", "window"]

MM = 1e3
WALL, CORE, START = "#8a8378", "#d9d2c3", "0.6"
# How much longer than wide and high a bundle is drawn in space, whatever it is.
BOX = (3.2, 1.5, 1.0)
# Around what is shown, as a part of its size, and at least so much [m].
MARGIN, LEAST = 0.12, 4e-5


def in_space(film: Film, kind: str, letter: str) -> Panel:
    """Fibres over the groove at the last frame, not to scale across."""
    with panel(3.2) as drawing:
        axes: Any = drawing.axes(projection=mplot3d.Axes3D.name, computed_zorder=False)
        paths = MM * film.paths
        X = paths[-1, :, :, 0].min(), paths[-1, :, :, 0].max()
        (low, high), (bottom, top) = MM * window(film)
        outline = np.minimum(MM * _drawn(film, (low / MM, high / MM)), (np.inf, top))
        faces = [
            [(x, *corner) for x, corner in zip((*X, *X[::-1]), (a, a, b, b), strict=True)] for a, b in pairwise(outline)
        ]
        axes.add_collection3d(
            mplot3d.art3d.Poly3DCollection(faces, facecolor=WALL, alpha=0.3, edgecolor="none", zorder=1)
        )
        for x in np.linspace(*X, 5):
            axes.plot(np.full(len(outline), x), *outline.T, color=WALL, linewidth=0.8, alpha=0.8, zorder=2)
        for k, colour in enumerate(fibre_colours(paths.shape[1])):
            first, last = paths[0, k], paths[-1, k]
            axes.plot(
                first[:, 0], first[:, 2], first[:, 1], color=colour, linewidth=0.8, linestyle=":", alpha=0.7, zorder=3
            )
            axes.plot(last[:, 0], last[:, 2], last[:, 1], color=colour, linewidth=1.8, zorder=4)
        # Z downwards the axis that Matplotlib calls y: X, −Z, Y are right-handed as X, Y, Z are.
        axes.set(xlim=X, ylim=(high, low), zlim=(bottom, top))
        axes.set_box_aspect(BOX, zoom=1.2)
        axes.view_init(elev=24.0, azim=-66.0)
        _name_axes(axes)
        # Its own layout: the box that Matplotlib reserves for axes in space is mostly empty.
        drawing.figure.set_layout_engine("none")
        axes.set_position((-0.03, 0.02, 1.0, 1.06))
        return drawing.done(
            f"({letter}) {kind}: the bundle in space",
            f"Fibres at t = {1e3 * film.times[-1]:.3g} ms over the groove (grey), dotted where they started. Across, "
            "everything is drawn much larger than along X. To see: from A on the left to B on the right the ribbon "
            "draws together.",
        )


def _name_axes(axes: Any) -> None:
    """Of a box in space, with few ticks."""
    axes.locator_params(nbins=4)
    axes.locator_params(axis="y", nbins=3)
    axes.tick_params(labelsize=9, pad=1)
    axes.set_xlabel("X, machine [mm]", labelpad=12)
    axes.set_ylabel("Z, across [mm]", labelpad=8)
    axes.set_zlabel("Y, out [mm]", labelpad=5)


def across(film: Film, kind: str, letter: str) -> Panel:
    """Fibres seen along X at the last frame, from A to B, to scale."""
    with panel(3.6) as drawing:
        axes = drawing.axes()
        paths, n = film.paths[-1], film.paths.shape[1]
        draw_section(axes, film, -1, None)
        for k, colour in enumerate(fibre_colours(n)):
            axes.plot(MM * film.paths[:, k, -1, 2], MM * film.paths[:, k, -1, 1], ":", color=colour, linewidth=1.0)
            axes.plot(MM * paths[k, :, 2], MM * paths[k, :, 1], color=colour, linewidth=1.6)
            for node, filled in ((0, False), (-1, True)):
                place = MM * paths[k, node, 2], MM * paths[k, node, 1]
                face = colour if filled else "white"
                axes.plot(*place, "o", color=colour, markerfacecolor=face, markersize=7, zorder=6)
            if n <= 9:
                place = MM * paths[k, 0, 2], MM * paths[k, 0, 1]
                axes.annotate(str(k + 1), place, (0, 7), textcoords="offset points", ha="center", color=colour)
        _to_scale(axes, window(film))
        return drawing.done(
            f"({letter}) {kind}: the YZ plane",
            "Seen along X: rings are fibres at A with their numbers, full dots their ends at B, dotted how these came "
            "there in time; groove and core to scale. To see: whether fibres that lay side by side at A have changed "
            "places at B.",
        )


def from_above(film: Film, kind: str) -> Panel:
    """Fibres in the X–Z plane at the last frame, the upper one over the lower, with its signed crossings."""
    with panel(3.3) as drawing:
        axes = drawing.axes()
        paths = film.paths[-1]
        for k, colour in enumerate(fibre_colours(len(paths))):
            points = MM * paths[k][:, [0, 2]]
            pieces = np.stack([points[:-1], points[1:]], axis=1)
            height = 0.5 * (paths[k][:-1, 1] + paths[k][1:, 1])
            for piece, y in zip(pieces, height, strict=True):
                # What lies higher is drawn later, with a pale edge that cuts what is below by a radius or more.
                order = 3.0 + MM * y
                below = order - MM * float(film.radius[0])
                axes.add_collection(LineCollection([piece], colors="white", linewidths=4.0, zorder=below))
                axes.add_collection(LineCollection([piece], colors=[colour], linewidths=1.8, zorder=order))
        crossings = film.crossings(-1)
        for _, k, _, _, X, sign in crossings:
            z = np.interp(X, paths[int(k), :, 0], paths[int(k), :, 2])
            text, colour = ("Z", "#a3231b") if sign > 0 else ("S", "#1f5fa8")
            axes.annotate(text, (MM * X, MM * z), (0, 9), textcoords="offset points", ha="center", color=colour)
        axes.autoscale()
        axes.margins(0.04, 0.14)
        axes.set(xlabel="X, machine [mm]", ylabel="Z, across [mm]")
        # Who looks down from above has X to the right and Z towards him: crossings keep their hand.
        axes.invert_yaxis()
        axes.grid(alpha=0.25)
        net = int(crossings[:, 5].sum())
        told = f"{len(crossings)} crossings, Z less S: {net:+d}" if len(crossings) else "No crossing"
        return drawing.done(
            f"{kind}: seen from above",
            f"{told}. Each crossing is half a turn of its two fibres about each other, Z right-handed or "
            "S left-handed; the upper fibre is drawn over the lower. Not to scale across.",
        )


def draw_section(axes: Axes, film: Film, frame: int, X: float | None) -> None:
    """Groove and core, and fibres as the circles they are where X is given."""
    reach = window(film)[0]
    outline = MM * _drawn(film, (float(reach[0]), float(reach[1])))
    floor = float(outline[:, 1].min()) - 10.0
    axes.fill_between(outline[:, 0], outline[:, 1], floor, color=WALL, alpha=0.35, linewidth=0, zorder=0)
    axes.plot(outline[:, 0], outline[:, 1], color=WALL, linewidth=1.2, zorder=1)
    if len(film.core):
        y, z, radius = MM * film.core[frame]
        axes.add_patch(Circle((z, y), radius, facecolor=CORE, edgecolor="0.45", linewidth=0.8, zorder=2))
    if X is None:
        return
    for r, colour in zip(film.paths[frame], fibre_colours(film.paths.shape[1]), strict=True):
        y, z = (MM * np.interp(X, r[:, 0], r[:, c]) for c in (1, 2))
        axes.add_patch(Circle((z, y), MM * film.radius[0], facecolor=colour, edgecolor="none", zorder=4))


def window(film: Film) -> Array:
    """Of z and of y: all that fibres come by, the foot of the groove and the core, shape (2, 2) [m]."""
    z, y = film.paths[..., 2], film.paths[..., 1]
    foot = film.outline[film.outline[:, 1].argmin()]
    points = [(z.min(), y.min()), (z.max(), y.max()), tuple(foot)]
    if len(film.core):
        Y, Z, radius = film.core.T
        points += [(Z.min() - radius[0], Y.min() - radius[0]), (Z.max() + radius[0], Y.max() + radius[0])]
    low, high = np.min(points, axis=0), np.max(points, axis=0)
    room = np.maximum(MARGIN * (high - low), LEAST)
    return np.stack([low - room, high + room], axis=1)


def _to_scale(axes: Axes, reach: Array) -> None:
    (left, right), (bottom, top) = MM * reach
    axes.set_aspect("equal", adjustable="box")
    axes.set(xlim=(left, right), ylim=(bottom, top), xlabel="Z, across [mm]", ylabel="Y, out [mm]")


def _drawn(film: Film, reach: tuple[float, float]) -> Array:
    """The outline between two z, its ends on them where it goes on beyond, shape (n, 2)."""
    z, y = film.outline.T
    inner = film.outline[(z > reach[0]) & (z < reach[1])]
    ends = [(at, float(np.interp(at, z, y))) for at in reach]
    return np.vstack([ends[0], inner, ends[1]])
