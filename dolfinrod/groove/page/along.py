"""What the bundles of all runs are like along X at the end, and in the course of time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.groove.page.panels import Panel, band, finish, panel
from dolfinrod.groove.page.words import signed
from dolfinrod.output.ledger import draw_ledger
from dolfinrod.output.scale import scale

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.groove.film import Film

    Array = NDArray[np.float64]
    Films = Mapping[str, Sequence[Film]]

__all__ = ["course_panels", "end_panels", "ledger_panel"]

MM = 1e3
BANDS = "Lines are means of all runs, bands go from the lowest to the highest."
# Row of `Film.along`, title, axis, factor to its unit, what to see.
ALONG = (
    (0, "Width along X", "width of the bundle [mm]", MM, "how far from A the ribbon has become a strand"),
    (1, "Tension along X", "mean tension of a fibre [mN]", 1e3, "friction and air change what is drawn at B towards A"),
    (2, "Contact with groove and core along X", "line load on all fibres [N/m]", 1.0, "where walls and core press"),
    (3, "Contact of fibres with fibres along X", "line load, met once [N/m]", 1.0, "where fibres press one another"),
)
COURSE = (
    ("width", "Width in time", "mean width of the bundle [mm]", MM, "how fast air and walls gather the fibres"),
    ("T_pair", "Twist of pairs in time", "twist by pairs [turns/m]", 1.0, "whether it settles"),
    ("wound", "Winding either way in time", "mean |winding| of a pair [turns]", 1.0, "half a turn is one crossing"),
    ("walls", "Contact force in time: groove and core", "normal force [mN]", 1e3, "when fibres land"),
    ("fibres", "Contact force in time: fibres on fibres", "normal force [mN]", 1e3, "when fibres meet"),
    ("speed", "Largest speed of a fibre in time", "speed [m/s]", 1.0, "the bundle has settled where it nears zero"),
)


def end_panels(films: Films) -> tuple[Panel, ...]:
    """T(X), width, tension and contact along X at the last frame.

    Args:
        films: Of all runs that have an end, by kind.

    Returns:
        Panels, of twist none for single fibres.
    """
    panels = [] if all(film.paths.shape[1] == 1 for group in films.values() for film in group) else [_twist(films)]
    for row, title, name, factor, see in ALONG:
        with panel() as drawing:
            axes = drawing.axes()
            for kind, group in films.items():
                band(
                    axes, kind, *_stacked([(film.X[-1], factor * film.along[-1, row]) for film in group]), stepped=True
                )
            axes.set_ylim(bottom=min(0.0, axes.get_ylim()[0]))
            finish(axes, "X, machine [mm]", name)
            panels.append(drawing.done(title, f"At the end of the runs. {BANDS} To see: {see}."))
    return tuple(panels)


def _twist(films: Films) -> Panel:
    with panel() as drawing:
        axes = drawing.axes()
        for kind, group in films.items():
            band(axes, kind, *_stacked([(film.X[-1], film.T[-1]) for film in group]), stepped=True)
        finish(axes, "X, machine [mm]", "twist T by pairs [turns/m]")
        return drawing.done(
            "Twist along X",
            f"At the end of the runs, Z twist upwards. {BANDS} To see: twist of one hand before another of the other "
            "hand is false twist, which cancels; only what is left over all of X would stay in a yarn.",
        )


def _stacked(curves: Sequence[tuple[Array, Array]]) -> tuple[Array, list[Array]]:
    """Mean ends of the stretches, which fibres that stretch move by little [mm], and the values of each run."""
    known = [X for X, _ in curves if np.isfinite(X).all()]
    ends = np.mean(known, axis=0) if known else np.arange(len(curves[0][0]), dtype=float)
    return MM * ends, [values for _, values in curves]


def course_panels(films: Films) -> tuple[Panel, ...]:
    """Width, winding and forces over time.

    Args:
        films: Of all runs that have an end, by kind.

    Returns:
        Panels.
    """
    panels = []
    for field, title, name, factor, see in COURSE:
        with panel() as drawing:
            axes = drawing.axes()
            for kind, group in films.items():
                t = group[0].course["t"]
                values = [factor * np.interp(t, film.course["t"], film.course[field]) for film in group]
                band(axes, kind, 1e3 * t, values)
            finish(axes, "time t [ms]", name)
            panels.append(drawing.done(title, f"{BANDS} To see: {see}."))
    return tuple(panels)


def ledger_panel(film: Film, kind: str) -> Panel:
    """Energies and works of a run over time."""
    with panel(3.8) as drawing:
        axes = drawing.axes()
        draw_ledger(axes, film.course["t"], film.energy)
        axes.set_title("")
        axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=3, borderaxespad=0.2)
        return drawing.done(
            f"{kind}: where the energy comes from and goes",
            "Energies that the fibres have (lines) and works done on them (dashed) since the start; their sums are "
            f"equal at every time, “numerical” is what the time stepping takes. At the end: {_largest(film.energy)}.",
        )


def _largest(energy: Mapping[str, Array]) -> str:
    """The four largest changes, in words."""
    changes = {name: float(values[-1] - values[0]) for name, values in energy.items()}
    shown = sorted(changes, key=lambda name: -abs(changes[name]))[:4]
    unit = scale(abs(changes[shown[0]]), "J")
    return ", ".join(f"{name} {signed(unit.factor * changes[name], 3)} {unit.unit}" for name in shown)
