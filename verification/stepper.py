"""Both models in motion behind one door: a scene and a scheme on a mesh, a time step in, a result out."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Protocol

from dolfinrod.scene import Dynamic, ImplicitEuler, Midpoint, Planar, Spatial

if TYPE_CHECKING:
    from collections.abc import Sequence

    from dolfinrod.result import Result
    from dolfinrod.scene import Scene
    from dolfinrod.scene.motion import Scheme

__all__ = ["ORDERS", "ContinuumStepper", "DiscreteStepper", "Stepper", "both_schemes"]

# Power of the time step with which errors fall, by theory.
ORDERS = {ImplicitEuler: 1, Midpoint: 2}


class Stepper(Protocol):
    """What moves a scene on.

    Attributes:
        family: "continuum" or "discrete".
        name: For tables and legends.
        mesh: In words, such as "4 × P4 planar".
        order: Power of the time step with which errors fall, by theory.
    """

    @property
    def family(self) -> str: ...  # noqa: D102 (above)

    @property
    def name(self) -> str: ...  # noqa: D102

    @property
    def mesh(self) -> str: ...  # noqa: D102

    @property
    def order(self) -> int: ...  # noqa: D102

    def motion(self, t_end: float, steps: int, output: float | Sequence[float] | None) -> Dynamic:
        """So many equal steps by the scheme."""

    def solve(self, scene: Scene, start: Result | None = None) -> Result:
        """The motion of the scene, from its stress-free shape or from the last state of a result."""


@dataclass(frozen=True)
class ContinuumStepper:
    """`dolfinrod.solve` on elements of one degree.

    Args:
        scheme: `ImplicitEuler()` or `Midpoint()`.
        elements: Of each rod.
        degree: Of the elements.
        kinematics: `Planar(…)` or `Spatial()`.
    """

    scheme: Scheme
    elements: int
    degree: int = 3
    kinematics: Planar | Spatial = field(default_factory=Spatial)
    family: str = field(default="continuum", init=False)

    @property
    def name(self) -> str:
        """Such as "continuum midpoint"."""
        return f"continuum {'midpoint' if isinstance(self.scheme, Midpoint) else 'Euler'}"

    @property
    def mesh(self) -> str:
        """Such as "4 × P4 planar"."""
        kind = "planar" if isinstance(self.kinematics, Planar) else "spatial"
        return f"{self.elements} × P{self.degree} {kind}"

    @property
    def order(self) -> int:
        """1 or 2."""
        return ORDERS[type(self.scheme)]

    def motion(self, t_end: float, steps: int, output: float | Sequence[float] | None) -> Dynamic:
        """So many equal steps by the scheme."""
        return Dynamic(t_end=t_end, dt=t_end / steps, scheme=self.scheme, output=output)

    def solve(self, scene: Scene, start: Result | None = None) -> Result:
        """The motion by the continuum model."""
        from dolfinrod.continuum import solve

        return solve(scene, elements=self.elements, degree=self.degree, kinematics=self.kinematics, start=start)


@dataclass(frozen=True)
class DiscreteStepper:
    """`discrete.solve`, which knows implicit Euler only.

    Args:
        elements: Of each rod.
        end_mass: "half", or "paper" for end nodes as heavy as the others.
    """

    elements: int
    end_mass: str = "half"
    family: str = field(default="discrete", init=False)
    order: int = field(default=1, init=False)

    @property
    def name(self) -> str:
        """With the literal masses named."""
        return "discrete Euler" + ("" if self.end_mass == "half" else ", the paper's end masses")

    @property
    def mesh(self) -> str:
        """Number of elements."""
        return f"{self.elements}"

    def motion(self, t_end: float, steps: int, output: float | Sequence[float] | None) -> Dynamic:
        """So many equal steps."""
        return Dynamic(t_end=t_end, dt=t_end / steps, scheme=ImplicitEuler(), output=output)

    def solve(self, scene: Scene, start: Result | None = None) -> Result:
        """The motion by the discrete model."""
        from discrete import solve

        return solve(scene, elements=self.elements, end_mass=self.end_mass, start=start)


def both_schemes(elements: int, degree: int, kinematics: Planar | Spatial) -> tuple[ContinuumStepper, ContinuumStepper]:
    """The continuum model by either scheme on one mesh, Midpoint first."""
    midpoint, euler = (
        ContinuumStepper(scheme, elements, degree, kinematics) for scheme in (Midpoint(), ImplicitEuler())
    )
    return midpoint, euler
