"""Panels: small pictures of their own, as wide as a telephone, that a page sets side by side."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from html import escape
from io import BytesIO
from typing import TYPE_CHECKING, Any

import matplotlib as mpl
import numpy as np
from matplotlib import colormaps
from matplotlib.figure import Figure

from dolfinrod.output.palette import RODS

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["COLOURS", "Panel", "band", "fibre_colours", "finish", "panel"]

# Of the kinds of groove; told apart by colour-blind eyes, and never by colour alone.
COLOURS = {"lateral": "#D55E00", "intermediate": "#0072B2", "lateral_steep": "#009E73"}
DASHES = {"lateral": "-", "intermediate": (0, (5, 2)), "lateral_steep": (0, (1, 1.5))}
WIDTH = 5.6
STYLE = {
    "font.size": 11.0,
    "axes.titlesize": 11.5,
    "axes.labelsize": 11.0,
    "legend.fontsize": 10.0,
    "legend.frameon": False,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.unicode_minus": True,
    "svg.hashsalt": "dolfinrod",
}


@dataclass(frozen=True)
class Panel:
    """A picture and what to see in it.

    Args:
        title: Above it.
        caption: Below it.
        svg: The picture.
    """

    title: str
    caption: str
    svg: bytes

    @property
    def html(self) -> str:
        """A figure that holds its picture."""
        data = b64encode(self.svg).decode("ascii")
        alt = escape(f"{self.title}. {self.caption}", quote=True)
        return (
            f'<figure><h3>{escape(self.title)}</h3><img alt="{alt}" src="data:image/svg+xml;base64,{data}">'
            f"<figcaption>{escape(self.caption)}</figcaption></figure>"
        )


class _Drawing:
    """A figure while it is drawn."""

    def __init__(self, height: float, width: float) -> None:
        self.figure = Figure(figsize=(width, height), layout="constrained")
        self.panel: Panel | None = None

    def axes(self, **options: Any) -> Axes:
        """The only axes."""
        return self.figure.add_subplot(**options)

    def done(self, title: str, caption: str) -> Panel:
        """The panel."""
        file = BytesIO()
        self.figure.savefig(file, format="svg", metadata={"Date": None, "Creator": None})
        self.panel = Panel(title, caption, file.getvalue())
        return self.panel


@contextmanager
def panel(height: float = 3.4, width: float = WIDTH) -> Iterator[_Drawing]:
    """A figure in the style of the page.

    Args:
        height: In inches.
        width: Likewise.

    Yields:
        The figure to draw on, which `done` makes a panel.
    """
    with mpl.rc_context(STYLE):
        yield _Drawing(height, width)


def fibre_colours(n: int) -> list[Any]:
    """A colour a fibre, from the right to the left: those of all pictures, of many fibres a scale."""
    if n <= len(RODS):
        return list(RODS[:n])
    return [colormaps["turbo"](x) for x in np.linspace(0.05, 0.95, n)]


def band(axes: Axes, kind: str, x: Array, curves: Sequence[Array], *, stepped: bool = False) -> None:
    """The mean of some curves, and all between the lowest and the highest of them.

    Args:
        axes: Where to draw.
        kind: Of groove.
        x: Shape (n,), or of steps their ends, shape (n + 1,).
        curves: Shapes (n,); not a number where nothing is known.
        stepped: Whether values are means between ends.
    """
    y = np.array(curves)
    known = np.isfinite(y)
    n = np.maximum(known.sum(axis=0), 1)
    mean = np.where(known.any(axis=0), np.where(known, y, 0.0).sum(axis=0) / n, np.nan)
    low, high = (np.where(known.any(axis=0), f(y, axis=0), np.nan) for f in (np.fmin.reduce, np.fmax.reduce))
    lines = [np.append(v, v[-1]) if stepped else v for v in (mean, low, high)]
    style: dict[str, Any] = {"drawstyle": "steps-post"} if stepped else {}
    label = f"{kind.replace('_', ' ')}, {len(curves)} run{'s' * (len(curves) != 1)}"
    axes.plot(x, lines[0], color=COLOURS[kind], linestyle=DASHES[kind], label=label, linewidth=1.8, **style)
    if len(curves) > 1:
        shaded: dict[str, Any] = {"step": "post"} if stepped else {}
        axes.fill_between(x, lines[1], lines[2], color=COLOURS[kind], alpha=0.18, linewidth=0, **shaded)


def finish(axes: Axes, x: str, y: str, *, key: int = 2, zero: bool = True) -> None:
    """Names of the axes, a grid, the line of zero, and a key above.

    Args:
        axes: Drawn.
        x: Quantity and unit.
        y: Likewise.
        key: Columns of the key; 0: none.
        zero: Whether upwards there are quantities, not rows.
    """
    axes.set(xlabel=x, ylabel=y)
    axes.grid(alpha=0.25)
    low, high = axes.get_ylim()
    if zero and low <= 0.0 <= high:
        axes.axhline(0.0, color="0.6", linewidth=0.8, zorder=0)
    if key:
        axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=key, borderaxespad=0.2)
