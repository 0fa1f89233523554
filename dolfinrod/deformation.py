"""How rods deform: centrelines, frames, strains and resultants along them at the stored times."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["RodHistory"]


@dataclass(frozen=True, eq=False)
class RodHistory:
    """Deformed states of one rod at the stored times.

    Args:
        s: Arc length of the nodes in the reference, ascending, shape (n_s,) [m].
        r: Centreline, shape (n_t, n_s, 3) [m].
        frames: Section frames, columns d1 (section normal), d2, d3, shape (n_t, n_s, 3, 3).
        gamma: Axial and shear strain Rᵀr′ − R₀ᵀr₀′, section frame, shape (n_t, n_s, 3).
        kappa: Twist and curvature strain κ − κ₀, section frame, shape (n_t, n_s, 3) [1/m].
        n: Force resultants, section frame, shape (n_t, n_s, 3) [N].
        m: Moment resultants, section frame, shape (n_t, n_s, 3) [N m].
        v: Velocity of the centreline, shape (n_t, n_s, 3) [m/s]; None in statics.
        omega: Spin ω of the sections in spatial axes, Ṙ = skew(ω)·R, shape (n_t, n_s, 3) [rad/s]; None in statics.
    """

    s: NDArray[np.float64]
    r: NDArray[np.float64]
    frames: NDArray[np.float64]
    gamma: NDArray[np.float64]
    kappa: NDArray[np.float64]
    n: NDArray[np.float64]
    m: NDArray[np.float64]
    v: NDArray[np.float64] | None = None
    omega: NDArray[np.float64] | None = None

    def at(self, s: float) -> NDArray[np.float64]:
        """Centreline point at arc length `s` at every stored time.

        Cubic between neighbouring nodes, whose slopes r′ = R (e₁ + γ) the section frames and strains give.

        Args:
            s: Arc length in [0, length] [m].

        Returns:
            Positions, shape (n_t, 3) [m].

        Raises:
            ValueError: `s` lies off the rod.
        """
        length = self.s[-1]
        if not 0.0 <= s <= length:
            raise ValueError(f"s must lie on the rod, between 0 and {length} m, got {s} m")
        i = min(int(np.searchsorted(self.s, s, side="right")) - 1, len(self.s) - 2)
        h = self.s[i + 1] - self.s[i]
        x = (s - self.s[i]) / h
        strain = self.gamma[:, i : i + 2] + np.array([1.0, 0.0, 0.0])
        slope = h * np.einsum("tnij,tnj->tni", self.frames[:, i : i + 2], strain)
        ends = (1 + 2 * x) * (1 - x) ** 2 * self.r[:, i] + x**2 * (3 - 2 * x) * self.r[:, i + 1]
        return ends + x * (1 - x) ** 2 * slope[:, 0] - x**2 * (1 - x) * slope[:, 1]
