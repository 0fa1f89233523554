"""Steps so long that a rod leaps from one side of a contact to another and wins energy by it.

Backward Euler takes forces at the end of a step all along it, which wins U₁ − U₀ + F₁·Δx of contact. Where the energy
U of contact is convex that is a loss; but as a rod goes around another the normal turns, and U is not. On ways that are
short against a radius what is won falls with the square of the step, as what inertia loses does. On long ones it may be
as much as the rods had: so such a step is cut.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.meeting.curves import Course, dot

if TYPE_CHECKING:
    from dolfinrod.scene.meeting.pressed import Pressed

__all__ = ["PART", "kinetic", "work"]

Array = NDArray[np.float64]

# Part of the kinetic energy that a contact may win in a step: the accuracy asked of energy in motions of long steps.
PART = 1e-3
# Of the least radius at a point: rods that go past each other by less keep their normals, and are never cut.
LEAP = 0.5
# Simpson's rule on a span.
PLACES, WEIGHTS = (0.0, 0.5, 1.0), (1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0)


def work(pressed: Pressed, moved: Array) -> tuple[float, int]:
    """What the loads at the end of a step do along it, and how many points have leapt past what they touch.

    Args:
        pressed: Points in contact at the end.
        moved: Ways of the nodes, shape (n_nodes, 3) [m].

    Returns:
        Σ length p n·(Δx_A − Δx_B) [J]; how many |Δx_A − Δx_B| are longer than half a radius.
    """
    facing = pressed.facing
    way = np.einsum("nm,nmi->ni", facing.h, moved[facing.nodes])
    reach = LEAP * np.minimum(pressed.radius_a, pressed.radius_b)
    done = float((pressed.length * pressed.p) @ dot(facing.normal, way))
    return done, int((dot(way, way) > reach**2).sum())


def kinetic(start: Course, end: Course, density: Array, dt: float) -> float:
    """Kinetic energy of centrelines with the velocities of backward Euler, ½ ∫ ρA |Δx/Δt|² ds.

    Args:
        start: Where they were.
        end: Where they are.
        density: Mass per length of each rod [kg/m].
        dt: Time between [s].

    Returns:
        Of all rods [J].
    """
    spans = start.spans
    of = np.arange(len(spans.rod))
    line = 0.5 * density[spans.rod] * spans.length / dt**2
    ways = [end.place(of, ξ) - start.place(of, ξ) for ξ in (np.full(len(of), place) for place in PLACES)]
    return sum(weight * float(line @ dot(way, way)) for weight, way in zip(WEIGHTS, ways, strict=True))
