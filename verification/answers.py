"""Answers that a contact is held against: closed forms, the other model, another way through the loads."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cache
from typing import TYPE_CHECKING, Protocol

import numpy as np

from dolfinrod.scene import Static

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.result import Result
    from dolfinrod.scene import Scene
    from verification.hardcontact import HardContact
    from verification.patience import Patience

    Array = NDArray[np.float64]

__all__ = ["N_STATIONS", "Answer", "Beside", "Exact", "InSteps", "other", "solved", "stations"]

# Points of a rod that are compared.
N_STATIONS = 11
# The model beside is solved on so many times the elements.
FINER = 2


class Answer(Protocol):
    """What a contact should come to, by other means than the solve that is tried."""

    @property
    def words(self) -> str:
        """For the table."""

    def error(self, result: Result, case: HardContact, model: str) -> float:
        """Relative distance from it."""


@dataclass(frozen=True)
class Exact:
    """A closed form.

    Args:
        words: The formula.
        off: Relative distance of a result from it.
    """

    words: str
    off: Callable[[Result], float] = field(repr=False)

    def error(self, result: Result, case: HardContact, model: str) -> float:
        """That of the formula."""
        return self.off(result)


@dataclass(frozen=True)
class Beside:
    """The other model on a mesh twice as fine, where it may go another way through the loads.

    Args:
        scene: By which the same end is reached; None: that of the case.
        words: For the table.
        steps: Equal load steps; None: as the scene has it.
    """

    scene: Callable[[], Scene] | None = field(default=None, repr=False)
    words: str = "the other model, twice the elements"
    steps: int | None = None

    def error(self, result: Result, case: HardContact, model: str) -> float:
        """Largest distance of evenly spaced points of the first rod, over its length."""
        exact = _beside(self.scene or case.scene, self.steps, model, case.elements, case.discrete)
        return float(np.linalg.norm(stations(result) - exact, axis=1).max() / result.rods[0].s[-1])


@dataclass(frozen=True)
class InSteps:
    """The same model in many equal load steps: without friction the way through the loads leaves no trace.

    Args:
        steps: How many.
    """

    steps: int

    @property
    def words(self) -> str:
        """How."""
        return f"the same in {self.steps} steps"

    def error(self, result: Result, case: HardContact, model: str) -> float:
        """Largest distance of evenly spaced points of the first rod, over its length."""
        scene = case.scene()
        stepped = replace(scene, motion=Static(steps=self.steps, t_end=scene.motion.t_end))
        exact = stations(solved(stepped, model, case.elements, case.discrete))
        return float(np.linalg.norm(stations(result) - exact, axis=1).max() / result.rods[0].s[-1])


@cache
def _beside(scene: Callable[[], Scene], steps: int | None, model: str, elements: int, discrete: int) -> Array:
    posed = scene()
    if steps is not None:
        posed = replace(posed, motion=Static(steps=steps, t_end=posed.motion.t_end))
    return stations(solved(posed, other(model), FINER * elements, FINER * discrete))


def stations(result: Result) -> Array:
    """Evenly spaced points of the first rod at the end, shape (11, 3) [m]."""
    rod = result.rods[0]
    return np.array([rod.at(float(s))[-1] for s in np.linspace(0.0, rod.s[-1], N_STATIONS)])


def other(model: str) -> str:
    """The model that is not this one."""
    return "discrete" if model == "continuum" else "continuum"


def solved(scene: Scene, model: str, elements: int, discrete: int, patience: Patience | None = None) -> Result:
    """By a model with its default settings on its mesh.

    Raises:
        NotConverged: A step could not be taken.
    """
    if model == "continuum":
        from dolfinrod.continuum import solve

        return solve(scene, elements=elements, degree=3, progress=patience)
    from discrete import solve as solve_discrete

    return solve_discrete(scene, elements=discrete, progress=patience)
