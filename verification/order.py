"""Observed orders of convergence."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

__all__ = ["FLOOR", "Order", "order"]

# Relative errors below this are round-off and what the references leave open; no order can be read off them.
FLOOR = 1e-13


@dataclass(frozen=True)
class Order:
    """A power of the element length.

    Args:
        observed: Between the two finest meshes above `FLOOR`; None where fewer are.
        theory: What it should be.
        meshes: Those two.
        worst: Largest error of the sequence.
    """

    observed: float | None
    theory: int
    meshes: tuple[int, int] | None
    worst: float


def order(errors: Sequence[float], meshes: Sequence[int], theory: int) -> Order:
    """Observed order log(e_i/e_j) / log(n_j/n_i) between the two finest neighbours that round-off leaves alone.

    Args:
        errors: Relative errors, coarse to fine.
        meshes: Numbers of elements.
        theory: What is expected.

    Returns:
        The order.
    """
    known = [(n, e) for n, e in zip(meshes, errors, strict=True) if np.isfinite(e)]
    pairs = [(a, b) for a, b in pairwise(known) if min(a[1], b[1]) > FLOOR]
    worst = max((e for _, e in known), default=np.nan)
    if not pairs:
        return Order(None, theory, None, worst)
    (n, e), (finer, smaller) = pairs[-1]
    return Order(float(np.log(e / smaller) / np.log(finer / n)), theory, (n, finer), worst)
