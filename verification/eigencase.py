"""A critical load or a frequency as a case: the scene, the analysis that finds it, what it should be."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Protocol

import numpy as np

if TYPE_CHECKING:
    from dolfinrod.eigen import Buckling, Modes
    from dolfinrod.result import Result
    from dolfinrod.scene import Scene
    from verification.references.scalar import Scalar

__all__ = ["Analysis", "AtRest", "Eigencase", "EigenModel", "Found", "Path", "Vibration"]


class EigenModel(Protocol):
    """What answers eigenvalue questions.

    Attributes:
        family: "continuum" or "discrete".
        name: For tables and legends.
        order: Power of the element length with which eigenvalues converge, by theory.
        meshes: Numbers of elements, coarse to fine.
    """

    @property
    def family(self) -> str: ...  # noqa: D102 (above)

    @property
    def name(self) -> str: ...  # noqa: D102

    @property
    def order(self) -> int: ...  # noqa: D102

    @property
    def meshes(self) -> tuple[int, ...]: ...  # noqa: D102

    def buckling(self, scene: Scene, elements: int, modes: int) -> Buckling:
        """Linear buckling about the state at t = 0."""

    def critical(self, scene: Scene, elements: int, modes: int) -> Buckling:
        """First critical point of the path."""

    def modes(self, scene: Scene, elements: int, modes: int) -> Modes:
        """Vibrations about the state at t = 0."""

    def solve(self, scene: Scene, elements: int) -> Result:
        """Equilibrium path with a verdict at each step."""


@dataclass(frozen=True)
class Found:
    """What an analysis says.

    Args:
        value: Load or frequency, in the units of the case; NaN where there is none.
        multiplicity: Number of its modes; 0 where there is none.
    """

    value: float
    multiplicity: int


class Analysis(Protocol):
    """How a value is found."""

    def find(self, model: EigenModel, case: Eigencase, elements: int) -> Found:
        """Ask a model."""


@dataclass(frozen=True)
class AtRest:
    """Linear buckling about the state without load: exact for inextensible straight columns."""

    def find(self, model: EigenModel, case: Eigencase, elements: int) -> Found:
        """First factor times the load."""
        return _first(model.buckling(case.scene(case.load), elements, 2), case.load, 0.0)


@dataclass(frozen=True)
class Path:
    """The first critical point on the path, deformation before it included.

    Args:
        since: Pseudo-time from which the load grows, linearly, for one unit of time.
    """

    since: float = 0.0

    def find(self, model: EigenModel, case: Eigencase, elements: int) -> Found:
        """Critical pseudo-time as a load."""
        return _first(model.critical(case.scene(case.load), elements, 2), case.load, self.since)


@dataclass(frozen=True)
class Vibration:
    """One of the natural frequencies.

    Args:
        mode: Its number among all that are found, multiple ones counted as often as they occur, from 0.
    """

    mode: int

    def find(self, model: EigenModel, case: Eigencase, elements: int) -> Found:
        """Angular frequency [rad/s]."""
        found = model.modes(case.scene(0.0), elements, self.mode + 2)
        if len(found.omega) <= self.mode:
            return Found(np.nan, 0)
        return Found(float(found.omega[self.mode].real), int(found.multiplicity[self.mode]))


def _first(found: Buckling, load: float, since: float) -> Found:
    if not len(found.factors):
        return Found(np.nan, 0)
    return Found(load * (float(found.factors[0]) - since), int(found.multiplicity[0]))


@dataclass(frozen=True)
class Eigencase:
    """A critical load or a frequency with a known answer.

    Args:
        name: Short, unique, fit for a file name.
        title: For people.
        family: Of which it is one, such as "columns".
        quantity: What the value is, with its unit.
        scene: The problem, under a full load of so much; frequencies ignore the number.
        analysis: How the value is found.
        reference: What it should be.
        multiplicity: Number of modes it should have.
        models: Families of models that pose the same problem.
        brackets: Whether loads just below and just above are stable and unstable; for critical loads.
        finer: By how much the meshes are finer than usual.
        note: One sentence where a model deviates from theory, or where the reference holds in a limit.
    """

    name: str
    title: str
    family: str
    quantity: str
    scene: Callable[[float], Scene] = field(repr=False)
    analysis: Analysis
    reference: Scalar
    multiplicity: int
    models: tuple[str, ...] = ("continuum", "discrete")
    brackets: bool = True
    finer: float = 1.0
    note: str = ""

    @property
    def load(self) -> float:
        """Full load of the scene that is analysed: half as much again as the critical one."""
        return 1.5 * self.reference.value
