"""How deep a point of a span lies within reach of others, where that is most and least, and where reach ends."""

from __future__ import annotations

from math import copysign, nan, sqrt
from typing import NamedTuple

from dolfinrod.scene.compiled import compiled
from dolfinrod.scene.meeting.curves import Curves, along, spot
from dolfinrod.scene.meeting.projection import begin, closest

__all__ = ["Seen", "deepest", "edge", "farthest", "sampled"]

# Corrections of a place on the true curves, and when one is small against the span.
CORRECTIONS, SETTLED = 12, 1e-6


class Seen(NamedTuple):
    """A point of a span, what lies opposite it, distance² − ρ² and two derivatives by u, and whether it is in reach."""

    u: float
    b: int
    v: float
    f: float
    slope: float
    bend: float
    inside: bool


@compiled
def _look(curves: Curves, a: int, u: float, b: int, v: float, ρ_2: float) -> Seen:
    """What lies opposite span a at u, looked for from span b at v on."""
    b, v, held = closest(curves, spot(curves.c, a, u), b, v)
    dd = dx = dt = xx = xt = tt = 0.0
    for i in range(3):
        x, x_u, x_uu = along(curves.c, a, i, u)
        x_B, t, t_v = along(curves.c, b, i, v)
        d = x - x_B
        dd += d * d
        dx += d * x_u
        dt += d * t_v
        xx += x_u * x_u + d * x_uu
        xt += x_u * t
        tt += t * t
    κ = tt - dt
    follows = 0.0 if held or not κ > 0.0 else xt * xt / κ
    return Seen(u, b, v, dd - ρ_2, 2.0 * dx, 2.0 * (xx - follows), dd < ρ_2)


@compiled
def sampled(curves: Curves, a: int, u: float, first: int, last: int, ρ_2: float) -> Seen:
    """A place of a span."""
    b, v = begin(curves, spot(curves.c, a, u), first, last)
    seen = _look(curves, a, u, b, v, ρ_2)
    # Far ends of a span may face another part of the rod, or themselves.
    within = seen.inside and first <= seen.b and seen.b <= last
    return Seen(u, seen.b, seen.v, seen.f, seen.slope, seen.bend, within)


@compiled
def deepest(curves: Curves, a: int, left: Seen, right: Seen, ρ_2: float, near: Seen) -> Seen:
    """Where between two samples beyond reach the distance is least, or a point within reach on the way there.

    Args:
        curves: The rods.
        a: The span.
        left: The one sample.
        right: The other.
        ρ_2: Square of the reach [m²].
        near: Where chords are closest, to look there if the slopes of the samples do not tell.

    Returns:
        The point.
    """
    low, high = left.u, right.u
    u, b, v = near.u, near.b, near.v
    # It may fall and rise between them, or only beside one of them, and then fall or rise on to the other.
    sought = False
    for place, beside in ((_turns(left, right)[0], left), (_least(left), left), (_least(right), right)):
        if not sought and low < place < high:
            u, b, v, sought = place, beside.b, beside.v, True
    seen = Seen(u, b, v, 0.0, 0.0, 0.0, False)
    if not sought and not low < u < high:
        return seen
    for _ in range(CORRECTIONS):
        seen = _look(curves, a, u, seen.b, seen.v, ρ_2)
        low, high = (u, high) if seen.slope < 0.0 else (low, u)
        to = _least(seen)
        to = to if low < to < high else 0.5 * (low + high)
        if seen.inside or not sought or not abs(to - u) > SETTLED:
            break
        u = to
    return seen


@compiled
def farthest(curves: Curves, a: int, left: Seen, right: Seen, ρ_2: float) -> Seen:
    """A point beyond reach between two samples, one of them or both within.

    Args:
        curves: The rods.
        a: The span.
        left: The one sample.
        right: The other.
        ρ_2: Square of the reach [m²].

    Returns:
        The point; the right sample where the distance is nowhere greatest, or least so within reach.
    """
    low, high = left.u, right.u
    _, u = _turns(left, right)
    if not (left.inside or right.inside) or not low < u < high:
        return right
    seen = left
    for _ in range(CORRECTIONS):
        seen = _look(curves, a, u, seen.b, seen.v, ρ_2)
        low, high = (u, high) if seen.slope > 0.0 else (low, u)
        to = u - seen.slope / seen.bend if seen.bend < 0.0 else nan
        to = to if low < to < high else 0.5 * (low + high)
        if not seen.inside or not abs(to - u) > SETTLED:
            break
        u = to
    return right if seen.inside else seen


@compiled
def _turns(left: Seen, right: Seen) -> tuple[float, float]:
    """Where the cubic with the values and slopes of two points is least and where it is greatest; nowhere else."""
    h = right.u - left.u
    rise, start, end = right.f - left.f, h * left.slope, h * right.slope
    bend, twist = 3.0 * rise - 2.0 * start - end, start + end - 2.0 * rise
    root = bend * bend - 3.0 * twist * start
    if not root > 0.0:
        return nan, nan
    # Of both roots of its slope that which loses no digits, and from their product the other.
    q = bend + copysign(sqrt(root), bend)
    near, far = left.u - h * start / q, left.u - h * q / (3.0 * twist) if twist != 0.0 else nan
    return (near, far) if bend > 0.0 else (far, near)


@compiled
def _least(seen: Seen) -> float:
    """Where a distance that bends upwards is least, as far as a point tells; nowhere else."""
    return seen.u - seen.slope / seen.bend if seen.bend > 0.0 else nan


@compiled
def edge(curves: Curves, a: int, seen: Seen, beyond: float, ρ_2: float) -> float:
    """Where, between a point of a span within reach and a place beyond, reach ends."""
    inner, outer, deepest = seen.u, beyond, seen.u
    root = sqrt(max(seen.slope**2 - 2.0 * seen.bend * seen.f, 0.0))
    to = outer
    if seen.bend > 0.0:
        to = inner + (-seen.slope + copysign(root, outer - inner)) / seen.bend
    u = min(max(to, min(inner, outer)), max(inner, outer))
    for _ in range(CORRECTIONS):
        seen = _look(curves, a, u, seen.b, seen.v, ρ_2)
        inner, outer = (u, outer) if seen.inside else (inner, u)
        steep = seen.slope * (1.0 if beyond > deepest else -1.0) > 0.0
        to = u - seen.f / seen.slope if steep else nan
        to = to if (to - inner) * (to - outer) <= 0.0 else 0.5 * (inner + outer)
        settled = abs(to - u) <= SETTLED * abs(to - deepest)
        u = to
        if settled:
            break
    return u
