"""Both models, asked for critical loads and natural frequencies."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from dolfinrod.eigen import Buckling, Modes
    from dolfinrod.result import Result
    from dolfinrod.scene import Scene

__all__ = ["EigenContinuum", "EigenDiscrete"]


@dataclass(frozen=True)
class EigenContinuum:
    """`dolfinrod`: eigenvalues converge with 2k, twice the degree.

    Args:
        degree: k.
    """

    degree: int = 3
    family: str = field(default="continuum", init=False)
    meshes: tuple[int, ...] = (4, 8, 16)

    @property
    def name(self) -> str:
        """Such as "continuum P3"."""
        return f"continuum P{self.degree}"

    @property
    def order(self) -> int:
        """2k."""
        return 2 * self.degree

    def buckling(self, scene: Scene, elements: int, modes: int) -> Buckling:
        """Linear buckling about the state at t = 0."""
        from dolfinrod.continuum import buckling

        return buckling(scene, elements=elements, degree=self.degree, modes=modes)

    def critical(self, scene: Scene, elements: int, modes: int) -> Buckling:
        """First critical point of the path."""
        from dolfinrod.continuum import critical

        return critical(scene, elements=elements, degree=self.degree, modes=modes)

    def modes(self, scene: Scene, elements: int, modes: int) -> Modes:
        """Vibrations about the state at t = 0."""
        from dolfinrod.continuum import modes as vibrations

        return vibrations(scene, elements=elements, degree=self.degree, modes=modes)

    def solve(self, scene: Scene, elements: int) -> Result:
        """Equilibrium path, judged in space."""
        from dolfinrod.continuum import solve

        return solve(scene, elements=elements, degree=self.degree)


@dataclass(frozen=True)
class EigenDiscrete:
    """`discrete`: the paper's elements, of order 2."""

    family: str = field(default="discrete", init=False)
    name: str = field(default="discrete", init=False)
    order: int = field(default=2, init=False)
    meshes: tuple[int, ...] = (20, 40, 80)

    def buckling(self, scene: Scene, elements: int, modes: int) -> Buckling:
        """Linear buckling about the state at t = 0."""
        from discrete import buckling

        return buckling(scene, elements=elements, modes=modes)

    def critical(self, scene: Scene, elements: int, modes: int) -> Buckling:
        """First critical point of the path."""
        from discrete import critical

        return critical(scene, elements=elements, modes=modes)

    def modes(self, scene: Scene, elements: int, modes: int) -> Modes:
        """Vibrations about the state at t = 0."""
        from discrete import modes as vibrations

        return vibrations(scene, elements=elements, modes=modes)

    def solve(self, scene: Scene, elements: int) -> Result:
        """Equilibrium path."""
        from discrete import solve

        return solve(scene, elements=elements)
