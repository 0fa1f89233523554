"""By how much a law of measured twist does not hold; no scene is solved for any of them."""

from __future__ import annotations

import numpy as np

import dolfinrod as dr
from tests.mutations.measures import Solve
from tests.scenes import Array, largest
from verification.references.coils import RIBBON, rigid_bundle, round_about, torus

T, LENGTH, SPEED = 55.0, 0.04, 0.2
MIRROR = np.array([1.0, 1.0, -1.0])
LINE = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]])
ABOVE = np.array([[0.0, 0.1, -0.3], [1.0, 0.1, 0.3]])


def _strand(n: int, of: int) -> Array:
    """One of three that wind T times a metre, by so many nodes."""
    X = np.linspace(0.0, LENGTH, n)
    return rigid_bundle(2.0 * np.pi * T * X, X, 3)[of]


def crosses(_solve: Solve) -> float:
    """Signs of crossings over and under a line, and of their mirror images."""
    ways = ((1.0, 1), (-1.0, -1))
    off = []
    for height, sign in ways:
        for image, sense in ((np.ones(3), 1), (MIRROR, -1)):
            (found,) = dr.twist.crossings([LINE * image, ABOVE * [1.0, height, 1.0] * image])
            off.append(abs(found.sign - sign * sense))
    return float(max(off))


def winds(_solve: Solve) -> float:
    """Pairs of a bundle and of its mirror image, each strand by nodes of its own."""
    strands = [_strand(n, k) for k, n in enumerate((81, 60, 97))]
    found = [dr.twist.pairs([r * image for r in strands]).T for image in (np.ones(3), MIRROR)]
    return largest(np.array(found) - [T, -T]) / T


def turns_about_its_axis(_solve: Solve) -> float:
    """A bundle as a whole, its last stretch, and the mirror image."""
    strands = [_strand(81, k) for k in range(3)]
    try:
        found = [
            (dr.twist.axis_winding(fibres).T, float(dr.twist.delivered(fibres).axis[0]))
            for fibres in (strands, [r * MIRROR for r in strands])
        ]
    except dr.twist.TooCoarse:
        return np.inf
    return largest(np.array(found) - [[T, T], [-T, -T]]) / T


def winds_with_a_hook(_solve: Solve) -> float:
    """Two strands of which one runs back a little."""
    one, other = _strand(81, 1), _strand(81, 2)
    hooked = other.copy()
    hooked[40, 0] = hooked[39, 0] - 1e-5
    return abs(dr.twist.winding(one, hooked).turns - dr.twist.winding(one, other).turns)


def linked(_solve: Solve) -> float:
    """Lk, Tw + Wr of a ribbon on a torus, and −4 turns."""
    t = round_about(60)
    curve = torus(t, *RIBBON)
    core = RIBBON[0] * np.stack([np.cos(2.0 * np.pi * t), np.sin(2.0 * np.pi * t), 0.0 * t], axis=1)
    total = dr.twist.twist(curve, core - curve, closed=True) + dr.twist.writhe(curve, closed=True)
    return max(abs(dr.twist.link(curve, core) + 4.0), abs(total + 4.0))


def leaves(_solve: Solve) -> float:
    """A strand that moves on as it is delivers the twist that it has."""
    t, X = np.linspace(0.0, 0.01, 21), np.linspace(-0.01, 0.05, 61)
    states = [rigid_bundle(2.0 * np.pi * T * (X - SPEED * time), X, 3) for time in t]
    histories = [np.stack(rows) for rows in zip(*states, strict=True)]
    return abs(dr.twist.outflow(t, histories, X=LENGTH, speed=SPEED).mean - T) / T
