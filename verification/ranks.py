"""The same answer from one rank and from two, and what two cost where there is little to share."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from verification.bundles import SAME
from verification.processes import said

__all__ = ["RankRow", "compared"]

RUN = "verification.ranksrun"


@dataclass(frozen=True)
class RankRow:
    """One kind of scene on one rank and on two.

    Args:
        name: Under which it is asked for.
        title: In words.
        apart: Largest difference of what was found, over the largest of it.
        seconds: Of a warm call, by the clock [s].
        failure: Why one ended early; empty: none did.
    """

    name: str
    title: str
    apart: float
    seconds: tuple[float, float]
    failure: str = ""

    @property
    def words(self) -> str:
        """How far they are apart."""
        return f"{self.title} on two ranks: {self.failure or f'answers differ by {self.apart:.1e}, at most {SAME:g}'}"

    @property
    def holds(self) -> bool:
        """The same answer."""
        return not self.failure and self.apart <= SAME


def compared(kind: str, title: str) -> RankRow:
    """One kind of `rankscenes.KINDS`, in processes of its own."""
    one, two = (said(RUN, (kind,), ranks) for ranks in (1, 2))
    if failure := one.get("failure", "") or two.get("failure", ""):
        return RankRow(kind, title, np.nan, (np.nan, np.nan), failure)
    a, b = (np.array(told["found"]) for told in (one, two))
    if a.shape != b.shape:
        return RankRow(kind, title, np.inf, (one["seconds"], two["seconds"]), "they do not find as many numbers")
    return RankRow(kind, title, float(np.abs(a - b).max() / np.abs(a).max()), (one["seconds"], two["seconds"]))
