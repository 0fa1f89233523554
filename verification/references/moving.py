"""What motions should come to, with provenance: tabulated in moving.json, or by a closed form."""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

__all__ = ["Moving", "exact", "moving"]


@dataclass(frozen=True)
class Moving:
    """What a motion comes to.

    Args:
        id: Under which it is tabulated, or the formula that gives it.
        value: In the units and axes of the case.
        method: How it was found.
        source: Where the method or the number comes from.
        digits_trusted: Significant digits it is good for.
    """

    id: str
    value: tuple[float, ...]
    method: str
    source: str
    digits_trusted: int


def moving(name: str, *quantities: str) -> Moving:
    """Tabulated quantities of a motion.

    Args:
        name: Id of the entry.
        quantities: Out of it, in the order in which the case reads them; none: all.

    Returns:
        The reference.
    """
    entry = _table()[name]
    chosen = quantities or tuple(entry["quantities"])
    return Moving(
        id=name,
        value=tuple(float(entry["quantities"][q]) for q in chosen),
        method=entry["method"],
        source=entry["source"],
        digits_trusted=entry["digits_trusted"],
    )


def exact(formula: str, source: str, *value: float) -> Moving:
    """What a closed form gives.

    Args:
        formula: In words.
        source: Of it.
        value: What it gives.

    Returns:
        The reference.
    """
    return Moving(id=formula, value=value, method="closed form", source=source, digits_trusted=15)


@cache
def _table() -> dict[str, dict[str, Any]]:
    found: dict[str, dict[str, Any]] = json.loads(
        files("verification.references").joinpath("moving.json").read_text("utf-8")
    )
    return found
