"""Cross-sections of the bundle at several X, to scale: groove, core and fibres."""

from __future__ import annotations

from typing import TYPE_CHECKING

from dolfinrod.groove.page.panels import Panel, panel
from dolfinrod.groove.page.views import MM, draw_section, window

if TYPE_CHECKING:
    from dolfinrod.groove.film import Film

__all__ = ["cuts"]

# Parts of the way from A to B; at A itself fibres are still as they enter.
PLACES = (0.05, 0.25, 0.5, 0.75, 1.0)
# Height of the names beside the pictures, in inches.
NAMES = 0.75
# Under the names within them.
PLATE = {"facecolor": "white", "edgecolor": "none", "alpha": 0.7, "pad": 1.5}


def cuts(film: Film, kind: str) -> Panel:
    """A column of sections at the last frame, all to the same scale."""
    (left, right), (bottom, top) = MM * window(film)
    ends = film.paths[-1, :, [0, -1], 0]
    low, high = float(ends[0].max()), float(ends[1].min())
    each = min(1.9, 4.9 * (top - bottom) / (right - left))
    with panel(len(PLACES) * (each + 0.12) + NAMES) as drawing:
        rows = drawing.figure.subplots(len(PLACES), 1, sharex=True, sharey=True)
        for axes, part in zip(rows, PLACES, strict=True):
            X = low + part * (high - low)
            draw_section(axes, film, -1, X)
            axes.set_aspect("equal", adjustable="box")
            axes.set(xlim=(left, right), ylim=(bottom, top))
            axes.locator_params(axis="y", nbins=3)
            axes.annotate(
                f"X = {MM * X:.3g} mm", (0.985, 0.93), xycoords="axes fraction", ha="right", va="top", bbox=PLATE
            )
        rows[-1].set_xlabel("Z, across [mm]")
        rows[len(PLACES) // 2].set_ylabel("Y, out [mm]")
        diameter = 2e6 * float(film.radius[0])
        return drawing.done(
            f"{kind}: cross-sections",
            f"From near A (top) to B (bottom) at t = {1e3 * film.times[-1]:.3g} ms, to scale: fibres of {diameter:.3g} "
            f"µm are the small discs, the pale circle {'is the core' if len(film.core) else 'would be a core: none'}, "
            "grey is the groove. To see: how the ribbon narrows and where in the groove it lies.",
        )
