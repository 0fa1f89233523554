"""By how much scenes of rods on rods are solved wrong."""

from __future__ import annotations

from tests.mutations import meeting_scenes as on
from tests.mutations.contact_scenes import EPS_T, RADIUS, Q
from tests.mutations.measures import Solve


def weighs(solve: Solve) -> float:
    """Vertical force on the rod below from that on top of it, and on that from the floor, by the load on top."""
    result = solve(on.stacked(), elements=2)
    found = result.meetings[0].force(-1, 1, 0)[1], result.contacts[0].force[-1, 1]
    return max(abs(float(force) / Q - 1.0) for force in found)


def twists(solve: Solve) -> float:
    """Friction on a rod turned on another and then held, by ε_T a θ L, whose lever arm a reaches to half of the gap."""
    result = solve(on.turned(), elements=4)
    met = result.meetings[0].times[-1]
    arm = RADIUS + 0.5 * float(met.gap.mean())
    return abs(abs(float(result.meetings[0].force(-1, 1, 0)[2])) / (EPS_T * arm * on.THROUGH) - 1.0)


def iterations(solve: Solve) -> float:
    """Of a small step of rods that cross."""
    result = solve(on.crossed())
    return float(sum(row.iterations for row in result.log if row.t > 1.0))
