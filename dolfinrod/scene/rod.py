"""A rod: a framed stress-free curve and the section carried along it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from dolfinrod.scene.errors import SceneError
from dolfinrod.scene.mesh import polyline
from dolfinrod.scene.quantity import VectorLike, assign, number, positive
from dolfinrod.scene.section import Section
from dolfinrod.scene.shape import Shape, UniformCurvature, rotation_about_d1
from dolfinrod.scene.spline import Spline

__all__ = ["Rod"]

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Rod:
    """A slender body, free of stress along a curve r₀(s) with section frames R₀(s) = [d1 d2 d3].

    r₀′ = d1 and R₀′ = R₀·skew(κ₀), s ∈ [0, length]. Pretwist turns the section about d1 by the angle pretwist·s.
    Wherever d2 is left None it is z × d1, and y where d1 is along z: a rod along x has d2 = y and d3 = z.

    Args:
        shape: The framed curve; made by `straight`, `arc`, `curved`, `through` and `from_mesh`.
        section: Stiffness and inertia.
        pretwist: Angle of the stress-free section per length, beyond that of the shape's frame [rad/m].

    Raises:
        SceneError: A field that cannot be.
    """

    shape: Shape
    section: Section
    pretwist: float = 0.0

    def __post_init__(self) -> None:
        if not isinstance(self.section, Section):
            raise SceneError(f"must be a Section, got {self.section!r}", field="Rod.section")
        if not isinstance(self.shape, Shape):
            raise SceneError(
                f"must be a framed curve, such as Rod.straight makes, got {self.shape!r}", field="Rod.shape"
            )
        assign(self, pretwist=number(self.pretwist, "Rod.pretwist", "rad/m"))

    @classmethod
    def straight(
        cls,
        length: float,
        section: Section,
        start: VectorLike = (0.0, 0.0, 0.0),
        direction: VectorLike = (1.0, 0.0, 0.0),
        d2: VectorLike | None = None,
        pretwist: float = 0.0,
    ) -> Rod:
        """Straight rod.

        Args:
            length: Arc length [m].
            section: Stiffness and inertia.
            start: First point [m].
            direction: Along the rod, of any length.
            d2: Second section axis; None: chosen.
            pretwist: Stress-free twist [rad/m].

        Returns:
            The rod.
        """
        return cls(UniformCurvature(length, start=start, direction=direction, d2=d2), section, pretwist)

    @classmethod
    def arc(
        cls,
        radius: float,
        angle: float,
        section: Section,
        start: VectorLike = (0.0, 0.0, 0.0),
        direction: VectorLike = (1.0, 0.0, 0.0),
        towards: VectorLike = (0.0, 1.0, 0.0),
        pretwist: float = 0.0,
    ) -> Rod:
        """Circular arc, d2 pointing to its centre: κ₀ = (0, 0, 1/radius), length = radius·angle.

        Args:
            radius: Of the centreline [m].
            angle: Between the first and the last section, beyond 2π allowed [rad].
            section: Stiffness and inertia.
            start: First point [m].
            direction: Along the rod at its start, of any length.
            towards: To the side of the centre, of any length.
            pretwist: Stress-free twist [rad/m].

        Returns:
            The rod.
        """
        ρ = positive(radius, "Rod.radius", "m")
        length = ρ * positive(angle, "Rod.angle", "rad")
        return cls.curved(length, section, (0.0, 0.0, 1.0 / ρ), start, direction, towards, pretwist)

    @classmethod
    def curved(
        cls,
        length: float,
        section: Section,
        curvature: VectorLike,
        start: VectorLike = (0.0, 0.0, 0.0),
        direction: VectorLike = (1.0, 0.0, 0.0),
        d2: VectorLike | None = None,
        pretwist: float = 0.0,
    ) -> Rod:
        """Rod of uniform material curvature, a helix in general.

        Args:
            length: Arc length [m].
            section: Stiffness and inertia.
            curvature: κ₀ about d1 (twist), d2 and d3 [1/m].
            start: First point [m].
            direction: Along the rod at its start, of any length.
            d2: Second section axis at the start; None: chosen.
            pretwist: Stress-free twist beyond `curvature` [rad/m].

        Returns:
            The rod.
        """
        return cls(
            UniformCurvature(length, kappa=curvature, start=start, direction=direction, d2=d2), section, pretwist
        )

    @classmethod
    def through(
        cls,
        points: Sequence[VectorLike] | Array,
        section: Section,
        d2: VectorLike | None = None,
        pretwist: float = 0.0,
    ) -> Rod:
        """Rod along the smooth cubic curve through points, framed without twist.

        Args:
            points: At least two, shape (n_p, 3) [m].
            section: Stiffness and inertia.
            d2: Second section axis at the start; None: chosen.
            pretwist: Stress-free twist [rad/m].

        Returns:
            The rod.
        """
        return cls(Spline(points, d2), section, pretwist)

    @classmethod
    def from_mesh(
        cls,
        file: str | Path,
        section: Section,
        unit: str = "m",
        group: str | None = None,
        d2: VectorLike | None = None,
        pretwist: float = 0.0,
    ) -> Rod:
        """Rod along the smooth cubic curve through the points of a mesh of line cells, as `through` them in order.

        The cells may stand in any order and orientation; the rod runs the way the first of them does.

        Args:
            file: Path of a mesh that meshio reads (VTU, Gmsh, XDMF, …); other cells than lines are passed over.
            section: Stiffness and inertia.
            unit: Unit of length of the file's coordinates, such as "mm".
            group: Physical group or cell set to read; None: all line cells.
            d2: Second section axis at the start; None: chosen.
            pretwist: Stress-free twist [rad/m].

        Returns:
            The rod.
        """
        return cls(Spline(polyline(file, unit=unit, group=group), d2), section, pretwist)

    @property
    def length(self) -> float:
        """Arc length from start to end [m]."""
        return self.shape.length

    @property
    def breakpoints(self) -> tuple[float, ...]:
        """Interior s at which the shape is only piecewise smooth [m]."""
        return self.shape.breakpoints

    def centerline(self, s: ArrayLike) -> Array:
        """Stress-free points.

        Args:
            s: Arc length, shape (n,) [m].

        Returns:
            r₀, shape (n, 3) [m].

        Raises:
            ValueError: `s` lies off the rod; so with `frames` and `curvature`.
        """
        return self.shape.centerline(self._on_rod(s))

    def frames(self, s: ArrayLike) -> Array:
        """Stress-free section frames.

        Args:
            s: Arc length, shape (n,) [m].

        Returns:
            R₀, columns d1, d2, d3, shape (n, 3, 3).
        """
        s = self._on_rod(s)
        R = self.shape.frames(s)
        return R @ rotation_about_d1(self.pretwist * s) if self.pretwist else R

    def curvature(self, s: ArrayLike) -> Array:
        """Stress-free curvature in the section frame, κ₀ = Rot₁(pretwist·s)ᵀ·κ_shape + pretwist·e1.

        Args:
            s: Arc length, shape (n,) [m].

        Returns:
            κ₀, shape (n, 3) [1/m].
        """
        s = self._on_rod(s)
        κ = self.shape.curvature(s)
        if not self.pretwist:
            return κ
        turned = np.einsum("...ji,...j->...i", rotation_about_d1(self.pretwist * s), κ)
        return turned + self.pretwist * np.eye(3)[0]

    def _on_rod(self, s: ArrayLike) -> Array:
        """Arc lengths as an array, on the rod but for round-off."""
        s = np.asarray(s, dtype=float)
        off = s[(s < -1e-9 * self.length) | (s > (1 + 1e-9) * self.length)]
        if off.size:
            raise ValueError(f"s must lie on the rod, between 0 and {self.length} m, got {off[0]} m")
        return s
