"""A bundle of fibres that a gentle load presses together."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import Coulomb, Dynamic, LineForce, Rod, RodContact, Scene, Section

if TYPE_CHECKING:
    from verification.case import Array

__all__ = ["LENGTH", "bundle", "places"]

RAMIE, RADIUS, LENGTH = Section.ramie(), 1e-5, 0.04
# The paper's steps; what leaves the fibres lying where they touch is a few nanometres of a halo of 1 µm.
STEP, LOAD, FRICTION = 1e-6, 1e-4, 0.3
# So far they turn about the axis per length, as in a yarn: they touch in the middle first, and more and more.
TURN = 25.0
# Part of the load along the fibres, to and fro: they slide on each other.
ALONG = 0.2


def places(n: int) -> Array:
    """Centres of n circles packed around the origin, as many as are nearest to it, shape (n, 2) [diameters]."""
    i, j = (k.ravel() for k in np.meshgrid(*2 * (np.arange(-n, n + 1),)))
    at = np.stack([i + 0.5 * j, np.sqrt(0.75) * j], axis=1)
    far, angle = np.hypot(*at.T).round(9), np.arctan2(*at.T[::-1]).round(9)
    chosen = at[np.lexsort((angle, far))[:n]]
    return np.asarray(chosen - chosen.mean(axis=0))


def bundle(n: int, steps: int) -> Scene:
    """Free fibres of the paper, slightly twisted about an axis, that a gentle load presses together.

    They lie so close in the middle that each is at the edge of the halos of its neighbours.

    Args:
        n: Fibres.
        steps: Of a microsecond.

    Returns:
        The scene.
    """
    contact = RodContact(friction=Coulomb(FRICTION))
    rods, loads = [], []
    for k, (y, z) in enumerate((2.0 * RADIUS + contact.law.g_0) * places(n)):
        middle = np.array([0.0, y, z])
        along = np.array([1.0, -TURN * z, TURN * y])
        along /= np.linalg.norm(along)
        rods.append(Rod.straight(LENGTH, RAMIE, start=tuple(middle - 0.5 * LENGTH * along), direction=tuple(along)))
        inward = -middle / max(float(np.hypot(y, z)), RADIUS)
        loads.append(LineForce(tuple(LOAD * (inward + np.array([ALONG * (-1) ** k, 0.0, 0.0]))), rod=k))
    motion = Dynamic(steps * STEP, dt=STEP, output=steps * STEP)
    return Scene(rods, loads=loads, contacts=[contact], motion=motion)
