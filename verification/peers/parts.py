"""What the seconds of our models are spent on, from a solve of its own in which every part is timed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from verification.bundlerun import Watch
from verification.limitrun import CONTINUUM, DISCRETE

if TYPE_CHECKING:
    from collections.abc import Callable

    from dolfinrod.result import Result

__all__ = ["parts_of"]

WORDS = {
    "assembly": "residual and tangent of the elements",
    "factors": "factors and solution",
    "petsc": "PETSc's loop",
    "python": "Newton's method but for these",
}
REST = "what a step does beside Newton's method"


def parts_of(family: str, solve: Callable[[], Result]) -> tuple[tuple[str, float], ...]:
    """Parts of the seconds of its steps, the largest first; they sum to one.

    Args:
        family: "continuum" or "discrete".
        solve: Solves it, everything warm.

    Returns:
        Words and part of each; what takes no time is left out.
    """
    with Watch() as watch:
        for part in DISCRETE if family == "discrete" else CONTINUUM:
            watch.time(*part)
        result = solve()
    taken = {WORDS[name]: seconds for name, seconds in watch.seconds.items()}
    taken[REST] = max(result.statistics.seconds_solve - sum(taken.values()), 0.0)
    whole = sum(taken.values())
    return tuple(sorted(((words, s / whole) for words, s in taken.items() if s > 0.0), key=lambda one: -one[1]))
