"""How a surface resists rods that slide on it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.errors import SceneError, quoted
from dolfinrod.scene.quantity import assign, nonnegative, positive

if TYPE_CHECKING:
    from dolfinrod.scene.normallaw import NormalLaw

__all__ = ["Coulomb", "CreepingCoulomb", "Friction", "anchoring"]

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Coulomb:
    """Dry friction that sticks: an elastic anchor that slips where it would pull harder than μ p.

    t = −ε_T u, |t| ≤ μ p; u is the displacement of the rod's surface from its anchor on the wall, which follows it as
    far as the limit asks and moves with the wall (Cundall & Strack 1979; return mapping of elastoplasticity).

    Args:
        mu: Coefficient of friction μ.
        eps_T: Stiffness of the anchors ε_T [N/m²]; None: that of the contact's law against penetration.
        at: Where it acts on a rod: at its "surface", where it turns the rod and a rod that rolls does not rub, or at
            its "centreline", a force without a moment, as where a model knows no surface of a rod.

    Raises:
        SceneError: A negative coefficient, a stiffness that is not positive, an unknown place.
    """

    mu: float
    eps_T: float | None = None
    at: Literal["surface", "centreline"] = "surface"

    def __post_init__(self) -> None:
        if not isinstance(self.at, str) or self.at not in ("surface", "centreline"):
            raise SceneError(f'must be "surface" or "centreline", got {quoted(self.at)}', field="Coulomb.at")
        eps_T = None if self.eps_T is None else positive(self.eps_T, "Coulomb.eps_T", "N/m²")
        assign(self, mu=nonnegative(self.mu, "Coulomb.mu"), eps_T=eps_T)

    def arm(self, distance: Array) -> Array:
        """Lever arm of the traction about centrelines at a distance from where rods touch, shape (n,) [m]."""
        return distance if self.at == "surface" else np.zeros_like(distance)


@dataclass(frozen=True)
class CreepingCoulomb:
    """Friction against the velocity to the letter of Eq. 28, t = −μ p v/√(|v|² + v_0²): it never sticks, but creeps.

    v is the velocity of the centreline in space, whatever the wall does, its part along the normal included: as
    printed. A load W on a rod that should stick drags it along at about v_0 W/√(μ²N² − W²).

    Args:
        mu: Coefficient of friction μ.
        v_0: Speed below which friction fades [m/s].

    Raises:
        SceneError: A negative coefficient, a speed that is not positive.
    """

    mu: float
    v_0: float

    def __post_init__(self) -> None:
        assign(
            self, mu=nonnegative(self.mu, "CreepingCoulomb.mu"), v_0=positive(self.v_0, "CreepingCoulomb.v_0", "m/s")
        )


Friction = Coulomb | CreepingCoulomb


def anchoring(friction: Friction | None, law: NormalLaw) -> float:
    """Stiffness of anchors, their own or that of the law against penetration [N/m²]."""
    own = friction.eps_T if isinstance(friction, Coulomb) else None
    return law.eps_N if own is None else own
