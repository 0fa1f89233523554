"""Where rods touch rods: spots, gaps and forces at the stored times."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]
    Integers = NDArray[np.int64]

__all__ = ["MeetingHistory", "Meetings"]


@dataclass(frozen=True, eq=False)
class Meetings:
    """Where rods touch at one time: a row for each span of a rod and each rod that touches it there.

    Two rods come twice, seen from either, with half their force each time.

    Args:
        rod_a: The one rod, shape (n,).
        s_a: Arc length where it is touched, shape (n,) [m].
        rod_b: The other, or the same, shape (n,).
        s_b: Arc length where that is touched, shape (n,) [m].
        point: Half-way between the surfaces, shape (n, 3) [m].
        gap: Between the surfaces, shape (n,) [m].
        length: Of rod a in contact, shape (n,) [m].
        force: On rod a, friction included, shape (n, 3) [N]; rod b feels the opposite.
        normal: From rod b to rod a, shape (n, 3).
        traction: Friction alone on rod a, shape (n, 3) [N].
        state: 1 sticking, 2 sliding, which is all that rods without friction do, shape (n,).
    """

    rod_a: Integers
    s_a: Array
    rod_b: Integers
    s_b: Array
    point: Array
    gap: Array
    length: Array
    force: Array
    normal: Array
    traction: Array
    state: NDArray[np.int8]

    @property
    def spots(self) -> Integers:
        """Spot to which each row belongs, counted from 0, shape (n,).

        Rows of the same two rods are one spot where their lengths reach each other along the first of these rods: so is
        a stretch along which they touch all the way.
        """
        turned = (self.rod_a > self.rod_b) | ((self.rod_a == self.rod_b) & (self.s_a > self.s_b))
        rods = np.where(turned, (self.rod_b, self.rod_a), (self.rod_a, self.rod_b))
        s = np.where(turned, self.s_b, self.s_a)
        order = np.lexsort((s, rods[1], rods[0]))
        length = self.length[order]
        apart = np.diff(s[order]) > length[1:] + length[:-1]
        other = (np.diff(rods[:, order]) != 0).any(axis=0)
        spots = np.zeros(len(order), dtype=np.int64)
        spots[order[1:]] = np.cumsum(apart | other)
        return spots


@dataclass(frozen=True, eq=False)
class MeetingHistory:
    """One contact among rods at the stored times.

    Args:
        times: What touches at each of them.
    """

    times: tuple[Meetings, ...]

    def force(self, i: int, a: int, b: int) -> Array:
        """Resultant on rod a from rod b at stored time i, shape (3,) [N]."""
        met = self.times[i]
        on_a, on_b = (met.rod_a == a) & (met.rod_b == b), (met.rod_a == b) & (met.rod_b == a)
        return np.asarray(met.force[on_a].sum(axis=0) - met.force[on_b].sum(axis=0))

    def n_spots(self, i: int) -> int:
        """Number of spots at which rods touch at stored time i."""
        return int(self.times[i].spots.max(initial=-1)) + 1

    def total(self, i: int) -> float:
        """Sum of the magnitudes of all forces at stored time i [N]."""
        return float(np.linalg.norm(self.times[i].force, axis=1).sum())
