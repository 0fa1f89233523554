"""How a load grows: over the pseudo-time of a static solve, over the seconds of a motion in time."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from operator import itemgetter
from typing import TYPE_CHECKING

from dolfinrod.scene.errors import SceneError, quoted
from dolfinrod.scene.quantity import entries, listed, number

if TYPE_CHECKING:
    from dolfinrod.scene.scene import Scene

__all__ = ["History", "Line", "Steady", "corners", "factor", "history", "kinks", "slope"]

# Step of the difference quotient of a function, in t_end: truncation and round-off of five points are both 1e-13.
STEP = 1e-3


@dataclass(frozen=True)
class Steady:
    """The full load from the start to the end, factor 1."""


@dataclass(frozen=True)
class Line:
    """A history that goes on as it was at some moment, value + slope · t.

    Args:
        value: Factor at t = 0.
        slope: Its rate.
    """

    value: float
    slope: float

    def __call__(self, t: float) -> float:
        """Factor at time `t`, which may be negative."""
        return self.value + self.slope * t


Table = tuple[tuple[float, float], ...]
History = Steady | Sequence[tuple[float, float]] | Callable[[float], float] | None


def history(value: object, field: str) -> Steady | Table | Callable[[float], float] | None:
    """A history as it is stored: None, `Steady()`, a function of time, or a table with ascending times.

    Args:
        value: None, `Steady()`, f(t), or rows (t, factor).
        field: Dotted name of the field.

    Returns:
        The same, a table as tuples of floats.

    Raises:
        SceneError: None of these, or the times of a table do not ascend.
    """
    if value is None or isinstance(value, Steady) or callable(value):
        return value
    if not isinstance(value, Iterable) or isinstance(value, str):
        raise SceneError(
            f"must be None, Steady(), rows (t, factor) or a function of t, got {quoted(value)}", field=field
        )
    rows = [entries(row, f"{field}[{i}]", "", 2) for i, row in enumerate(listed(value))]
    table = tuple((number(t, f"{field}[{i}][0]"), number(f, f"{field}[{i}][1]")) for i, (t, f) in enumerate(rows))
    if not table:
        raise SceneError("must have at least one row (t, factor), got none", field=field)
    for i, ((before, _), (after, _)) in enumerate(pairwise(table), start=1):
        if after <= before:
            raise SceneError(f"must be later than {before}, the row before, got {after}", field=f"{field}[{i}][0]")
    return table


def factor(history: History, t: float, t_end: float) -> float:
    """What a load is multiplied with at time `t`.

    None: t/t_end (proportional). Steady: 1. Table: linear between its rows, constant beyond them. Function: f(t).
    In a Dynamic motion a load without history is steady: `dolfinrod.scene.in_time` writes that out.

    Args:
        history: How the load grows.
        t: Pseudo-time, or time [s] where the scene moves.
        t_end: Where it ends.

    Returns:
        The factor.

    Raises:
        SceneError: A function gave no finite number.
    """
    if history is None:
        return t / t_end
    if isinstance(history, Steady):
        return 1.0
    if callable(history):
        return number(history(t), f"history({t})")
    after = bisect_right(history, t, key=itemgetter(0))
    if after in (0, len(history)):
        return float(history[min(after, len(history) - 1)][1])
    (t_0, f_0), (t_1, f_1) = history[after - 1 : after + 1]
    return f_0 + (t - t_0) / (t_1 - t_0) * (f_1 - f_0)


def kinks(history: History) -> tuple[float, ...]:
    """Times at which the slope of the history may jump: the rows of a table, none otherwise."""
    if history is None or isinstance(history, Steady) or callable(history):
        return ()
    return tuple(t for t, _ in history)


def corners(scene: Scene) -> tuple[float, ...]:
    """Times at which the rate of a load, of a prescribed motion or of a wall may jump, ascending.

    Args:
        scene: Any scene.

    Returns:
        Rows of all its tables, times outside the motion among them.
    """
    parts = (*scene.supports, *scene.loads, *scene.walls)
    return tuple(sorted({t for part in parts for t in kinks(getattr(part, "history", None))}))


def slope(history: History, t: float, t_end: float) -> float:
    """Rate of the factor from time `t` on; at the end of the path, with which it got there.

    Args:
        history: How the load grows.
        t: Pseudo-time.
        t_end: Where the pseudo-time ends.

    Returns:
        d factor/dt, one-sided.
    """
    ahead = 1.0 if t < t_end else -1.0
    if history is None or isinstance(history, Steady):
        return 1.0 / t_end if history is None else 0.0
    if not callable(history):
        after = (bisect_right if ahead > 0.0 else bisect_left)(history, t, key=itemgetter(0))
        if after in (0, len(history)):
            return 0.0
        (t_0, f_0), (t_1, f_1) = history[after - 1 : after + 1]
        return (f_1 - f_0) / (t_1 - t_0)
    step = ahead * STEP * t_end
    f = [factor(history, t + i * step, t_end) for i in range(5)]
    # Lagrange's formula for the derivative at the first of five points.
    return (4.0 * (f[1] - f[0]) - 3.0 * (f[2] - f[0]) + 4.0 / 3.0 * (f[3] - f[0]) - 0.25 * (f[4] - f[0])) / step
