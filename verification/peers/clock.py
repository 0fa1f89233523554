"""Seconds of our models, taken as those of the others are: of the steps alone, warm, the quickest of some."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from dolfinrod.result import Result

__all__ = ["quickest"]


def quickest(solve: Callable[[], Result], repeats: int, budget: float) -> float:
    """The least of some repetitions.

    Args:
        solve: Solves it, everything warm.
        repeats: Of which at most so many.
        budget: After so many seconds there are none any more, but two where as many were asked for [s].

    Returns:
        Seconds of its steps [s].
    """
    spent: list[float] = []
    until = time.perf_counter() + budget
    while len(spent) < repeats and (len(spent) < min(2, repeats) or time.perf_counter() < until):
        spent.append(solve().statistics.seconds_solve)
    return min(spent)
