"""Where the fibre lies in the groove at the end, by both models side by side: gap, line load, friction, what sticks."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from verification.groovebench import TIGHT, Setup, kind, solve

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from verification.contacts.groove import GrooveCase

    Array = NDArray[np.float64]

__all__ = ["AGREES", "MESHES", "GrooveProfile", "SideBySide", "side_by_side"]

# Meshes and steps on which the models stand side by side: the paper's 0.5 mm, and as many unknowns of the continuum.
MESHES = {
    None: (Setup("discrete", 80, 40), Setup("continuum", 27, 40)),
    "motion": (Setup("discrete", 80, 200), Setup("continuum", 27, 200)),
}
# Difference of resultants over the larger one, beyond which the models do not agree.
AGREES = 2e-2


@dataclass(frozen=True)
class GrooveProfile:
    """A model at the end.

    Args:
        solver: Model and scheme.
        mesh: Elements and steps.
        s: Arc length of the points, ascending [m].
        gap: Between surface and surface [m].
        pressure: Line load along the normal [N/m].
        traction: Friction, its size [N/m].
        state: 0 open, 1 sticking, 2 sliding.
        z: Across the groove [m].
        force: Resultant of contact [N].
        touching: Length in contact [m].
        sticking: Length that sticks [m].
        iterations: Newton iterations a step, failed attempts included.
        seconds: Of the solve [s].
    """

    solver: str
    mesh: str
    s: tuple[float, ...]
    gap: tuple[float, ...]
    pressure: tuple[float, ...]
    traction: tuple[float, ...]
    state: tuple[int, ...]
    z: tuple[float, ...]
    force: tuple[float, float, float]
    touching: float
    sticking: float
    iterations: float
    seconds: float


@dataclass(frozen=True)
class SideBySide:
    """Both models on one case.

    Args:
        case: Its name.
        title: For people.
        profiles: Of the discrete and of the continuum model.
        forces: Difference of the resultants over the larger.
        pressures: Root mean square difference of the line loads over their mean, on points between the nodes.
        gaps: Largest difference of gaps where both touch [m].
        zones: Part of the length on which one sticks and the other does not.
    """

    case: str
    title: str
    profiles: tuple[GrooveProfile, GrooveProfile]
    forces: float
    pressures: float
    gaps: float
    zones: float

    @property
    def holds(self) -> bool:
        """The resultants agree."""
        return self.forces <= AGREES


def side_by_side(case: GrooveCase) -> SideBySide:
    """Solve by both models and compare.

    Args:
        case: A way into the groove.

    Returns:
        Profiles and differences.

    Raises:
        NotConverged: A step could not be taken.
    """
    first, second = (_profile(case, how) for how in MESHES[kind(case)])
    F, G = np.asarray(first.force), np.asarray(second.force)
    # Halfway between the nodes of the coarser, where neither end counts double.
    s = 0.5 * (np.asarray(first.s[1:]) + np.asarray(first.s[:-1]))
    p, q = (np.interp(s, profile.s, profile.pressure) for profile in (first, second))
    g, h = (np.interp(s, profile.s, profile.gap) for profile in (first, second))
    near = (g < TIGHT.g_0) & (h < TIGHT.g_0)
    sticks = [_at(s, profile) == 1 for profile in (first, second)]
    return SideBySide(
        case=case.name,
        title=case.title,
        profiles=(first, second),
        forces=float(np.linalg.norm(F - G) / max(np.linalg.norm(F), np.linalg.norm(G))),
        pressures=float(np.sqrt(np.mean((p - q) ** 2)) / (0.5 * np.mean(p + q))),
        gaps=float(np.abs(g - h)[near].max(initial=0.0)),
        zones=float(np.mean(sticks[0] != sticks[1])),
    )


def _at(s: Array, profile: GrooveProfile) -> Array:
    """State of the node nearest to each arc length."""
    nodes = np.asarray(profile.s)
    return np.asarray(profile.state)[np.abs(s[:, None] - nodes).argmin(axis=1)]


def _profile(case: GrooveCase, how: Setup) -> GrooveProfile:
    result = solve(case, how)
    rod = result.contacts[0].rods[0]
    assert rod is not None
    state = rod.state[-1]
    return GrooveProfile(
        solver=how.words(case),
        mesh=how.mesh,
        s=tuple(rod.s.tolist()),
        gap=tuple(rod.gap[-1].tolist()),
        pressure=tuple(rod.pressure[-1].tolist()),
        traction=tuple(np.linalg.norm(rod.traction[-1], axis=1).tolist()),
        state=tuple(state.tolist()),
        z=tuple(result.rods[0].r[-1, :, 2].tolist()),
        force=tuple(result.contacts[0].force[-1].tolist()),
        touching=float(rod.length[-1]),
        sticking=float(rod.share[state == 1].sum()),
        iterations=result.statistics.newton_iterations / len(result.log),
        seconds=result.statistics.seconds_solve,
    )
