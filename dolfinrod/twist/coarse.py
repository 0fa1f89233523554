"""Whether points are close enough together to tell which way two fibres turn about each other."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.twist.angle import swept

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["TooCoarse", "resolved"]

# Pieces of the smooth curve beside a straight way, each of which must turn by less than a right angle.
PIECES = 64
# Of the distances from one to the other, below which fibres meet: what is left of doubles after interpolation.
MEET = 1e-12
# Of the length looked at, below which knots of two fibres are one: slopes over less would be round-off.
ONE = 1e-9


class TooCoarse(ValueError):  # noqa: N818 (it is said of points)
    """Points too far apart to tell which way fibres turn from one to the next."""


def resolved(X: Array, d: Array, pair: tuple[int, int]) -> None:
    """Let pass a polyline that turns by a right angle or more from knot to knot, or complain.

    Fibres that cross do so within little length, and the straight way from knot to knot then says rightly how. It must
    be a straight way, though: where the relative motion changes its direction by a right angle there, too, or where a
    smooth curve through the knots goes round on the other side, the points are too few to tell.

    Args:
        X: Knots, ascending, shape (m,) [m].
        d: From one fibre to the other, shape (2, m) [m].
        pair: Of fibres.

    Raises:
        TooCoarse: Their points are too far apart.
        ValueError: The fibres meet.
    """
    new = np.r_[True, np.diff(X) > ONE * (X[-1] - X[0])]
    X, d = X[new], d[:, new]
    angle, way = swept(d[:, :-1], d[:, 1:]), np.diff(d)
    slope = way / np.diff(X)
    turns = np.r_[False, np.sum(slope[:, 1:] * slope[:, :-1], axis=0) <= 0.0, False]
    m = _slopes(X, slope)
    for i in np.flatnonzero(np.abs(angle) >= 0.5 * np.pi):
        size = float(np.linalg.norm(way[:, i]))
        if abs(d[0, i] * way[1, i] - d[1, i] * way[0, i]) <= MEET * size * float(np.abs(d).max()):
            raise ValueError(f"fibres {pair[0]} and {pair[1]} meet near X = {X[i]:.6g} m: no winding is defined there")
        if turns[i] or turns[i + 1] or not _same_side(d[:, i : i + 2], (X[i + 1] - X[i]) * m[:, i : i + 2]):
            raise TooCoarse(
                f"fibres {pair[0]} and {pair[1]} turn about each other by {np.degrees(angle[i]):.0f} degrees between "
                f"X = {X[i]:.6g} and {X[i + 1]:.6g} m, too far to tell which way: give points closer together, such as "
                "those of `dolfinrod.twist.smooth`"
            )


def _slopes(X: Array, slope: Array) -> Array:
    """Of the parabola through three knots at each, of the first and last line at the ends, shape (2, m)."""
    if slope.shape[1] == 1:
        return np.repeat(slope, 2, axis=1)
    h = np.diff(X)
    inner = (h[1:] * slope[:, :-1] + h[:-1] * slope[:, 1:]) / (h[1:] + h[:-1])
    first, last = 2.0 * slope[:, :1] - inner[:, :1], 2.0 * slope[:, -1:] - inner[:, -1:]
    return np.concatenate([first, inner, last], axis=1)


def _same_side(d: Array, m: Array) -> bool:
    """Whether the cubic with end values d and slopes m turns as the straight line does."""
    t = np.linspace(0.0, 1.0, PIECES + 1)
    line = (1.0 + 2.0 * t) * (1.0 - t) ** 2 * d[:, :1] + t**2 * (3.0 - 2.0 * t) * d[:, 1:]
    curve = line + t * (1.0 - t) ** 2 * m[:, :1] - t**2 * (1.0 - t) * m[:, 1:]
    angle = swept(curve[:, :-1], curve[:, 1:])
    straight = float(swept(d[:, 0], d[:, 1]))
    return bool(np.abs(angle).max() < 0.5 * np.pi and abs(float(angle.sum()) - straight) < np.pi)
