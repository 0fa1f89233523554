"""A thin rod in a plane against a wall that pushes back in proportion, as a boundary-value problem of its own.

Inextensible and without shear: x′ = cos θ, y′ = sin θ, θ′ = m/EI, n′ = −f − p ∇g, m′ = n_x sin θ − n_y cos θ, with
p = ε_N max(−g, 0) and the gap g of the axis of the rod from where the wall begins to push. Where p begins and ends is
found with the rest, so that every piece is smooth and the solution exact to round-off. Nothing of the models is read.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from verification.references.contactpanels import Line, Piece, Pieces, corrected, line
from verification.references.contactwalls import Wall

__all__ = ["ANGLE", "N_X", "N_Y", "End", "M", "PressedRod", "Pushed", "X", "Y", "pushed"]

Array = NDArray[np.float64]

X, Y, ANGLE, N_X, N_Y, M = range(6)
DEGREE, PANELS = 10, 24
MAX_ITERATIONS = 40
# A first guess of where contact begins and ends will do on the way.
CONVERGED, ON_THE_WAY = 1e-11, 1e-6
SMALLEST_STEP = 1e-4
# Pieces shorter than this part of the rod are round-off of a gap that is zero.
SHORTEST = 1e-7


@dataclass(frozen=True)
class End:
    """What holds an end or acts there: of each pair one, the displacement or the resultant in the section.

    Args:
        x: Where it is held [m]; None: n_x is given.
        y: Likewise.
        angle: θ [rad]; None: m is given.
        n_x: [N].
        n_y: [N].
        m: [N m].
    """

    x: float | None = None
    y: float | None = None
    angle: float | None = None
    n_x: float = 0.0
    n_y: float = 0.0
    m: float = 0.0

    def off(self, u: Array) -> Array:
        """Zero where it is in order, shape (..., 3)."""
        held, given = (self.x, self.y, self.angle), (self.n_x, self.n_y, self.m)
        rows = [
            u[..., k + 3] - b if a is None else u[..., k] - a for k, (a, b) in enumerate(zip(held, given, strict=True))
        ]
        return np.stack(rows, axis=-1)


@dataclass(frozen=True)
class PressedRod:
    """A rod, its ends, its load and its wall.

    Args:
        length: [m].
        EI: [N m²].
        start: Its start.
        end: Its end.
        wall: Where it begins to push.
        eps_N: How hard [N/m²].
        f_x: Dead load [N/m].
        f_y: Likewise.
    """

    length: float
    EI: float
    start: End
    end: End
    wall: Wall
    eps_N: float
    f_x: float = 0.0
    f_y: float = 0.0

    def pressure(self, u: Array) -> Array:
        """p, zero where the wall is not reached, shape (...) [N/m]."""
        depth = -self.wall.gap(u[..., X], u[..., Y])[0]
        return np.asarray(self.eps_N * np.where(depth.real > 0.0, depth, 0.0))

    def slope(self, u: Array, pressure: Callable[[Array], Array]) -> Array:
        """u′ under a pressure."""
        _, along_x, along_y = self.wall.gap(u[..., X], u[..., Y])
        p, c, s = pressure(u), np.cos(u[..., ANGLE]), np.sin(u[..., ANGLE])
        n_x, n_y = -self.f_x - p * along_x, -self.f_y - p * along_y
        return np.stack([c, s, u[..., M] / self.EI, n_x, n_y, u[..., N_X] * s - u[..., N_Y] * c], axis=-1)

    def whole(self, panels: int) -> Pieces:
        """As one piece, the pressure cut off at zero."""
        piece = Piece(lambda u: self.slope(u, self.pressure), panels)
        return Pieces((piece,), self.start.off, self.end.off, self._edge, self.length)

    def cut(self, touching: list[bool], panels: int) -> Pieces:
        """In pieces that touch the wall or not."""

        def of(touches: bool) -> Piece:
            def pressure(u: Array) -> Array:
                return np.asarray(-self.eps_N * float(touches) * self.wall.gap(u[..., X], u[..., Y])[0])

            return Piece(lambda u: self.slope(u, pressure), panels)

        return Pieces(tuple(of(one) for one in touching), self.start.off, self.end.off, self._edge, self.length)

    def _edge(self, u: Array) -> Array:
        return np.stack([self.wall.gap(u[..., X], u[..., Y])[0]], axis=-1)


@dataclass(frozen=True, eq=False)
class Pushed:
    """An equilibrium.

    Args:
        rod: Whose.
        line: Its state, in pieces.
        touching: Which of them touch.
    """

    rod: PressedRod
    line: Line
    touching: tuple[bool, ...]

    @property
    def start(self) -> Array:
        """x, y, θ, n_x, n_y, m at the start."""
        return self.line.u[0]

    @property
    def end(self) -> Array:
        """Likewise at the end."""
        return self.line.u[-1]

    @property
    def force(self) -> float:
        """∫ p ds [N]."""
        return self.line.integral(self.rod.pressure)

    @property
    def drawn_in(self) -> float:
        """∫ (1 − cos θ) ds, by how much less than its length the rod reaches along x, to all digits [m]."""
        return self.line.integral(lambda u: 2.0 * np.sin(0.5 * u[..., ANGLE]) ** 2)

    @property
    def edges(self) -> Array:
        """Where contact begins or ends [m]."""
        return np.cumsum(self.line.lengths)[:-1]


def pushed(
    family: Callable[[float], PressedRod],
    crest: float = 0.0,
    *,
    degree: int = DEGREE,
    panels: int = PANELS,
    first: float = 0.25,
) -> Pushed:
    """The equilibrium that a straight rod along x comes to.

    Args:
        family: The rod on the way, from 0 where it is straight to 1.
        crest: Height of the straight rod where its start is held at none [m].
        degree: Of the polynomials.
        panels: Of each piece.
        first: Step on the way, halved where Newton's method fails.

    Returns:
        The equilibrium at 1.

    Raises:
        ArithmeticError: Newton's method fails however small the step.
    """
    rod = family(0.0)
    x_0, y_0 = rod.start.x or 0.0, rod.start.y if rod.start.y is not None else crest
    straight = [lambda s: x_0 + s, lambda s: y_0 + 0.0 * s, *(lambda s: 0.0 * s for _ in range(4))]
    found = line(rod.whole(2 * panels), lambda s: np.stack([f(s) for f in straight], axis=-1), [rod.length], degree)
    way, step = 0.0, first
    while way < 1.0:
        target = min(1.0, way + step)
        last = _solved(family(target).whole(2 * panels), found, ON_THE_WAY)
        if last is None:
            step *= 0.5
            if step < SMALLEST_STEP:
                raise ArithmeticError(f"no equilibrium found beyond {way:g}")
            continue
        way, found, step = target, last, min(2.0 * step, first)
    return _sharpened(family(1.0), found, panels)


def _solved(problem: Pieces, at: Line, enough: float = CONVERGED) -> Line | None:
    """Newton's method; None where it does not converge."""
    for _ in range(MAX_ITERATIONS):
        try:
            at, change = corrected(problem, at)
        except RuntimeError:
            return None
        if not change < 1e6:
            return None
        if change < enough * max(1.0, np.abs(at.u).max()):
            return at
    return None


def _sharpened(rod: PressedRod, whole: Line, panels: int) -> Pushed:
    """The same in pieces that end where contact begins and ends."""
    s = np.linspace(0.0, rod.length, 40_001)
    u = whole.at(s)
    touches = rod.wall.gap(u[:, X], u[:, Y])[0] < 0.0
    cuts = s[1:][touches[1:] != touches[:-1]]
    lengths = np.diff([0.0, *cuts, rod.length])
    touching = [bool(touches[0]) ^ bool(k % 2) for k in range(len(lengths))]
    problem = rod.cut(touching, panels)
    found = _solved(problem, line(problem, whole.at, lengths, whole.degree))
    if found is None or (found.lengths < SHORTEST * rod.length).any():
        raise ArithmeticError("the edges of contact are not found")
    return Pushed(rod, found, tuple(touching))
