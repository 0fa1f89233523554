"""A motion as a case: the scene, what is read off it, what that should be, and the time steps it is taken in."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from dolfinrod.scene import Dynamic, Scene
    from verification.case import Array
    from verification.references.moving import Moving
    from verification.stepper import Stepper

__all__ = ["MotionCase", "Run", "tip"]


def tip(result: Result) -> Array:
    """End of the first rod at the last stored state."""
    return result.tip


@dataclass(frozen=True)
class Run:
    """A model on a mesh, and the time steps in which it takes a case.

    Args:
        stepper: The model.
        steps: Numbers of steps in the motion, ascending, each a multiple of the one before by the same factor.
        limit: Largest error allowed of what steps of no length would give, or of the finest steps where no order is
            sought; None: only the order is asked for.
        ordered: Whether the order of the scheme has to show.
        quick: Whether a quick run takes it.
    """

    stepper: Stepper
    steps: tuple[int, ...]
    limit: float | None = None
    ordered: bool = True
    quick: bool = False


@dataclass(frozen=True)
class MotionCase:
    """A motion with a known answer.

    Args:
        name: Short, unique, fit for a file name.
        title: For people.
        scene: The problem, moved on as given.
        t_end: When it ends [s].
        reference: What the quantity should be.
        scale: By which errors are divided, in the unit of the quantity.
        runs: By which models, in which steps.
        quantity: What is read off, with its unit.
        read: Reads it off, shape of the reference's value.
        output: Times of the states stored [s]; None: the last only.
        note: One sentence where a model deviates, or where the reference holds in a limit.
    """

    name: str
    title: str
    scene: Callable[[Dynamic], Scene] = field(repr=False)
    t_end: float
    reference: Moving
    scale: float
    runs: tuple[Run, ...] = field(repr=False)
    quantity: str = "tip position, m"
    read: Callable[[Result], Array] = field(default=tip, repr=False)
    output: tuple[float, ...] | None = None
    note: str = ""

    def solve(self, stepper: Stepper, steps: int) -> Result:
        """The motion in so many steps.

        Args:
            stepper: The model.
            steps: In the whole motion.

        Raises:
            NotConverged: A step could not be taken.
        """
        output = (self.t_end,) if self.output is None else self.output
        return stepper.solve(self.scene(stepper.motion(self.t_end, steps, output)))

    def error(self, found: Array) -> float:
        """|found − reference| / scale."""
        return float(np.linalg.norm(found - np.asarray(self.reference.value)) / self.scale)
