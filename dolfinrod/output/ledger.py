"""The energies of a motion over time, and the works that change them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.output.scale import scale

if TYPE_CHECKING:
    from collections.abc import Mapping

    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["draw_ledger"]

# Energies that the rods have are lines, works done on them dashed; the colours are Okabe and Ito's, those of contact
# Tol's: wine, olive, indigo.
LINES = {
    "kinetic": ("#D55E00", "-"),
    "strain": ("#0072B2", "-"),
    "potential": ("#009E73", "-"),
    "load work": ("#CC79A7", "--"),
    "support work": ("#E69F00", "--"),
    "drag": ("#56B4E9", "--"),
    "damping": ("0.2", "--"),
    "contact": ("#882255", "-"),
    "friction": ("#999933", "--"),
    "wall work": ("#332288", "--"),
    "numerical": ("0.6", "--"),
}
OTHER = ("0.45", ":")
# Relative to the largest: the rest is round-off, and left out.
ROUND_OFF = 1e-9


def draw_ledger(axes: Axes, t: Array, energy: Mapping[str, Array]) -> None:
    """Change of each energy since the start, and the works; their sums are equal at every time.

    Args:
        axes: Where to draw.
        t: Stored times, shape (n_t,) [s].
        energy: Ledger at these times, by name, shapes (n_t,) [J].
    """
    changes = {name: values - values[0] for name, values in energy.items()}
    most = max(float(np.abs(values).max()) for values in changes.values())
    unit = scale(most, "J")
    for name, values in changes.items():
        if np.abs(values).max() > ROUND_OFF * most:
            color, style = LINES.get(name, OTHER)
            axes.plot(t, unit.factor * values, color=color, linestyle=style, label=name)
    if not most:
        axes.plot(t, np.zeros_like(t), color="0.75", label="nothing")
        axes.set_ylim(-1.0, 1.0)
    axes.axhline(0.0, color="0.75", linewidth=0.8, zorder=0)
    axes.grid(alpha=0.25)
    axes.set(xlabel="time t [s]", ylabel=f"energy E [{unit.unit}]")
    axes.set_title("Energies (lines) and works (dashed) since the start", fontsize=11)
    axes.legend(fontsize=8, frameon=False, loc="center left", bbox_to_anchor=(1.0, 0.5))
