"""Pictures of rods that touch rods: forces and numbers of spots over time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from dolfinrod.output.contactpanels import PRESSURE, TRACTION, ZONES, dots, finish, line_styles, time_axis
from dolfinrod.output.meetings import spot_sums
from dolfinrod.output.palette import STYLES
from dolfinrod.output.scale import scale

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.gridspec import GridSpec
    from numpy.typing import NDArray

    from dolfinrod.output.view import View
    from dolfinrod.result import MeetingHistory, Result

    Array = NDArray[np.float64]

__all__ = ["draw_meetings", "mark_spots"]

# Contacts beyond these are left to the tables.
MOST_MEETINGS = len(STYLES)
SLIDING = 2
MARK: dict[str, Any] = {"linestyle": "none", "marker": "o", "markersize": 4.0, "color": "0.1", "zorder": 5}


def draw_meetings(figure: Figure, grid: GridSpec, result: Result) -> None:
    """Magnitudes of all forces between rods, summed, and numbers of spots, over time.

    Args:
        figure: Where to draw.
        grid: Whose last row, of two panels, is free.
        result: With rods that may touch rods.
    """
    _draw_forces(figure.add_subplot(grid[-1, 0]), result)
    _draw_spots(figure.add_subplot(grid[-1, 1]), result)


def mark_spots(axes: Any, result: Result, seen: View, factor: float) -> list[Line2D]:
    """Mark on the shapes where rods touch rods at the last stored state.

    Args:
        axes: With the shapes.
        result: What was found.
        seen: From where.
        factor: What metres are drawn with.

    Returns:
        Key of the marks; none where nothing touches.
    """
    points = [meeting.times[-1].point for meeting in result.meetings if len(meeting.times[-1].point)]
    if not points:
        return []
    axes.plot(*(factor * seen.seen(np.concatenate(points))), **MARK)
    return [Line2D([], [], **MARK, label="rods touch")]


def _draw_forces(axes: Axes, result: Result) -> None:
    """Sums of the magnitudes of whole forces and of friction."""
    forces = [spot_sums(meeting)["force"] for meeting in result.meetings[:MOST_MEETINGS]]
    rubbed = [_friction(meeting) for meeting in result.meetings[:MOST_MEETINGS]]
    size = max(float(force.max()) for force in forces)
    unit, rubs = scale(size, "N"), any(contact.friction is not None for contact in result.scene.meetings)
    drawn = {r"all $\Sigma|F|$": (PRESSURE, forces)} | ({r"friction $\Sigma|T|$": (TRACTION, rubbed)} if rubs else {})
    for color, curves in drawn.values():
        _draw(axes, result, [unit.factor * values for values in curves], color)
    axes.set(xlabel=time_axis(result), ylabel=f"force F [{unit.unit}]")
    key = [Line2D([], [], color=color, label=name) for name, (color, _) in drawn.items()]
    finish(axes, "Forces between rods, magnitudes summed", size, key + _numbers(result))


def _draw_spots(axes: Axes, result: Result) -> None:
    """Numbers of spots, and of those where anything slides."""
    shown = result.meetings[:MOST_MEETINGS]
    counts = [spot_sums(meeting)["spots"] for meeting in shown]
    drawn = {"all": (PRESSURE, counts)}
    if any(contact.friction is not None for contact in result.scene.meetings):
        name, color = ZONES[SLIDING]
        drawn[name] = (color, [_sliding(meeting) for meeting in shown])
    for color, curves in drawn.values():
        _draw(axes, result, curves, color)
    axes.yaxis.set_major_locator(MaxNLocator(integer=True))
    axes.set(xlabel=time_axis(result), ylabel="number of spots [1]")
    key = [Line2D([], [], color=color, label=name) for name, (color, _) in drawn.items()]
    finish(axes, "Spots at which rods touch", max(float(count.max()) for count in counts), key + _numbers(result))


def _draw(axes: Axes, result: Result, curves: list[Array], color: str) -> None:
    """One quantity of all contacts, each in its line style."""
    for values, style in zip(curves, STYLES, strict=False):
        axes.plot(result.t, values, color=color, linestyle=style, **dots(result))


def _friction(meeting: MeetingHistory) -> Array:
    return np.array([np.linalg.norm(met.traction, axis=1).sum() for met in meeting.times])


def _sliding(meeting: MeetingHistory) -> Array:
    return np.array([float(len(np.unique(met.spots[met.state == SLIDING]))) for met in meeting.times])


def _numbers(result: Result) -> list[Line2D]:
    """Key of the contacts, where the scene has several among rods."""
    numbers = list(range(len(result.meetings)))
    return line_styles("contact", numbers) if numbers[1:] else []
