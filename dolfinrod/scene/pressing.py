"""Which points are pressed while Newton's method runs, and how hard.

Under a stiff law the gap of an iterate says little: on a curved wall the error of a linear step is far larger than any
penetration, and times the stiffness it is a force that drives the next step away. So a point that was pressed stays so
as long as the pressure to which the last linear step has led is above zero, and the normals turn under that pressure.
Newton's method then is that of a mixed formulation with pressures as unknowns, whose elimination leaves these two
traces; where it ends, pressures and gaps agree.

Source: Hintermüller, Ito & Kunisch, SIAM J. Optim. 13, 2002 (primal-dual active sets); Hüeber & Wohlmuth, Comput.
Methods Appl. Mech. Eng. 194, 2005.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.damped import elastic
from dolfinrod.scene.pushing import GRAZING, followed, touching

if TYPE_CHECKING:
    from dolfinrod.scene.damped import Law

__all__ = ["Pressing"]

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

# A renewal of multipliers that leaves more than this of the penetration is followed by a firmer law, and how firm.
SLOW, FIRMER, FIRMEST = 0.1, 10.0, 1e6


class Pressing:
    """Pressures of points in an iteration.

    Args:
        law: How the surface pushes back.
        radius: Of the rod at each point, shape (n,) [m].

    Attributes:
        law: That of the step, softened or not.
    """

    def __init__(self, law: Law, radius: Array) -> None:
        self._radius, self._firm = radius, 1.0
        self.begin(law)

    def begin(self, law: Law) -> None:
        """An iteration begins, under the law of its step."""
        self._full, self._g_0 = law, np.full(len(self._radius), law.g_0)
        self.soften(1.0)
        self._worst = np.inf
        self._kept = np.zeros(len(self._radius), dtype=bool)

    def cling(self, pressed: Flags, gap: Array) -> Flags:
        """Keep these points pressed in the first answer, and those whose gap was none; all of them."""
        self._kept = pressed | self._just_touch(gap)
        return self._kept

    def _just_touch(self, gap: Array) -> Flags:
        return np.asarray(np.abs(gap - self._g_0) <= GRAZING * self._radius)

    def soften(self, by: float) -> None:
        """Begin with a law softer by a factor, so that what is pressed shows in a few iterations."""
        self.law = self._full if by == self._firm else self._full.softened(by / self._firm)
        self._led: tuple[Flags, Array, Array, Array] | None = None
        self._foreseen: tuple[Flags, Array] | None = None
        # Points that a linear step has been found to let go: they touch no more, however near they are.
        self._open = np.zeros(len(self._radius), dtype=bool)

    def at(self, X: Array, gap: Array, λ: Array, torn: Flags) -> tuple[Array, Array, Flags, Array]:
        """Pressures at the end of a step.

        Args:
            X: Points, shape (n, 3) [m].
            gap: Shape (n,) [m].
            λ: Multipliers, shape (n,) [N/m].
            torn: Points that are not let go in this answer, shape (n,).

        Returns:
            p, dp/dg, which points are pressed, and the pressure under which normals turn, each of shape (n,).
        """
        p, slope = self.law.drawn(gap, λ)
        if self._foreseen is not None:
            (pressed, expected), self._foreseen = self._foreseen, None
        elif self._led is None:
            pressed, expected = (p > 0.0) | self._kept, np.maximum(p, 0.0)
        else:
            pressed, expected = followed(p, torn, X, *self._led)
            self._open = self._open | (self._led[0] & ~pressed)
        return (*self._grazing(p, slope, pressed, np.where(self._open, np.inf, gap)), expected)

    def _grazing(self, p: Array, slope: Array, pressed: Flags, gap: Array) -> tuple[Array, Array, Flags]:
        """What just touches is about to be pressed: without its stiffness a rod that lies on a wall would be free."""
        p, slope, touch = touching(p, slope, pressed, gap, self._g_0, self.law.eps_N, self._radius)
        return p, slope, touch

    def mean(self, start: Array, gap: Array, λ: Array) -> tuple[Array, Array, Flags, Array]:
        """The same of mean pressures over steps from gaps `start` on, which are taken as they are."""
        p, slope = self.law.mean(start, gap, λ)
        return (*self._grazing(p, slope, p > 0.0, gap), p)

    def foresee(self, X: Array, gap: Array, normal: Array) -> bool:
        """Whether a linear step to X presses other points than it was taken with; `adopt` takes it anew with them.

        Args:
            X: Where the step leads, shape (n, 3) [m].
            gap: Where it was taken, shape (n,) [m].
            normal: There, shape (n, 3).
        """
        assert self._led is not None
        was, X_0, p_0, p_X = self._led
        way = X - X_0
        hoped = p_0 + np.einsum("ni,ni->n", p_X, way)
        ahead = gap + np.einsum("ni,ni->n", normal, way) < self._g_0
        self._ahead = np.where(was, hoped > 0.0, ahead), np.where(was, np.maximum(p_0, 0.0), 0.0)
        return not np.array_equal(self._ahead[0], was)

    def adopt(self) -> None:
        """Let the points that were foreseen be those of the next answer, at the same place."""
        self._foreseen, self._led = self._ahead, None

    def ahead(self, X: Array, gap: Array, λ: Array, normal: Array) -> tuple[Array, Array, Flags, Array]:
        """Where a linear step to X leads; other arguments are of where it is taken from.

        Args:
            X: Points where it leads, shape (n, 3) [m].
            gap: Shape (n,) [m].
            λ: Multipliers, shape (n,) [N/m].
            normal: Shape (n, 3).

        Returns:
            Pressures where it is taken and where it leads, below zero beyond the wall, what is pressed, and −dp/dg,
            each of shape (n,).
        """
        X_0, touch, p_0, _ = self._taken
        p, slope = self.law.drawn(gap, λ)
        p = np.where(touch, p_0, p)
        self._onward = X_0, p, slope[:, None] * normal
        return p, p + slope * np.einsum("ni,ni->n", normal, X - X_0), touch, -slope

    def settle(self, pressed: Flags) -> None:
        """Let these be the points that are pressed at the end of that step; none are asked about where none is open."""
        X_0, p, p_X = self._onward
        if len(pressed) == len(p):
            self._led, self._open = (pressed, X_0, p, p_X), ~pressed

    def enough(self, p: Array, gap: Array) -> bool:
        """Whether multipliers need no renewal; where the last one did little, the law is made firmer for good.

        Args:
            p: Pressures, shape (n,).
            gap: Shape (n,) [m].
        """
        tolerance = getattr(self._full, "tolerance", np.inf)
        worst = float(np.abs(gap[p > 0.0]).max(initial=0.0))
        if worst <= tolerance:
            return True
        if worst > SLOW * self._worst and self._firm < FIRMEST:
            self._firm *= FIRMER
            self.soften(1.0)
        self._worst = worst
        return False

    def damped(self, start: Array, gap: Array, p: Array, *, mean: bool) -> Array:
        """Work of damping in the step, shape (n,) [J/m]; arguments as of `elastic`."""
        return (p - elastic(self._full, start, gap, p, mean=mean)) * (start - gap)

    def led(self, X: Array, p: Array, p_X: Array, pressed: Flags) -> None:
        """From here the next linear step is taken; arguments as for `at`, p_X of shape (n, 3)."""
        self._taken = X, pressed, p, p_X
        self._led = pressed & (p != 0.0), X, p, p_X
