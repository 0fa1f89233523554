"""Both models behind one door: a scene and a number of elements in, a result out."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Protocol

import numpy as np

from dolfinrod.scene import Planar, Spatial

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from dolfinrod.scene import Scene
    from verification.case import Case

__all__ = ["BOTH", "Continuum", "Discrete", "Model", "elongation", "natural"]

BOTH = (Planar(), Spatial())


class Model(Protocol):
    """What solves a scene.

    Attributes:
        family: "continuum" or "discrete".
        kinematics_name: "planar" or "spatial".
        degree: Of the centreline on an element.
        tip_order: Power of the element length with which the tip converges, by theory.
        centreline_order: The same of the centreline in L2.
    """

    @property
    def name(self) -> str:
        """For tables and legends."""

    @property
    def family(self) -> str: ...  # noqa: D102 (above)

    @property
    def kinematics_name(self) -> str: ...  # noqa: D102

    @property
    def degree(self) -> int: ...  # noqa: D102

    @property
    def tip_order(self) -> int: ...  # noqa: D102

    @property
    def centreline_order(self) -> int: ...  # noqa: D102

    def applies_to(self, case: Case) -> bool:
        """Whether it poses the same problem."""

    def solve(self, scene: Scene, elements: int) -> Result:
        """Equilibrium of the scene on so many elements a rod."""


@dataclass(frozen=True)
class Continuum:
    """`dolfinrod.solve`: mixed elements of degree k; nodal values superconverge with 2k, r in L2 with k + 1.

    Args:
        degree: k, 1 to 5.
        kinematics: `Planar()` or `Spatial()`.
    """

    degree: int
    kinematics: Planar | Spatial = field(default_factory=Spatial)
    family: str = field(default="continuum", init=False)

    @property
    def name(self) -> str:
        """Such as "continuum P3 spatial"."""
        return f"continuum P{self.degree} {self.kinematics_name}"

    @property
    def kinematics_name(self) -> str:
        """Planar or spatial, in one word."""
        return "planar" if isinstance(self.kinematics, Planar) else "spatial"

    @property
    def tip_order(self) -> int:
        """2k."""
        return 2 * self.degree

    @property
    def centreline_order(self) -> int:
        """k + 1."""
        return self.degree + 1

    def applies_to(self, case: Case) -> bool:
        """Planar kinematics needs a plane."""
        return self.family in case.models and (case.planar or not isinstance(self.kinematics, Planar))

    def solve(self, scene: Scene, elements: int) -> Result:
        """Equilibrium by the continuum model."""
        from dolfinrod.continuum import solve

        return solve(scene, elements=elements, degree=self.degree, kinematics=self.kinematics)


@dataclass(frozen=True)
class Discrete:
    """`discrete.solve`: the paper's 12×12 elements, straight and shear-rigid, of order 2.

    Args:
        axial: "chord", or "paper" for Eq. 16 as printed.
    """

    axial: str = "chord"
    family: str = field(default="discrete", init=False)
    degree: int = field(default=1, init=False)
    tip_order: int = field(default=2, init=False)
    centreline_order: int = field(default=2, init=False)

    @property
    def kinematics_name(self) -> str:
        """Always in space."""
        return "spatial"

    @property
    def name(self) -> str:
        """Such as "discrete chord"."""
        return f"discrete {self.axial}"

    def applies_to(self, case: Case) -> bool:
        """Where no shear enters."""
        return self.family in case.models

    def solve(self, scene: Scene, elements: int) -> Result:
        """Equilibrium by the discrete model."""
        from discrete import solve

        return solve(scene, elements=elements, axial=self.axial)


def natural(case: Case) -> Planar | Spatial:
    """The smaller kinematics that holds a case."""
    return Planar() if case.planar else Spatial()


def elongation(result: Result) -> float:
    """By how much the rods grow longer that should not: the discrete model lends them EA = 1e8 EI/L².

    Args:
        result: Of either model.

    Returns:
        Σ max|n₁| ℓ/EA over the rods of length ℓ that are rigid in extension, 0 for the continuum model [m].
    """
    if result.formulation.model != "discrete":
        return 0.0
    from discrete.mesh import RIGID_EXTENSION

    rods = result.scene.rods
    EA = RIGID_EXTENSION * max(max(rod.section.EI) for rod in rods) / max(rod.length for rod in rods) ** 2
    return sum(
        float(np.abs(history.n[-1, :, 0]).max()) * rod.length / EA
        for rod, history in zip(rods, result.rods, strict=True)
        if "extension" in rod.section.rigid
    )
