"""Which points a wall presses at the end of a linear step, found before it is taken: a linear complementarity problem.

On rods a wrong set costs dear: where nodes must not leave, a beam pulls on every other one, and an iteration that
exchanges them by the signs of a step moves the edge of contact by a node or two. So the way of the step is gone along,
point after point being pressed or let go where its turn comes, as loads grow: Lemke's method from the present state.
What one force moves is a solution with the factors at hand; Newton's method goes on with the step that has been found,
and is that of the smooth problem with the right set.

Source: Cottle, Pang & Stone, The Linear Complementarity Problem, 1992, DOI 10.1137/1.9780898719000, ch. 4.4-4.5.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.pushing import BLURRED

__all__ = ["Outlook", "joined", "pivoted"]

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Moved = Callable[[int], Array]

# Exchanges, in numbers of points, and exchanges from which the way leads back, after which the step is taken as it is.
MOST, MOST_BACK = 10, 10
# Gaps that keep points apart at the start, over the largest one, spread evenly by multiples of the golden ratio.
SPREAD, GOLDEN = 1e-6, 0.5 * (1.0 + 5.0**0.5)


@dataclass(frozen=True, eq=False)
class Outlook:
    """Where a linear step leads points that one wall may press.

    Args:
        start: Pressure where it is taken, by the branch of the law with pressure: below zero beyond the wall, shape
            (n,) [N/m].
        pressure: The same where it leads.
        pressed: Points with whose resistance it was taken, shape (n,).
        slope: −dp/dg, shape (n,) [N/m²].
        normal: In space, shape (n, 3).
        share: Length of rod for which each stands, shape (n,) [m].
    """

    start: Array
    pressure: Array
    pressed: Flags
    slope: Array
    normal: Array
    share: Array

    def first(self, n: int) -> Outlook:
        """Of the first points only."""
        return Outlook(*(getattr(self, f.name)[:n] for f in fields(self)))


def joined(outlooks: list[Outlook]) -> Outlook:
    """Those of several walls, one after the other."""
    return Outlook(*(np.concatenate([getattr(one, f.name) for one in outlooks]) for f in fields(Outlook)))


def pivoted(ahead: Outlook, moved: Moved) -> tuple[Flags, Array] | None:
    """The points that are pressed where the pressures they lead to are above zero, and only these.

    With q the forces by which those of the step taken change, w the ways along normals by unit forces, p the pressures
    of the step, l the shares and s = 1 where a point was open, −1 where it was pressed, y = s q/(ε l) − s (p/ε − w q)
    and z = q/(ε l) are not negative, and one of both is zero: y is the gap of what is open and the penetration of what
    is pressed, z that of what has come to be pressed and the gap of what has been let go.

    Args:
        ahead: Where the step leads.
        moved: Ways of all points along their normals by a unit force at one, shape (n,) [m/N].

    Returns:
        Which are pressed, and the forces q, shape (n,) [N]; None where the way of the step does not lead to any.
    """
    sign, stiffness = np.where(ahead.pressed, -1.0, 1.0), ahead.slope * ahead.share
    goal, start = (-sign * p / ahead.slope for p in (ahead.pressure, ahead.start))
    found = np.zeros(len(goal))
    if (goal < -BLURRED * max(np.abs(goal).max(initial=0.0), np.abs(start).max(initial=0.0))).any():
        # Points that just touch or leave at the start would have no order among them, and be exchanged without end.
        apart = SPREAD * np.abs(goal).max() * (1.0 + np.arange(len(goal)) * GOLDEN % 1.0)
        way = _Way(goal, np.maximum(start, 0.0) + apart - goal, lambda i: sign * stiffness[i] * moved(i))
        if not way.went():
            return None
        found[way.chosen] = way.values[:-1]
    return ahead.pressed ^ (found > 0.0), stiffness * found


class _Way:
    """Solutions z, y ≥ 0, z y = 0 of y = z + M z + goal + τ rest, from τ = 1 to τ = 0.

    Args:
        goal: Shape (n,).
        rest: Shape (n,).
        column: Of M.

    Attributes:
        chosen: Numbers of what is not zero of z.
        values: These, and τ.
    """

    def __init__(self, goal: Array, rest: Array, column: Callable[[int], Array]) -> None:
        n = len(goal)
        self._goal, self._rest, self._column = goal, rest, column
        # Columns of 1 + M where known, and of what τ multiplies.
        self._columns, self._known = np.zeros((n, n + 1), order="F"), np.zeros(n, dtype=bool)
        self._columns[:, n] = rest
        self.chosen: list[int] = []
        self.values = np.ones(1)

    def went(self) -> bool:
        """Go; whether the end was reached. A way that leads back is that of rods which give way."""
        n, back = len(self._goal), 0
        turns = np.where(self._goal < 0.0, -self._goal / np.where(self._goal < 0.0, self._rest, 1.0), -np.inf)
        point, joins = int(np.argmax(turns)), True
        for _ in range(MOST * n):
            before = self.values[-1]
            left = self._exchange(point, joins=joins)
            back += bool(self.values[-1] > before)
            if left is None or back > MOST_BACK:
                return False
            point, joins = left
            if point == n:
                return True
        return False

    def _exchange(self, point: int, *, joins: bool) -> tuple[int, bool] | None:
        """Let z of a point grow, or y, from where both are zero, until something else is: that, n for τ.

        Returns:
            Its number, and whether it was y: z then grows next. None where nothing is.
        """
        n, rows = len(self._goal), [*self.chosen, point]
        basis, grows = self._columns[:, [*self.chosen, n]], np.zeros(n)
        grows[point] = 1.0
        if joins:
            grows = -self._grown(point)
        try:
            ways = np.linalg.solve(basis[rows], np.stack([-self._goal[rows], grows[rows]], axis=1))
        except np.linalg.LinAlgError:
            return None
        gaps, closing = (basis @ ways + np.stack([self._goal, -grows], axis=1)).T
        now, slope = ways.T
        steps = _until_zero(gaps, closing)
        steps[rows] = np.inf
        (own, first), at = (_first(_until_zero(now, slope)), _first(steps))
        taken = min(first, at[1])
        if not np.isfinite(taken):
            return None
        self.values = now + taken * slope
        if joins:
            self.chosen, self.values = rows, np.insert(self.values, len(rows) - 1, taken)
        if first > at[1]:
            return at[0], True
        if own == len(now) - 1:
            return n, False
        return self.chosen.pop(own), False

    def _grown(self, point: int) -> Array:
        """Column of 1 + M."""
        if not self._known[point]:
            self._columns[:, point], self._known[point] = self._column(point), True
            self._columns[point, point] += 1.0
        return self._columns[:, point]


def _first(steps: Array) -> tuple[int, float]:
    """Which is the shortest, the last of equals, and how long it is."""
    first = len(steps) - 1 - int(np.argmin(steps[::-1]))
    return first, float(steps[first])


def _until_zero(values: Array, slopes: Array) -> Array:
    """How far they go until they are; infinite where they do not fall."""
    falls = slopes < -BLURRED * np.abs(slopes).max(initial=0.0)
    return np.where(falls, np.maximum(values, 0.0) / np.where(falls, -slopes, 1.0), np.inf)
