"""The crossing of `crossing` by collocation of both rods at once, in pieces that end where their lenses do."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from verification.references.contactpanels import Line, Piece, Pieces, corrected, line
from verification.references.crossing import ANGLE, EDGE, LENS, MIDDLE, N_H, N_X, OTHER, PARTS, H, M, Q, X

if TYPE_CHECKING:
    from verification.references.crossing import Crossing

__all__ = ["Crossed", "crossed"]

Array = NDArray[np.float64]

DEGREE, PANELS = 10, 3
MAX_ITERATIONS = 40
# Largest change of any number by its size; numbers smaller than that are zeros.
CONVERGED, SMALL = 1e-11, 1e-30
# Of the heights from where the rods only just touch, on the way.
STEPS = (0.1, 0.4, 1.0)


@dataclass(frozen=True, eq=False)
class Crossed:
    """An equilibrium.

    Args:
        crossing: Whose.
        heights: h of the middles [m].
        force: That the rods press with [N].
        lens: Half lengths of contact, along the rods [m].
        ends: x of the ends [m].
    """

    crossing: Crossing
    heights: tuple[float, float]
    force: float
    lens: tuple[float, float]
    ends: tuple[float, float]

    @property
    def distance(self) -> float:
        """Of the axes at the crossing [m]."""
        return sum(self.heights)

    @property
    def lifts(self) -> tuple[float, float]:
        """Of the middles over the ends [m]."""
        first, second = (h - s.height for h, s in zip(self.heights, self.crossing.strands, strict=True))
        return first, second


def crossed(crossing: Crossing, *, degree: int = DEGREE, panels: int = PANELS) -> Crossed:
    """The equilibrium that rods come to whose ends sink from where they only just touch.

    Args:
        crossing: With ends low enough that the rods touch.
        degree: Of the polynomials.
        panels: Of each lens; twice as many beyond it.

    Returns:
        The equilibrium.

    Raises:
        ArithmeticError: None was found.
    """
    found: Line | None = None
    for way in STEPS:
        problem = _posed(crossing.moved(way), panels)
        guess = found.at if found is not None else partial(_sketched, crossing.moved(way))
        found = _solved(problem, line(problem, guess, (1.0, 1.0), degree))
    assert found is not None
    first, second = (found.u[[0, -1], k * PARTS : (k + 1) * PARTS] for k in (0, 1))
    # Either rod feels both halves: that of its own lens, from both sides of its middle, and as much at its middle.
    return Crossed(
        crossing,
        (float(first[0, H]), float(second[0, H])),
        2.0 * float(first[1, Q] + second[1, Q]),
        (float(first[0, LENS]), float(second[0, LENS])),
        (float(first[1, X]), float(second[1, X])),
    )


def _sketched(problem: Crossing, places: Array) -> Array:
    """Linear theory of straight rods in the lens, at places from 0 through 1, where the lens ends, to 2."""
    force = problem.linear
    δ, a = problem.lens(force)
    parts = []
    for strand in problem.strands:
        s = np.where(places < 1.0, a * places, a + (0.5 * strand.length - a) * (places - 1.0))
        part = np.minimum(places, 1.0)
        other = problem.reach - δ - strand.sketch(force, 0.0 * s[:1])[0, H]
        rest = [part**2 - 1.0, a, other, 0.5 * force]
        shares = [-0.25 * force * (1.0 + part), 0.25 * force * part]
        own = strand.sketch(force, s)
        own[:, N_H], own[:, Q] = shares
        parts += [own, *(np.full((len(s), 1), 0.0) + np.reshape(r, (-1, 1)) for r in rest)]
    return np.concatenate([*parts, places[:, None]], axis=-1)


def _posed(problem: Crossing, panels: int) -> Pieces:
    """Halves of both rods: their lenses, each stretched to a length of one, and what is left of them likewise."""

    def slopes(u: Array, *, lens: bool) -> Array:
        found = []
        for strand, own in zip(problem.strands, _split(u), strict=True):
            load = problem.load(own) if lens else (0.0 * own[..., X], 0.0 * own[..., X])
            by_s = strand.slope(own, *load)
            up = own[..., H] + own[..., OTHER]
            # How (D/D₀)² grows within the lens; beyond it, what it has come to is kept.
            closing = 2.0 * (own[..., X] * by_s[..., X] + up * by_s[..., H]) / problem.reach**2 * float(lens)
            stretch = own[..., LENS] if lens else 0.5 * strand.length - own[..., LENS]
            still = np.zeros_like(own[..., :3])
            found += [stretch[..., None] * np.concatenate([by_s, closing[..., None]], axis=-1), still]
        return np.concatenate([*found, np.ones_like(u[..., -1:])], axis=-1)

    def start(u: Array) -> Array:
        rows = [u[..., -1]]
        for own, other in _pairs(u):
            up = own[..., H] + own[..., OTHER]
            rows += [own[..., X], own[..., ANGLE], own[..., N_H] + 0.5 * own[..., MIDDLE], own[..., Q]]
            rows += [own[..., OTHER] - other[..., H], own[..., EDGE] - (up / problem.reach) ** 2 + 1.0]
        return np.stack(rows, axis=-1)

    def end(u: Array) -> Array:
        rows = []
        for strand, (own, other) in zip(problem.strands, _pairs(u), strict=True):
            rows += [own[..., N_X] - strand.pull, own[..., H] - strand.height, own[..., M]]
            rows += [own[..., EDGE], own[..., MIDDLE] - 2.0 * other[..., Q]]
        return np.stack(rows, axis=-1)

    def edge(u: Array) -> Array:
        return u[..., -1:] - 1.0

    pieces = Piece(partial(slopes, lens=True), panels), Piece(partial(slopes, lens=False), 2 * panels)
    return Pieces(pieces, start, end, edge, 2.0)


def _split(u: Array) -> tuple[Array, Array]:
    return u[..., :PARTS], u[..., PARTS : 2 * PARTS]


def _pairs(u: Array) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
    first, second = _split(u)
    return (first, second), (second, first)


def _solved(problem: Pieces, at: Line) -> Line:
    """Newton's method, to round-off."""
    for _ in range(MAX_ITERATIONS):
        size, last = np.maximum(np.abs(at.u).max(axis=0), SMALL), at
        try:
            at, _ = corrected(problem, at)
        except RuntimeError as failed:
            raise ArithmeticError("the rods have no equilibrium") from failed
        if not np.isfinite(at.u).all():
            break
        if (np.abs(at.u - last.u) / size).max() < CONVERGED:
            return at
    raise ArithmeticError("the rods have no equilibrium")
