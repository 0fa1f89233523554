"""How the scene moves on."""

from __future__ import annotations

from dataclasses import dataclass

from dolfinrod.scene.errors import SceneError
from dolfinrod.scene.quantity import assign, count, positive

__all__ = ["Static"]

MOST_STEPS = 1_000_000
# Beyond these a fraction of the time is no longer told from nothing, or from infinity.
SHORTEST, LONGEST = 1e-100, 1e100


@dataclass(frozen=True)
class Static:
    """Equilibrium at every pseudo-time from 0 to `t_end`; neither mass nor inertia.

    Args:
        steps: Equal load steps; None: the whole load first, halved on failure.
        t_end: Where the pseudo-time ends; proportional loads are full there.

    Raises:
        SceneError: Not a whole number of steps, more than a million of them, or no positive time.
    """

    steps: int | None = None
    t_end: float = 1.0

    def __post_init__(self) -> None:
        t_end = positive(self.t_end, "Static.t_end")
        if not SHORTEST <= t_end <= LONGEST:
            raise SceneError(f"must lie between {SHORTEST} and {LONGEST}, got {t_end}", field="Static.t_end")
        steps = None if self.steps is None else count(self.steps, "Static.steps", MOST_STEPS)
        assign(self, steps=steps, t_end=t_end)
