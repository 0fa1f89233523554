"""How the scene moves on."""

from __future__ import annotations

from dataclasses import dataclass

from dolfinrod.scene.quantity import assign, count, positive

__all__ = ["Static"]


@dataclass(frozen=True)
class Static:
    """Equilibrium at every pseudo-time from 0 to `t_end`; neither mass nor inertia.

    Args:
        steps: Equal load steps; None: the whole load first, halved on failure.
        t_end: Where the pseudo-time ends; proportional loads are full there.

    Raises:
        SceneError: Not a whole number of steps, or no positive time.
    """

    steps: int | None = None
    t_end: float = 1.0

    def __post_init__(self) -> None:
        assign(
            self,
            steps=None if self.steps is None else count(self.steps, "Static.steps"),
            t_end=positive(self.t_end, "Static.t_end"),
        )
