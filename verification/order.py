"""Observed orders of convergence."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from verification.case import Case

__all__ = ["FLOOR", "Order", "floor_of", "order"]

# Relative errors below this are round-off and what the references leave open; no order can be read off them.
FLOOR = 1e-13


@dataclass(frozen=True)
class Order:
    """A power of the element length.

    Args:
        observed: Between the two finest meshes above the floor; None where fewer are.
        theory: What it should be.
        meshes: Those two.
        worst: Largest error of the sequence.
    """

    observed: float | None
    theory: int
    meshes: tuple[int, int] | None
    worst: float


def order(errors: Sequence[float], meshes: Sequence[int], theory: int, floor: float = FLOOR) -> Order:
    """Observed order log(e_i/e_j) / log(n_j/n_i) between the two finest neighbours that round-off leaves alone.

    Args:
        errors: Relative errors, coarse to fine.
        meshes: Numbers of elements.
        theory: What is expected.
        floor: Relative error below which round-off or the reference hides the model's own.

    Returns:
        The order.
    """
    known = [(n, e) for n, e in zip(meshes, errors, strict=True) if np.isfinite(e)]
    pairs = [(a, b) for a, b in pairwise(known) if min(a[1], b[1]) > floor]
    worst = max((e for _, e in known), default=np.nan)
    if not pairs:
        return Order(None, theory, None, worst)
    (n, e), (finer, smaller) = pairs[-1]
    return Order(float(np.log(e / smaller) / np.log(finer / n)), theory, (n, finer), worst)


def floor_of(case: Case) -> float:
    """Relative error below which round-off or the reference's own error hides the model's.

    Args:
        case: With its reference.

    Returns:
        The largest of `FLOOR`, what two computations of the reference differ by, and two digits beyond those trusted,
        which are put with care.
    """
    reference = case.reference
    beyond = 10.0 ** -(reference.digits_trusted + 2) * float(np.linalg.norm(reference.value))
    return max(FLOOR, reference.agreement / case.length, beyond / case.length)
