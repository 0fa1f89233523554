"""Where the nodes of a stress-free rod lie, for the adapters of other people's solvers; standard library only."""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil, cos, pi, sin

__all__ = ["Place", "equal", "nodes", "round_drum"]

# Position [m] and angle of the tangent in the x-y plane [rad].
Place = tuple[float, float, float]


def equal(n: int) -> list[float]:
    """Ends of n equal elements, over the length."""
    return [i / n for i in range(n + 1)]


def nodes(length: float, angle: float, places: Sequence[float]) -> list[Place]:
    """Points of a rod along x that turns towards y, straight or an arc.

    x = s sin φ/φ, y = s (1 − cos φ)/φ at φ = angle·s/ℓ.

    Args:
        length: Of the rod [m].
        angle: By which its tangent turns over the length; 0: straight [rad].
        places: s over the length.

    Returns:
        x, y and φ at each place [m, m, rad].
    """
    return [point(length * s, angle * s) for s in places]


def point(way: float, turn: float) -> Place:
    """Behind a chord of sin(φ/2)/(φ/2) of the way, along half the turn."""
    half = 0.5 * turn
    chord = way * (sin(half) / half if half != 0.0 else 1.0)
    return chord * cos(half), chord * sin(half), turn


def round_drum(n: int, tail: float) -> list[tuple[float, float, float]]:
    """Nodes of a rope along x = −1, over a drum about z by n chords of half a unit circle, and back along x = 1.

    Args:
        n: Elements on the drum.
        tail: Length of the rope before and after it [m].

    Returns:
        Positions [m].
    """
    angle = pi / n
    straight = ceil(tail / angle)
    before = [(-1.0, tail * (k / straight - 1.0), 0.0) for k in range(straight)]
    arc = [(-cos(k * angle), sin(k * angle), 0.0) for k in range(n + 1)]
    return [*before, *arc, *((-x, y, z) for x, y, z in reversed(before))]
