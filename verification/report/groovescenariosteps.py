"""A bundle in ever shorter steps: how far its paths are apart over time, and how its fibres rebound."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

from verification.groovescenariosteps import NUDGE
from verification.references.friction import restitution
from verification.report.canvas import Curve, log_log
from verification.report.groove import figure

if TYPE_CHECKING:
    from verification.groovescenariosteps import GrooveSteps

__all__ = ["stepped"]

# Less than a distance can be told from none [µm].
LEAST = 1e-9


def stepped(row: GrooveSteps) -> str:
    """The figure and what to see in it.

    Args:
        row: What was found.

    Returns:
        HTML.
    """
    whole, half, quarter = (f"{1e6 * dt:g}" for dt in row.steps)
    legends = f"{whole} against {half} µs", f"{half} against {quarter} µs", f"raised by {1e9 * NUDGE:g} nm"
    t = tuple(1e3 * at for at in row.t)
    curves = [
        Curve(kind, t, tuple(max(1e6 * d, LEAST) for d in apart), legend, label=letter)
        for kind, letter, legend, apart in zip(
            ("p3", "p4", "chord"), "abc", legends, (row.halved, row.quartered, row.nudged), strict=True
        )
    ]
    drawing = log_log(curves, x="time [ms]", y="largest distance of a node [µm]", alt="Paths of a bundle apart")
    key = "; ".join(f"{letter}: {legend}" for letter, legend in zip("abc", legends, strict=True))
    return f'<div class="panels wide">{figure(key, drawing)}</div><p>{escape(said(row))}</p>'


def said(row: GrooveSteps) -> str:
    """In words."""
    _, half, quarter = (f"{1e6 * dt:g}" for dt in row.steps)
    until = row.t[row.trusted] if row.trusted >= 0 else 0.0
    grown = row.nudged[-1] / NUDGE
    back = ", ".join(f"{b:.2f} in steps of {1e6 * dt:g} µs" for b, dt in zip(row.rebound, row.steps, strict=True))
    return (
        f"{row.title}, {row.model} model. Until {1e3 * until:.2f} ms paths in steps of {half} and {quarter} µs are "
        f"nearer than the noise of {1e6 * row.noise:g} µm that tells one bundle from the next, and near one another "
        f"with order {row.order:.2f}. At {1e3 * row.t[-1]:.2f} ms they are {1e6 * row.quartered[-1]:.2g} µm apart, and "
        f"what raised all fibres by {1e9 * NUDGE:g} nm has moved a node by {grown:.0f} times as much. Chance is not "
        f"all of it: a fibre that strikes a wall leaves with this part of its speed: {back}. {_takes(row)}"
    )


def _takes(row: GrooveSteps) -> str:
    """What of its speed a fibre should lose, and what it does."""
    if row.damping > 0.0:
        left = restitution(row.damping)
        return (
            f"Here contact takes what is not given back: the law by itself would leave {left:.2f} (Schwager & Pöschel "
            "2007), whatever the step, and the rest is what implicit Euler takes."
        )
    return (
        "A penalty gives all of it back, implicit Euler takes some of it, and the paper says nothing of how much walls "
        "and fibres should take: so the step decides how hard fibres rebound, and what depends on that settles in "
        "shorter steps only where fibres rebound as if nothing were lost."
    )
