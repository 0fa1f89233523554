"""By how much a law of rods that touch rods does not hold; no scene is solved for any of them.

Both models ask the same law, each with curves of its own: so what is planted there shows here, in milliseconds.
"""

from __future__ import annotations

import numpy as np

import dolfinrod as dr
from dolfinrod.scene.meeting import Felt, Meeting, Strands
from tests.mutations.measures import Solve
from tests.scenes import Array, largest

# Unlike radii, so that it shows which is which.
RADII = np.array([0.05, 0.03])
EPS, EPS_T, HALO, DEPTH, MU = 1e3, 500.0, 0.01, 0.004, 0.3
LAW = dr.Penalty(EPS, HALO)
S = np.linspace(0.0, 1.0, 9)
N = len(S)
LINES = Strands.smooth([S, S], RADII)
# Distance of the axes of what is pressed by DEPTH.
APART = float(RADII.sum()) + HALO - DEPTH


def straight(angle: float, height: float) -> Array:
    """Nodes of a rod across the z axis, which it meets between two of them."""
    return (S[:, None] - 0.47) * np.array([np.cos(angle), np.sin(angle), 0.0]) + np.array([0.0, 0.0, height])


def pair(angle: float, apart: float = APART) -> Array:
    """A straight rod and one above it, shape (2 N, 3)."""
    return np.concatenate([straight(0.0, 0.0), straight(angle, apart)])


def above(x: float, y: float, z: float = 0.0) -> Array:
    """A displacement of the rod above."""
    return np.repeat([[0.0, 0.0, 0.0], [x, y, z]], N, axis=0)


def bent(x: Array, size: float = 1e-3, seed: int = 1) -> Array:
    """Somewhere near."""
    return x + size * np.random.default_rng(seed).standard_normal(x.shape)


def meet(x: Array, mu: float | None = None, level: float = 1.0, lines: Strands = LINES) -> Meeting:
    """Rods placed there."""
    friction = None if mu is None else dr.Coulomb(mu, eps_T=EPS_T)
    meeting = Meeting(dr.RodContact(LAW, friction), lines, level)
    meeting.place(x, 0.0)
    return meeting


def acting(meeting: Meeting, x: Array, turn: Array | None = None) -> Felt:
    """What the rods do to each other there."""
    return meeting.respond(x, np.zeros_like(x) if turn is None else turn)


def third_law(mu: float | None, _solve: Solve) -> float:
    """Sum of forces, and of their moments about the origin with couples, by the sum of their sizes."""
    off = []
    for angle in (0.0, 1.0):
        x = bent(pair(angle))
        felt = acting(meet(pair(angle), mu), x, None if mu is None else 0.1 * bent(0.0 * x, 1.0))
        size = np.abs(felt.force).sum()
        moment = np.cross(x, felt.force) + felt.moment
        off += [largest(felt.force.sum(axis=0)) / size, largest(moment.sum(axis=0)) / size]
    return max(off)


def exchanged(_solve: Solve) -> float:
    """Forces with the other rod named first, by their largest."""
    x = bent(pair(1.0))
    here, there = acting(meet(x), x).force, np.concatenate([x[N:], x[:N]])
    swapped = Strands.smooth([S, S], RADII[::-1])
    felt = acting(meet(there, lines=swapped), there).force
    return largest(np.concatenate([felt[N:], felt[:N]]) - here) / largest(here)


def side_by_side(_solve: Solve) -> float:
    """Force between parallel rods by ε δ L, and their gap."""
    x = pair(0.0)
    meeting = meet(x)
    lift = float(acting(meeting, x).force[N:, 2].sum()) / (EPS * DEPTH)
    met = meeting.met()
    gap = largest(met.gap - (HALO - DEPTH)) / DEPTH if len(met.gap) else np.inf
    return max(abs(lift - 1.0), gap)


def crossing(_solve: Solve) -> float:
    """Force between rods at right angles by ε ∫ (D₀ − D) d/D ds, D² = s² + d², wherever nodes are."""
    d, D_0 = APART, float(RADII.sum()) + HALO
    half = np.sqrt(D_0**2 - d**2)
    at, weight = np.polynomial.legendre.leggauss(40)
    D = np.sqrt((half * at) ** 2 + d**2)
    exact = EPS * half * float(weight @ ((D_0 - D) * d / D))
    x = pair(0.5 * np.pi)
    return abs(float(acting(meet(x), x).force[N:, 2].sum()) / exact - 1.0)


def loop(_solve: Solve) -> float:
    """Force of a straight rod on itself, which is none, and part of that of a hairpin on itself that is missing."""
    lines, still = Strands.smooth([4.0 * S], RADII[:1]), np.stack([4.0 * S, 0.0 * S, 0.0 * S], axis=1)
    alone = largest(acting(meet(still, lines=lines), still).force)
    apart, n = 2.0 * RADII[0] + HALO - DEPTH, 41
    s = np.linspace(0.0, 2.0, n)
    leg = np.minimum(s, 2.0 - s)
    hairpin = np.stack([leg, np.where(s < 1.0, 0.0, apart), 0.0 * s], axis=1)
    felt = acting(meet(hairpin, lines=Strands.smooth([s], RADII[:1])), hairpin).force
    pushed = float(felt[: n // 2 - 6, 1].sum()) / (-EPS * DEPTH * s[n // 2 - 6])
    return max(alone, max(0.0, 0.8 - pushed))


def slopes(angle: float, mu: float | None, level: float, _solve: Solve) -> float:
    """Slopes of forces and couples, as products and as blocks, from their differences, by their size."""
    depth = DEPTH if angle == 0.0 else 1e-5
    x_0 = pair(angle, float(RADII.sum()) + HALO - depth)
    meeting, x = meet(x_0, mu, level), bent(x_0, 0.1 * depth)
    turn = 1e-2 * depth * bent(0.0 * x, 1.0, 3)
    rubs = mu is not None
    if rubs:
        acting(meeting, x, turn)
        meeting.accept()
        meeting.begin(1.0)
        x = bent(x, 0.1 * depth, 2)
    acting(meeting, x, turn)
    K, dx = meeting.gradient(), bent(0.0 * x, 1.0, 4)
    dturn = bent(0.0 * x, 1.0, 5) if rubs else 0.0 * x

    def both(felt: Felt) -> Array:
        return np.concatenate([felt.force, felt.moment / RADII[0]])

    def slope(h: float) -> Array:
        more, less = (both(acting(meeting, x + k * h * dx, turn + k * h * dturn)) for k in (1, -1))
        return (more - less) / (2.0 * h)

    h = 1e-3 * depth
    exact = (4.0 * slope(h) - slope(2.0 * h)) / 3.0
    ways = [both(Felt(*K.times(dx, dturn)))]
    fixed, turning = _spread(K.nodes, K.f_x, dx), 0.0
    if rubs:
        turning = _spread(K.nodes, K.f_turn, dturn)
        moment = _spread(K.nodes, K.m_x, dx) + _spread(K.nodes, K.m_turn, dturn)
    else:
        moment = np.zeros_like(x)
    ways.append(both(Felt(fixed + turning, moment)))
    return max(largest(found - exact) for found in ways) / largest(exact)


def _spread(nodes: Array, blocks: Array | None, d: Array) -> Array:
    """What blocks say of changes at their nodes."""
    assert blocks is not None
    felt = np.zeros_like(d)
    np.add.at(felt, nodes, np.einsum("paibj,pbj->pai", blocks, d[nodes]))
    return felt


def holds(_solve: Solve) -> float:
    """Force of anchors on the rod above, drawn along the other in four steps, by ε_T u L; and beyond, by μ p L.

    What is drawn along loses as much of its length; it is drawn less far than the first point is from the end.
    """
    x, u = pair(0.0), 0.2 * MU * EPS * DEPTH / EPS_T
    meeting, off = meet(x, MU), []
    for k, limit in ((1, np.inf), (2, np.inf), (3, np.inf), (4, np.inf), (6, MU * EPS * DEPTH)):
        meeting.begin(float(k))
        held = float(acting(meeting, x + k * above(u, 0.0)).force[N:, 0].sum())
        off.append(abs(held / min(EPS_T * k * u, limit) + 1.0))
        meeting.accept()
    return max(off)


def rolls(_solve: Solve) -> float:
    """Friction of rods that turn against each other like gears, by what it is if one alone turns."""
    x, arms = pair(0.0), RADII + 0.5 * (HALO - DEPTH)
    gears = np.repeat([[1e-3 / arms[0], 0.0, 0.0], [-1e-3 / arms[1], 0.0, 0.0]], N, axis=0)
    meeting = meet(x, MU)
    both = largest(acting(meeting, x, gears).moment)
    return both / largest(acting(meeting, x, gears * np.repeat([[0.0], [1.0]], N, axis=0)).moment)


def turned_along(_solve: Solve) -> float:
    """Forces of anchors between rods that have turned together, against them turned, by their size."""
    x, θ = pair(0.0) + above(2e-4, -1e-4), 0.02
    meeting = meet(pair(0.0), 5.0)
    force = acting(meeting, x).force
    meeting.accept()
    meeting.begin(1.0)
    Q = np.array([[np.cos(θ), -np.sin(θ), 0.0], [np.sin(θ), np.cos(θ), 0.0], [0.0, 0.0, 1.0]])
    found = acting(meeting, x @ Q.T, np.tile([0.0, 0.0, θ], (2 * N, 1))).force
    t = force - [0.0, 0.0, 1.0] * force
    return largest(found - force @ Q.T) / largest(t)


def lands(_solve: Solve) -> float:
    """Friction on a rod that comes from afar, by that of the part of its way on which it touches."""
    far, along = 0.01, 1e-4
    meeting = meet(pair(0.0, APART + far), 5.0)
    held = float(acting(meeting, pair(0.0) + above(along, 0.0)).force[N:, 0].sum())
    return abs(held / (-EPS_T * along * DEPTH / far) - 1.0)


def work(_solve: Solve) -> float:
    """Work of the mean load on a way into contact, by what is stored then, ½ ε δ² L."""
    x = pair(0.0, APART + DEPTH + 1e-3)
    meeting, way = meet(x, level=0.5), above(0.0, 0.0, -DEPTH - 1e-3)
    felt = acting(meeting, x + way)
    stored, *_ = meeting.accept()
    return max(
        abs(-np.vdot(felt.force, way) / (0.5 * EPS * DEPTH**2) - 1.0), abs(stored / (0.5 * EPS * DEPTH**2) - 1.0)
    )


def goes_on(_solve: Solve) -> float:
    """Forces after a step from what was remembered, by those of a meeting that has come there itself."""
    x = pair(0.0)
    one, other = meet(x, MU), meet(x, MU)
    acting(one, x + above(0.0, 1e-4))
    one.accept()
    other.recall(one.memory(), x + above(0.0, 1e-4), 1.0)
    one.begin(2.0)
    here, there = (acting(meeting, x + above(0.0, 1.5e-4)).force for meeting in (one, other))
    return largest(here - there) / largest(here * [1.0, 1.0, 0.0])


def comes(_solve: Solve) -> float:
    """Force on a rod that comes from ten diameters away, by ε δ L."""
    x = pair(0.0)
    meeting = meet(x + above(0.0, 0.0, 1.0))
    return abs(float(acting(meeting, x).force[N:, 2].sum()) / (EPS * DEPTH) - 1.0)


def passes(_solve: Solve) -> float:
    """Wrong verdicts on shots through the other rod, and past its end."""
    found = 0
    for angle in (0.0, 0.7, 1.5):
        x = pair(angle)
        for aside, through in ((0.0, True), (3.0, False)):
            meeting = meet(x + above(aside, 0.0))
            acting(meeting, x + above(aside, 0.0, -3.0 * APART))
            found += bool(meeting.pierces()) != through
    return float(found)
