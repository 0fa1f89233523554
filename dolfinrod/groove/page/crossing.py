"""Who crosses whom, where and when: Z and S crossings of one run in time, and of all runs at their ends."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.groove.page.panels import Panel, finish, panel

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    from dolfinrod.groove.film import Film

    Array = NDArray[np.float64]

__all__ = ["by_pair", "in_time"]

MM = 1e3
HANDS = ((1, "^", "#a3231b", "Z, right-handed"), (-1, "v", "#1f5fa8", "S, left-handed"))
# Of pairs beyond which rows have no room for names.
MOST_PAIRS = 15


def in_time(film: Film, kind: str) -> Panel:
    """Crossings of a run over X and time."""
    with panel(3.6) as drawing:
        axes = drawing.axes()
        frame, X, sign = film.crossed[:, 0].astype(int), film.crossed[:, 4], film.crossed[:, 5]
        _mark(axes, MM * X, 1e3 * film.times[frame], sign)
        axes.set_ylim(0.0, 1e3 * film.times[-1])
        _frame(axes, [film], "time t [ms]")
        told = "" if len(film.crossed) else "No fibre crosses another in this run. "
        return drawing.done(
            f"{kind}: crossings over X and time",
            f"{told}Each mark is a crossing of two fibres seen from above, half a turn. To see: pairs of opposite hand "
            "come and go together; a hand that is left alone is net twist.",
        )


def by_pair(films: Sequence[Film], kind: str) -> Panel:
    """Crossings of all runs at their ends over X, by the pair of fibres that cross."""
    n = max(film.paths.shape[1] for film in films)
    pairs = [(k, l) for k in range(n) for l in range(k + 1, n)]
    rows = {pair: row for row, pair in enumerate(pairs)}
    found = np.concatenate([film.crossings(-1) for film in films])
    with panel(3.6) as drawing:
        axes = drawing.axes()
        beside = np.concatenate([np.full(len(f.crossings(-1)), i) for i, f in enumerate(films)])
        # Runs lie above one another in the row of a pair.
        height = np.array([rows[int(k), int(l)] for k, l in found[:, 1:3]], dtype=float)
        height += 0.7 * ((beside + 0.5) / len(films) - 0.5)
        _mark(axes, MM * found[:, 4], height, found[:, 5])
        if len(pairs) <= MOST_PAIRS:
            axes.set_yticks(range(len(pairs)), [f"{k + 1}–{l + 1}" for k, l in pairs])
        axes.set_ylim(-0.6, len(pairs) - 0.4)
        _frame(axes, films, "pair of fibres")
        told = f"{len(films)} run{'s' * (len(films) != 1)} at the end, {_balance(found)}."
        return drawing.done(
            f"{kind}: who crosses whom",
            f"{told} A row a pair of fibres, numbered from the right to the left as they enter. To see: which fibres "
            "cross in every run, and whether one hand prevails.",
        )


def _mark(axes: Axes, x: Array, y: Array, sign: Array) -> None:
    for which, marker, colour, name in HANDS:
        on = sign == which
        label = f"{name}: {int(on.sum())}"
        axes.plot(
            x[on], y[on], marker, color=colour, markersize=5, alpha=0.7, linestyle="none", label=label, clip_on=False
        )


def _frame(axes: Axes, films: Sequence[Film], y: str) -> None:
    """From A to B."""
    ends = np.array([film.paths[-1, :, [0, -1], 0].mean(axis=1) for film in films])
    axes.set_xlim(MM * float(ends.min()), MM * float(ends.max()))
    if not any(line.get_xdata().size for line in axes.lines):
        axes.text(0.5, 0.5, "no crossing", transform=axes.transAxes, ha="center", color="0.4")
    finish(axes, "X, machine [mm]", y, zero=False)


def _balance(found: Array) -> str:
    if not len(found):
        return "no fibre crosses another"
    z = int((found[:, 5] > 0).sum())
    return f"{len(found)} crossings in all: {z} Z and {len(found) - z} S"
