"""What an eigenvalue analysis leaves behind: critical loads and natural frequencies, the same from either model."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.result import Result

__all__ = ["Buckling", "Modes", "RodShapes"]


@dataclass(frozen=True, eq=False)
class RodShapes:
    """How one rod moves in each mode, all rods of a mode to one scale.

    The largest displacement of a mode is 1, its spins are then per metre of it; where nothing but the spin is left,
    as in pure torsion, the largest spin is 1. A multiple mode stands for any basis of its motions.

    Args:
        s: Arc length of the nodes in the reference, ascending, shape (n_s,) [m].
        displacement: Of the centreline in space, shape (n_modes, n_s, 3).
        spin: Rotation vector of the section in space, shape (n_modes, n_s, 3).
    """

    s: NDArray[np.float64]
    displacement: NDArray[np.float64]
    spin: NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Buckling:
    """Critical loads on the path that leads on from an equilibrium.

    Args:
        factors: Pseudo-times at which the loads are critical, the next one first, a multiple one as often as it has
            modes; of a proportional load with t_end = 1 they are load factors, shape (n,).
        multiplicity: Number of independent modes of each factor, shape (n,).
        rods: Shapes of the modes, one record a rod.
        at: The equilibrium they were computed from, at its last stored pseudo-time.
        complex_factors: Complex ones among those sought; loads that are not conservative have them, and they are no
            critical loads.
    """

    factors: NDArray[np.float64]
    multiplicity: NDArray[np.int64]
    rods: tuple[RodShapes, ...]
    at: Result
    complex_factors: NDArray[np.complex128]


@dataclass(frozen=True, eq=False)
class Modes:
    """Free vibrations about an equilibrium, u(t) = Re(shape · exp(iωt)).

    Args:
        omega: Angular frequencies, those of unstable directions first, then ascending [rad/s]. Zero: a rigid
            motion, or a critical load. Imaginary: the rod leaves this equilibrium like exp(|ω| t). Neither real nor
            imaginary: flutter, both of it and its mirror image grow and decay. Shape (n,).
        multiplicity: Number of independent modes of each frequency, shape (n,).
        rods: Shapes of the modes, the real part of complex ones, one record a rod.
        at: The equilibrium.
    """

    omega: NDArray[np.complex128]
    multiplicity: NDArray[np.int64]
    rods: tuple[RodShapes, ...]
    at: Result

    @property
    def frequencies(self) -> NDArray[np.float64]:
        """Oscillations per second, zero for what does not oscillate, shape (n,) [Hz]."""
        return np.asarray(self.omega.real / (2 * np.pi))

    @property
    def stable(self) -> bool:
        """Whether every mode found stays near the equilibrium."""
        return bool(np.all(self.omega.imag == 0.0))
