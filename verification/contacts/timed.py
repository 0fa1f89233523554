"""Steppers at work on contact cases, in ever more time steps."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from verification.contactcase import ContactRun

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from dolfinrod.result import Result
    from dolfinrod.scene import Dynamic, Scene
    from verification.stepper import Stepper

__all__ = ["in_time"]


def in_time(
    stepper: Stepper,
    scene: Callable[[Dynamic], Scene],
    t_end: float,
    levels: tuple[int, ...],
    *,
    output: Sequence[float] | None = None,
    limit: float | None = None,
    order: float | None = None,
    quick: bool = False,
) -> ContactRun:
    """A motion in more and more steps.

    Args:
        stepper: The model.
        scene: The problem, moved on as given.
        t_end: When it ends [s].
        levels: Numbers of steps, ascending.
        output: Times stored [s]; None: the last.
        limit: Largest error allowed on the last level.
        order: Least order between the last two.
        quick: Whether a quick report takes it.
    """
    solve = partial(moved, stepper, scene, t_end, (t_end,) if output is None else tuple(output))
    label = f"{stepper.name}, {stepper.mesh} element{'s' if stepper.mesh != '1' else ''}"
    return ContactRun(stepper.family, label, solve, levels, "steps", limit, order, quick)


def moved(
    stepper: Stepper, scene: Callable[[Dynamic], Scene], t_end: float, output: tuple[float, ...], steps: int
) -> Result:
    """The motion in so many steps."""
    return stepper.solve(scene(stepper.motion(t_end, steps, output)))
