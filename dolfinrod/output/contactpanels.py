"""Pictures of contact: pressures, tractions and gaps along the rods, stick and slip, forces and lengths over time."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import StrMethodFormatter

from dolfinrod.output.palette import COMPONENTS, RODS, STYLES
from dolfinrod.output.scale import scale
from dolfinrod.result import Touching
from dolfinrod.scene import Dynamic

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.gridspec import GridSpec
    from numpy.typing import NDArray

    from dolfinrod.result import Result

    Array = NDArray[np.float64]

__all__ = [
    "CAPTION",
    "PRESSURE",
    "TRACTION",
    "ZONES",
    "dots",
    "draw_contacts",
    "finish",
    "line_styles",
    "n_rows",
    "time_axis",
]

CAPTION = "Friction t reaches its limit μp only where a rod slides; rods are pressed where they come closer than g₀."
# Contacts beyond these are left to the tables.
MOST_CONTACTS = 4
ZONES = {1: ("sticks", "#009E73"), 2: ("slides", "#E69F00")}
PRESSURE, TRACTION, LIMIT = "#0072B2", "#D55E00", "0.5"
# Gaps of so many times the penetration would hide it on an axis of even steps.
FAR = 20.0


def n_rows(result: Result) -> int:
    """Rows of panels that the contacts of a result fill: one a contact, and one for all."""
    return 1 + min(len(result.contacts), MOST_CONTACTS) if result.contacts else 0


def draw_contacts(figure: Figure, grid: GridSpec, result: Result, first: int) -> None:
    """Line loads and gaps of each contact at the last stored state, then forces and lengths over time.

    Args:
        figure: Where to draw.
        grid: Its rows are of two panels each.
        result: With contacts.
        first: Row from which on `n_rows` of them are free.
    """
    last = first + n_rows(result) - 1
    for k in range(last - first):
        _draw_loads(figure.add_subplot(grid[first + k, 0]), result, k)
        _draw_gaps(figure.add_subplot(grid[first + k, 1]), result, k)
    _draw_forces(figure.add_subplot(grid[last, 0]), result)
    _draw_lengths(figure.add_subplot(grid[last, 1]), result)


def _draw_loads(axes: Axes, result: Result, k: int) -> None:
    """Pressure, traction and its limit along the rods; where they stick and where they slide."""
    rods, friction = _rods(result, k), result.scene.walls[k].friction
    norms = {j: np.linalg.norm(rod.traction[-1], axis=1) for j, rod in rods.items()}
    size = max(float(np.concatenate((rod.pressure[-1], norms[j])).max()) for j, rod in rods.items())
    unit, along = scale(size, "N/m"), _along(rods)
    for row, (j, rod) in enumerate(rods.items()):
        s, p, style = along.factor * rod.s, unit.factor * rod.pressure[-1], STYLES[j % len(STYLES)]
        _shade(axes, along.factor * rod.s, rod.state[-1], (row / len(rods), (row + 1) / len(rods)))
        axes.plot(s, p, color=PRESSURE, linestyle=style)
        if friction is not None:
            axes.plot(s, friction.mu * p, color=LIMIT, linestyle=style, linewidth=1.0)
            axes.plot(s, unit.factor * norms[j], color=TRACTION, linestyle=style)
    told = {"pressure $p$": PRESSURE} | (
        {} if friction is None else {"traction $|t|$": TRACTION, r"limit $\mu p$": LIMIT}
    )
    key: list[Any] = [Line2D([], [], color=color, label=name) for name, color in told.items()]
    states = np.concatenate([rod.state[-1] for rod in rods.values()])
    key += [Patch(color=color, alpha=0.2, linewidth=0, label=name) for i, (name, color) in ZONES.items() if i in states]
    axes.set(xlabel=f"arc length s [{along.unit}]", ylabel=f"line load [{unit.unit}]")
    finish(axes, f"{_name(result, k)}: loads along the rods, {_at(result)}", size, key + _rod_styles(result, rods))


def _draw_gaps(axes: Axes, result: Result, k: int) -> None:
    """Gap along the rods, the surface and where contact begins."""
    rods, g_0 = _rods(result, k), result.scene.walls[k].law.g_0
    gaps = np.concatenate([rod.gap[-1] for rod in rods.values()])
    pressed = np.concatenate([rod.pressure[-1] for rod in rods.values()]) > 0.0
    near = max(abs(g_0), float(np.abs(gaps[pressed]).max(initial=0.0)))
    size = max(abs(g_0), float(np.abs(gaps).max()))
    hidden = near > 0.0 and size > FAR * near
    unit, along = scale(near if hidden else size, "m"), _along(rods)
    for j, rod in rods.items():
        axes.plot(along.factor * rod.s, unit.factor * rod.gap[-1], color=PRESSURE, linestyle=STYLES[j % len(STYLES)])
    key: list[Any] = [Line2D([], [], color=PRESSURE, label="gap $g$")]
    if g_0:
        key.append(axes.axhline(unit.factor * g_0, color=TRACTION, linewidth=1.0, label="$g_0$, begins"))
    key.append(axes.axhline(0.0, color="0.2", linewidth=1.0, label="surface"))
    if hidden:
        axes.set_yscale("symlog", linthresh=unit.factor * near, linscale=2.0)
        axes.autoscale_view()  # limits were found on the even scale
        axes.yaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    far_off = "\n(logarithmic far off)" if hidden else ""
    axes.set(xlabel=f"arc length s [{along.unit}]", ylabel=f"gap g [{unit.unit}]{far_off}")
    title = f"{_name(result, k)}: gap along the rods, {_at(result)}"
    finish(axes, title, size, key + _rod_styles(result, rods))


def _draw_forces(axes: Axes, result: Result) -> None:
    """Resultant of each contact on the rods."""
    forces = [contact.force for contact in result.contacts]
    size = max(float(np.abs(force).max()) for force in forces)
    unit = scale(size, "N")
    for k, force in enumerate(forces):
        for i, color in enumerate(COMPONENTS):
            axes.plot(
                result.t, unit.factor * force[:, i], color=color, linestyle=STYLES[k % len(STYLES)], **dots(result)
            )
    axes.set(xlabel=time_axis(result), ylabel=f"force F [{unit.unit}]")
    names = ("$F_x$", "$F_y$", "$F_z$")
    key = [Line2D([], [], color=color, label=name) for color, name in zip(COMPONENTS, names, strict=True)]
    numbers = list(range(len(forces)))
    finish(
        axes,
        "Contact forces on the rods, in space",
        size,
        key + (line_styles("contact", numbers) if numbers[1:] else []),
    )


def _draw_lengths(axes: Axes, result: Result) -> None:
    """Length of the rods that each contact presses."""
    lengths = [contact.length for contact in result.contacts]
    size = max(float(length.max()) for length in lengths)
    unit, few = scale(size, "m"), len(lengths) <= len(RODS)
    for k, length in enumerate(lengths):
        axes.plot(
            result.t,
            unit.factor * length,
            color=RODS[k] if few else LIMIT,
            linestyle=STYLES[k % len(STYLES)],
            **dots(result),
            label=f"contact {k}",
        )
    axes.set(xlabel=time_axis(result), ylabel=f"length in contact [{unit.unit}]")
    finish(axes, "Length in contact", size, axes.lines[: len(RODS)] if few else axes.lines[:1])


def _rods(result: Result, k: int) -> dict[int, Touching]:
    """The rods that a contact concerns."""
    return {j: rod for j, rod in enumerate(result.contacts[k].rods) if rod is not None}


def _shade(axes: Axes, s: Array, state: NDArray[np.int8], height: tuple[float, float]) -> None:
    """A strip that is coloured where a rod sticks or slides, half-way to the neighbours of its points."""
    edges = np.concatenate(([s[0]], 0.5 * (s[1:] + s[:-1]), [s[-1]]))
    turns = [0, *(np.flatnonzero(np.diff(state)) + 1), len(state)]
    for i, j in pairwise(turns):
        if state[i] in ZONES:
            color = ZONES[int(state[i])][1]
            axes.axvspan(edges[i], edges[j], *height, color=color, alpha=0.2, linewidth=0)


def _along(rods: dict[int, Touching]) -> Any:
    return scale(max(rod.s[-1] for rod in rods.values()), "m")


def _name(result: Result, k: int) -> str:
    return f"Contact {k}, {type(result.scene.walls[k].surface).__name__.lower()}"


def _moving(result: Result) -> bool:
    return isinstance(result.scene.motion, Dynamic)


def _at(result: Result) -> str:
    return f"t = {result.t[-1]:.4g}{' s' * _moving(result)}"


def time_axis(result: Result) -> str:
    """Name of the axis of stored times."""
    return "time t [s]" if _moving(result) else "pseudo-time t [1]"


def dots(result: Result) -> dict[str, Any]:
    """Equilibria are dots on their path."""
    return {} if _moving(result) else {"marker": "o", "markersize": 3.5}


def _rod_styles(result: Result, rods: dict[int, Touching]) -> list[Line2D]:
    """Key of the rods, where the scene has several."""
    return line_styles("rod", list(rods)) if len(result.rods) > 1 else []


def line_styles(what: str, numbers: list[int]) -> list[Line2D]:
    """Key of the line styles."""
    more = ", …" if len(numbers) > len(STYLES) else ""
    shown = numbers[: len(STYLES)]
    return [Line2D([], [], color="0.3", linestyle=STYLES[j % len(STYLES)], label=f"{what} {j}{more}") for j in shown]


def finish(axes: Axes, title: str, size: float, key: list[Any]) -> None:
    """Title, grid, the line of zero and the key; a panel in which all is zero keeps to ±1."""
    if not size:
        axes.set_ylim(-1.0, 1.0)
    axes.set_title(title, fontsize=11)
    axes.axhline(0.0, color="0.75", linewidth=0.8, zorder=0)
    axes.grid(alpha=0.25)
    axes.legend(handles=key, fontsize=8, frameon=False, loc="center left", bbox_to_anchor=(1.0, 0.5))
