"""Audit of contact: whether the ledger of a motion closes, what its steps made or took, how deep rods were."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.result import Result

    Array = NDArray[np.float64]

__all__ = ["audit", "deepest_of"]

STORED = ("kinetic", "strain", "potential", "contact")
# Works that may bring energy in, and those that only take it or are the steps' own.
BRINGING = ("load work", "support work", "drag", "wall work")
WORKS = (*BRINGING, "friction", "damping", "numerical")


def audit(energy: dict[str, Array]) -> tuple[float, float, float]:
    """Gap of a ledger, and energies that the steps took and made.

    Args:
        energy: As the result of a motion with contacts has it.

    Returns:
        Gap |Δstored − works| over the largest entry; what the steps had taken at the end, and most that they had made
        at any time, over all that went in: what was there at the start and every positive work.
    """
    since = {name: energy[name] - energy[name][0] for name in (*STORED, *WORKS)}
    start = float(sum(energy[name][0] for name in ("kinetic", "strain", "contact")))
    least = float(np.finfo(float).tiny)
    gap = float(np.abs(sum(since[name] for name in STORED) - sum(since[name] for name in WORKS)).max())
    largest = max(start, least, *(float(np.abs(entry).max()) for entry in since.values()))
    brought = sum(float(np.maximum(np.diff(energy[name]), 0.0).sum()) for name in BRINGING)
    falls = float(np.maximum(-since["potential"], 0.0).max())
    supplied = max(start + brought + falls, least)
    made = since["numerical"]
    return gap / largest, -float(made[-1]) / supplied, float(made.max()) / supplied


def deepest_of(result: Result) -> float:
    """How far rods came into one another at any stored time, over the sum of their radii; NaN where none met."""
    radius = np.array([np.nan if rod.section.radius is None else rod.section.radius for rod in result.scene.rods])
    depths = [
        -met.gap / (radius[met.rod_a] + radius[met.rod_b]) for contact in result.meetings for met in contact.times
    ]
    return float(max((depth.max() for depth in depths if len(depth)), default=np.nan))
