"""The verdict in one picture: twist of simulated bundles beside the twist of measured yarns."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from dolfinrod.groove.comparison import difference, measured
from dolfinrod.groove.page.panels import COLOURS, Panel, finish, panel
from dolfinrod.groove.page.words import interval
from dolfinrod.groove.statistics import Interval, of_mean

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from dolfinrod.groove.page.settings import Setting

__all__ = ["headline"]

YARN, DIFFERENCE = "#5b2a86", "0.1"
# Under numbers, where the line of zero goes through.
PLATE = {"facecolor": "white", "edgecolor": "none", "alpha": 0.75, "pad": 0.5}
PLAIN = {
    "lateral": "bundles,\nlateral",
    "intermediate": "bundles,\nintermediate",
    "lateral_steep": "bundles,\nlateral, steep",
}


def headline(base: Setting) -> Panel:
    """Each run a dot, means and differences with their intervals, on one axis.

    Args:
        base: The setting that the page is about.

    Returns:
        The panel.
    """
    yarns = measured().comparison.difference
    rows: list[tuple[str, str, Interval | None, tuple[float, ...]]] = [
        ("yarns measured,\nlateral − intermediate", YARN, yarns, ())
    ]
    samples = {kind: base.values("T_crossed", kind) for kind in base.kinds}
    a, b = samples.get("lateral", ()), samples.get("intermediate", ())
    if min(len(a), len(b)) >= 2:
        rows.append(("bundles simulated,\nlateral − intermediate", DIFFERENCE, difference(a, b), ()))
    for kind, values in samples.items():
        mean = of_mean(values) if len(values) >= 2 else None
        rows.append((PLAIN[kind], COLOURS[kind], mean, values))
    with panel(0.75 * len(rows) + 1.0, 5.8) as drawing:
        axes = drawing.axes()
        for place, row in enumerate(rows):
            _row(axes, -place, *row)
        axes.set_yticks([-place for place in range(len(rows))], [row[0] for row in rows])
        axes.set_ylim(0.55 - len(rows), 0.6)
        axes.margins(x=0.28)
        axes.tick_params(axis="y", length=0)
        axes.axvline(0.0, color="0.4", linewidth=1.0, zorder=0)
        axes.axvspan(yarns.low, yarns.high, color=YARN, alpha=0.10, linewidth=0, zorder=0)
        finish(axes, "twist [turns/m]; Z twist, as of the yarn, to the right", "", key=0, zero=False)
        axes.grid(visible=False, axis="y")
        return drawing.done(
            "Additional twist: measured yarns and simulated bundles",
            "Bars are 95 % intervals of means, small dots single runs, twist of bundles counted by crossings. The "
            "shaded stripe is the difference that Table 1 of the paper shows between yarns. To see: whether the bar of "
            "the simulated difference leaves zero, and whether it reaches the stripe.",
        )


def _row(axes: Axes, y: float, _: str, colour: str, mean: Interval | None, values: tuple[float, ...]) -> None:
    """One line of the picture."""
    if values:
        # Runs of the same twist lie beside one another, not on top.
        beside = -0.16 - 0.09 * (np.arange(len(values)) % 3)
        axes.plot(values, y + beside, "o", color=colour, markersize=4, alpha=0.55, markeredgewidth=0, linestyle="none")
    if mean is not None:
        style: dict[str, Any] = {"color": colour, "solid_capstyle": "butt"}
        axes.plot((mean.low, mean.high), (y, y), linewidth=3.0, **style)
        axes.plot(mean.value, y, "D", color=colour, markersize=8)
        axes.annotate(
            interval(mean), (mean.value, y), (0, 9), textcoords="offset points", ha="center", color=colour, bbox=PLATE
        )
