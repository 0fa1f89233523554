"""Five rods on top of each other on a plane: line loads add up from the top."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import Contact, Guide, LineForce, Plane, RodContact, Scene
from verification.contactcase import ContactCase
from verification.contacts.runs import DISCRETE, RADIUS, SPACE, on_meshes
from verification.meetings.bundle import EVEN, LAW, loads_found, rods_at
from verification.references.moving import exact

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from verification.case import Array

__all__ = ["CASES", "stack"]

# So short that the rods, whose ends are held sideways, do not roll off each other: n q/2r < EI (π/L)⁴.
RODS, LOAD, LENGTH = 5, 1.0, 0.5


def stack() -> Scene:
    """Rods one above the other, just touching; their ends rise and sink only."""
    centres = np.array([(0.0, RADIUS * (2 * k + 1)) for k in range(RODS)])
    return Scene(
        rods=rods_at(centres, LENGTH),
        supports=[Guide("start", free=("y", "ry", "rz")), Guide("end", free=("x", "y", "ry", "rz", "rx"))],
        loads=[LineForce((0.0, -LOAD, 0.0))],
        contacts=[Contact(Plane((0.0, 0.0, 0.0), (0.0, 1.0, 0.0)), LAW), RodContact(LAW)],
    )


def heights_found(result: Result) -> Array:
    """Line loads from below, and how high each rod lies in its middle."""
    loads = loads_found(result, tuple((k, k + 1) for k in range(RODS - 1)), LENGTH)
    heights = [rod.at(0.5 * LENGTH)[-1, 1] for rod in result.rods]
    return np.array([loads[0], *loads[RODS:], *heights])


def stack_case() -> ContactCase:
    """Gaps g_0 − n q/ε_N."""
    carried = LOAD * np.arange(RODS, 0, -1)
    gaps = LAW.g_0 - carried / LAW.eps_N
    heights = np.cumsum(gaps) + RADIUS * (2 * np.arange(RODS) + 1)
    return ContactCase(
        name="pile-stack",
        title="Five rods on top of each other on a plane",
        family="pile",
        reference=exact("p = n q, g = g_0 − n q/ε_N", "statics", *carried.tolist(), *heights.tolist()),
        scale=(*RODS * (LOAD,), *RODS * (RADIUS,)),
        runs=(
            on_meshes(SPACE, stack(), (1, 6), limit=EVEN, quick=True),
            on_meshes(DISCRETE, stack(), (5, 10, 20), limit=1e-3, quick=True),
        ),
        quantity="line loads from below, N/m, and heights half-way, m",
        read=heights_found,
    )


CASES = (stack_case(),)
