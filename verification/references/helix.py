"""A rod that is a helix before and after loading: exact for every stiffness, found from the deformed state backwards.

A wrench along the axis of a helix looks the same from all its sections, so that strains and resultants are uniform in
section axes. With the curvature κ after loading chosen, and the force f and the moment α along the axis â = κ/|κ|,

    n = f â,  Γ = C_n⁻¹ n,  κ × m + (e₁ + Γ) × n = 0,  m = α â + (n × (e₁ + Γ)) × κ/|κ|²,  κ₀ = κ − C_m⁻¹ m:

the stress-free rod has the uniform curvature κ₀.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

__all__ = ["Coil"]

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Coil:
    """A deformed helix that starts at the origin with the section axes x, y, z.

    Args:
        curvature: κ about d1, d2, d3 after loading.
        force: f along the axis of the helix, positive pulls.
        moment: α, the part of the section moment along the axis.
        stretching: Diagonal of C_n: EA, GA2, GA3; infinite where rigid.
        bending: Diagonal of C_m: GJ, EI2, EI3.
    """

    curvature: tuple[float, float, float]
    force: float
    moment: float
    stretching: tuple[float, float, float]
    bending: tuple[float, float, float]

    @property
    def axis(self) -> Array:
        """Direction of the axis, the same in space and in every section, shape (3,)."""
        κ = np.asarray(self.curvature)
        return np.asarray(κ / np.linalg.norm(κ))

    @property
    def tangent(self) -> Array:
        """e₁ + Γ, shape (3,)."""
        return np.array([1.0, 0.0, 0.0]) + self.force * self.axis / np.asarray(self.stretching)

    @property
    def section_moment(self) -> Array:
        """m in section axes, shape (3,)."""
        κ = np.asarray(self.curvature)
        return np.asarray(
            self.moment * self.axis + np.cross(np.cross(self.force * self.axis, self.tangent), κ) / (κ @ κ)
        )

    @property
    def natural_curvature(self) -> Array:
        """κ₀ of the stress-free rod, shape (3,)."""
        return np.asarray(self.curvature) - self.section_moment / np.asarray(self.bending)

    def rotation(self, s: float) -> Array:
        """Section frame R(s) = exp(s κ×), shape (3, 3)."""
        return np.asarray(Rotation.from_rotvec(s * np.asarray(self.curvature)).as_matrix())

    def centreline(self, s: Array) -> Array:
        """r(s) = ∫ R (e₁ + Γ) ds.

        Args:
            s: Arc lengths, shape (n,).

        Returns:
            Points, shape (n, 3).
        """
        a, v, rate = self.axis, self.tangent, float(np.linalg.norm(self.curvature))
        along = (a @ v) * a
        across, φ = v - along, rate * np.asarray(s)[:, None]
        return np.asarray(φ / rate * along + np.sin(φ) / rate * across + (1.0 - np.cos(φ)) / rate * np.cross(a, v))
