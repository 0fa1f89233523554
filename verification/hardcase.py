"""A hard case: a scene that solvers stumble over, the mesh, and a check of its equilibrium by other means."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cache
from typing import TYPE_CHECKING, Protocol

import numpy as np

from dolfinrod.scene import Spatial, Static
from verification.case import SKEW

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from dolfinrod.scene import Scene
    from verification.case import Array, Case, Pose

__all__ = ["Against", "Check", "HardCase", "Place", "Refined", "known"]


class Check(Protocol):
    """What an equilibrium is held against."""

    @property
    def words(self) -> str:
        """For the table."""

    def error(self, result: Result, case: HardCase) -> float:
        """Distance from it, relative to the size of the rod."""


@dataclass(frozen=True)
class Against:
    """A case with a reference.

    Args:
        case: Whose quantity is read.
        pose: In which the scene is posed.
    """

    case: Case
    pose: Pose = SKEW

    @property
    def words(self) -> str:
        """Its id, without the numbers that the title has."""
        return f"reference {self.case.reference.id.partition('(')[0]}"

    def error(self, result: Result, case: HardCase) -> float:
        """That of the case."""
        return self.case.error(result, self.pose)


@dataclass(frozen=True)
class Place:
    """Where the tip is known to be, exactly.

    Args:
        tip: Its position [m].
        length: By which the distance is divided [m].
        why: In words.
    """

    tip: tuple[float, float, float]
    length: float
    why: str

    @property
    def words(self) -> str:
        """Why."""
        return self.why

    def error(self, result: Result, case: HardCase) -> float:
        """|tip − known| / length."""
        return float(np.linalg.norm(result.tip - np.asarray(self.tip)) / self.length)


@dataclass(frozen=True)
class Refined:
    """The continuum model of degree 5 in space on more elements, taken in many equal steps.

    For the continuum model another mesh, degree, kinematics and another way through the loads, for the discrete one
    another model.

    Args:
        elements: Of the first rod.
        steps: Equal load steps.
        at: Arc length at which the centreline is compared, in lengths; the tip where 1.
    """

    elements: int = 24
    steps: int = 20
    at: float = 1.0

    @property
    def words(self) -> str:
        """How."""
        return f"{self.elements} × P5, spatial, {self.steps} or more steps"

    def error(self, result: Result, case: HardCase) -> float:
        """Distance of the section at that arc length, relative to the length of the rod."""
        length = case.scene().rods[0].length
        exact = _refined(self, case.scene)
        return float(np.linalg.norm(result.rods[0].at(self.at * length)[-1] - exact) / length)


@cache
def _refined(how: Refined, scene: Callable[[], Scene]) -> Array:
    from dolfinrod.continuum import solve

    posed = scene()
    stepped = replace(posed, motion=Static(steps=how.steps, t_end=posed.motion.t_end))
    result = solve(stepped, elements=how.elements, degree=5, kinematics=Spatial())
    return np.asarray(result.rods[0].at(how.at * posed.rods[0].length)[-1])


@dataclass(frozen=True)
class HardCase:
    """A scene that solvers stumble over.

    Args:
        name: Short, unique.
        group: What is hard about it.
        title: For people.
        scene: The problem.
        check: Of its equilibrium.
        elements: Of the continuum model; its default mesh is 16.
        discrete: Elements of the discrete model.
        degree: Of the continuum model.
        models: That pose the problem.
        limit: Error beyond which an equilibrium is another one than sought, or worthless.
        unstable: Whether the equilibrium sought is unstable and has to be flagged.
    """

    name: str
    group: str
    title: str
    scene: Callable[[], Scene] = field(repr=False)
    check: Check
    elements: int = 16
    discrete: int = 80
    degree: int = 3
    models: tuple[str, ...] = ("continuum", "discrete")
    limit: float = 1e-2
    unstable: bool = False


def known(
    case: Case,
    group: str,
    title: str = "",
    *,
    elements: int = 16,
    discrete: int = 80,
    degree: int = 3,
    pose: Pose = SKEW,
    name: str = "",
    limit: float = 1e-2,
) -> HardCase:
    """A verification case as a hard one.

    Args:
        case: With a reference.
        group: What is hard about it.
        title: Of the row; empty: that of the case.
        elements: Of the continuum model.
        discrete: Of the discrete one.
        degree: Of the continuum model.
        pose: Of the scene.
        name: Of the row; empty: that of the case.
        limit: Error beyond which it is another equilibrium.

    Returns:
        The hard case.
    """
    return HardCase(
        name=name or case.name,
        group=group,
        title=title or case.title,
        scene=lambda: case.scene(pose),
        check=Against(case, pose),
        elements=elements,
        discrete=discrete,
        degree=degree,
        models=case.models,
        limit=limit,
    )
