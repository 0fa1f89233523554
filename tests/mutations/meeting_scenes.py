"""Scenes of rods on rods for the laws: laid on one another, crossed and pressed, turned on one another."""

from __future__ import annotations

import dolfinrod as dr
from tests.mutations.contact_scenes import EPS, EPS_T, G_0, PENALTY, RADIUS, ROUND, Q, floor
from tests.scenes import FLAT

__all__ = ["THROUGH", "crossed", "stacked", "turned"]

# Turn of the rod on top, that friction holds far within its cone.
THROUGH, STICKY = 1e-4, dr.Coulomb(5.0, EPS_T)
# So stiff that friction turns and bends nothing.
STIFF = dr.Section(EA=4e6, GA=1.5e6, GJ=8e4, EI=1e5, radius=RADIUS)
# Heights of the axes of two rods on a floor, each of which feels half of Q in its contact.
HALF = G_0 - 0.5 * Q / EPS
LOW, HIGH = RADIUS + HALF, 3.0 * RADIUS + 2.0 * HALF


def _two(section: dr.Section, *supports: dr.Support, friction: dr.Coulomb | None = None, **parts: object) -> dr.Scene:
    """A rod on a floor and one on it, pressed down by the line load Q from the beginning."""
    rods = [FLAT.straight(section, start=(0, height, 0)) for height in (LOW, HIGH)]
    load = dr.LineForce(FLAT.turned((0, -Q, 0)), history=dr.Steady(), rod=1)
    contacts = [floor(FLAT), dr.RodContact(PENALTY, friction)]
    return dr.Scene(rods, supports, [load], contacts, **parts)


def stacked() -> dr.Scene:
    """Free to sink."""
    return _two(ROUND, dr.Guide("start", free={"y"}))


def turned() -> dr.Scene:
    """The upper one is turned about itself on the lower, and then held."""
    history = [(0.0, 0.0), (0.5, 1.0), (1.0, 1.0)]
    held = [dr.Clamp(at, rod=0) for at in ("start", "end")]
    turns = FLAT.turned((THROUGH, 0, 0))
    grips = [dr.Prescribed(at, (0, 0, 0), turns, history, rod=1) for at in ("start", "end")]
    return _two(STIFF, *held, *grips, friction=STICKY, motion=dr.Static(steps=4))


def crossed() -> dr.Scene:
    """Clamped at both ends, one across the other, pressed together, then by a fifth more."""
    apart = 2.0 * RADIUS + G_0
    lower = FLAT.straight(ROUND, start=(-0.5, 0.0, 0.013))
    upper = dr.Rod.straight(1.1, ROUND, start=FLAT.placed((0.013, apart, -0.6)), direction=FLAT.turned((0.2, 0, 1)))
    history = [(0.0, 0.0), (1.0, 1.0), (2.0, 1.2)]
    loads = [dr.LineForce(FLAT.turned((0, sign, 0)), rod=k, history=history) for k, sign in ((0, 1.0), (1, -1.0))]
    supports = [dr.Clamp("start"), dr.Clamp("end")]
    law = dr.Penalty(EPS, G_0)
    return dr.Scene([lower, upper], supports, loads, [dr.RodContact(law)], motion=dr.Static(t_end=2.0))
