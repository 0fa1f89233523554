"""Rods on rigid surfaces as cases: how models take them on finer and finer levels, and what should come out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from verification.case import Array
    from verification.references.moving import Moving

__all__ = ["ContactCase", "ContactRun"]


@dataclass(frozen=True)
class ContactRun:
    """A model, and the levels on which it takes a case.

    Args:
        model: "continuum" or "discrete".
        label: What stays the same on all levels, such as "P3, planar".
        solve: The case solved on a level.
        levels: Ascending.
        unit: What a level counts, such as "elements" or "steps".
        limit: Largest error allowed on the last level; None: only the order is asked for.
        order: Least order that must show between the last two levels; None: none is asked for.
        quick: Whether a quick report takes it.
    """

    model: str
    label: str
    solve: Callable[[int], Result] = field(repr=False)
    levels: tuple[int, ...]
    unit: str = "elements"
    limit: float | None = None
    order: float | None = None
    quick: bool = False


@dataclass(frozen=True)
class ContactCase:
    """A rod that touches something, with a known answer.

    Args:
        name: Short, unique, fit for a file name.
        title: For people.
        family: "normal", "friction", "impact", "capstan" or "groove".
        reference: What the quantities should be.
        scale: By which errors are divided, one number or one a quantity, in their units.
        runs: By which models, on which levels.
        quantity: What is read off, with units.
        read: Reads it off, shape of the reference's value.
        note: One sentence where a model deviates, or where the reference holds in a limit.
    """

    name: str
    title: str
    family: str
    reference: Moving
    scale: float | tuple[float, ...]
    runs: tuple[ContactRun, ...] = field(repr=False)
    quantity: str
    read: Callable[[Result], Array] = field(repr=False)
    note: str = ""

    def error(self, result: Result) -> float:
        """Largest difference from the reference over its scale."""
        found = np.asarray(self.read(result), dtype=float)
        return float(np.abs((found - np.asarray(self.reference.value)) / np.asarray(self.scale)).max())
