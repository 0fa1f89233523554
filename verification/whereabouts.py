"""Where a hard motion ends by other means than the one that is tried."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache
from typing import TYPE_CHECKING, Protocol

import numpy as np
from scipy.linalg import eigh

from dolfinrod.result import NotConverged
from dolfinrod.scene import Dynamic, Midpoint, Static, in_time
from verification.explicit import Explicit
from verification.explicitlimit import matrix
from verification.hardmotion import LOSS, books
from verification.patience import CRAWLS, Patience

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from dolfinrod.result import Result
    from dolfinrod.scene import Scene
    from verification.hardmotion import HardMotion

    Array = NDArray[np.float64]

__all__ = ["At", "AtRest", "Finer", "UnsoundError", "Vibrating", "Whereabouts"]

# Points of a rod that are compared.
N_STATIONS = 11


class UnsoundError(ArithmeticError):
    """A check that was refused itself, or whose own ledger says that it is none."""


class Whereabouts(Protocol):
    """Where a motion ends by other means."""

    @property
    def words(self) -> str:
        """For the table."""

    def error(self, result: Result, case: HardMotion) -> float:
        """Largest distance from there, of evenly spaced points of the first rod, over its length or the way gone."""


@dataclass(frozen=True)
class Finer:
    """The continuum model of degree 4 by the midpoint rule, its steps a part of those of the case.

    Args:
        elements: Of each rod.
        parts: Into which a step is cut.
    """

    elements: int = 12
    parts: int = 4

    @property
    def words(self) -> str:
        """How."""
        return f"{self.elements} × P4, midpoint, {self.parts} times the steps"

    def error(self, result: Result, case: HardMotion) -> float:
        """Over the way, where that is shorter than the rod."""
        exact, why = _finer(self, case.scene, case.dt)
        if exact is None:
            raise UnsoundError(why)
        way = float(np.linalg.norm(exact - _stations(result, 0), axis=1).max())
        return _off(result, exact, min(way, float(result.rods[0].s[-1])))


@cache
def _finer(how: Finer, scene: Callable[[], Scene], dt: float) -> tuple[Array | None, str]:
    """Solved once; why it is no check where it is none."""
    from dolfinrod.continuum import solve

    posed = scene()
    assert isinstance(posed.motion, Dynamic)
    motion = Dynamic(posed.motion.t_end, dt / how.parts, scheme=Midpoint(), output=dt)
    patience = Patience(motion)
    try:
        result = solve(replace(posed, motion=motion), elements=how.elements, degree=4, progress=patience)
    except NotConverged as failed:
        return None, CRAWLS if patience.over else failed.reason
    _, lost, gained = books(result.energy)
    if max(abs(lost), gained) > LOSS:
        return None, f"its steps made {max(-lost, gained):.2g} times the energy that went in"
    return _stations(result, -1), ""


@dataclass(frozen=True)
class Vibrating:
    """A straight rod along x, let go at rest under constant loads: its small vibrations, summed exactly in time.

    u = Σ φ (φ·f) (1 − cos ωt)/ω² over the modes of so many discrete elements, which no scheme has stepped.
    """

    elements: int = 80

    @property
    def words(self) -> str:
        """How."""
        return f"tip: linear vibrations of {self.elements} discrete elements, exact in time"

    def error(self, result: Result, case: HardMotion) -> float:
        """Of the tip alone, over its way: no mesh resolves the layer that a wave from the clamp has reached so soon."""
        way = _vibrated(self, case.scene)
        found = result.rods[0].r[-1, -1] - result.rods[0].r[0, -1]
        return float(np.linalg.norm(found - way) / np.linalg.norm(way))


@cache
def _vibrated(how: Vibrating, scene: Callable[[], Scene]) -> Array:
    posed = scene()
    rod = Explicit(in_time(posed), how.elements)
    free = ~rod.held
    scaled, m = matrix(rod)
    square, modes = eigh(scaled)
    loads, _, _ = rod.forces(rod.rest(), 0.0)
    phase = np.sqrt(square) * posed.motion.t_end
    # 1 − cos x = 2 sin²(x/2) keeps its digits where x is small.
    amplitude = 2.0 * np.sin(0.5 * phase) ** 2 / square * (modes.T @ (loads[:, :6][free] / np.sqrt(m)))
    u = np.zeros(free.shape)
    u[free] = modes @ amplitude / np.sqrt(m)
    return np.asarray(u[-1, :3] * rod.mesh.units.length)


@dataclass(frozen=True)
class AtRest:
    """The equilibrium under the last loads, where inertia is next to nothing; continuum model, 24 × P4."""

    words: str = "equilibrium, 24 × P4"

    def error(self, result: Result, case: HardMotion) -> float:
        """Over the length."""
        return _off(result, _at_rest(case.scene), float(result.rods[0].s[-1]))


@cache
def _at_rest(scene: Callable[[], Scene]) -> Array:
    from dolfinrod.continuum import solve

    posed = scene()
    return _stations(solve(replace(posed, motion=Static(t_end=posed.motion.t_end)), elements=24, degree=4), -1)


@dataclass(frozen=True)
class At:
    """A straight rod whose place is known exactly.

    Args:
        start: Of the rod [m].
        end: Of the rod [m].
        why: In words.
    """

    start: tuple[float, float, float]
    end: tuple[float, float, float]
    why: str

    @property
    def words(self) -> str:
        """Why."""
        return self.why

    def error(self, result: Result, case: HardMotion) -> float:
        """Over the length."""
        part = np.linspace(0.0, 1.0, N_STATIONS)[:, None]
        exact = (1.0 - part) * np.asarray(self.start) + part * np.asarray(self.end)
        return _off(result, exact, float(result.rods[0].s[-1]))


def _stations(result: Result, k: int) -> Array:
    """Evenly spaced points of the first rod in its k-th stored state, shape (n, 3) [m]."""
    length = result.rods[0].s[-1]
    return np.array([result.rods[0].at(float(s))[k] for s in np.linspace(0.0, length, N_STATIONS)])


def _off(result: Result, exact: Array, scale: float) -> float:
    """Largest distance at the end over a length."""
    return float(np.linalg.norm(_stations(result, -1) - exact, axis=1).max() / scale)
