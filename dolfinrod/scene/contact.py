"""Contact of rods with a rigid surface: where it is, how it pushes back, whether it rubs."""

from __future__ import annotations

from dataclasses import dataclass, field

from dolfinrod.scene.errors import SceneError, quoted
from dolfinrod.scene.friction import Coulomb, CreepingCoulomb, Friction
from dolfinrod.scene.history import History
from dolfinrod.scene.normallaw import NormalLaw
from dolfinrod.scene.pressure import AugmentedLagrangian, Penalty, SmoothPenalty
from dolfinrod.scene.quantity import assign, rod_index
from dolfinrod.scene.surfaces import SURFACES, Surface

__all__ = ["Contact"]

LAWS = (Penalty, SmoothPenalty, AugmentedLagrangian)
FRICTIONS = (Coulomb, CreepingCoulomb)


@dataclass(frozen=True)
class Contact:
    """A rigid surface that round rods cannot enter; their gap is that between the surfaces, g = φ(r) − radius.

    Args:
        surface: What they touch.
        law: How it pushes back.
        friction: How it resists sliding; None: not at all.
        rod: Number of the rod; None: every rod.

    Raises:
        SceneError: None of these.
    """

    surface: Surface
    law: NormalLaw = field(default_factory=Penalty.tight)
    friction: Friction | None = None
    rod: int | None = None

    def __post_init__(self) -> None:
        for name, value, kinds, none in (
            ("surface", self.surface, SURFACES, ""),
            ("law", self.law, LAWS, ""),
            ("friction", self.friction, (*FRICTIONS, type(None)), " or None"),
        ):
            if not isinstance(value, kinds):
                known = ", ".join(kind.__name__ for kind in kinds if kind is not type(None))
                raise SceneError(f"must be one of {known}{none}, got {quoted(value)}", field=f"Contact.{name}")
        assign(self, rod=rod_index(self.rod, "Contact.rod"))

    @property
    def history(self) -> History:
        """Of the motion of the surface; None where it has none."""
        motion = self.surface.motion
        return None if motion is None else motion.history
