"""Contact of rods with rods, and of a rod with itself: how they push each other apart, whether they rub."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from dolfinrod.scene.errors import SceneError, quoted
from dolfinrod.scene.friction import Coulomb
from dolfinrod.scene.pressure import Penalty, SmoothPenalty
from dolfinrod.scene.quantity import assign, listed, rod_index

__all__ = ["RodContact"]


@dataclass(frozen=True)
class RodContact:
    """Round rods that cannot enter one another, nor themselves; their gap is g = |r_A − r_B| − radius_A − radius_B.

    Neighbours along one rod, closer than π (radius_A + radius_B) of arc, do not count: a loop must close to touch.

    Args:
        law: How they push each other apart.
        friction: How they resist sliding along and around each other; None: not at all.
        rods: Numbers of the rods among which contact is looked for; None: all.

    Raises:
        SceneError: None of these.
    """

    law: Penalty | SmoothPenalty = field(default_factory=Penalty.tight)
    friction: Coulomb | None = None
    rods: Sequence[int] | None = None

    def __post_init__(self) -> None:
        if not isinstance(self.law, Penalty | SmoothPenalty):
            raise SceneError(f"must be one of Penalty, SmoothPenalty, got {quoted(self.law)}", field="RodContact.law")
        if not isinstance(self.friction, Coulomb | None):
            raise SceneError(f"must be Coulomb or None, got {quoted(self.friction)}", field="RodContact.friction")
        assign(self, rods=None if self.rods is None else _numbers(self.rods))

    def among(self, n_rods: int) -> tuple[int, ...]:
        """Numbers of the rods of a scene of n_rods among which contact is looked for, ascending."""
        return tuple(range(n_rods)) if self.rods is None else tuple(self.rods)


def _numbers(rods: object) -> tuple[int, ...]:
    """Numbers of rods, ascending, each once."""
    name = "RodContact.rods"
    given = listed(rods)
    if not given:
        raise SceneError(f"must be numbers of rods (0, 1, …) or None for all, got {quoted(rods)}", field=name)
    numbers = [rod_index(k, f"{name}[{i}]") for i, k in enumerate(given)]
    found = sorted(k for k in numbers if k is not None)
    if len(found) < len(numbers) or len(set(found)) < len(found):
        raise SceneError(f"must be numbers of rods, each named once, got {quoted(rods)}", field=name)
    return tuple(found)
