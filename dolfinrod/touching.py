"""Where rods touch surfaces: gaps, pressures and tractions along them at the stored times."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["ContactHistory", "Touching"]


@dataclass(frozen=True, eq=False)
class Touching:
    """One rod against one surface, at the points at which the model looks for contact: its nodes.

    Args:
        s: Arc length of the points, ascending, shape (n_s,) [m].
        share: Length for which each stands, shape (n_s,) [m].
        gap: Between surface and surface of the rod, shape (n_t, n_s) [m].
        pressure: Line load along the normal, shape (n_t, n_s) [N/m].
        normal: Of the surface where it touches, zero elsewhere, shape (n_t, n_s, 3).
        traction: Friction, shape (n_t, n_s, 3) [N/m].
        slip: Way that the anchors of friction have gone since the start, shape (n_t, n_s) [m].
        state: 0 open, 1 sticking, 2 sliding, which is all that a rod without friction does, shape (n_t, n_s).
    """

    s: NDArray[np.float64]
    share: NDArray[np.float64]
    gap: NDArray[np.float64]
    pressure: NDArray[np.float64]
    normal: NDArray[np.float64]
    traction: NDArray[np.float64]
    slip: NDArray[np.float64]
    state: NDArray[np.int8]

    @property
    def force(self) -> NDArray[np.float64]:
        """Resultant ∫ p n + t ds on the rod, shape (n_t, 3) [N]."""
        return np.einsum("s,tsi->ti", self.share, self.pressure[:, :, None] * self.normal + self.traction)

    @property
    def length(self) -> NDArray[np.float64]:
        """Length in contact, shape (n_t,) [m]."""
        return np.asarray((self.pressure > 0.0) @ self.share)


@dataclass(frozen=True, eq=False)
class ContactHistory:
    """One contact of a scene at the stored times.

    Args:
        rods: What each rod of the scene feels of it; None for rods it does not concern.
    """

    rods: tuple[Touching | None, ...]

    @property
    def force(self) -> NDArray[np.float64]:
        """Resultant on all rods, shape (n_t, 3) [N]."""
        return np.asarray(sum(rod.force for rod in self.rods if rod is not None))

    @property
    def length(self) -> NDArray[np.float64]:
        """Length in contact of all rods, shape (n_t,) [m]."""
        return np.asarray(sum(rod.length for rod in self.rods if rod is not None))
