"""How a surface resists rods that slide on it."""

from __future__ import annotations

from dataclasses import dataclass

from dolfinrod.scene.quantity import assign, nonnegative, positive

__all__ = ["Coulomb", "CreepingCoulomb", "Friction"]


@dataclass(frozen=True)
class Coulomb:
    """Dry friction that sticks: an elastic anchor that slips where it would pull harder than μ p.

    t = −ε_T u, |t| ≤ μ p; u is the displacement of the rod's surface from its anchor on the wall, which follows it as
    far as the limit asks and moves with the wall (Cundall & Strack 1979; return mapping of elastoplasticity).

    Args:
        mu: Coefficient of friction μ.
        eps_T: Stiffness of the anchors ε_T [N/m²]; None: that of the contact's law against penetration.

    Raises:
        SceneError: A negative coefficient, a stiffness that is not positive.
    """

    mu: float
    eps_T: float | None = None

    def __post_init__(self) -> None:
        eps_T = None if self.eps_T is None else positive(self.eps_T, "Coulomb.eps_T", "N/m²")
        assign(self, mu=nonnegative(self.mu, "Coulomb.mu"), eps_T=eps_T)


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
